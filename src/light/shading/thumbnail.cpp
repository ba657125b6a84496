#include "light/shading/thumbnail.h"

#include <algorithm>
#include <array>
#include <cstdint>

#include "sunlit/image/srgb.h"
#include "sunlit/scene/wrap.h"

namespace sunlit::light {
namespace {

/// A little of what is cut out counts, so that where nothing else is there is a colour, too.
constexpr float kOfHoles = 4e-6f;

/// What bytes of a texel are worth. In three parts, which are added: each knows one channel, and the first 1.
class Values {
 public:
  explicit Values(Thumbnail::Kind kind) {
    for (std::size_t byte = 0; byte < 256; ++byte) {
      const float share = static_cast<float>(byte) / 255.0f;
      const float value = kind == Thumbnail::Kind::kData ? share : image::linearOfSrgb()[byte];
      red_[byte] = {value, 0.0f, 0.0f, 1.0f};
      green_[byte] = {0.0f, value, 0.0f, 0.0f};
      blue_[byte] = {0.0f, 0.0f, value, 0.0f};
      solid_[byte] = kind == Thumbnail::Kind::kSolidColor ? share + kOfHoles : 1.0f;
    }
  }
  static const Values& of(Thumbnail::Kind kind) {
    static const Values color(Thumbnail::Kind::kColor), solid_color(Thumbnail::Kind::kSolidColor),
        data(Thumbnail::Kind::kData);
    return kind == Thumbnail::Kind::kData ? data : kind == Thumbnail::Kind::kColor ? color : solid_color;
  }

  /// r g b and 1.
  Eigen::Array4f color(const std::uint8_t* rgba) const {
    return red_[rgba[0]] + green_[rgba[1]] + blue_[rgba[2]];
  }
  float solid(const std::uint8_t* rgba) const { return solid_[rgba[3]]; }

  Eigen::Array4f sum(const std::uint8_t* rgba, int texels, Eigen::Array4f from) const {
    const std::uint8_t* const end = rgba + 4 * texels;
    for (; rgba != end; rgba += 4) from += color(rgba) * solid(rgba);
    return from;
  }

 private:
  std::array<Eigen::Array4f, 256> red_, green_, blue_;
  std::array<float, 256> solid_;
};

/// Of so many squares the first of the texels of each, and behind them the number of all texels.
std::vector<int> beginsOf(int squares, int texels) {
  std::vector<int> begins;
  for (int square = 0; square <= squares; ++square)
    begins.push_back((square * texels + squares - 1) / squares);
  return begins;
}

std::size_t numberOf(float coordinate, scene::Wrap wrap, int size) {
  const auto number = static_cast<int>(scene::wrapped(coordinate, wrap) * static_cast<float>(size));
  return static_cast<std::size_t>(std::min(number, size - 1));
}

}  // namespace

Thumbnail::Thumbnail(const scene::Texture& texture, Kind kind)
    : texture_(texture),
      kind_(kind),
      width_(std::min(texture.width, kMost)),
      height_(std::min(texture.height, kMost)),
      squares_(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_), Eigen::Array4f::Zero()) {
  const std::vector<int> columns = beginsOf(width_, texture.width), rows = beginsOf(height_, texture.height);
  const Values& values = Values::of(kind);
  const std::uint8_t* rgba = texture.rgba.data();
  Eigen::Array4f* square = squares_.data();
  for (std::size_t row = 0; row + 1 < rows.size(); ++row, square += width_) {
    for (int y = rows[row]; y < rows[row + 1]; ++y) {
      for (std::size_t column = 0; column + 1 < columns.size(); ++column) {
        const int texels = columns[column + 1] - columns[column];
        square[column] = values.sum(rgba, texels, square[column]);
        rgba += 4 * texels;
      }
    }
    for (std::size_t column = 0; column + 1 < columns.size(); ++column) {
      Eigen::Array4f& sum = square[column];
      const int texels = (columns[column + 1] - columns[column]) * (rows[row + 1] - rows[row]);
      sum.head<3>() /= sum[3];
      sum[3] /= static_cast<float>(texels);
    }
  }
}

Eigen::Array4f Thumbnail::at(const Eigen::Vector2f& uv, Grain grain) const {
  const bool texels = grain == Grain::kTexels;
  const int width = texels ? texture_.width : width_, height = texels ? texture_.height : height_;
  const std::size_t number = numberOf(uv.y(), texture_.wrap_v, height) * static_cast<std::size_t>(width) +
                             numberOf(uv.x(), texture_.wrap_u, width);
  if (!texels) return squares_[number];
  const Values& values = Values::of(kind_);
  const std::uint8_t* const rgba = texture_.rgba.data() + 4 * number;
  Eigen::Array4f value = values.color(rgba);
  value[3] = values.solid(rgba);
  return value;
}

Eigen::Array2f Thumbnail::size(Grain grain) const {
  const bool texels = grain == Grain::kTexels;
  return {static_cast<float>(texels ? texture_.width : width_),
          static_cast<float>(texels ? texture_.height : height_)};
}

}  // namespace sunlit::light
