#include "sunlit/image/texture_files.h"

#include <algorithm>
#include <cstring>
#include <fstream>
#include <iterator>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <stdexcept>
#include <vector>

namespace sunlit::image {
namespace {

/// Any depth to 8 bit: the full range of the type is mapped to 0 … 255.
cv::Mat toEightBit(const cv::Mat& decoded, const std::string& name) {
  cv::Mat eight_bit;
  switch (decoded.depth()) {
    case CV_8U:
      return decoded;
    case CV_16U:
      decoded.convertTo(eight_bit, CV_8U, 255.0 / 65535.0);
      return eight_bit;
    case CV_32F:
      decoded.convertTo(eight_bit, CV_8U, 255.0);
      return eight_bit;
    default:
      throw std::runtime_error(name + ": a texture must have 8 or 16 bits, or floats, a channel");
  }
}

/// The bytes of a PNG file without its colour profile: textures are sRGB whatever it says, and libpng prints
/// a line about each profile that it does not like. Anything else comes back as it is.
std::vector<std::uint8_t> withoutProfile(const std::uint8_t* bytes, std::size_t size) {
  constexpr std::size_t kSignature = 8;
  constexpr std::size_t kAroundData = 12;  // length, name and checksum of a chunk
  const std::uint8_t signature[kSignature] = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1A, '\n'};
  if (size < kSignature || !std::equal(signature, signature + kSignature, bytes))
    return {bytes, bytes + size};
  std::vector<std::uint8_t> kept(bytes, bytes + kSignature);
  std::size_t at = kSignature;
  while (at + kAroundData <= size) {
    const std::size_t data = std::size_t{bytes[at]} << 24 | std::size_t{bytes[at + 1]} << 16 |
                             std::size_t{bytes[at + 2]} << 8 | std::size_t{bytes[at + 3]};
    const std::size_t end = std::min(size, at + kAroundData + data);
    if (std::memcmp(bytes + at + 4, "iCCP", 4) != 0) kept.insert(kept.end(), bytes + at, bytes + end);
    at = end;
  }
  kept.insert(kept.end(), bytes + at, bytes + size);
  return kept;
}

}  // namespace

Rgba8Image decodeRgba(const std::uint8_t* bytes, std::size_t size, const std::string& name) {
  cv::Mat decoded;
  const std::vector<std::uint8_t> kept = withoutProfile(bytes, size);
  if (!kept.empty()) {
    const cv::Mat input(1, static_cast<int>(kept.size()), CV_8UC1, const_cast<std::uint8_t*>(kept.data()));
    try {
      decoded = cv::imdecode(input, cv::IMREAD_UNCHANGED);
    } catch (const cv::Exception& error) {
      throw std::runtime_error(name + ": cannot decode this picture (" + error.err + ")");
    }
  }
  if (decoded.empty()) {
    throw std::runtime_error(name +
                             ": cannot decode this picture; PNG, JPEG, BMP, TIFF and WebP are understood");
  }
  const cv::Mat eight_bit = toEightBit(decoded, name);
  Rgba8Image picture(eight_bit.cols, eight_bit.rows);
  cv::Mat rgba(eight_bit.rows, eight_bit.cols, CV_8UC4, picture.data.data());
  switch (eight_bit.channels()) {
    case 1:
      cv::cvtColor(eight_bit, rgba, cv::COLOR_GRAY2RGBA);
      break;
    case 3:
      cv::cvtColor(eight_bit, rgba, cv::COLOR_BGR2RGBA);
      break;
    case 4:
      cv::cvtColor(eight_bit, rgba, cv::COLOR_BGRA2RGBA);
      break;
    default:
      throw std::runtime_error(name + ": a texture must have 1, 3 or 4 channels");
  }
  return picture;
}

Rgba8Image readRgba(const std::string& file) {
  std::ifstream stream(file, std::ios::binary);
  const std::vector<char> bytes{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  if (!stream.is_open() || stream.bad()) throw std::runtime_error(file + ": cannot read this picture");
  return decodeRgba(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size(), file);
}

std::string encodePng(const Rgba8Image& picture) {
  const cv::Mat rgba(picture.height, picture.width, CV_8UC4, const_cast<std::uint8_t*>(picture.data.data()));
  std::vector<std::uint8_t> bytes;
  cv::Mat bgra;
  if (!picture.data.empty()) cv::cvtColor(rgba, bgra, cv::COLOR_RGBA2BGRA);
  if (bgra.empty() || !cv::imencode(".png", bgra, bytes)) {
    throw std::runtime_error("cannot write a picture of " + std::to_string(picture.width) + " × " +
                             std::to_string(picture.height) + " px as PNG");
  }
  return {bytes.begin(), bytes.end()};
}

}  // namespace sunlit::image
