/// Fractal detail of a material, prepared for the shader.
#pragma once

#include <Eigen/Core>
#include <array>
#include <string>

#include "render/gl_program.h"
#include "sunlit/scene/scene.h"

namespace sunlit::render {

/// Octaves of gradient noise on a simplex lattice, each turned by another rotation, so that no lattice shows.
/// Coordinates are counted from the camera, whose own place in each octave's lattice is kept as whole cells
/// and a fraction: the noise stands still in `map` to a fraction of a millimetre, however far from the
/// origin.
struct DetailOctaves {
  static constexpr int kMax = 16;  ///< coarsest_m / finest_m beyond 2^15 is cut off at the fine end

  DetailOctaves(const scene::Detail& detail, const Eigen::Vector3d& eye);

  int count = 0;
  std::array<Eigen::Matrix3f, kMax> lattice_from_map;     ///< turns, and divides by the wavelength
  std::array<Eigen::Vector3f, kMax> eye_fraction;         ///< the camera within its cell
  std::array<Eigen::Matrix<GLint, 3, 1>, kMax> eye_cell;  ///< in the skewed lattice
  std::array<float, kMax> weight;                         ///< standard deviation 1 of the noise becomes this
  std::array<float, kMax> wavelength_m;
};

/// Where the shader's uniforms are.
class DetailUniforms {
 public:
  explicit DetailUniforms(const GlProgram& program);
  /// For the program in use.
  void set(const scene::Detail& detail, const Eigen::Vector3d& eye) const;

 private:
  GLint count_, lattice_from_map_, eye_fraction_, eye_cell_, weight_, wavelength_m_, tint_;
};

/// The shader's side: defines `vec3 detailFactor(vec3 relative)`, to multiply the albedo with.
extern const char* const kDetailShader;

}  // namespace sunlit::render
