/// A point of a surface, as far as it decides how light is reflected, and what it lets straight through.
#pragma once

#include <Eigen/Core>

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

/// Share of the light that a clear sheet lets straight through towards the eye, without its mirrored and its
/// scattered light: zero where `glass` is.
Eigen::Array3f straightThrough(const Reflection& reflection);

}  // namespace sunlit::light
