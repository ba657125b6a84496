/// The light that arrives at the scene from outside it: sun disc and sky.
#pragma once

#include <Eigen/Core>
#include <memory>

#include "sunlit/quantity/angle.h"
#include "sunlit/quantity/direction.h"
#include "sunlit/quantity/photometry.h"

namespace sunlit::sky {

/// Angular radius of the sun seen from 1 AU: 959.63″ (Astronomical Almanac).
constexpr Angle kSunRadiusAtOneAu = Angle::degrees(0.2666);

/// A distant light of visible size, such as the sun.
struct DiscLight {
  Direction towards;                         ///< apparent centre, may lie below the horizon
  Angle angular_radius = kSunRadiusAtOneAu;  ///< true angular radius of the disc
  LinearRgb illuminance;  ///< lx on a plane facing it, at the ground, its unobscured disc; zero when the
                          ///< whole disc is set
};

/// Tabulated sky; see atmosphere.h for how it is computed.
struct SkyTable;

/// Light of one instant at one place. Cheap to copy, immutable, safe to read from many threads.
/// Direction arguments are unit vectors in `map` (ENU).
class Daylight {
 public:
  explicit Daylight(std::shared_ptr<const SkyTable> table);

  /// Luminance of the sky behind the scene, cd/m², without the discs. Below the horizon: the luminance of the
  /// ground far away, continuous at the horizon.
  LinearRgb skyLuminance(const Eigen::Vector3f& towards) const;
  /// Illuminance, lx, of an unoccluded surface facing `normal`: from the sky above the horizon and from
  /// ground of the model's albedo below it; without the discs' direct light.
  LinearRgb skyIlluminance(const Eigen::Vector3f& normal) const;
  const DiscLight& sun() const;
  /// Illuminance of level, open ground, sun and sky together, lx.
  LinearRgb groundIlluminance() const;

 private:
  std::shared_ptr<const SkyTable> table_;
};

}  // namespace sunlit::sky
