/// The directions that rough mirrors look at, by number, and which of the sky's patches lie there.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>

#include "light/patches/sky_patches.h"
#include "sunlit/sky/octahedral.h"

namespace sunlit::light {

/// One table of the sky.
struct MirrorLevel {
  int side;           ///< cells an axis of the map
  float radius_rad;   ///< of the caps
  std::size_t first;  ///< of its cells
  std::size_t cells() const { return static_cast<std::size_t>(side * side); }
};
constexpr std::array<MirrorLevel, 5> kMirrorLevels = {
    {{128, 0.02f, 0}, {64, 0.14f, 16384}, {64, 0.26f, 20480}, {64, 0.45f, 24576}, {64, 0.75f, 28672}}};
constexpr std::size_t kMirrorPlaces = kMirrorLevels.back().first + 64 * 64;
static_assert(kMirrorPlaces <= 65536, "places are 16-bit numbers");

/// The cap, evenly filled, whose mean direction has a length (1 + cos radius) / 2: number of its level.
inline std::int32_t mirrorLevel(float squared_length) {
  // Halfway between the squares of neighbouring radii, by 1 − length ≈ radius² / 4.
  constexpr auto kShorter = [](float missing) { return (1.0f - missing) * (1.0f - missing); };
  return (squared_length < kShorter(0.0025f) ? 1 : 0) + (squared_length < kShorter(0.0109f) ? 1 : 0) +
         (squared_length < kShorter(0.0338f) ? 1 : 0) + (squared_length < kShorter(0.0956f) ? 1 : 0);
}

/// Place of a direction whose length tells the level.
inline std::int32_t mirrorPlace(float x, float y, float z) {
  const std::int32_t level = mirrorLevel(x * x + y * y + z * z);
  // kMirrorLevels by arithmetic: all but the first are alike.
  constexpr auto kFirst = static_cast<std::int32_t>(kMirrorLevels[1].first);
  constexpr auto kStep = static_cast<std::int32_t>(kMirrorLevels[2].first - kMirrorLevels[1].first);
  const std::int32_t side = level == 0 ? kMirrorLevels[0].side : kMirrorLevels[1].side;
  const std::int32_t first = level == 0 ? 0 : kFirst + (level - 1) * kStep;
  return first + sky::octahedralCell(side, x, y, z);
}

constexpr std::size_t kTaps = 16;   ///< cells of a table that one of the next is made of
constexpr std::size_t kProbes = 8;  ///< patches that tell how much of a cap is open

using PatchValues = std::array<float, SkyPatches::kCount>;

/// What is the same for every sky: which patches and cells belong to each place, and where the patches lie.
struct MirrorPlaces {
  std::array<bool, kMirrorPlaces> below;
  /// For a place of any table but the first those in the table before it that it is the mean of.
  std::array<std::array<std::uint16_t, kTaps>, kMirrorPlaces> taps;
  std::array<std::array<std::uint8_t, kProbes>, kMirrorPlaces> patches;
  /// How many of `patches` lie below the horizon.
  std::array<std::uint8_t, kMirrorPlaces> patches_below;
  /// Middles of the patches, as long as their solid angles; those below the horizon have none.
  struct Middles {
    PatchValues x{}, y{}, z{}, solid_angle{};
  } middles;
  /// Mean of a patch's unit vectors, and 1; of those below the horizon 0.
  alignas(16) std::array<Eigen::Array4f, SkyPatches::kCount> means;
  MirrorPlaces();

 private:
  void fill(std::size_t level, std::size_t cell);
};

/// Made at the first call.
const MirrorPlaces& mirrorPlaces();

}  // namespace sunlit::light
