#include "render/map_pyramid.h"

#include <array>
#include <cmath>

#include "sunlit/image/srgb.h"
#include "sunlit/scene/wrap.h"

namespace sunlit::render {
namespace {

constexpr float kOne = 65535.0f;

/// What a byte of each kind stands for, as a Level has it.
using Codes = std::array<float, 256>;

const Codes& dataCodes() {
  static const Codes kCodes = [] {
    Codes codes;
    for (std::size_t i = 0; i < codes.size(); ++i) codes[i] = static_cast<float>(i * 257);
    return codes;
  }();
  return kCodes;
}

const Codes& colorCodes() {
  static const Codes kCodes = [] {
    Codes codes;
    for (std::size_t i = 0; i < codes.size(); ++i) codes[i] = std::round(image::linearOfSrgb()[i] * kOne);
    return codes;
  }();
  return kCodes;
}

/// The level of half the size of one of `width` × `height` texels, each of which `texel(column, row)` tells.
template <typename Level, typename Texel>
Level halved(int width, int height, const Texel& texel) {
  Level level{std::max(1, width / 2), std::max(1, height / 2), {}};
  level.texels.reserve(4 * static_cast<std::size_t>(level.width) * static_cast<std::size_t>(level.height));
  const auto begin = [](int i, int smaller, int of) { return i * of / smaller; };
  for (int y = 0; y < level.height; ++y) {
    for (int x = 0; x < level.width; ++x) {
      Eigen::Array4d sum = Eigen::Array4d::Zero();
      int count = 0;
      for (int j = begin(y, level.height, height); j < begin(y + 1, level.height, height); ++j) {
        for (int i = begin(x, level.width, width); i < begin(x + 1, level.width, width); ++i, ++count)
          sum += texel(i, j).template cast<double>();
      }
      for (Eigen::Index c = 0; c < 4; ++c)
        level.texels.push_back(static_cast<std::uint16_t>(std::floor(sum[c] / count + 0.5)));
    }
  }
  return level;
}

/// The texel beside an edge that a place just beyond it means.
int neighbour(int i, int size, scene::Wrap wrap) {
  if (wrap == scene::Wrap::kRepeat) return (i + size) % size;
  return std::clamp(i, 0, size - 1);  // mirrored, the texel at the edge comes twice
}

/// Of the texel at (x, y), four numbers each.
std::size_t offset(int width, int x, int y) {
  return 4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x));
}

Eigen::Array4f texelOf(const std::uint16_t* t) {
  return {static_cast<float>(t[0]), static_cast<float>(t[1]), static_cast<float>(t[2]),
          static_cast<float>(t[3])};
}

}  // namespace

MapPyramid::MapPyramid(const scene::Texture& texture, Kind kind)
    : full_(texture.rgba.data()),
      width_(texture.width),
      height_(texture.height),
      size_(static_cast<float>(texture.width), static_cast<float>(texture.height)),
      wrap_u_(texture.wrap_u),
      wrap_v_(texture.wrap_v),
      kind_(kind) {
  if (width_ == 1 && height_ == 1) return;
  smaller_.push_back(
      halved<Level>(width_, height_, [&](int x, int y) { return decoded(full_ + offset(width_, x, y)); }));
  while (smaller_.back().width > 1 || smaller_.back().height > 1) {
    const Level& last = smaller_.back();
    Level next = halved<Level>(last.width, last.height, [&](int x, int y) {
      return texelOf(last.texels.data() + offset(last.width, x, y));
    });
    smaller_.push_back(std::move(next));
  }
}

Eigen::Array4f MapPyramid::decoded(const std::uint8_t* rgba) const {
  const Codes& data = dataCodes();
  if (kind_ == Kind::kData) return {data[rgba[0]], data[rgba[1]], data[rgba[2]], data[rgba[3]]};
  if (kind_ == Kind::kColor) {
    const Codes& color = colorCodes();
    return {color[rgba[0]], color[rgba[1]], color[rgba[2]], data[rgba[3]]};
  }
  const Eigen::Vector3f normal =
      2.0f * Eigen::Vector3f(rgba[0], rgba[1], rgba[2]) / 255.0f - Eigen::Vector3f::Ones();
  const float length = normal.norm();
  const Eigen::Vector3f unit =
      length > 1e-3f ? Eigen::Vector3f(normal / length) : Eigen::Vector3f(Eigen::Vector3f::UnitZ());
  const auto code = [&](Eigen::Index axis) { return 0.5f * kOne * (unit[axis] + 1.0f); };
  return {code(0), code(1), code(2), data[rgba[3]]};
}

template <typename Texel>
Eigen::Array4f MapPyramid::bilinear(int width, int height, const Texel& texel,
                                    const Eigen::Array2f& at) const {
  // Texel centres lie at half-integers.
  const float x = scene::wrapped(at.x(), wrap_u_) * static_cast<float>(width) - 0.5f;
  const float y = scene::wrapped(at.y(), wrap_v_) * static_cast<float>(height) - 0.5f;
  const int left = floorOf(x), above = floorOf(y);
  const float right = x - static_cast<float>(left), down = y - static_cast<float>(above);
  const auto row = [&](int j) -> Eigen::Array4f {
    const int clamped = neighbour(j, height, wrap_v_);
    const Eigen::Array4f first = texel(neighbour(left, width, wrap_u_), clamped);
    return first + right * (texel(neighbour(left + 1, width, wrap_u_), clamped) - first);
  };
  const Eigen::Array4f top = row(above);
  return (top + down * (row(above + 1) - top)) / kOne;
}

Eigen::Array4f MapPyramid::look(std::size_t level, const Eigen::Array2f& at) const {
  if (level == 0)
    return bilinear(
        width_, height_, [&](int x, int y) { return decoded(full_ + offset(width_, x, y)); }, at);
  const Level& smaller = smaller_[level - 1];
  const auto texel = [&](int x, int y) {
    return texelOf(smaller.texels.data() + offset(smaller.width, x, y));
  };
  return bilinear(smaller.width, smaller.height, texel, at);
}

Eigen::Array4f MapPyramid::at(const Eigen::Array2f& at, float level) const {
  const float last = static_cast<float>(smaller_.size());
  const float clamped = level > 0.0f ? std::min(level, last) : 0.0f;
  const auto lower = static_cast<std::size_t>(clamped);
  const float between = clamped - static_cast<float>(lower);
  Eigen::Array4f value = look(lower, at);
  if (between > 0.0f) value += between * (look(lower + 1, at) - value);
  if (kind_ == Kind::kNormals) value.head<3>() = 2.0f * value.head<3>() - 1.0f;
  return value;
}

Eigen::Array4f MapPyramid::mean(const TextureArea& area) const {
  if (area.magnified()) return at(area.middle(), 0.0f);
  Eigen::Array4f sum = Eigen::Array4f::Zero();
  for (int i = 0; i < area.taps(); ++i) sum += at(area.tap(i), area.level());
  return sum / static_cast<float>(area.taps());
}

}  // namespace sunlit::render
