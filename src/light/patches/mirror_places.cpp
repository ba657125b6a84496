#include "light/patches/mirror_places.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "light/patches/angles.h"

namespace sunlit::light {
namespace {

/// Points evenly spread over a cap.
template <std::size_t kCount>
std::array<Eigen::Vector3f, kCount> capAround(const Eigen::Vector3f& middle, float radius_rad) {
  const float depth = 1.0f - std::cos(radius_rad);
  const Eigen::Vector3f right = middle.unitOrthogonal(), up = middle.cross(right);
  std::array<Eigen::Vector3f, kCount> points;
  for (std::size_t i = 0; i < kCount; ++i) {
    const float cosine = 1.0f - depth * (static_cast<float>(i) + 0.5f) / static_cast<float>(kCount);
    const float sine = std::sqrt(1.0f - cosine * cosine);
    const auto turn = static_cast<float>(kGoldenAngle * static_cast<double>(i));
    points[i] = cosine * middle + sine * (std::cos(turn) * right + std::sin(turn) * up);
  }
  return points;
}

constexpr float kNarrowest_rad =
    0.12f;  ///< cap that they are looked for in: half a patch, so that none is missed

/// The patch that a direction above the horizon lies in, or kBelow.
std::uint8_t patchOf(const Eigen::Vector3f& towards) {
  if (towards.z() < 0.0f) return SkyPatches::kBelow;
  const auto shares = SkyPatches::around(towards);
  const auto largest =
      std::max_element(shares.begin(), shares.end(),
                       [](const PatchShare& a, const PatchShare& b) { return a.share < b.share; });
  return static_cast<std::uint8_t>(largest->patch);
}

}  // namespace

MirrorPlaces::MirrorPlaces() {
  for (std::size_t level = 0; level < kMirrorLevels.size(); ++level) {
    for (std::size_t cell = 0; cell < kMirrorLevels[level].cells(); ++cell) fill(level, cell);
  }
  const SkyPatches fine(8);
  for (const SkyPatches::Ray& ray : fine.rays()) {
    if (ray.patch >= SkyPatches::kAbove) continue;
    const auto patch = static_cast<std::size_t>(ray.patch);
    middles.x[patch] += ray.towards.x() * ray.solid_angle;
    middles.y[patch] += ray.towards.y() * ray.solid_angle;
    middles.z[patch] += ray.towards.z() * ray.solid_angle;
  }
  means.fill(Eigen::Array4f::Zero());
  for (std::size_t patch = 0; patch < SkyPatches::kAbove; ++patch) {
    const float angle = SkyPatches::solidAngle(static_cast<int>(patch));
    middles.solid_angle[patch] = angle;
    means[patch] = {middles.x[patch] / angle, middles.y[patch] / angle, middles.z[patch] / angle, 1.0f};
  }
}

void MirrorPlaces::fill(std::size_t level, std::size_t cell) {
  const Eigen::Vector3f towards = sky::octahedralMiddle(kMirrorLevels[level].side, cell);
  const std::size_t place = kMirrorLevels[level].first + cell;
  below[place] = towards.z() < 0.0f;
  const float radius = kMirrorLevels[level].radius_rad;
  const auto probes = capAround<kProbes>(towards, std::max(radius, kNarrowest_rad));
  for (std::size_t i = 0; i < kProbes; ++i) patches[place][i] = patchOf(probes[i]);
  patches_below[place] =
      static_cast<std::uint8_t>(std::count(patches[place].begin(), patches[place].end(), SkyPatches::kBelow));
  if (level == 0) return;
  // Caps of such a size that with those of the level before they make up those of this one.
  const float before = kMirrorLevels[level - 1].radius_rad;
  const auto points = capAround<kTaps>(towards, std::sqrt(radius * radius - before * before));
  for (std::size_t i = 0; i < kTaps; ++i) {
    const Eigen::Vector3f& p = points[i];
    taps[place][i] =
        static_cast<std::uint16_t>(static_cast<std::int32_t>(kMirrorLevels[level - 1].first) +
                                   sky::octahedralCell(kMirrorLevels[level - 1].side, p.x(), p.y(), p.z()));
  }
}

const MirrorPlaces& mirrorPlaces() {
  static const MirrorPlaces made;
  return made;
}

}  // namespace sunlit::light
