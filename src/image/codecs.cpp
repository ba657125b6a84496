#include "sunlit/image/codecs.h"

#include <limits>

#include "codecs_by_opencv.h"
#include "sunlit/quantity/late_library.h"

namespace sunlit::image {
namespace {

const Codecs& codecs() {
  static const Codecs& loaded = *functionIn<decltype(sunlitCodecs)>("libsunlit_codecs.so", "sunlitCodecs")();
  return loaded;
}

}  // namespace

cv::Mat decodePicture(const std::uint8_t* bytes, std::size_t size, int flags) {
  if (size == 0 || size > static_cast<std::size_t>(std::numeric_limits<int>::max())) return {};
  return codecs().decode({1, static_cast<int>(size), CV_8UC1, const_cast<std::uint8_t*>(bytes)}, flags);
}

bool isDamagedJpeg(const std::uint8_t* bytes, std::size_t size) {
  return codecs().isDamagedJpeg(bytes, size);
}

std::vector<std::uint8_t> encodePicture(const std::string& ending, const cv::Mat& pixels,
                                        const std::vector<int>& parameters) {
  std::vector<std::uint8_t> bytes;
  if (!codecs().encode(ending, pixels, parameters, &bytes)) bytes.clear();
  return bytes;
}

}  // namespace sunlit::image
