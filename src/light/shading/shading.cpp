#include "light/shading/shading.h"

#include <algorithm>
#include <cmath>

#include "light/shading/direct_parts.h"
#include "light/shading/ggx.h"
#include "light/shading/mirror_lobe.h"
#include "light/shading/schlick.h"
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

}  // namespace

DirectParts directParts(const Reflection& r) {
  return {normalReflectance(r), lambert(r), (1.0f - r.metalness) * r.transmission / kPiFloat * r.albedo,
          grazingReflectance(r), clearness(r)};
}

Eigen::Array3f directReflectance(const Reflection& r, const Eigen::Vector3f& to_light,
                                 float source_radius_rad) {
  const float n_l = r.normal.dot(to_light);
  if (n_l <= 0.0f) return (1.0f - r.metalness) * r.transmission / kPiFloat * -n_l * r.albedo;
  // A shading normal may turn away from the eye near silhouettes; the surface is seen all the same.
  const float n_v = std::max(r.normal.dot(r.to_eye), 1e-3f);
  const Eigen::Vector3f half = (to_light + r.to_eye).normalized();
  const float n_h = std::clamp(r.normal.dot(half), 0.0f, 1.0f);
  const float v_h = std::clamp(r.to_eye.dot(half), 0.0f, 1.0f);

  // Half the source's radius adds to the half vector's spread: the lobe is that of the surface blurred by the
  // source.
  const float alpha = std::min(1.0f, r.roughness * r.roughness + 0.5f * source_radius_rad);
  const Ggx<float> facets(alpha);
  const Eigen::Array3f f0 = normalReflectance(r);
  Eigen::Array3f fresnel = f0 + (grazingReflectance(r) - f0) * schlick(v_h);
  if (r.glass > 0.0f) fresnel = ofSheet(r, fresnel);
  return (lambert(r) * (1.0f - fresnel) +
          fresnel * (facets.distribution(n_h) * facets.visibility(n_l, n_v))) *
         n_l;
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
