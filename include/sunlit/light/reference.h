/// The slow truth that the fast picture is measured against: every path of light is traced, nothing is baked,
/// interpolated or filtered. Same surfaces, same reflection, same sun, moon, sky and air as in a
/// PreparedPicture.
#pragma once

#include <cstdint>
#include <vector>

#include "sunlit/image/images.h"
#include "sunlit/light/surfaces.h"
#include "sunlit/light/world.h"
#include "sunlit/quantity/field.h"
#include "sunlit/sky/daylight.h"

namespace sunlit::light {

struct ReferenceOptions {
  int samples_per_pixel = 256;
  int bounces = 16;  ///< from the fourth on a path goes on by chance (Russian roulette): as accurate
  std::uint32_t seed = 0;
  std::vector<scene::Lamp> lamps;  ///< that burn under all skies; none is relative
};

inline std::vector<Field> fieldsOf(ReferenceOptions& options) {
  return {{"samples", &options.samples_per_pixel, "", {2, 65536}, "paths a pixel"},
          {"bounces", &options.bounces, "", {0, 64}, "beyond the surface that is seen"}};
}

/// Throws std::invalid_argument naming key, value and range.
void validate(const ReferenceOptions& options);

/// A picture and how far to trust it.
struct Traced {
  image::LinearImage luminance;  ///< cd/m², as of a PreparedPicture
  /// Standard error of each pixel's luminance, cd/m²: half the difference of two halves of the paths, which
  /// share no random numbers. One pixel's value is itself a guess; averages over many are good.
  image::Picture<float, 1> noise;
};

/// One picture for each of `days`, which all use the same paths: more suns cost only their shadow rays.
///
/// What surfaces beyond the first add: texture at full resolution, vertex colours, interpolated normals;
/// light meets one-sided triangles from both sides; Material::detail, whose mean is none, is left out. Bodies
/// that move are lit where `surfaces` shows them, but hide and pass on nothing. Air lies between the eye and
/// the first surface only, as much of it lit as in a PreparedPicture. Random numbers are counted, not drawn:
/// the same bits for any thread count.
std::vector<Traced> traceReference(const Surfaces& surfaces, const World& world,
                                   const std::vector<sky::Daylight>& days, const ReferenceOptions& options);

}  // namespace sunlit::light
