/// How a surface reflects light. Shared by everything that lights the scene.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "sunlit/light/reflection.h"

namespace sunlit::light {

/// Far away, or as seen from one place.
struct SmallSource {
  Eigen::Vector3f towards;
  float radius_rad;
};

/// Luminance (cd/m²) towards the eye for 1 lx on a plane facing a small source in direction `to_light`; that
/// is, the BRDF times the cosine. Lambert plus GGX with the height-correlated Smith term and Schlick's
/// Fresnel, as in glTF 2.0, appendix B. `source_radius_rad` widens the highlight of smooth surfaces to the
/// source's size. Below the horizon of the surface: the transmitted light of a thin sheet, else zero.
Eigen::Array3f directReflectance(const Reflection& reflection, const Eigen::Vector3f& to_light,
                                 float source_radius_rad);
/// The same of many surfaces, to the bit, sixteen at a time. `reflectances` has room for all.
void directReflectances(const std::vector<Reflection>& reflections, const SmallSource& source,
                        Eigen::Array3f* reflectances);

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

/// Mirror of `to_eye` at `normal`.
inline Eigen::Vector3f mirrored(const Eigen::Vector3f& to_eye, const Eigen::Vector3f& normal) {
  return 2.0f * normal.dot(to_eye) * normal - to_eye;
}

}  // namespace sunlit::light
