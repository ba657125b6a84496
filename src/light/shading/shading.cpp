#include "light/shading/shading.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

#include "light/shading/direct_parts.h"
#include "light/shading/ggx.h"
#include "light/shading/mirror_lobe.h"
#include "light/shading/schlick.h"
#include "light/shading/wide_disc.h"
#include "sunlit/quantity/angle.h"

namespace sunlit::light {
namespace {

Eigen::Array3f normalReflectance(const Reflection& r) {
  return r.dielectric + (r.albedo - r.dielectric) * r.metalness;
}
/// How much of it is a clear sheet: no metal is.
float clearness(const Reflection& r) {
  return r.glass * (1.0f - r.metalness);
}
/// Of a sheet, as much as it is clear, both faces mirror.
Eigen::Array3f ofSheet(const Reflection& r, const Eigen::Array3f& of_face) {
  return of_face + clearness(r) * (ofBothFaces(of_face) - of_face);
}
float grazingReflectance(const Reflection& r) {
  return r.dielectric_grazing + (1.0f - r.dielectric_grazing) * r.metalness;
}
Eigen::Array3f lambert(const Reflection& r) {
  return (1.0f - r.metalness) * (1.0f - r.transmission) * (1.0f - r.glass) / kPiFloat * r.albedo;
}

/// Mean of D over the facets that mirror the points of a disc, as Ggx::meanDistribution() is, but over the
/// ellipse that they are: where the disc is wide beside the lobe, at a low sun in water, that is several
/// times as long across the way to the disc as along it. Exact across, by five points (Gauss and Chebyshev's)
/// along.
float meanOverEllipse(const Reflection& r, const Eigen::Vector3f& to_light, const Eigen::Vector3f& half,
                      float radius_rad) {
  constexpr int kPoints = 5;
  struct Points {
    std::array<float, kPoints> at, root, weight;
    Points() : at(), root(), weight() {
      for (int i = 0; i < kPoints; ++i) {
        const float angle = kPiFloat * static_cast<float>(i + 1) / (kPoints + 1);
        const auto k = static_cast<std::size_t>(i);
        at[k] = std::cos(angle);
        root[k] = std::sin(angle);
        weight[k] = 2.0f / (kPoints + 1) * root[k] * root[k];
      }
    }
  };
  static const Points points;
  const auto facets = Ggx<float>::ofRoughness(r.roughness);
  const float ball2 = facets.ball2();
  const Eigen::Vector3f apart = to_light - r.to_eye;
  const float sine2 = apart.norm();
  const Eigen::Vector3f along = sine2 > 1e-6f ? Eigen::Vector3f(apart / sine2) : half.unitOrthogonal();
  const float x = r.normal.dot(along), y = r.normal.dot(half.cross(along));
  const float v_h = std::max(r.to_eye.dot(half), 1e-3f);
  const float height = 0.5f * radius_rad, width = height / v_h;
  float sum = 0.0f;
  for (std::size_t i = 0; i < kPoints; ++i) {
    const float aside = x + height * points.at[i];
    const float c2 = ball2 + aside * aside, c = std::sqrt(c2);
    const float reach = width * points.root[i];
    const auto upTo = [&](float end) { return end / (c2 + end * end) + std::atan(end / c) / c; };
    sum += points.weight[i] * (upTo(y + reach) - upTo(y - reach)) / (4.0f * reach * c2);
  }
  return ball2 / facets.narrowness() / kPiFloat * sum;
}

/// The mirror-like part without Fresnel, 1/sr.
float lobe(const Reflection& r, const Eigen::Vector3f& to_light, const Eigen::Vector3f& half,
           float radius_rad) {
  constexpr float kFar = 12.0f;  // how far off the disc's facets are, of their width
  const float n_l = r.normal.dot(to_light);
  // A shading normal may turn away from the eye near silhouettes; the surface is seen all the same.
  const float n_v = std::max(r.normal.dot(r.to_eye), 1e-3f);
  const float n_h = std::clamp(r.normal.dot(half), 0.0f, 1.0f);
  const float v_h = std::clamp(r.to_eye.dot(half), 1e-3f, 1.0f);
  const auto facets = Ggx<float>::ofRoughness(r.roughness);
  const float width = widthOfFacets(radius_rad, v_h);
  const bool wide =
      showsEllipse(r.roughness, v_h, radius_rad) && 1.0f - n_h * n_h < kFar * width * kFar * width;
  const float distribution =
      wide ? meanOverEllipse(r, to_light, half, radius_rad) : facets.meanDistribution(n_h, v_h, radius_rad);
  return distribution * facets.visibility(n_l, n_v);
}

}  // namespace

DirectParts directParts(const Reflection& r) {
  return {normalReflectance(r), lambert(r), (1.0f - r.metalness) * r.transmission / kPiFloat * r.albedo,
          grazingReflectance(r), clearness(r)};
}

Eigen::Array3f directReflectance(const Reflection& r, const Eigen::Vector3f& to_light,
                                 float source_radius_rad) {
  const float n_l = r.normal.dot(to_light);
  if (n_l <= 0.0f) return (1.0f - r.metalness) * r.transmission / kPiFloat * -n_l * r.albedo;
  const Eigen::Vector3f half = (to_light + r.to_eye).normalized();
  const float v_h = std::clamp(r.to_eye.dot(half), 0.0f, 1.0f);
  const Eigen::Array3f f0 = normalReflectance(r);
  Eigen::Array3f fresnel = f0 + (grazingReflectance(r) - f0) * schlick(v_h);
  if (r.glass > 0.0f) fresnel = ofSheet(r, fresnel);
  return (lambert(r) * (1.0f - fresnel) + fresnel * lobe(r, to_light, half, source_radius_rad)) * n_l;
}

AmbientReflectance ambientReflectance(const Reflection& r) {
  const float n_v = std::clamp(r.normal.dot(r.to_eye), 1e-3f, 1.0f);
  const Eigen::Array3f f0 = normalReflectance(r);
  const MirrorAlbedo mirror = mirrorAlbedo(r.roughness, n_v);
  const float f90 = grazingReflectance(r);
  Eigen::Array3f lobe = f0 * mirror.plain + f90 * mirror.grazing;
  Eigen::Array3f taken = f0 + (f90 - f0) * meanGrazing(n_v);  // by Fresnel, from the Lambert part
  Eigen::Array3f matt = (1.0f - r.metalness) / kPiFloat * r.albedo;
  if (r.glass > 0.0f) {
    lobe = ofSheet(r, lobe);
    taken = ofSheet(r, taken);
    matt *= 1.0f - r.glass;
  }
  return {(1.0f - r.transmission) * matt * (1.0f - taken), r.transmission * matt, lobe};
}

Eigen::Array3f straightThrough(const Reflection& r) {
  if (!(r.glass > 0.0f)) return Eigen::Array3f::Zero();
  const Eigen::Array3f f0 = normalReflectance(r);
  const float cosine = std::min(std::abs(r.normal.dot(r.to_eye)), 1.0f);
  const Eigen::Array3f face = f0 + (grazingReflectance(r) - f0) * schlick(cosine);
  return (1.0f - r.metalness) * r.glass * r.albedo * (1.0f - ofBothFaces(face));
}

}  // namespace sunlit::light
