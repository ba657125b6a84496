#include "render/detail.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "sunlit/quantity/angle.h"
#include "sunlit/quantity/vector_clones.h"
#include "sunlit/quantity/whole.h"

namespace sunlit::render {
namespace {

/// Standard deviation of the noise before weighting, measured over 400,000 random points.
constexpr double kNoiseDeviation = 0.003614;

/// With two samples a pixel and axis, a pixel's average leaves little of waves shorter than this.
constexpr float kHiddenSamples = 1.5f;

constexpr int kLanes = DetailPoints::kCount;
using Lanes = std::array<float, kLanes>;
constexpr std::array<std::uint32_t, 3> kHashStep = {0x8da6b343u, 0xd8163841u, 0xcb1ab31fu};

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
      eye_cell[i][c] = static_cast<std::uint32_t>(
          static_cast<std::int64_t>(skewed[c]));  // the hash wraps, and so may this
    }
    eye_fraction[i] = (place - cell).cast<float>();
    lattice_from_map[i] = lattice.cast<float>();
    wavelength_m[i] = static_cast<float>(wavelength);
    weight[i] = static_cast<float>(static_cast<double>(detail.contrast) *
                                   std::pow(static_cast<double>(detail.gain), k) / std::sqrt(energy) /
                                   kNoiseDeviation);
  }
}

namespace {

// The loops below are plain C++ for one point after another; compilers turn them into vector code. Where the
// CPU has wider vectors than every x86-64, a copy compiled for those runs, operation by operation the same.

/// One corner of a simplex: a gradient by hash `h`, faded with the distance.
inline __attribute__((always_inline)) float corner(float x, float y, float z, std::uint32_t h) {
  h = (h ^ (h >> 15)) * 0x2c1b3c6du;
  h = (h ^ (h >> 12)) * 0x297a2d39u;
  h ^= h >> 15;
  const auto component = [](std::uint32_t bits) {
    return static_cast<float>(static_cast<std::int32_t>(bits & 1023u)) * (2.0f / 1023.0f) - 1.0f;
  };
  float near = 0.5f - (x * x + y * y + z * z);
  near = near > 0.0f ? near : 0.0f;
  near *= near;
  return near * near * (component(h) * x + component(h >> 10) * y + component(h >> 20) * z);
}

/// Simplex noise: K. Perlin, "Noise hardware", 2001, with a hash in place of the permutation table, so that
/// it does not repeat. `px` … are lattice coordinates, `first_hash` the hash of the camera's cell.
inline __attribute__((always_inline)) float simplexNoise(float px, float py, float pz,
                                                         std::uint32_t first_hash) {
  const float skew = (px + py + pz) * (1.0f / 3.0f);
  const std::int32_t ix = floorOf(px + skew), iy = floorOf(py + skew), iz = floorOf(pz + skew);
  const auto cx = static_cast<float>(ix), cy = static_cast<float>(iy), cz = static_cast<float>(iz);
  const float unskew = (cx + cy + cz) * (1.0f / 6.0f);
  const float ax = px - cx + unskew, ay = py - cy + unskew, az = pz - cz + unskew;
  // The walk from the first to the last corner goes along the largest coordinate first, the smallest last.
  const std::uint32_t xy = ax >= ay ? 1u : 0u, yz = ay >= az ? 1u : 0u, zx = az >= ax ? 1u : 0u;
  const std::uint32_t x2 = xy & (1u - zx), y2 = yz & (1u - xy), z2 = zx & (1u - yz);
  const std::uint32_t x3 = xy | (1u - zx), y3 = yz | (1u - xy), z3 = zx | (1u - yz);
  const auto real = [](std::uint32_t bit) { return static_cast<float>(static_cast<std::int32_t>(bit)); };
  const float s = 1.0f / 6.0f, t = 1.0f / 3.0f;
  const std::uint32_t h = first_hash + static_cast<std::uint32_t>(ix) * kHashStep[0] +
                          static_cast<std::uint32_t>(iy) * kHashStep[1] +
                          static_cast<std::uint32_t>(iz) * kHashStep[2];
  // 0 or all bits: cheaper than a product of whole numbers.
  const auto step = [](std::uint32_t bit, std::size_t axis) { return (0u - bit) & kHashStep[axis]; };
  return corner(ax, ay, az, h) +
         corner(ax - real(x2) + s, ay - real(y2) + s, az - real(z2) + s,
                h + step(x2, 0) + step(y2, 1) + step(z2, 2)) +
         corner(ax - real(x3) + t, ay - real(y3) + t, az - real(z3) + t,
                h + step(x3, 0) + step(y3, 1) + step(z3, 2)) +
         corner(ax - 0.5f, ay - 0.5f, az - 0.5f, h + kHashStep[0] + kHashStep[1] + kHashStep[2]);
}

/// One octave, as the evaluation wants it.
struct Octave {
  Eigen::Matrix3f lattice_from_map;
  Eigen::Vector3f eye_fraction;
  std::uint32_t hash;
};

SUNLIT_VECTOR_CLONES
void addOctave(const Octave& octave, const DetailPoints& points, const Lanes& weights, float* sums) {
  const Eigen::Matrix3f m = octave.lattice_from_map;
  const float* const l = m.data();  // by columns
  const float fx = octave.eye_fraction.x(), fy = octave.eye_fraction.y(), fz = octave.eye_fraction.z();
  const float *const x = points.x.data(), *const y = points.y.data(), *const z = points.z.data();
  const float* const w = weights.data();
  const std::uint32_t hash = octave.hash;
  float noise[kLanes];
  for (int i = 0; i < kLanes; ++i) {
    noise[i] = simplexNoise(l[0] * x[i] + l[3] * y[i] + l[6] * z[i] + fx,
                            l[1] * x[i] + l[4] * y[i] + l[7] * z[i] + fy,
                            l[2] * x[i] + l[5] * y[i] + l[8] * z[i] + fz, hash);
  }
  for (int i = 0; i < kLanes; ++i) sums[i] += w[i] * noise[i];
}

}  // namespace

