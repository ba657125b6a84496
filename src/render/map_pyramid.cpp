#include "render/map_pyramid.h"

#include <array>
#include <cmath>

#include "sunlit/image/srgb.h"
#include "sunlit/scene/wrap.h"

namespace sunlit::render {
namespace {

constexpr float kOne = 65535.0f;

std::uint16_t coded(float value) {
  return static_cast<std::uint16_t>(std::lround(std::clamp(value, 0.0f, 1.0f) * kOne));
}

Eigen::Array3f decoded(const std::uint8_t* rgba, MapPyramid::Kind kind) {
  const Eigen::Array3f bytes(rgba[0], rgba[1], rgba[2]);
  if (kind == MapPyramid::Kind::kData) return bytes / 255.0f;
  if (kind == MapPyramid::Kind::kColor) {
    const auto& linear = image::linearOfSrgb();
    return {linear[rgba[0]], linear[rgba[1]], linear[rgba[2]]};
  }
  const Eigen::Vector3f normal = (2.0f * bytes / 255.0f - 1.0f).matrix();
  const float length = normal.norm();
  const Eigen::Vector3f unit =
      length > 1e-3f ? Eigen::Vector3f(normal / length) : Eigen::Vector3f(Eigen::Vector3f::UnitZ());
  return 0.5f * (unit.array() + 1.0f);
}

/// The texel beside an edge that a place just beyond it means.
int neighbour(int i, int size, scene::Wrap wrap) {
  if (wrap == scene::Wrap::kRepeat) return (i + size) % size;
  return std::clamp(i, 0, size - 1);  // mirrored, the texel at the edge comes twice
}

}  // namespace

MapPyramid::MapPyramid(const scene::Texture& texture, Kind kind)
    : size_(static_cast<float>(texture.width), static_cast<float>(texture.height)),
      wrap_u_(texture.wrap_u),
      wrap_v_(texture.wrap_v),
      kind_(kind) {
  Level full{texture.width, texture.height, std::vector<std::uint16_t>(texture.rgba.size())};
  for (std::size_t i = 0; i < texture.rgba.size(); i += 4) {
    const Eigen::Array3f value = decoded(&texture.rgba[i], kind);
    for (std::size_t c = 0; c < 3; ++c) full.texels[i + c] = coded(value[static_cast<Eigen::Index>(c)]);
    full.texels[i + 3] = coded(static_cast<float>(texture.rgba[i + 3]) / 255.0f);
  }
  levels_.push_back(std::move(full));
  while (levels_.back().width > 1 || levels_.back().height > 1) levels_.push_back(halved(levels_.back()));
}

MapPyramid::Level MapPyramid::halved(const Level& larger) {
  Level level{std::max(1, larger.width / 2), std::max(1, larger.height / 2), {}};
  const auto begin = [](int i, int smaller, int of) { return i * of / smaller; };
  for (int y = 0; y < level.height; ++y) {
    for (int x = 0; x < level.width; ++x) {
      std::array<std::uint32_t, 4> sums{};
      std::uint32_t count = 0;
      for (int j = begin(y, level.height, larger.height); j < begin(y + 1, level.height, larger.height);
           ++j) {
        for (int i = begin(x, level.width, larger.width); i < begin(x + 1, level.width, larger.width); ++i) {
          const std::size_t at = 4 * (static_cast<std::size_t>(j) * static_cast<std::size_t>(larger.width) +
                                      static_cast<std::size_t>(i));
          for (std::size_t c = 0; c < 4; ++c) sums[c] += larger.texels[at + c];
          ++count;
        }
      }
      for (const std::uint32_t sum : sums)
        level.texels.push_back(static_cast<std::uint16_t>((sum + count / 2) / count));
    }
  }
  return level;
}

Eigen::Array4f MapPyramid::texel(const Level& level, int x, int y) const {
  const auto column = static_cast<std::size_t>(neighbour(x, level.width, wrap_u_));
  const auto row = static_cast<std::size_t>(neighbour(y, level.height, wrap_v_));
  const std::uint16_t* const t = &level.texels[4 * (row * static_cast<std::size_t>(level.width) + column)];
  return {static_cast<float>(t[0]), static_cast<float>(t[1]), static_cast<float>(t[2]),
          static_cast<float>(t[3])};
}

Eigen::Array4f MapPyramid::bilinear(const Level& level, const Eigen::Array2f& at) const {
  // Texel centres lie at half-integers.
  const float x = scene::wrapped(at.x(), wrap_u_) * static_cast<float>(level.width) - 0.5f;
  const float y = scene::wrapped(at.y(), wrap_v_) * static_cast<float>(level.height) - 0.5f;
  const int left = floorOf(x), above = floorOf(y);
  const float right = x - static_cast<float>(left), down = y - static_cast<float>(above);
  const Eigen::Array4f top =
      texel(level, left, above) + right * (texel(level, left + 1, above) - texel(level, left, above));
  const Eigen::Array4f bottom = texel(level, left, above + 1) +
                                right * (texel(level, left + 1, above + 1) - texel(level, left, above + 1));
  return (top + down * (bottom - top)) / kOne;
}

Eigen::Array4f MapPyramid::at(const Eigen::Array2f& at, float level) const {
  const float last = static_cast<float>(levels_.size() - 1);
  const float clamped = level > 0.0f ? std::min(level, last) : 0.0f;
  const auto lower = static_cast<std::size_t>(clamped);
  const float between = clamped - static_cast<float>(lower);
  Eigen::Array4f value = bilinear(levels_[lower], at);
  if (between > 0.0f) value += between * (bilinear(levels_[lower + 1], at) - value);
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
