#include "codecs_by_opencv.h"

#include "damaged_jpeg.h"

#include <opencv2/imgcodecs.hpp>

namespace sunlit::image {
namespace {

cv::Mat decode(const cv::Mat& bytes, int flags) {
  return cv::imdecode(bytes, flags);
}

bool encode(const std::string& ending, const cv::Mat& pixels, const std::vector<int>& parameters,
            std::vector<std::uint8_t>* bytes) {
  return cv::imencode(ending, pixels, *bytes, parameters);
}

}  // namespace
}  // namespace sunlit::image

const sunlit::image::Codecs* sunlitCodecs() {
  static const sunlit::image::Codecs codecs{sunlit::image::decode, sunlit::image::encode,
                                            sunlit::image::damagedJpeg};
  return &codecs;
}
