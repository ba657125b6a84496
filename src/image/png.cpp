#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <stdexcept>
#include <vector>

#include "png_chunks.h"
#include "sunlit/image/codecs.h"
#include "sunlit/image/encoded_size.h"
#include "sunlit/image/files.h"
#include "sunlit/image/texture_files.h"
#include "sunlit/quantity/range.h"

namespace sunlit::image {

namespace {

/// The pixels of `picture` as a matrix of this type, not copied; it must not be empty.
template <typename Value, int kChannels>
cv::Mat matOf(const Picture<Value, kChannels>& picture, int type) {
  require("width of the picture", picture.width, Range::atLeast(1), "px");
  require("height of the picture", picture.height, Range::atLeast(1), "px");
  return {picture.height, picture.width, type, const_cast<Value*>(picture.data.data())};
}

/// Of channels in OpenCV's order.
std::string encoded(const cv::Mat& channels) {
  // Level 3 is near the knee of size against time for rendered pictures.
  const std::vector<std::uint8_t> bytes = encodePicture(".png", channels, {cv::IMWRITE_PNG_COMPRESSION, 3});
  if (bytes.empty()) throw std::runtime_error("PNG encoder failed");
  return {bytes.begin(), bytes.end()};
}

}  // namespace

std::string encodePng(const Rgb8Image& picture) {
  cv::Mat bgr;
  cv::cvtColor(matOf(picture, CV_8UC3), bgr, cv::COLOR_RGB2BGR);
  return encoded(bgr);
}

void writePng(const std::string& path, const Rgb8Image& picture) {
  writeFileAtomically(path, encodePng(picture));
}
void writePng(const std::string& path, const Grey8Image& picture) {
  writeFileAtomically(path, encoded(matOf(picture, CV_8UC1)));
}
void writePng(const std::string& path, const Grey16Image& picture) {
  writeFileAtomically(path, encoded(matOf(picture, CV_16UC1)));
}

namespace {

const std::uint8_t* beginOf(const std::string& bytes) {
  return reinterpret_cast<const std::uint8_t*>(bytes.data());
}

// Decoders fill what a cut-off file lacks with black or grey, and what is damaged with anything.
void requireWhole(const std::string& bytes, const std::string& path) {
  const std::optional<EncodedPicture> encoded = encodedPicture(beginOf(bytes), bytes.size());
  if (encoded ? encoded->is_cut_short : isPng(beginOf(bytes), bytes.size()))
    throw std::runtime_error(path + ": read: the file is cut off");
  if (encoded && encoded->is_lossy && isDamagedJpeg(beginOf(bytes), bytes.size()))
    throw std::runtime_error(path + ": read: damaged JPEG");
}

/// As `flags` of cv::imdecode() have it; not empty.
cv::Mat decodedPng(const std::string& path, int flags) {
  const std::string bytes = readWholeFile(path);
  if (!isPng(beginOf(bytes), bytes.size())) throw std::runtime_error(path + ": read: not a PNG file");
  requireWhole(bytes, path);
  cv::Mat decoded;
  try {
    decoded = decodePicture(beginOf(bytes), bytes.size(), flags);
  } catch (const cv::Exception& error) {
    throw std::runtime_error(path + ": read: " + error.what());
  }
  if (decoded.empty()) {
    throw std::runtime_error(path + ": read: damaged PNG");
  }
  return decoded;
}

}  // namespace

Rgb8Image readPng(const std::string& path) {
  const cv::Mat decoded = decodedPng(path, cv::IMREAD_ANYDEPTH | cv::IMREAD_COLOR);
  if (decoded.depth() != CV_8U) {
    throw std::runtime_error(path + ": read: more than 8 bits a channel");
  }
  Rgb8Image picture(decoded.cols, decoded.rows);
  cv::Mat rgb(picture.height, picture.width, CV_8UC3, picture.data.data());
  cv::cvtColor(decoded, rgb, cv::COLOR_BGR2RGB);
  return picture;
}

Grey16Image readGrey16Png(const std::string& path) {
  const cv::Mat decoded = decodedPng(path, cv::IMREAD_UNCHANGED);
  if (decoded.type() != CV_16UC1) {
    throw std::runtime_error(path + ": read: not one channel of 16 bits");
  }
  Grey16Image picture(decoded.cols, decoded.rows);
  decoded.copyTo(cv::Mat(picture.height, picture.width, CV_16UC1, picture.data.data()));
  return picture;
}

Rgb8Image readPhotograph(const std::string& path) {
  const std::string bytes = readWholeFile(path);
  requireWhole(bytes, path);
  Rgba8Image decoded = decodeRgba(beginOf(bytes), bytes.size(), path);
  Rgb8Image picture(decoded.width, decoded.height);
  const cv::Mat rgba(decoded.height, decoded.width, CV_8UC4, decoded.data.data());
  cv::Mat rgb(picture.height, picture.width, CV_8UC3, picture.data.data());
  cv::cvtColor(rgba, rgb, cv::COLOR_RGBA2RGB);
  return picture;
}

}  // namespace sunlit::image
