#include "light/picture/gather/gathered_light.h"

#include "light/patches/mirror_places.h"
#include "sunlit/quantity/angle.h"
#include "sunlit/quantity/vector_clones.h"

namespace sunlit::light {
namespace {

constexpr std::size_t kLanes = 8;  ///< sums kept side by side
constexpr std::size_t kSums = 5;   ///< red, green, blue, open, all
static_assert(SkyPatches::kCount % kLanes == 0, "no loop for a rest");

struct Sides {
  float front[kSums][kLanes] = {}, behind[kSums][kLanes] = {};
};

/// By the cosines of patches to the normal, which are positive before the surface and negative behind it.
SUNLIT_WIDE_VECTOR_CLONES
void addUp(const float* normal, const PatchSky& sky, const std::uint8_t* __restrict open,
           Sides* __restrict sides) {
  const MirrorPlaces::Middles& middles = mirrorPlaces().middles;
  const float x = normal[0], y = normal[1], z = normal[2];
  const float *const mx = middles.x.data(), *const my = middles.y.data(), *const mz = middles.z.data();
  const std::int16_t *const red = sky.channel(0), *const green = sky.channel(1), *const blue = sky.channel(2);
  for (std::size_t p = 0; p < SkyPatches::kCount; p += kLanes) {
    for (std::size_t k = 0; k < kLanes; ++k) {
      const float cosine = x * mx[p + k] + y * my[p + k] + z * mz[p + k];
      const float before = cosine > 0.0f ? cosine : 0.0f, beyond = before - cosine;
      const auto share = static_cast<float>(open[p + k]);
      const float r = share * static_cast<float>(red[p + k]), g = share * static_cast<float>(green[p + k]),
                  b = share * static_cast<float>(blue[p + k]);
      sides->front[0][k] += before * r;
      sides->front[1][k] += before * g;
      sides->front[2][k] += before * b;
      sides->front[3][k] += before * share;
      sides->front[4][k] += before;
      sides->behind[0][k] += beyond * r;
      sides->behind[1][k] += beyond * g;
      sides->behind[2][k] += beyond * b;
      sides->behind[3][k] += beyond * share;
      sides->behind[4][k] += beyond;
    }
  }
}

/// `up`: share of the half sphere, by cosine, that is above the horizon.
Eigen::Array4f side(const float (&sums)[kSums][kLanes], const PatchSky& sky, float up) {
  std::array<float, kSums> whole{};
  for (std::size_t i = 0; i < kSums; ++i)
    for (const float lane : sums[i]) whole[i] += lane;
  if (!(whole[4] > 0.0f)) return Eigen::Array4f::Zero();
  // Patches that the surface's plane cuts count by their middle: what that leaves out is made up for.
  const float share = up / (whole[4] * 255.0f);
  return {kPiFloat * share * sky.scale(0) * whole[0], kPiFloat * share * sky.scale(1) * whole[1],
          kPiFloat * share * sky.scale(2) * whole[2], share * whole[3]};
}

}  // namespace

GatheredLight gatheredLight(const GatheredSky& gathered, const PatchSky& sky, const Eigen::Vector3f& normal) {
  Sides sides;
  addUp(normal.data(), sky, gathered.open.data(), &sides);
  return {side(sides.front, sky, 0.5f * (1.0f + normal.z())),
          side(sides.behind, sky, 0.5f * (1.0f - normal.z()))};
}

}  // namespace sunlit::light
