#include "light/picture/mirror/smooth_mirror.h"

#include <algorithm>
#include <cmath>

#include "light/patches/mirror_places.h"
#include "light/shading/mirror_lobe.h"
#include "sunlit/quantity/vector_clones.h"

namespace sunlit::light {
namespace {

static_assert(SmoothMirror::kParts == static_cast<std::size_t>(MirrorLobe::kParts), "one direction a part");
constexpr float kPart = 1.0f / static_cast<float>(SmoothMirror::kParts);

/// Part of a lobe as far as it is open: how much of it, and towards where.
struct OpenPart {
  float share = 0.0f;
  Eigen::Vector3f towards;  ///< as MirrorLobe::towards
  float below = 0.0f;       ///< share of it that is hidden and below the horizon
};

/// What is hidden is often the brightest: the sky above the horizon. So the open rest of a part has its own
/// direction. `below` is what a direction below the horizon counts: on level ground nothing, as no part of a
/// lobe lies there.
OpenPart openPart(std::uint16_t place, const Eigen::Vector3f& towards, const OpenPatches& open, float below) {
  const MirrorPlaces& sky = mirrorPlaces();
  Eigen::Array4f all = Eigen::Array4f::Zero(), seen = Eigen::Array4f::Zero();  // the fourth counts
  for (const std::uint8_t patch : sky.patches[place]) {
    all += open.known[patch] * sky.means[patch];
    seen += open.share[patch] * sky.means[patch];
  }
  const float down = below * static_cast<float>(sky.patches_below[place]);
  const float count = all[3] + down;
  const float share_below = down > 0.0f ? down / count : 0.0f;
  if (!(seen[3] > 0.0f)) return {0.0f, towards, share_below};
  return {seen[3] / count, towards + (seen.head<3>() / seen[3] - all.head<3>() / all[3]).matrix(),
          share_below};
}

/// The parts of a surface's lobe as MirrorLobe::towards, in `map`.
using Parts = std::array<Eigen::Vector3f, SmoothMirror::kParts>;
Parts partsOf(const Surface& surface, float roughness) {
  const Eigen::Vector3f& normal = surface.shading_normal;
  const float n_v = normal.dot(surface.to_eye);
  const MirrorLobe lobe = mirrorLobe(roughness, n_v);
  const MirrorFrame frame(normal, surface.to_eye);
  Parts parts;
  for (std::size_t k = 0; k < parts.size(); ++k) parts[k] = frame.inMap(lobe.towards[k]);
  return parts;
}

/// mirrorPlace() of all of them at once.
SUNLIT_WIDE_VECTOR_CLONES
void findPlaces(const Parts& parts, std::array<std::uint16_t, SmoothMirror::kParts>* places) {
  constexpr int kCount = MirrorLobe::kParts;
  const float* const coordinates = parts[0].data();
  float x[kCount], y[kCount], z[kCount];
  for (int k = 0; k < kCount; ++k) {
    x[k] = coordinates[3 * k];
    y[k] = coordinates[3 * k + 1];
    z[k] = coordinates[3 * k + 2];
  }
  std::int32_t place[kCount];
  for (int k = 0; k < kCount; ++k) place[k] = mirrorPlace(x[k], y[k], z[k]);
  std::uint16_t* const to = places->data();
  for (int k = 0; k < kCount; ++k) to[k] = static_cast<std::uint16_t>(place[k]);
}

std::uint8_t inWhole(float share) {
  return static_cast<std::uint8_t>(255.0f * std::min(share, 1.0f) + 0.5f);
}

}  // namespace

SmoothMirror smoothMirror(const Surface& surface, float roughness, bool sheet, const OpenPatches& open) {
  const MirrorPlaces& sky = mirrorPlaces();
  const float below = 1.0f - std::abs(surface.shading_normal.z());
  Parts parts = partsOf(surface, roughness);
  std::array<float, SmoothMirror::kParts> shares;
  SmoothMirror mirror;
  mirror.tint = open.tint;
  findPlaces(parts, &mirror.place);
  for (std::size_t k = 0; k < parts.size(); ++k) {
    if (sheet) {
      const std::uint8_t patch = sky.patches[mirror.place[k]][0];
      shares[k] = open.share[patch];
      if (patch == SkyPatches::kBelow) mirror.hidden_below += kPart;
    } else if (surface.geometric_normal.dot(parts[k]) <= 0.0f) {
      shares[k] = 1.0f;
      parts[k] = -Eigen::Vector3f::UnitZ();  // into the surface itself: nothing is seen, as of no sky
    } else {
      const OpenPart part = openPart(mirror.place[k], parts[k], open, below);
      shares[k] = part.share;
      parts[k] = part.towards;
      mirror.hidden_below += kPart * part.below;
    }
  }
  if (!sheet) findPlaces(parts, &mirror.place);
  for (std::size_t k = 0; k < parts.size(); ++k) mirror.open[k] = inWhole(shares[k]);
  return mirror;
}

}  // namespace sunlit::light
