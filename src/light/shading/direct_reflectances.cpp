// directReflectance() for sixteen surfaces at a time: its operations in its order, so that the bits are the
// same.
#include <algorithm>
#include <cmath>

#include "light/shading/ggx.h"
#include "light/shading/schlick.h"
#include "light/shading/shading.h"
#include "light/shading/wide_disc.h"
#include "sunlit/quantity/angle.h"
#include "sunlit/quantity/vector_clones.h"

namespace sunlit::light {
namespace {

constexpr std::size_t kBlock = 16;
using Row = float[kBlock];

/// Reflections, each value of all of them side by side.
struct Block {
  alignas(64) Row normal[3], to_eye[3], albedo[3], dielectric[3];
  alignas(64) Row roughness, metalness, transmission, grazing, glass;

  void set(std::size_t k, const Reflection& r) {
    for (std::size_t c = 0; c < 3; ++c) {
      const auto i = static_cast<Eigen::Index>(c);
      normal[c][k] = r.normal[i];
      to_eye[c][k] = r.to_eye[i];
      albedo[c][k] = r.albedo[i];
      dielectric[c][k] = r.dielectric[i];
    }
    roughness[k] = r.roughness;
    metalness[k] = r.metalness;
    transmission[k] = r.transmission;
    grazing[k] = r.dielectric_grazing;
    glass[k] = r.glass;
  }
};

/// How they see the source.
struct SeenSource {
  alignas(64) Row n_l, fresnel, lobe;
  alignas(64) int alone[kBlock];  ///< 1: directReflectance() is to be asked
};

/// As Eigen adds up.
inline __attribute__((always_inline)) float sumOf(float x, float y, float z) {
  return x + (y + z);
}

inline __attribute__((always_inline)) void lookAt(const SmallSource& source, const Block& block,
                                                  SeenSource* __restrict seen) {
  const float x = source.towards.x(), y = source.towards.y(), z = source.towards.z();
  const float radius_rad = source.radius_rad;
  for (std::size_t k = 0; k < kBlock; ++k) {
    const float n_x = block.normal[0][k], n_y = block.normal[1][k], n_z = block.normal[2][k];
    const float v_x = block.to_eye[0][k], v_y = block.to_eye[1][k], v_z = block.to_eye[2][k];
    const float n_l = sumOf(n_x * x, n_y * y, n_z * z);
    const float sum_x = x + v_x, sum_y = y + v_y, sum_z = z + v_z;
    const float length = std::sqrt(sumOf(sum_x * sum_x, sum_y * sum_y, sum_z * sum_z));
    const float h_x = sum_x / length, h_y = sum_y / length, h_z = sum_z / length;
    const float eye_half = sumOf(v_x * h_x, v_y * h_y, v_z * h_z);
    const float n_v = std::max(sumOf(n_x * v_x, n_y * v_y, n_z * v_z), 1e-3f);
    const float n_h = std::min(std::max(sumOf(n_x * h_x, n_y * h_y, n_z * h_z), 0.0f), 1.0f);
    const float v_h = std::min(std::max(eye_half, 1e-3f), 1.0f);
    const auto facets = Ggx<float>::ofRoughness(block.roughness[k]);
    seen->n_l[k] = n_l;
    seen->fresnel[k] = schlick(std::min(std::max(eye_half, 0.0f), 1.0f));
    seen->lobe[k] = facets.meanDistribution(n_h, v_h, radius_rad) * facets.visibility(n_l, n_v);
    // Straight behind the eye there is no half vector.
    seen->alone[k] = (showsEllipse(block.roughness[k], v_h, radius_rad) | !(length > 0.0f)) ? 1 : 0;
  }
}

inline __attribute__((always_inline)) void reflectInto(const SeenSource& seen, const Block& block,
                                                       std::size_t c, float* __restrict values) {
  for (std::size_t k = 0; k < kBlock; ++k) {
    const float albedo = block.albedo[c][k], dielectric = block.dielectric[c][k];
    const float metalness = block.metalness[k], matt = 1.0f - metalness;
    const float transmission = block.transmission[k], glass = block.glass[k];
    const float f0 = dielectric + (albedo - dielectric) * metalness;
    const float f90 = block.grazing[k] + (1.0f - block.grazing[k]) * metalness;
    const float face = f0 + (f90 - f0) * seen.fresnel[k];
    const float fresnel = face + glass * matt * (2.0f * face / (1.0f + face) - face);
    const float lambert = matt * (1.0f - transmission) * (1.0f - glass) / kPiFloat * albedo;
    const float front = (lambert * (1.0f - fresnel) + fresnel * seen.lobe[k]) * seen.n_l[k];
    const float behind = matt * transmission / kPiFloat * -seen.n_l[k] * albedo;
    values[k] = seen.n_l[k] <= 0.0f ? behind : front;
  }
}

struct Reflected {
  alignas(64) Row rgb[3];
  alignas(64) int alone[kBlock];
};

SUNLIT_WIDE_VECTOR_CLONES
void reflectBlock(const SmallSource& source, const Block& block, Reflected* reflected) {
  SeenSource seen;
  lookAt(source, block, &seen);
  for (std::size_t c = 0; c < 3; ++c) reflectInto(seen, block, c, reflected->rgb[c]);
  for (std::size_t k = 0; k < kBlock; ++k) reflected->alone[k] = seen.alone[k];
}

}  // namespace

void directReflectances(const std::vector<Reflection>& reflections, const SmallSource& source,
                        Eigen::Array3f* reflectances) {
  Block block{};
  Reflected reflected;
  for (std::size_t begin = 0; begin < reflections.size(); begin += kBlock) {
    const std::size_t count = std::min(kBlock, reflections.size() - begin);
    for (std::size_t k = 0; k < count; ++k) block.set(k, reflections[begin + k]);
    reflectBlock(source, block, &reflected);
    for (std::size_t k = 0; k < count; ++k) {
      reflectances[begin + k] =
          reflected.alone[k] != 0
              ? directReflectance(reflections[begin + k], source.towards, source.radius_rad)
              : Eigen::Array3f(reflected.rgb[0][k], reflected.rgb[1][k], reflected.rgb[2][k]);
    }
  }
}

}  // namespace sunlit::light
