// Calibrations of cameras, and what their lenses do with a picture's pixels.
#include "sunlit/image/calibration.h"
#include "fuzz/reader.h"
#include "support/temporary_folder.h"

namespace sunlit::fuzz {

std::vector<std::string> seeds() {
  return {contentOf(SUNLIT_SOURCE_DIR "/test/support/cameras/euroc.yaml"),
          contentOf(SUNLIT_SOURCE_DIR "/test/support/cameras/tum_vi.yaml")};
}

void read(const std::string& input) {
  setContent("./input.yaml", input);
  const image::Calibration calibration = image::readCalibration("input.yaml");
  const image::Lens lens(calibration.camera, calibration.distortion);
  for (const double share : {0.0, 0.37, 1.0}) {
    const Eigen::Vector2d pixel(share * (calibration.camera.width - 1),
                                share * (calibration.camera.height - 1));
    if (const auto ray = lens.unproject(pixel)) static_cast<void>(lens.project(*ray));
  }
}

std::string named() {
  return "input.yaml";
}

}  // namespace sunlit::fuzz
