#include "sunlit/light/shading.h"

#include <algorithm>
#include <cmath>

#include "sunlit/quantity/angle.h"

namespace sunlit::light {
namespace {

constexpr float kPiFloat = static_cast<float>(kPi);
/// Reflectance of a dielectric of index 1.5 at normal incidence, as glTF 2.0 fixes it.
constexpr float kDielectricF0 = 0.04f;

Eigen::Array3f normalReflectance(const Reflection& r) {
  return kDielectricF0 + (r.albedo - kDielectricF0) * r.metalness;
}

float fifthPower(float x) {
  const float square = x * x;
  return square * square * x;
}

}  // namespace

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
  const float a2 = alpha * alpha;
  const float d_base = (n_h * a2 - n_h) * n_h + 1.0f;
  const float d = a2 / (kPiFloat * d_base * d_base);
  const float smith_l = n_v * std::sqrt(n_l * n_l * (1.0f - a2) + a2);
  const float smith_v = n_l * std::sqrt(n_v * n_v * (1.0f - a2) + a2);
  const float visible = 0.5f / (smith_l + smith_v);

  const Eigen::Array3f f0 = normalReflectance(r);
  const Eigen::Array3f fresnel = f0 + (1.0f - f0) * fifthPower(1.0f - v_h);
  const Eigen::Array3f diffuse =
      (1.0f - r.metalness) * (1.0f - r.transmission) / kPiFloat * r.albedo * (1.0f - fresnel);
  return (diffuse + fresnel * (d * visible)) * n_l;
}

AmbientReflectance ambientReflectance(const Reflection& r) {
  const float n_v = std::clamp(r.normal.dot(r.to_eye), 0.0f, 1.0f);
  const float rx = 1.0f - r.roughness;
  const float ry = -0.0275f * r.roughness + 0.0425f;
  const float rz = -0.572f * r.roughness + 1.04f;
  const float rw = 0.022f * r.roughness - 0.04f;
  const float a004 = std::min(rx * rx, std::exp2(-9.28f * n_v)) * rx + ry;
  const float scale = -1.04f * a004 + rz;
  const float offset = 1.04f * a004 + rw;
  const Eigen::Array3f lobe = (normalReflectance(r) * scale + offset).max(0.0f).min(1.0f);
  const Eigen::Array3f lambert = (1.0f - r.metalness) / kPiFloat * r.albedo;
  return {(1.0f - r.transmission) * lambert * (1.0f - lobe), r.transmission * lambert, lobe};
}

}  // namespace sunlit::light
