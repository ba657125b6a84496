#include "sunlit/image/texture_files.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>
#include <limits>
#include <mutex>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

#include "png_chunks.h"
#include "sunlit/image/codecs.h"
#include "sunlit/image/encoded_size.h"
#include "sunlit/image/files.h"
#include "tga.h"
#include "tiff_no_data.h"

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
    default:
      throw std::runtime_error(name + ": a texture must have 8 or 16 bits a channel");
  }
}

/// The bytes of a PNG file without its colour profile: textures are sRGB whatever it says, and libpng prints
/// a line about each profile that it does not like. Anything else comes back as it is.
std::vector<std::uint8_t> withoutProfile(const std::uint8_t* bytes, std::size_t size) {
  if (!isPng(bytes, size)) return {bytes, bytes + size};
  std::size_t at = kPngSignature.size();
  std::vector<std::uint8_t> kept(bytes, bytes + at);
  while (const std::optional<PngChunk> chunk = pngChunkAt(at, bytes, size)) {
    if (chunk->name != "iCCP") kept.insert(kept.end(), bytes + at, bytes + chunk->end);
    at = chunk->end;
  }
  kept.insert(kept.end(), bytes + at, bytes + size);
  return kept;
}

struct Size {
  std::int64_t width = 0;
  std::int64_t height = 0;

  std::int64_t longest() const { return std::max(width, height); }
};

std::int64_t littleEndian(const std::uint8_t* bytes) {
  return std::int64_t{bytes[3]} << 24 | std::int64_t{bytes[2]} << 16 | std::int64_t{bytes[1]} << 8 | bytes[0];
}

/// As the first bytes tell it; 0 × 0 where they do not.
Size sizeInHeader(const std::uint8_t* bytes, std::size_t size) {
  if (const std::optional<EncodedPicture> picture = encodedPicture(bytes, size))
    return {picture->width, picture->height};
  if (size >= 26 && bytes[0] == 'B' && bytes[1] == 'M') {
    const auto height = static_cast<std::int32_t>(littleEndian(bytes + 22));  // below 0: top row first
    return {littleEndian(bytes + 18), std::abs(std::int64_t{height})};
  }
  if (const std::optional<TgaSize> tga = sizeOfTga(bytes, size)) return {tga->width, tga->height};
  return {};
}

/// As it is in the file, or, of a JPEG that is far too large, already smaller: libjpeg leaves out the finest
/// waves by itself, without ever having the whole picture.
int decodingFlags(int longest_px, const std::uint8_t* bytes, std::size_t size) {
  const std::optional<EncodedPicture> picture = encodedPicture(bytes, size);
  if (!picture || !picture->is_lossy) return cv::IMREAD_UNCHANGED;
  const std::int64_t longest = std::max(picture->width, picture->height);
  for (const auto& [divisor, flag] : {std::pair{8, cv::IMREAD_REDUCED_COLOR_8},
                                      {4, cv::IMREAD_REDUCED_COLOR_4},
                                      {2, cv::IMREAD_REDUCED_COLOR_2}}) {
    if (longest / divisor >= longest_px) return flag | cv::IMREAD_IGNORE_ORIENTATION;
  }
  return cv::IMREAD_UNCHANGED;
}

/// What the bytes are that make no texture: a format that textures have elsewhere, by what its files begin
/// with; empty for others.
std::string formatOf(const std::uint8_t* bytes, std::size_t size) {
  struct Format {
    std::size_t at;
    std::string begin;
    const char* name;
  };
  static const std::vector<Format> formats = {
      {0, "DDS ", "DDS"},      {0, "GIF8", "GIF"},       {0, "\xABKTX 20", "KTX2"}, {0, "\xABKTX 11", "KTX"},
      {0, "sB", "Basis"},      {0, "8BPS", "Photoshop"}, {4, "ftypavif", "AVIF"},   {4, "ftyphei", "HEIF"},
      {0, "gimp xcf", "GIMP"}, {0, "<svg", "SVG"},       {0, "#?", "Radiance HDR"}, {0, "v/1\x01", "OpenEXR"},
      {0, "PF", "PFM"},        {0, "Pf", "PFM"}};
  for (const Format& format : formats) {
    const std::size_t length = format.begin.size();
    if (size >= format.at + length && std::memcmp(bytes + format.at, format.begin.data(), length) == 0)
      return format.name;
  }
  return "";
}

