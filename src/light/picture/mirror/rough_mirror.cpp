#include "light/picture/mirror/rough_mirror.h"

#include <algorithm>
#include <cmath>

#include "light/shading/ggx.h"
#include "light/shading/schlick.h"
#include "sunlit/quantity/vector_clones.h"

namespace sunlit::light {
namespace {

constexpr std::size_t kPatches = SkyPatches::kCount;
static_assert(RoughMirror::kPatches == kPatches, "a share for each patch");
constexpr std::size_t kDown = SkyPatches::kDown / 2;  ///< directions: every second one says as much
constexpr std::size_t kLanes = 8;                     ///< sums kept side by side
static_assert(kPatches % kLanes == 0 && kDown % kLanes == 0, "no loop for a rest");

/// Directions side by side.
template <std::size_t kCount>
struct Directions {
  std::array<float, kCount> x{}, y{}, z{}, solid_angle{};
  void set(std::size_t i, const SkyPatches::Ray& ray) {
    x[i] = ray.towards.x();
    y[i] = ray.towards.y();
    z[i] = ray.towards.z();
    solid_angle[i] = ray.solid_angle;
  }
};

/// Directions that stand for the sphere: as many in each patch, and those below the horizon.
struct Sphere {
  static constexpr int kMost = 2;
  std::array<Directions<kPatches>, kMost> above;
  Directions<kDown> below;

