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

Eigen::Array4f valueOf(const std::uint8_t* rgba, Thumbnail::Kind kind) {
  if (kind == Thumbnail::Kind::kData) return Eigen::Array4f(rgba[0], rgba[1], rgba[2], 255.0f) / 255.0f;
  const std::array<float, 256>& linear = image::linearOfSrgb();
  const float solid = static_cast<float>(rgba[3]) / 255.0f + kOfHoles;
  return {linear[rgba[0]], linear[rgba[1]], linear[rgba[2]],
          kind == Thumbnail::Kind::kSolidColor ? solid : 1.0f};
}

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
  const std::uint8_t* rgba = texture.rgba.data();
  Eigen::Array4f* square = squares_.data();
  for (std::size_t row = 0; row + 1 < rows.size(); ++row, square += width_) {
    for (int y = rows[row]; y < rows[row + 1]; ++y) {
      for (std::size_t column = 0; column + 1 < columns.size(); ++column) {
        Eigen::Array4f sum = square[column];
        for (int x = columns[column]; x < columns[column + 1]; ++x, rgba += 4) {
          const Eigen::Array4f value = valueOf(rgba, kind);
          sum += Eigen::Array4f(value[0], value[1], value[2], 1.0f) * value[3];
        }
        square[column] = sum;
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
  return texels ? valueOf(texture_.rgba.data() + 4 * number, kind_) : squares_[number];
}

Eigen::Array2f Thumbnail::size(Grain grain) const {
  const bool texels = grain == Grain::kTexels;
  return {static_cast<float>(texels ? texture_.width : width_),
          static_cast<float>(texels ? texture_.height : height_)};
}

}  // namespace sunlit::light