float detailSpread_m(std::uint32_t samples, float longer_m, float shorter_m) {
  // k² samples have a variance of (k² − 1) / 12 steps² along each side. A wave loses exp(−½ (2π /
  // wavelength)² · variance) along its direction; over all directions the two sides count half each.
  const float variance = static_cast<float>(samples - 1) / 12.0f;
  return kPiFloat * std::sqrt(variance * (longer_m * longer_m + shorter_m * shorter_m));
}

void sumOctaves(const DetailOctaves& octaves, const DetailPoints& points, Lanes* sums) {
  sums->fill(0.0f);
  const float least = *std::min_element(points.footprint.begin(), points.footprint.end());
  for (std::size_t k = 0; k < static_cast<std::size_t>(octaves.count); ++k) {
    const float wavelength = octaves.wavelength_m[k];
    if (wavelength <= kHiddenSamples * least) break;
    Lanes weights;
    for (std::size_t i = 0; i < kLanes; ++i) {
      const float fade = (wavelength / points.footprint[i] - kHiddenSamples) / kHiddenSamples;
      const float within = points.spread[i] / wavelength, squared = within * within;
      // exp(−squared) to within 0.02.
      weights[i] =
          octaves.weight[k] * std::clamp(fade, 0.0f, 1.0f) / (1.0f + squared * (1.0f + 0.5f * squared));
    }
    const auto& cell = octaves.eye_cell[k];
    addOctave({octaves.lattice_from_map[k], octaves.eye_fraction[k],
               cell[0] * kHashStep[0] + cell[1] * kHashStep[1] + cell[2] * kHashStep[2]},
              points, weights, sums->data());
  }
}

}  // namespace sunlit::render