  explicit Sphere(int in_patch) {
    std::array<int, SkyPatches::kAbove> times{};
    std::size_t down = 0;
    const SkyPatches patches(in_patch);
    for (const SkyPatches::Ray& ray : patches.rays()) {
      if (ray.patch == SkyPatches::kBelow) {
        if (down % 2 == 0) below.set(down / 2, {ray.towards, 2.0f * ray.solid_angle, ray.patch, ray.coarse});
        ++down;
      } else {
        const auto patch = static_cast<std::size_t>(ray.patch);
        above[static_cast<std::size_t>(times[patch]++)].set(patch, ray);
      }
    }
  }
};

/// A surface's mirror-like lobe.
struct Lobe {
  Eigen::Vector3f normal, to_eye;
  Eigen::Vector3f outside;  ///< nothing is seen where the product with this is negative; zero: everything is
  float f0;
  GgxOfView<float> facets;
};

/// Adds to all[i] the reflectance for direction i, times its solid angle and what is the same for all, and to
/// seen[i] likewise, if it is not below the surface itself.
template <std::size_t kCount>
inline __attribute__((always_inline)) void addReflected(const Lobe& lobe, const Directions<kCount>& towards,
                                                        float* __restrict all, float* __restrict seen) {
  const float *const x = towards.x.data(), *const y = towards.y.data(), *const z = towards.z.data();
  const float* const angle = towards.solid_angle.data();
  const float nx = lobe.normal.x(), ny = lobe.normal.y(), nz = lobe.normal.z();
  const float vx = lobe.to_eye.x(), vy = lobe.to_eye.y(), vz = lobe.to_eye.z();
  const float gx = lobe.outside.x(), gy = lobe.outside.y(), gz = lobe.outside.z();
  const float f0 = lobe.f0;
  const GgxOfView<float> facets = lobe.facets;
  for (std::size_t i = 0; i < kCount; ++i) {
    const float n_l = std::max(nx * x[i] + ny * y[i] + nz * z[i], 0.0f);
    const float v_h2 = std::max(0.5f * (1.0f + vx * x[i] + vy * y[i] + vz * z[i]), 1e-6f);
    const float fresnel = f0 + (1.0f - f0) * schlick(std::min(std::sqrt(v_h2), 1.0f));
    const float value = fresnel * (n_l * angle[i]) * (v_h2 * v_h2) / facets.divisor(n_l, v_h2);
    all[i] += value;
    seen[i] += gx * x[i] + gy * y[i] + gz * z[i] >= 0.0f ? value : 0.0f;
  }
}

template <std::size_t kCount>
inline __attribute__((always_inline)) float sumOf(const float* __restrict values) {
  float lanes[kLanes] = {};
  for (std::size_t i = 0; i < kCount; i += kLanes)
    for (std::size_t k = 0; k < kLanes; ++k) lanes[k] += values[i + k];
  float sum = 0.0f;
  for (const float lane : lanes) sum += lane;
  return sum;
}

/// A lobe's sums.
struct LobeSums {
  alignas(32) PatchValues seen{};  ///< by patch, as far as it is not below the surface itself
  float below = 0.0f;              ///< below the horizon, as far as it is not below the surface itself
  float all = 0.0f;
};

SUNLIT_WIDE_VECTOR_CLONES
void addUp(const Lobe& lobe, const Sphere& sphere, int in_patch, LobeSums* sums) {
  alignas(32) float all[kPatches] = {};
  for (int k = 0; k < in_patch; ++k)
    addReflected(lobe, sphere.above[static_cast<std::size_t>(k)], all, sums->seen.data());
  sums->all = sumOf<kPatches>(all);
  constexpr float kLevel = 0.99999f;
  if (lobe.normal.z() > kLevel) return;
  alignas(32) float all_below[kDown] = {}, seen_below[kDown] = {};
  addReflected(lobe, sphere.below, all_below, seen_below);
  sums->all += sumOf<kDown>(all_below);
  sums->below = sumOf<kDown>(seen_below);
}

/// Fills in the mirror of a lobe that is not black.
SUNLIT_WIDE_VECTOR_CLONES
void fill(const LobeSums& sums, const float* __restrict open, RoughMirror* mirror) {
  alignas(32) float shares[kPatches], hidden[kPatches];
  float largest[kLanes] = {};
  for (std::size_t p = 0; p < kPatches; p += kLanes) {
    for (std::size_t k = 0; k < kLanes; ++k) {
      shares[p + k] = sums.seen[p + k] * open[p + k];
      hidden[p + k] = sums.seen[p + k] - shares[p + k];
      largest[k] = largest[k] > shares[p + k] ? largest[k] : shares[p + k];
    }
  }
  mirror->hidden_above = sumOf<kPatches>(hidden) / sums.all;
  mirror->hidden_below = sums.below / sums.all;
  const float most = *std::max_element(largest, largest + kLanes);
  if (!(most > 0.0f)) return;
  mirror->scale = most / (255.0f * sums.all);
  const float factor = 255.0f / most;
  std::uint8_t* const bytes = mirror->share.data();
  for (std::size_t p = 0; p < kPatches; ++p)
    bytes[p] = static_cast<std::uint8_t>(static_cast<int>(shares[p] * factor + 0.5f));
}

Lobe lobeOf(const Surface& surface, const scene::Material& material) {
  const Eigen::Vector3f outside =
      material.transmission > 0.0f ? Eigen::Vector3f(Eigen::Vector3f::Zero()) : surface.geometric_normal;
  const float f0 = normalReflectance(material.base_color.luminance(), surface.metalness);
  const float n_v = std::max(surface.shading_normal.dot(surface.to_eye), 1e-3f);
  const GgxOfView<float> facets(surface.roughness * surface.roughness, n_v);
  return {surface.shading_normal, surface.to_eye, outside, f0, facets};
}

}  // namespace

RoughMirror roughMirror(const Surface& surface, const scene::Material& material, const OpenPatches& open,
                        bool leaf) {
  const int in_patch = leaf ? 1 : Sphere::kMost;
  static const std::array<Sphere, Sphere::kMost> spheres = {Sphere(1), Sphere(2)};
  LobeSums sums;
  addUp(lobeOf(surface, material), spheres[static_cast<std::size_t>(in_patch - 1)], in_patch, &sums);
  RoughMirror mirror;
  mirror.tint = open.tint;
  if (sums.all > 0.0f) fill(sums, open.share.data(), &mirror);
  return mirror;
}

}  // namespace sunlit::light