constexpr const char* kAreRead = "PNG, JPEG, BMP, TIFF, TGA, WebP and PPM are understood";

/// What a grey PNG cuts out (ISO/IEC 15948, 11.3.2.1), in samples as OpenCV decodes them, which leaves that
/// out; nothing for other pictures. The bytes are those of a picture that it has decoded.
std::optional<int> greyCutOut(const std::vector<std::uint8_t>& bytes) {
  constexpr std::size_t kBitDepth = 24, kColorType = 25, kToData = 8, kOneLevel = 14;  // bytes
  if (!isPng(bytes.data(), bytes.size()) || bytes[kColorType] != 0) return std::nullopt;
  std::size_t at = kPngSignature.size();
  while (const std::optional<PngChunk> chunk = pngChunkAt(at, bytes.data(), bytes.size())) {
    if (chunk->name == "tRNS" && chunk->end == at + kOneLevel) {
      const int grey = bytes[at + kToData] << 8 | bytes[at + kToData + 1], full = (1 << bytes[kBitDepth]) - 1;
      return full < 255 ? (grey & full) * (255 / full) : grey & full;
    }
    at = chunk->end;
  }
  return std::nullopt;
}

/// With an alpha of 0 where `grey` is `cut_out`, else the largest.
cv::Mat withCutOut(const cv::Mat& grey, int cut_out) {
  cv::Mat alpha, picture;
  cv::compare(grey, cv::Scalar(cut_out), alpha, cv::CMP_NE);
  if (grey.depth() == CV_16U) alpha.convertTo(alpha, CV_16U, 65535.0 / 255.0);
  cv::merge(std::vector<cv::Mat>{grey, grey, grey, alpha}, picture);
  return picture;
}

cv::Mat decode(const std::uint8_t* bytes, std::size_t size, const std::string& name, int flags) {
  if (const std::optional<TgaSize> tga = sizeOfTga(bytes, size)) {
    std::vector<std::uint8_t> bgra = decodeTga(bytes, size, name);
    return cv::Mat(tga->height, tga->width, CV_8UC4, bgra.data()).clone();
  }
  cv::Mat decoded;
  const std::vector<std::uint8_t> kept = withoutProfile(bytes, size);
  if (!kept.empty()) {
    try {
      decoded = decodePicture(kept.data(), kept.size(), flags);
    } catch (const cv::Exception& error) {
      throw std::runtime_error(name + ": cannot decode this picture (" + error.err + ")");
    }
  }
  if (decoded.empty()) {
    const std::string format = formatOf(bytes, size);
    if (format.empty()) throw std::runtime_error(name + ": cannot decode this picture; " + kAreRead);
    const bool packed = format.compare(0, 3, "KTX") == 0 || format == "Basis";
    throw std::runtime_error(name + ": this is a " + format + " picture, and not read; " + kAreRead +
                             ", whatever the file's name: convert it to PNG, by " +
                             (packed ? "ktx extract or basisu -unpack" : "ImageMagick or GIMP"));
  }
  const std::optional<int> cut_out = decoded.channels() == 1 ? greyCutOut(kept) : std::nullopt;
  return cut_out ? withCutOut(decoded, *cut_out) : decoded;
}

/// Floats are amounts of light, in units that files do not tell, and no values of a display.
void requireNoFloats(const cv::Mat& decoded, const std::uint8_t* bytes, std::size_t size,
                     const std::string& name) {
  if (decoded.depth() != CV_32F && decoded.depth() != CV_64F) return;
  const std::string format = formatOf(bytes, size);
  throw std::runtime_error(name + ": this is a " + (format.empty() ? "" : format + " ") +
                           "picture of floats, and not read as a texture; " + kAreRead +
                           " with 8 or 16 bits a channel: convert it to PNG, by ImageMagick or GIMP");
}

