/// The sky in a few sectors, each of which leaves hide more or less of.
#pragma once

#include <Eigen/Core>
#include <Eigen/StdVector>
#include <array>
#include <cstdint>
#include <vector>

#include "light/patches/sky_openness.h"
#include "light/patches/sky_patches.h"
#include "sunlit/sky/daylight.h"

namespace sunlit::light {

/// What each sector of one sky gives to surfaces of any tilt. A sector is a group of patches of SkyPatches:
/// 10 up to 12° above the horizon, where twilight is brightest and trees hide most, 6 from there to 36°, 6 to
/// 60°, and 2 above.
class SkySectors {
 public:
  static constexpr std::size_t kCount = SkyOpenness::kSectors;

  explicit SkySectors(const sky::Daylight& day);

  /// The sector that a patch above the horizon belongs to.
  static std::size_t of(int patch);
  /// What is open of each sector, as SkyOpenness::open, by what is of its patches.
  static std::array<std::uint8_t, kCount> openOf(const PatchBytes& patches);

  /// Illuminance by the sky that `view` leaves open, lx; fourth: the share of the half sphere about a normal,
  /// by cosine, that is open sky.
  struct OfBothSides {
    Eigen::Array4f front, behind;
  };
  /// Of a leaf whose normal is the unit vector `normal`, to within 2° of it.
  OfBothSides irradiance(const SkyOpenness& view, const Eigen::Vector3f& normal) const;

 private:
  /// Its entry of the first sector.
  const Eigen::Array4f* rowOf(const Eigen::Vector3f& normal) const;

  using Table = std::vector<Eigen::Array4f, Eigen::aligned_allocator<Eigen::Array4f>>;
  Table table_;  ///< kCount for each cell of an octahedral map of normals, row by row
};

}  // namespace sunlit::light
