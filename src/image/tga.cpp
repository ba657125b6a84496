#include "tga.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace sunlit::image {
namespace {

constexpr std::size_t kHeader = 18;
constexpr int kIndexed = 1, kColor = 2, kGrey = 3,
              kEncoded = 8;  // of image types; kEncoded is added to others

std::size_t wordAt(const std::uint8_t* bytes) {
  return std::size_t{bytes[0]} | std::size_t{bytes[1]} << 8;
}

std::size_t bytesOf(int bits) {
  return static_cast<std::size_t>((bits + 7) / 8);
}

struct Header {
  explicit Header(const std::uint8_t* b)
      : id_bytes(b[0]),
        has_map(b[1] == 1),
        type(b[2] & ~kEncoded),
        encoded((b[2] & kEncoded) != 0),
        first_color(wordAt(b + 3)),
        colors(wordAt(b + 5)),
        color_bits(b[7]),
        width(wordAt(b + 12)),
        height(wordAt(b + 14)),
        pixel_bits(b[16]),
        alpha_bits(b[17] & 0x0F),
        from_right((b[17] & 0x10) != 0),
        from_top((b[17] & 0x20) != 0) {}

  std::size_t id_bytes;
  bool has_map;
  int type;
  bool encoded;
  std::size_t first_color, colors;
  int color_bits;
  std::size_t width, height;
  int pixel_bits, alpha_bits;
  bool from_right, from_top;
};

class Decoder {
 public:
  Decoder(const std::uint8_t* bytes, std::size_t size, const std::string& name)
      : header_(bytes), at_(bytes + kHeader), end_(bytes + size), name_(name) {}

  std::vector<std::uint8_t> pixels() {
    take(header_.id_bytes);
    map_ = take(header_.has_map ? header_.colors * bytesOf(header_.color_bits) : 0);
    const std::size_t all = header_.width * header_.height, pixel = bytesOf(header_.pixel_bits);
    // Before there is room for them: a packet of a byte and a pixel tells 128 pixels at most.
    const auto left = static_cast<std::size_t>(end_ - at_);
    if (header_.encoded ? all / 128 > left / (1 + pixel) : all > left / pixel) failCut();
    pixels_.resize(4 * all);
    for (std::size_t i = 0; i < all;) {  // packets may go on from row to row
      const std::size_t packet = header_.encoded ? *take(1) : 0,
                        count = std::min((packet & 0x7F) + 1, all - i);
      const std::uint8_t* from = take(pixel);
      for (std::size_t k = 0; k < count; ++k) {
        if (k > 0 && packet < 0x80) from = take(pixel);
        write(i++, from);
      }
    }
    if (header_.alpha_bits == 0) dropVoidAlpha();
    return std::move(pixels_);
  }

 private:
  [[noreturn]] void failCut() const { throw std::runtime_error(name_ + ": this TGA picture is cut off"); }

  const std::uint8_t* take(std::size_t count) {
    if (static_cast<std::size_t>(end_ - at_) < count) failCut();
    return std::exchange(at_, at_ + count);
  }

  /// Pixel `i` in the order of the file.
  void write(std::size_t i, const std::uint8_t* pixel) {
    std::size_t x = i % header_.width, y = i / header_.width;
    if (header_.from_right) x = header_.width - 1 - x;
    if (!header_.from_top) y = header_.height - 1 - y;
    std::uint8_t* const to = pixels_.data() + 4 * (y * header_.width + x);
    if (header_.type == kGrey) {
      std::fill_n(to, 3, pixel[0]);
      to[3] = header_.pixel_bits == 16 ? pixel[1] : 255;
    } else if (header_.type == kIndexed) {
      const std::size_t index = header_.pixel_bits == 8 ? pixel[0] : wordAt(pixel);
      if (index < header_.first_color || index - header_.first_color >= header_.colors)
        throw std::runtime_error(name_ + ": this TGA picture has a pixel of colour " + std::to_string(index) +
                                 ", which is none of its own");
      writeColor(map_ + (index - header_.first_color) * bytesOf(header_.color_bits), header_.color_bits, to);
    } else {
      writeColor(pixel, header_.pixel_bits, to);
    }
  }

  void writeColor(const std::uint8_t* color, int bits, std::uint8_t* to) const {
    to[3] = bits == 32 ? color[3] : 255;
    if (bits >= 24) {
      std::copy_n(color, 3, to);
      return;
    }
    const std::size_t word = wordAt(color);  // 5 bits a channel, blue lowest
    for (std::size_t c = 0; c < 3; ++c)
      to[c] = static_cast<std::uint8_t>(((word >> (5 * c) & 0x1F) * 255 + 15) / 31);
    if (header_.alpha_bits > 0 && (word & 0x8000) == 0) to[3] = 0;
  }

  /// Where the header tells of no alpha, some leave it at 0, and others write one all the same.
  void dropVoidAlpha() {
    for (std::size_t i = 3; i < pixels_.size(); i += 4) {
      if (pixels_[i] != 0) return;
    }
    for (std::size_t i = 3; i < pixels_.size(); i += 4) pixels_[i] = 255;
  }

  const Header header_;
  const std::uint8_t* at_;
  const std::uint8_t* const end_;
  const std::string& name_;
  const std::uint8_t* map_ = nullptr;
  std::vector<std::uint8_t> pixels_;
};

}  // namespace

std::optional<TgaSize> sizeOfTga(const std::uint8_t* bytes, std::size_t size) {
  if (size < kHeader || bytes[1] > 1 || bytes[17] >> 6 != 0) return std::nullopt;  // none is interleaved
  const Header header(bytes);
  const auto isColor = [](int bits) { return bits == 15 || bits == 16 || bits == 24 || bits == 32; };
  const bool small = header.pixel_bits == 8 || header.pixel_bits == 16;
  const bool known = header.type == kColor
                         ? isColor(header.pixel_bits)
                         : small && (header.type == kGrey || (header.type == kIndexed && header.has_map));
  if (!known || (header.has_map && !isColor(header.color_bits)) || header.width == 0 || header.height == 0)
    return std::nullopt;
  return TgaSize{static_cast<int>(header.width), static_cast<int>(header.height)};
}

std::vector<std::uint8_t> decodeTga(const std::uint8_t* bytes, std::size_t size, const std::string& name) {
  return Decoder(bytes, size, name).pixels();
}

}  // namespace sunlit::image
