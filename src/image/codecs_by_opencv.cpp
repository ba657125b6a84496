#include "codecs_by_opencv.h"

#include "damaged_jpeg.h"

#include <cctype>
#include <cstdint>
#include <opencv2/imgcodecs.hpp>
#include <vector>

namespace sunlit::image {
namespace {

/// A Netpbm picture of text whose last number is followed by nothing, which OpenCV wants.
bool endsWithItsNumber(const cv::Mat& bytes) {
  const auto* const data = bytes.ptr<std::uint8_t>();
  const std::size_t size = bytes.total();
  return size > 2 && data[0] == 'P' && data[1] >= '1' && data[1] <= '3' && std::isdigit(data[size - 1]) != 0;
}

cv::Mat decode(const cv::Mat& bytes, int flags) {
  if (!endsWithItsNumber(bytes)) return cv::imdecode(bytes, flags);
  std::vector<std::uint8_t> ended(bytes.datastart, bytes.dataend);
  ended.push_back('\n');
  return cv::imdecode(ended, flags);
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
