/// The mirror-like part of a surface's reflection.
#pragma once

#include <Eigen/Geometry>
#include <array>

namespace sunlit::light {

/// The GGX lobe of one roughness and angle of view in parts of equal weight (those of a dielectric), each
/// given by the mean of its unit vectors: along the view, to the left of it, along the normal. The wider the
/// part, the shorter its mean.
struct MirrorLobe {
  static constexpr int kParts = 16;
  std::array<Eigen::Vector3f, kParts> towards;
};

/// The axes of MirrorLobe::towards in `map`.
struct MirrorFrame {
  Eigen::Vector3f along, left, normal;

  MirrorFrame(const Eigen::Vector3f& of_surface, const Eigen::Vector3f& to_eye)
      : along(of_surface.dot(to_eye) * of_surface - to_eye), normal(of_surface) {
    const float length = along.norm();
    along = length > 1e-4f ? Eigen::Vector3f(along / length) : normal.unitOrthogonal();
    left = normal.cross(along);
  }
  Eigen::Vector3f inMap(const Eigen::Vector3f& towards) const {
    return towards.x() * along + towards.y() * left + towards.z() * normal;
  }
};

/// Interpolated in a table, made at the first call. `n_v`: cosine between normal and eye.
MirrorLobe mirrorLobe(float roughness, float n_v);

/// Sums over the lobe: with 1 cd/m² from everywhere the mirror-like part shows F0 · plain + grazing, where F
/// = F0 (1 − c) + c is Schlick's Fresnel with c = (1 − v·h)^5.
struct MirrorAlbedo {
  float plain, grazing;
};
MirrorAlbedo mirrorAlbedo(float roughness, float n_v);

/// The mean of (1 − v·h)^5 over a hemisphere of even light, by cosine: what Fresnel takes from the Lambert
/// part.
float meanGrazing(float n_v);

}  // namespace sunlit::light
