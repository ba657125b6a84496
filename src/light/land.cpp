#include "sunlit/light/land.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "light/shading/reflectances.h"

namespace sunlit::light {
namespace {

constexpr std::size_t kPlaces = std::size_t{1} << 18;
constexpr std::size_t kBlock = 4096;
constexpr std::size_t kHeights = std::size_t{1} << 12;  ///< places of groundLevel()

/// A part of a sum of albedos.
struct Sum {
  double albedo = 0.0;
  std::size_t count = 0;
};

/// A place on a triangle.
struct Spot {
  std::uint32_t triangle;
  Eigen::Vector3f within;  ///< shares of its corners
  float z;
};

class FromAbove {
 public:
  FromAbove(const Geometry& geometry, const Visibility& visibility)
      : geometry_(geometry), visibility_(visibility) {
    areas_up_to_.reserve(geometry_.triangles.size());
    double sum = 0.0;
    float highest = 0.0f;
    for (std::uint32_t t = 0; t < geometry_.triangles.size(); ++t) {
      sum += levelArea(t);
      areas_up_to_.push_back(sum);
    }
    for (const Eigen::Vector3f& position : geometry_.positions) highest = std::max(highest, position.z());
    eye_height_m_ = highest + 1.0f;
  }

  bool isEmpty() const { return areas_up_to_.empty() || !(areas_up_to_.back() > 0.0); }
  const scene::Material& materialOf(std::uint32_t triangle) const {
    return geometry_.scene->materials[static_cast<std::size_t>(geometry_.materials[triangle])];
  }

  /// One of so many `places`, at equal steps of area through all triangles, and within each by Roberts'
  /// sequence R2 (2018). Nothing where something else is seen before it. Not if isEmpty().
  std::optional<Spot> seen(std::size_t place, std::size_t places) const {
    const double at = areas_up_to_.back() * (static_cast<double>(place) + 0.5) / static_cast<double>(places);
    const auto found = std::lower_bound(areas_up_to_.begin(), areas_up_to_.end(), at);
    const auto triangle = static_cast<std::uint32_t>(found - areas_up_to_.begin());
    constexpr double kFirst = 0.7548776662466927, kSecond = 0.5698402909980532;
    double u = kFirst * static_cast<double>(place), v = kSecond * static_cast<double>(place);
    u -= std::floor(u);
    v -= std::floor(v);
    if (u + v > 1.0) {
      u = 1.0 - u;
      v = 1.0 - v;
    }
    const Eigen::Vector3f within(static_cast<float>(1.0 - u - v), static_cast<float>(u),
                                 static_cast<float>(v));
    Eigen::Vector3f eye = Eigen::Vector3f::Zero();
    for (int k = 0; k < 3; ++k)
      eye += within[k] * geometry_.positions[geometry_.triangles[triangle][static_cast<std::size_t>(k)]];
    const float z = eye.z();
    eye.z() = eye_height_m_;
    const auto first = visibility_.firstSeen(eye, -Eigen::Vector3f::UnitZ(), 0.0f);
    if (!first || *first != triangle) return std::nullopt;
    return Spot{triangle, within, z};
  }

 private:
  /// m² of its shadow under a sun overhead; none of what is never seen first from there.
  double levelArea(std::uint32_t triangle) const {
    const scene::Material& material = materialOf(triangle);
    if (material.alpha_mode == scene::AlphaMode::kBlend) return 0.0;
    const auto& [a, b, c] = geometry_.triangles[triangle];
    const Eigen::Vector2d u = (geometry_.positions[b] - geometry_.positions[a]).head<2>().cast<double>();
    const Eigen::Vector2d v = (geometry_.positions[c] - geometry_.positions[a]).head<2>().cast<double>();
    const double area = 0.5 * (u.x() * v.y() - u.y() * v.x());
    return material.double_sided ? std::abs(area) : std::max(area, 0.0);
  }

  const Geometry& geometry_;
  const Visibility& visibility_;
  std::vector<double> areas_up_to_;  ///< m² of each triangle and all before it
  float eye_height_m_ = 0.0f;
};

/// Of the light that falls on it.
double albedoOf(const Spot& spot, const FromAbove& above, const Reflectances& reflectances,
                const Geometry& geometry) {
  const bool front = geometry.planes[spot.triangle].normal.z() > 0.0f;
  Paint paint = reflectances.at({spot.triangle, front}, spot.within);
  paint.albedo *= 1.0f - above.materialOf(spot.triangle).transmission;
  return static_cast<double>(LinearRgb(meanReflectance(paint).all()).luminance());
}

std::optional<double> meanAlbedo(const World& world) {
  const FromAbove above(*world.geometry, *world.visibility);
  if (above.isEmpty()) return std::nullopt;
  const Reflectances reflectances(*world.geometry);
  std::vector<Sum> blocks(kPlaces / kBlock);
  tbb::parallel_for(std::size_t{0}, blocks.size(), [&](std::size_t b) {
    for (std::size_t i = b * kBlock; i < (b + 1) * kBlock; ++i) {
      const std::optional<Spot> spot = above.seen(i, kPlaces);
      if (!spot) continue;
      blocks[b].albedo += albedoOf(*spot, above, reflectances, *world.geometry);
      ++blocks[b].count;
    }
  });
  Sum all;
  for (const Sum& block : blocks) {
    all.albedo += block.albedo;
    all.count += block.count;
  }
  if (all.count == 0) return std::nullopt;
  return all.albedo / static_cast<double>(all.count);
}

}  // namespace

float groundLevel(const Geometry& geometry, const Visibility& visibility) {
  const FromAbove above(geometry, visibility);
  if (above.isEmpty()) return 0.0f;
  std::vector<float> heights;
  for (std::size_t i = 0; i < kHeights; ++i) {
    if (const std::optional<Spot> spot = above.seen(i, kHeights)) heights.push_back(spot->z);
  }
  if (heights.empty()) return 0.0f;
  const auto middle = heights.begin() + static_cast<std::ptrdiff_t>((heights.size() - 1) / 2);
  std::nth_element(heights.begin(), middle, heights.end());
  return *middle;
}

std::optional<double> albedoFromAbove(const World& world) {
  const std::optional<double> mean = meanAlbedo(world);
  if (!mean) return std::nullopt;
  // What prints exactly is the same again when it is typed.
  return std::clamp(std::round(1000.0 * *mean) / 1000.0, 0.0, 1.0);
}

}  // namespace sunlit::light
