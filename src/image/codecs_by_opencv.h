/// What libsunlit_codecs.so, which links to OpenCV's codecs, has for libsunlit_image.so, which does not.
#pragma once

#include <cstddef>
#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <string>
#include <vector>

namespace sunlit::image {

struct Codecs {
  cv::Mat (*decode)(const cv::Mat& bytes, int flags);
  bool (*encode)(const std::string& ending, const cv::Mat& pixels, const std::vector<int>& parameters,
                 std::vector<std::uint8_t>* bytes);
  bool (*isDamagedJpeg)(const std::uint8_t* bytes, std::size_t size);
};

}  // namespace sunlit::image

extern "C" const sunlit::image::Codecs* sunlitCodecs();
