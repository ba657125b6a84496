/// The visible disc of a distant light, with its phase.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "sunlit/light/surfaces.h"
#include "sunlit/sky/daylight.h"

namespace sunlit::light {

/// The sun shines evenly, the moon by the Lommel-Seeliger law µ0 / (µ0 + µ) over its lit part: dark, rough
/// ground is as bright towards its rim as in the middle. Either way what all pixels together receive is
/// DiscLight::illuminance. What of the disc is below the level horizon, or behind its cover, is not shown; of
/// a covered sun at the horizon, where both cut it, all pixels together may receive more or less.
class DiscInView {
 public:
  /// Keeps a reference to `surfaces`.
  DiscInView(const Surfaces& surfaces, const sky::DiscLight& disc);

  /// False where pixels that look `towards` (unit), or pixels up to two diagonals farther, cannot touch
  /// the disc.
  bool near(const Eigen::Vector3f& towards) const { return shines_ && towards.dot(towards_) > near_cosine_; }
  /// Whether what lies far away in direction `towards` (unit) is behind the disc.
  bool hides(const Eigen::Vector3f& towards) const { return shines_ && towards.dot(towards_) > disc_cosine_; }
  /// Its part of the mean luminance of pixel (x, y), cd/m².
  Eigen::Array3f luminance(int x, int y) const;
  /// How many points of the pixel luminance() looks at: none where it does not touch the disc.
  int points(int x, int y) const;

 private:
  /// The part of the view that a pixel shows, straight within it.
  struct Pixel {
    Eigen::Vector3d middle, right, down;  ///< its rays are middle + i right + j down, |i|, |j| ≤ ½
  };
  Pixel pixel(int x, int y) const;
  struct Grid {
    int across = 0, down = 0;  ///< points
  };
  Grid gridOf(const Pixel& pixel) const;
  double brightness(const Eigen::Vector3d& towards) const;
  /// Where only the share `lit` of the disc's light is left, in a part that is as narrow as `width`, radii.
  void showPart(double lit, double width);

  const Surfaces& surfaces_;
  bool shines_;
  Eigen::Vector3f towards_;
  float disc_cosine_;  ///< of the disc's radius
  float near_cosine_;  ///< of the angle beyond which none of those touches the disc
  // Double: the disc is small, and a crescent a small part of it.
  Eigen::Vector3d centre_;                   ///< unit
  double radius_rad_;                        ///< of the disc
  double disc_sine_;                         ///< of that
  std::optional<Eigen::Vector3d> lit_from_;  ///< unit; empty: shines all over
  std::optional<Eigen::Vector3d> cover_;     ///< unit, its centre; empty: none
  double cover_chord_ = 0.0;                 ///< between its centre and its rim, on the unit sphere
  Eigen::Array3f mean_luminance_;            ///< cd/m², over the part of the disc above the horizon
  double brightness_scale_ = 1.0;            ///< so that brightness() has a mean of 1 over the disc
  double points_per_radius_;                 ///< to be looked at, where a pixel is not too wide for it
};

}  // namespace sunlit::light
