/// The veil that light, scattered between the glasses of a lens, lays over the whole picture.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "sunlit/image/images.h"
#include "sunlit/image/vignetting.h"
#include "sunlit/quantity/angle.h"
#include "sunlit/quantity/field.h"
#include "sunlit/quantity/photometry.h"

namespace sunlit::image {

struct WingsFromBeyond;

/// The default is a lens that scatters nothing.
struct GlareOptions {
  double share = 0.0;  ///< ISO 9358's veiling glare index: what a small black spot in a white sphere shows
  double wings = 0.5;
  Angle hood = Angle::degrees(60.0);
};

inline std::vector<Field> fieldsOf(GlareOptions& options) {
  return {
      {"share",
       &options.share,
       "",
       {0, 0.2},
       "of the light that goes astray (ISO 9358); 0.01 to 0.05 are usual"},
      {"wings",
       &options.wings,
       "",
       {0, 1},
       "of that, what stays around where it comes from; the rest lies evenly"},
      {"hood",
       &options.hood,
       "deg",
       {0, 90},
       "from the axis, up to which light outside of the picture gets in; to 5 deg past its edge at least"}};
}

/// Throws std::invalid_argument naming key, value and range.
void validate(const GlareOptions& options);

/// A light that shines on the lens, and whose light is in no pixel: outside of the picture, or a lamp in it
/// that is too small to be drawn.
struct LightOutside {
  Eigen::Vector3d towards;  ///< unit, in the optical frame
  LinearRgb illuminance;    ///< lx on a plane facing it, at the camera: what nothing hides of it
};

/// (1 − V) L + V ((1 − w) mean + w wings), V the share, w that of the wings: `mean` of all pixels, `wings`
/// the picture blurred by Gaussians of which each is twice as wide as the one before, up to a quarter of the
/// longer side, of equal parts: about 1 / r² around a point. What leaves the picture comes in again at the
/// same edge, so the sum of all pixels stays. A light that is in no pixel is added as if its image lay where
/// it is, and one outside as if it lay on the edge nearest to it, where it passes on without a step to one
/// that is seen; of each Gaussian what reaches the edge lies about there, all else evenly. From the edge on
/// it fades by its cosine and evenly with the angle up to the hood, where the last of the lens lies in its
/// shadow, and over 5° at least, also where the picture shows more than the hood lets in; from 85° on the
/// front of the lens is taken to face as far to the side. Beside a picture without its axis it fades as if it
/// had gone on outwards from the edge by the angle between the two.
class VeilingGlare {
 public:
  /// Keeps what it needs of `vignetting`, which the picture has been through. Throws as validate().
  VeilingGlare(const Vignetting& vignetting, const GlareOptions& options);

  bool none() const { return options_.share == 0.0; }
  /// Adds the veil to `picture` (cd/m², of the lens's size). NaN counts as black. The same bits for any
  /// thread count.
  void apply(const std::vector<LightOutside>& outside, LinearImage* picture) const;
  /// What `light` adds to the mean of all pixels, cd/m².
  LinearRgb meanOf(const LightOutside& light) const;

 private:
  WingsFromBeyond wingsOf(const LightOutside& light, const LinearRgb& mean) const;
  /// Where a light is in the picture, or has left it. Without a ray, which no pixel of a lens lacks that
  /// shows all of its picture, the angles are 0.
  struct Passed {
    Eigen::Vector2d pixel;               ///< on the edge, if it has
    std::optional<Eigen::Vector3d> ray;  ///< of that
    double edge_rad = 0.0;               ///< of that, from the axis
    double light_rad = 0.0;              ///< of the light, from the axis, as far as it fades by
  };
  /// By a light in the direction `towards`, a unit vector. Where the axis is in the picture, the edge is on
  /// the way from there to the light; else it is what lies nearest to the light.
  Passed passedBy(const Eigen::Vector3d& towards) const;

  Vignetting vignetting_;
  GlareOptions options_;
};

}  // namespace sunlit::image
