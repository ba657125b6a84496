/// Picture files to and from matrices, by OpenCV's codecs. These bring a hundred libraries along, of formats
/// that few have heard of, and are loaded by the first call: whoever meets no picture starts in a third of
/// the time.
#pragma once

#include <cstddef>
#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <string>
#include <vector>

namespace sunlit::image {

/// As cv::imdecode() of these bytes: channels are blue, green, red; empty where no codec takes them. Throws
/// cv::Exception as that does, and std::runtime_error where the codecs cannot be loaded.
cv::Mat decodePicture(const std::uint8_t* bytes, std::size_t size, int flags);

/// Whether data within these bytes of a JPEG do not mean what they should: what a decoder makes of the rest
/// of the picture then is anybody's guess, and OpenCV's gives no sign of it. Not every damage shows. Bytes
/// without meaning between the parts, which some cameras leave, are none. Throws std::runtime_error as above.
bool isDamagedJpeg(const std::uint8_t* bytes, std::size_t size);

/// As cv::imencode() for files of `ending`, such as ".png"; empty where that fails. Throws as above.
std::vector<std::uint8_t> encodePicture(const std::string& ending, const cv::Mat& pixels,
                                        const std::vector<int>& parameters = {});

}  // namespace sunlit::image
