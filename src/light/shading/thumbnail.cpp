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
  std::vector<int> counts(squares_.size(), 0);
  const std::uint8_t* rgba = texture.rgba.data();
  for (int y = 0; y < texture.height; ++y) {
    for (int x = 0; x < texture.width; ++x, rgba += 4) {
      const auto to =
          static_cast<std::size_t>(y * height_ / texture.height * width_ + x * width_ / texture.width);
      const Eigen::Array4f value = valueOf(rgba, kind);
      squares_[to].head<3>() += value[3] * value.head<3>();
      squares_[to][3] += value[3];
      ++counts[to];
    }
  }
  for (std::size_t i = 0; i < squares_.size(); ++i) {
    squares_[i].head<3>() /= squares_[i][3];
    squares_[i][3] /= static_cast<float>(counts[i]);
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
