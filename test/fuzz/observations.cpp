// What a run found in its pictures, in one file.
#include <cstring>
#include <opencv2/core.hpp>

#include "fuzz/reader.h"
#include "sunlit/evaluate/localise/observations.h"
#include "support/temporary_folder.h"

namespace sunlit::fuzz {
namespace {

std::string fileOf(int type) {
  const TemporaryFolder folder;
  {
    evaluate::ObservationFile file(folder.file("seed"));
    for (int i = 0; i < 2; ++i) {
      evaluate::Observation one;
      one.camera = image::PinholeCamera::fromFieldOfView(64, 48, Angle::degrees(60.0));
      one.features.key_points = {cv::KeyPoint(3.0F, 4.0F, 1.0F), cv::KeyPoint(5.0F, 6.0F, 1.0F)};
      one.features.descriptors = cv::Mat::ones(2, 4, type);
      one.points.assign(2, Eigen::Vector3d(1.0, 2.0, 3.0));
      file.add({"h04", "sift", i, 1000 + i}, one);
    }
  }
  return contentOf(folder.file("seed"));
}

}  // namespace

std::vector<std::string> seeds() {
  return {fileOf(CV_32F), fileOf(CV_8U)};
}

void read(const std::string& input) {
  setContent("./input.bin", input);
  const evaluate::ObservationFile file("input.bin");
  for (std::size_t i = 0; i < file.keys().size(); ++i) {
    file.head(i);
    const evaluate::Observation one = file.read(i);
    if (one.features.descriptors.rows != static_cast<int>(one.features.key_points.size()) ||
        (!one.points.empty() && one.points.size() != one.features.key_points.size()))
      throw std::logic_error("an observation whose parts do not fit was read");
  }
}

std::string named() {
  return "input.bin";
}

}  // namespace sunlit::fuzz