Rgba8Image toRgba(const cv::Mat& decoded, const std::string& name) {
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

cv::Mat shrunk(const cv::Mat& decoded, int longest_px) {
  const double factor = static_cast<double>(longest_px) / std::max(decoded.cols, decoded.rows);
  const auto side = [&](int px) { return std::max(1, static_cast<int>(std::lround(factor * px))); };
  cv::Mat smaller;
  cv::resize(decoded, smaller, cv::Size(side(decoded.cols), side(decoded.rows)), 0.0, 0.0, cv::INTER_AREA);
  return smaller;
}

std::vector<std::uint8_t> contentOf(const std::string& file) {
  requireContent(file);
  std::ifstream stream(file, std::ios::binary);
  std::vector<std::uint8_t> bytes{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  if (!stream.is_open() || stream.bad()) throw std::runtime_error(file + ": cannot read this picture");
  return bytes;
}

Rgba8Image enlarged(const Rgba8Image& picture, int width, int height) {
  if (picture.width == width && picture.height == height) return picture;
  Rgba8Image large(width, height);
  const cv::Mat from(picture.height, picture.width, CV_8UC4, const_cast<std::uint8_t*>(picture.data.data()));
  cv::Mat to(height, width, CV_8UC4, large.data.data());
  cv::resize(from, to, to.size(), 0.0, 0.0, cv::INTER_LINEAR);
  return large;
}

}  // namespace

Rgba8Image decodeRgba(const std::uint8_t* bytes, std::size_t size, const std::string& name) {
  const cv::Mat decoded = decode(bytes, size, name, cv::IMREAD_UNCHANGED);
  requireNoFloats(decoded, bytes, size, name);
  return toRgba(decoded, name);
}

namespace {

/// Whether its header tells of a side longer than `longest_px`. Throws for more than kMostPixels.
bool isLarge(const Size& told, int longest_px, const std::string& name) {
  // No product: a side may be as large as 2^32.
  if (told.width > 0 && told.height > kMostPixels / told.width) {
    throw std::runtime_error(name + ": this picture has " + std::to_string(told.width) + " × " +
                             std::to_string(told.height) + " px, more than the " +
                             std::to_string(kMostPixels) + " that can be read");
  }
  return told.longest() > longest_px;
}

}  // namespace

FittedImage decodeRgbaWithin(int longest_px, const std::uint8_t* bytes, std::size_t size,
                             const std::string& name) {
  static std::mutex one_large_at_a_time;
  const Size told = sizeInHeader(bytes, size);
  std::unique_lock<std::mutex> lock(one_large_at_a_time, std::defer_lock);
  if (isLarge(told, longest_px, name)) lock.lock();
  cv::Mat decoded = decode(bytes, size, name, decodingFlags(longest_px, bytes, size));
  requireNoFloats(decoded, bytes, size, name);
  FittedImage fitted;
  fitted.width = told.width > 0 ? static_cast<int>(told.width) : decoded.cols;
  fitted.height = told.height > 0 ? static_cast<int>(told.height) : decoded.rows;
  if (std::max(decoded.cols, decoded.rows) > longest_px) decoded = shrunk(decoded, longest_px);
  fitted.picture = toRgba(decoded, name);
  return fitted;
}

FittedImage readRgbaWithin(int longest_px, const std::string& file) {
  const std::vector<std::uint8_t> bytes = contentOf(file);
  return decodeRgbaWithin(longest_px, bytes.data(), bytes.size(), file);
}

Rgba8Image coveredBy(const Rgba8Image& picture, const Rgba8Image& opacity) {
  const int width = std::max(picture.width, opacity.width), height = std::max(picture.height, opacity.height);
  bool has_alpha = false;
  for (std::size_t i = 3; i < opacity.data.size() && !has_alpha; i += 4) has_alpha = opacity.data[i] < 255;
  Rgba8Image covered = enlarged(picture, width, height);
  const Rgba8Image by = enlarged(opacity, width, height);
  for (std::size_t i = 0; i < covered.data.size(); i += 4) {
    const int sum = by.data[i] + by.data[i + 1] + by.data[i + 2];
    covered.data[i + 3] = has_alpha ? by.data[i + 3] : static_cast<std::uint8_t>((sum + 1) / 3);
  }
  return covered;
}

namespace {

/// What pixels of elevation models have where nothing was measured, beside what their files say.
class NoData {
 public:
  NoData(const std::uint8_t* bytes, std::size_t size) {
    const std::optional<double> told = tiffNoData(bytes, size);
    if (told && std::abs(*told) < kNearlyLargest) values_.push_back(static_cast<float>(*told));
  }

  bool operator()(float value) const {
    return !(std::abs(value) < kNearlyLargest) ||  // NaN, too
           std::find(values_.begin(), values_.end(), value) != values_.end();
  }

 private:
  static constexpr float kNearlyLargest = 3.4e38f;
  std::vector<float> values_ = {-9999.0f, -32768.0f, -32767.0f};
};

/// One value a pixel; NaN where any of its colours is none.
cv::Mat greyOf(const cv::Mat& decoded, const NoData& no_data) {
  const int depth = decoded.depth();
  const float full = depth == CV_8U ? 255.0f : depth == CV_16U ? 65535.0f : 1.0f;
  cv::Mat values, grey(decoded.size(), CV_32F);
  decoded.convertTo(values, CV_32F);
  const int channels = values.channels(), colors = std::min(channels, 3);
  for (int y = 0; y < values.rows; ++y) {
    const float* row = values.ptr<float>(y);
    for (int x = 0; x < values.cols; ++x) {
      float sum = 0.0f;
      for (int c = 0; c < colors; ++c) {
        const float value = row[channels * x + c];
        sum += no_data(value) ? std::numeric_limits<float>::quiet_NaN() : value / full;
      }
      grey.at<float>(y, x) = sum / static_cast<float>(colors);
    }
  }
  return grey;
}

/// Gives pixels that are NaN the lowest value of the others, or 0 where there is none. How many there were.
std::size_t fillWithLowest(cv::Mat& grey) {
  float lowest = std::numeric_limits<float>::infinity();
  const auto begin = grey.begin<float>(), end = grey.end<float>();
  std::for_each(begin, end, [&](float value) { lowest = std::min(lowest, value); });
  if (!std::isfinite(lowest)) lowest = 0.0f;
  std::size_t filled = 0;
  std::for_each(begin, end, [&](float& value) {
    if (!std::isnan(value)) return;
    value = lowest;
    ++filled;
  });
  return filled;
}

}  // namespace

GreyPicture readGreyWithin(int longest_px, const std::string& file) {
  const std::vector<std::uint8_t> bytes = contentOf(file);
  isLarge(sizeInHeader(bytes.data(), bytes.size()), longest_px, file);
  cv::Mat grey = greyOf(decode(bytes.data(), bytes.size(), file, cv::IMREAD_UNCHANGED),
                        NoData(bytes.data(), bytes.size()));
  GreyPicture read;
  read.filled = fillWithLowest(grey);
  if (std::max(grey.cols, grey.rows) > longest_px) grey = shrunk(grey, longest_px);
  read.values = Picture<float, 1>(grey.cols, grey.rows);
  grey.copyTo(cv::Mat(grey.rows, grey.cols, CV_32F, read.values.data.data()));
  return read;
}

std::string encodePng(const Rgba8Image& picture) {
  const cv::Mat rgba(picture.height, picture.width, CV_8UC4, const_cast<std::uint8_t*>(picture.data.data()));
  std::vector<std::uint8_t> bytes;
  if (!picture.data.empty()) {
    cv::Mat bgra;
    cv::cvtColor(rgba, bgra, cv::COLOR_RGBA2BGRA);
    bytes = encodePicture(".png", bgra);
  }
  if (bytes.empty()) {
    throw std::runtime_error("cannot write a picture of " + std::to_string(picture.width) + " × " +
                             std::to_string(picture.height) + " px as PNG");
  }
  return {bytes.begin(), bytes.end()};
}

}  // namespace sunlit::image
