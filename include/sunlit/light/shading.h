/// How a surface reflects light. Shared by everything that lights the scene.
#pragma once

#include <Eigen/Core>

#include "sunlit/quantity/photometry.h"

namespace sunlit::light {

/// Metallic-roughness reflection at one point, all directions unit vectors in one frame.
struct Reflection {
  Eigen::Vector3f normal;  ///< shading normal
  Eigen::Vector3f to_eye;
  Eigen::Array3f albedo;      ///< base colour, 0 … 1
  float roughness = 1.0f;     ///< perceptual, scene::Material::kSmoothest … 1
  float metalness = 0.0f;     ///< 0 … 1
  float transmission = 0.0f;  ///< share of the diffuse light that comes out on the other side, 0 … 1
  /// Of what is not metal, at normal incidence and at grazing, 0 … 1.
  Eigen::Array3f dielectric = Eigen::Array3f::Constant(0.04f);
  float dielectric_grazing = 1.0f;
  /// A clear sheet, both of whose faces mirror: share of what neither does that goes straight through, 0 … 1.
  float glass = 0.0f;
};

/// Luminance (cd/m²) towards the eye for 1 lx on a plane facing a small source in direction `to_light`; that
/// is, the BRDF times the cosine. Lambert plus GGX with the height-correlated Smith term and Schlick's
/// Fresnel, as in glTF 2.0, appendix B. `source_radius_rad` widens the highlight of smooth surfaces to the
/// source's size. Below the horizon of the surface: the transmitted light of a thin sheet, else zero.
Eigen::Array3f directReflectance(const Reflection& reflection, const Eigen::Vector3f& to_light,
                                 float source_radius_rad);

/// What a surface does with light from all around, split into its Lambert and its mirror-like part.
struct AmbientReflectance {
  Eigen::Array3f diffuse;   ///< luminance for 1 lx of irradiance over the hemisphere
  Eigen::Array3f through;   ///< luminance for 1 lx of irradiance on the other side
  Eigen::Array3f specular;  ///< luminance for 1 cd/m² about the mirrored direction
};
/// All are directReflectance() summed over a hemisphere of even light, from tables, within 2 %.
AmbientReflectance ambientReflectance(const Reflection& reflection);

/// Reflectance of a clear sheet whose faces mirror `face` each, all bounces between them summed; what is left
/// goes through, (1 − F) / (1 + F).
inline Eigen::Array3f ofBothFaces(const Eigen::Array3f& face) {
  return 2.0f * face / (1.0f + face);
}

/// Share of the light that a clear sheet lets straight through towards the eye, without its mirrored and its
/// scattered light: zero where `glass` is.
Eigen::Array3f straightThrough(const Reflection& reflection);

/// Mirror of `to_eye` at `normal`.
inline Eigen::Vector3f mirrored(const Eigen::Vector3f& to_eye, const Eigen::Vector3f& normal) {
  return 2.0f * normal.dot(to_eye) * normal - to_eye;
}

}  // namespace sunlit::light
