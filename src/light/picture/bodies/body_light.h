/// The light that bodies get from all around, and what they keep from their surroundings.
#pragma once

#include <Eigen/Core>
#include <array>
#include <memory>
#include <vector>

#include "light/picture/outlook/outlook.h"
#include "sunlit/light/illumination.h"
#include "sunlit/light/surfaces.h"
#include "sunlit/light/visibility.h"
#include "sunlit/light/world.h"

namespace sunlit::light {

/// Light from all around at one place, as spherical harmonics up to the second order: enough for the
/// illuminance of matt surfaces, within some per cent (Ramamoorthi & Hanrahan 2001).
class AroundLight {
 public:
  /// Adds light of `luminance`, cd/m², from the solid angle `solid_angle`, sr, about the unit vector
  /// `towards`.
  void add(const Eigen::Vector3f& towards, float solid_angle, const Eigen::Array3f& luminance);
  /// lx on a surface that faces `normal`, a unit vector; ≥ 0.
  Eigen::Array3f illuminance(const Eigen::Vector3f& normal) const;

 private:
  std::array<Eigen::Array3f, 9> coefficients_ = zeros();
  static std::array<Eigen::Array3f, 9> zeros();
};

/// Without the direct light of sun, moon and lamps, which meet bodies by rays as they meet everything else. A
/// body is taken as small: one place, the middle of it, stands for all of it, and what other bodies hide is
/// told surface by surface. Light that bodies pass on is left out.
class BodyLight {
 public:
  /// Of the bodies of `world`, which must have some.
  explicit BodyLight(const World& world);
  ~BodyLight();

  /// What the middles of the bodies see of the scene at one pose.
  struct Views;
  std::shared_ptr<const Views> look(const Geometry& bodies,
                                    std::shared_ptr<const Visibility> visibility) const;
  /// At each body, in its order. The lamps of `light` are those that stand: what surfaces pass on of others
  /// meets bodies by rays.
  std::vector<AroundLight> around(const Views& views, const Illumination& light) const;
  /// Sets Outlook::body and Outlook::unhidden of all surfaces. `visibility` knows the bodies where they
  /// stand.
  void hide(const Surfaces& surfaces, const Visibility& visibility, Outlooks* outlooks) const;

 private:
  class Implementation;
  std::unique_ptr<const Implementation> implementation_;
};

}  // namespace sunlit::light
