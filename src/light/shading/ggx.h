/// Microfacets that mirror: how their normals are spread, and how they hide each other.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "sunlit/quantity/angle.h"

namespace sunlit::light {

/// The distribution of Trowbridge and Reitz, known as GGX, with Smith's shadowing. Vectors are unit, in the
/// frame whose z axis is the surface's normal; cosines n_h, n_v, n_l are those between it and the facets'
/// normal, the eye and the light, v_h that between eye and facet. Equations are of
///   Walter et al., "Microfacet Models for Refraction through Rough Surfaces", EGSR 2007 [W];
///   Heitz, "Understanding the Masking-Shadowing Function in Microfacet-Based BRDFs", JCGT 3(2), 2014 [H];
///   Heitz, "Sampling the GGX Distribution of Visible Normals", JCGT 7(4), 2018 [V].
template <typename Real>
class Ggx {
 public:
  using Vector = Eigen::Matrix<Real, 3, 1>;

  /// `alpha`: width of the distribution, > 0 … 1.
  explicit Ggx(Real alpha) : alpha_(alpha), alpha2_(alpha * alpha) {}
  /// Of perceptual roughness: α = roughness² (glTF 2.0, appendix B).
  static Ggx ofRoughness(Real roughness) { return Ggx(roughness * roughness); }

  /// D, 1/sr: area of the facets of that normal, for a unit of area of the surface; [W] eq. 33.
  Real distribution(Real n_h) const {
    // Of smooth surfaces rounding of n_h tells: as in meanDistribution(), to whose values this is compared.
    const Real base = (1 - n_h * n_h) * (1 - alpha2_) + alpha2_;
    return alpha2_ / (static_cast<Real>(kPi) * base * base);
  }
  /// By the sines of their angles to the normal facets are spread as points of a ball of this squared radius,
  /// even over it, are on a plane that they are thrown upon from its pole: D = ball2 / (π narrowness (ball2 +
  /// sine²)²).
  Real ball2() const { return alpha2_ / narrowness(); }
  Real narrowness() const { return std::max<Real>(1 - alpha2_, static_cast<Real>(1e-4)); }
  /// Mean of D, 1/sr, over the facets that mirror the points of a round, even source of the angular radius
  /// `radius_rad`; n_h and v_h are of its middle. A source's disc is a cap of the ball that ball2() tells of.
  /// The facets of a source are an ellipse, taken for a disc of its area.
  Real meanDistribution(Real n_h, Real v_h, Real radius_rad) const {
    const Real middle2 = (1 - n_h * n_h) / ball2(),
               radius2 = radius_rad * radius_rad * n_h / (4 * v_h * ball2());
    const Real near = 1 + middle2 - radius2;
    const Real whole = std::sqrt(near * near + 4 * radius2);
    // Two ways to write (1 − near / whole) / (2 radius²), each exact for one sign.
    const Real cap = near > 0 ? 2 / (whole * (whole + near))
                              : (whole - near) / (2 * whole * std::max(radius2, static_cast<Real>(1e-9)));
    return cap / (static_cast<Real>(kPi) * alpha2_);
  }

  /// Λ of the eye or the light: area that is hidden, for a unit of that which is seen; [H] eq. 72.
  Real lambda(Real n_v) const {
    return static_cast<Real>(0.5) * (std::sqrt(1 + alpha2_ * (1 - n_v * n_v) / (n_v * n_v)) - 1);
  }
  /// G2 / G1: of the facets that the eye sees, the share that the light reaches too; [H] eq. 99 over eq. 43.
  Real shadowing(Real n_l, Real n_v) const { return (1 + lambda(n_v)) / (1 + lambda(n_v) + lambda(n_l)); }
  /// G2 / (4 n_l n_v): [H] eq. 99 without its fraction; times D and Fresnel the BRDF, [W] eq. 20.
  Real visibility(Real n_l, Real n_v) const {
    const Real from_light = n_v * std::sqrt(n_l * n_l * (1 - alpha2_) + alpha2_);
    const Real from_eye = n_l * std::sqrt(n_v * n_v * (1 - alpha2_) + alpha2_);
    return static_cast<Real>(0.5) / (from_light + from_eye);
  }

  /// Cosine n_h of a normal chosen with the density D n_h, by a number in [0, 1); [W] eq. 35.
  Real normalsCosine(Real random) const { return std::sqrt((1 - random) / (1 + (alpha2_ - 1) * random)); }
  /// Such a normal, turned about the surface's by a second number.
  Vector normal(Real random, Real random_turn) const {
    const Real cosine = normalsCosine(random), turn = static_cast<Real>(2 * kPi) * random_turn;
    const Real sine = std::sqrt(std::max<Real>(0, 1 - cosine * cosine));
    return {sine * std::cos(turn), sine * std::sin(turn), cosine};
  }
  /// With which density, 1/sr, light comes from where such a normal mirrors the eye; [W] eq. 24 and 14.
  Real mirroredDensity(Real n_h, Real v_h) const { return distribution(n_h) * n_h / (4 * v_h); }

  /// A normal among those that the eye sees, each as often as it is seen. `eye` lies in the plane of x and z,
  /// x ≤ 0, z ≥ 0; `disc` is a point of the unit disc, evenly chosen, x along the plane; [V] appendix A.
  Vector visibleNormal(const Vector& eye, const Eigen::Matrix<Real, 2, 1>& disc) const {
    const Vector stretched = Vector(alpha_ * eye.x(), 0, eye.z()).normalized();
    const Vector second(stretched.z(), 0, -stretched.x());  // in the plane, across `stretched`
    const Real aside = disc.y();
    const Real share = static_cast<Real>(0.5) * (1 + stretched.z());
    const Real in_plane = (1 - share) * std::sqrt(1 - aside * aside) - share * disc.x();
    const Vector facet = Vector(0, aside, 0) + in_plane * second +
                         std::sqrt(std::max<Real>(0, 1 - aside * aside - in_plane * in_plane)) * stretched;
    return Vector(alpha_ * facet.x(), alpha_ * facet.y(), std::max<Real>(0, facet.z())).normalized();
  }

 private:
  Real alpha_, alpha2_;
};

/// The same lobe seen from one place, for loops over many lights: without roots, by Hammon's fit of Smith's
/// term, a mean of its limits for smooth and rough surfaces weighed by α ("PBR Diffuse Lighting for GGX+Smith
/// Microsurfaces", GDC 2017).
template <typename Real>
class GgxOfView {
 public:
  /// `alpha` as of Ggx; n_v > 0.
  GgxOfView(Real alpha, Real n_v)
      : n_v_(n_v), rest2_(1 - alpha * alpha), both_(2 * n_v * (1 - alpha) + alpha), one_(alpha * n_v) {}

  /// D · visibility = 8 α² / π · v_h2² / this, where v_h2 > 0 is the square of v_h: |light + eye| is 2 v_h,
  /// so that the half vector is not needed.
  Real divisor(Real n_l, Real v_h2) const {
    const Real sum = n_l + n_v_;  // 2 v_h n_h
    const Real wide = 4 * v_h2 - std::min(sum * sum, 4 * v_h2) * rest2_;
    return wide * wide * (n_l * both_ + one_);
  }

 private:
  Real n_v_, rest2_, both_, one_;
};

}  // namespace sunlit::light
