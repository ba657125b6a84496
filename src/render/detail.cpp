#include "render/detail.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace sunlit::render {
namespace {

/// Standard deviation of the shader's noise before weighting, measured over 400,000 random points.
constexpr double kNoiseDeviation = 0.003614;

int octaveCount(const scene::Detail& detail) {
  if (detail.contrast <= 0.0f) return 0;
  // The small addition keeps a ratio that is a power of two from losing its last octave to rounding.
  const int count = 1 + static_cast<int>(std::floor(std::log2(detail.coarsest_m / detail.finest_m) + 1e-3f));
  return std::clamp(count, 1, DetailOctaves::kMax);
}

}  // namespace

DetailOctaves::DetailOctaves(const scene::Detail& detail, const Eigen::Vector3d& eye)
    : count(octaveCount(detail)) {
  double energy = 0.0;
  for (int k = 0; k < count; ++k) energy += std::pow(static_cast<double>(detail.gain), 2.0 * k);
  const Eigen::Vector3d axis = Eigen::Vector3d(1.0, 2.0, 3.0).normalized();
  for (int k = 0; k < count; ++k) {
    const auto i = static_cast<std::size_t>(k);
    const double wavelength = static_cast<double>(detail.coarsest_m) * std::pow(0.5, k);
    // Any angle that is no simple fraction of a turn will do.
    const Eigen::Matrix3d lattice = Eigen::AngleAxisd(0.7 + 1.3 * k, axis).toRotationMatrix() / wavelength;
    const Eigen::Vector3d place = lattice * eye;
    // Whole multiples of three cells shift the skewed lattice by whole cells, too.
    const Eigen::Vector3d cell = 3.0 * (place / 3.0).array().floor().matrix();
    const Eigen::Vector3d skewed = cell.array() + cell.sum() / 3.0;
    for (int c = 0; c < 3; ++c) {
      eye_cell[i][c] =
          static_cast<GLint>(static_cast<std::int64_t>(skewed[c]));  // the hash wraps, and so may this
    }
    eye_fraction[i] = (place - cell).cast<float>();
    lattice_from_map[i] = lattice.cast<float>();
    wavelength_m[i] = static_cast<float>(wavelength);
    weight[i] = static_cast<float>(static_cast<double>(detail.contrast) *
                                   std::pow(static_cast<double>(detail.gain), k) / std::sqrt(energy) /
                                   kNoiseDeviation);
  }
}

DetailUniforms::DetailUniforms(const GlProgram& program)
    : count_(program.uniform("detail_count")),
      lattice_from_map_(program.uniform("detail_lattice_from_map")),
      eye_fraction_(program.uniform("detail_eye_fraction")),
      eye_cell_(program.uniform("detail_eye_cell")),
      weight_(program.uniform("detail_weight")),
      wavelength_m_(program.uniform("detail_wavelength_m")),
      tint_(program.uniform("detail_tint")) {}

void DetailUniforms::set(const scene::Detail& detail, const Eigen::Vector3d& eye) const {
  const DetailOctaves octaves(detail, eye);
  glUniform1i(count_, octaves.count);
  glUniformMatrix3fv(lattice_from_map_, octaves.count, GL_FALSE, octaves.lattice_from_map[0].data());
  glUniform3fv(eye_fraction_, octaves.count, octaves.eye_fraction[0].data());
  glUniform3iv(eye_cell_, octaves.count, octaves.eye_cell[0].data());
  glUniform1fv(weight_, octaves.count, octaves.weight.data());
  glUniform1fv(wavelength_m_, octaves.count, octaves.wavelength_m.data());
  glUniform3fv(tint_, 1, detail.tint.data());
}

// Simplex noise: K. Perlin, "Noise hardware", 2001, with a hash in place of the permutation table, so that it
// does not repeat.
const char* const kDetailShader = R"(
uniform int detail_count;
uniform mat3 detail_lattice_from_map[16];
uniform vec3 detail_eye_fraction[16];
uniform ivec3 detail_eye_cell[16];
uniform float detail_weight[16];
uniform float detail_wavelength_m[16];
uniform vec3 detail_tint;

const uvec3 kHashStep = uvec3(0x8da6b343u, 0xd8163841u, 0xcb1ab31fu);

float corner(vec3 offset, uint h) {
  h = (h ^ (h >> 15)) * 0x2c1b3c6du;
  h = (h ^ (h >> 12)) * 0x297a2d39u;
  h ^= h >> 15;
  vec3 gradient = vec3(uvec3(h, h >> 10, h >> 20) & 1023u) * (2.0 / 1023.0) - 1.0;
  float near = max(0.0, 0.5 - dot(offset, offset));
  near *= near;
  return near * near * dot(gradient, offset);
}

float simplexNoise(vec3 p, ivec3 cell_offset) {
  vec3 cell = floor(p + dot(p, vec3(1.0 / 3.0)));
  vec3 a = p - cell + dot(cell, vec3(1.0 / 6.0));
  vec3 larger = step(a.yzx, a.xyz);
  vec3 smaller = 1.0 - larger;
  vec3 second = min(larger, smaller.zxy);
  vec3 third = max(larger, smaller.zxy);
  vec3 b = a - second + 1.0 / 6.0;
  vec3 c = a - third + 1.0 / 3.0;
  vec3 d = a - 0.5;
  uvec3 at = uvec3(ivec3(cell) + cell_offset) * kHashStep;
  uint h = at.x + at.y + at.z;
  uvec3 to_second = uvec3(second) * kHashStep;
  uvec3 to_third = uvec3(third) * kHashStep;
  return corner(a, h) + corner(b, h + to_second.x + to_second.y + to_second.z) +
         corner(c, h + to_third.x + to_third.y + to_third.z) + corner(d, h + kHashStep.x + kHashStep.y + kHashStep.z);
}

vec3 detailFactor(vec3 relative) {
  // What one sample covers, along its longer side.
  float footprint = sqrt(max(dot(dFdx(relative), dFdx(relative)), dot(dFdy(relative), dFdy(relative))));
  float sum = 0.0;
  for (int k = 0; k < detail_count; ++k) {
    // With two samples a pixel and axis, a pixel's average leaves little of waves shorter than 1.5 samples.
    float fade = clamp((detail_wavelength_m[k] / footprint - 1.5) / 1.5, 0.0, 1.0);
    if (fade <= 0.0) break;
    vec3 p = detail_lattice_from_map[k] * relative + detail_eye_fraction[k];
    sum += fade * detail_weight[k] * simplexNoise(p, detail_eye_cell[k]);
  }
  return max(vec3(0.0), 1.0 + detail_tint * sum);
}
)";

}  // namespace sunlit::render
