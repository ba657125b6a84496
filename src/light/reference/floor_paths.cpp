// Paths by way of polished floors to the discs that they mirror.
#include <algorithm>
#include <cmath>
#include <utility>

#include "light/reference/paths.h"
#include "light/shading/polished_floor.h"
#include "sunlit/quantity/angle.h"

namespace sunlit::light {
namespace {

/// Random numbers, beyond those of paths.cpp: four a bounce and day.
constexpr std::uint64_t kInFloors = std::uint64_t{1} << 34;

}  // namespace

/// By the mean roughness of materials that level triangles have and that are polished.
std::optional<Ggx<float>> facetsOfFloors(const Geometry& geometry) {
  double sum = 0.0, areas = 0.0;
  for (std::size_t t = 0; t < geometry.triangles.size(); ++t) {
    const scene::Material& material =
        geometry.scene->materials[static_cast<std::size_t>(geometry.materials[t])];
    if (std::abs(geometry.planes[t].normal.z()) < kFlat || !(material.roughness < kPolished)) continue;
    const bool metal = material.metalness >= 0.5f && !material.metalness_map.given();
    if (material.glass > 0.0f || material.transmission > 0.0f || metal) continue;
    const auto& c = geometry.triangles[t];
    const Eigen::Vector3f& a = geometry.positions[c[0]];
    const auto area =
        static_cast<double>((geometry.positions[c[1]] - a).cross(geometry.positions[c[2]] - a).norm());
    sum += area * static_cast<double>(material.roughness);
    areas += area;
  }
  if (!(areas > 0.0)) return std::nullopt;
  return Ggx<float>::ofRoughness(static_cast<float>(sum / areas));
}

float Paths::densityInFloors(const Path& path, const Eigen::Vector3f& towards) const {
  if (!scene_.floors || !(path.density > 0.0f) || !isPolishedFloor(path.vertex)) return 0.0f;
  const Eigen::Vector3f facet = (towards + path.vertex.reflection.to_eye).normalized();
  const float cosine = facet.dot(towards);
  return facet.z() > 0.0f && cosine > 0.0f ? scene_.floors->mirroredDensity(facet.z(), cosine) : 0.0f;
}

// Weighed as the sky's directions are, see addSkyOf().
void Paths::addDiscInFloors(const Disc& disc, int bounce) {
  if (!scene_.floors || bounce >= scene_.options.bounces) return;
  bundle_.clear();
  weights_.clear();
  std::vector<Eigen::Vector3f> points;
  for (std::size_t i = 0; i < paths_.size(); ++i) {
    const Path& path = paths_[i];
    const std::uint64_t number =
        kInFloors + 4 * (static_cast<std::uint64_t>(bounce) * scene_.days.size() + disc.day);
    const auto next = [&](std::uint64_t k) { return uniform(path.key, number + k); };
    const Eigen::Vector3f point = disc.area.point(next(0), next(1));
    const Eigen::Vector3f facet = scene_.floors->normal(next(2), next(3));
    const float cosine = facet.dot(point);
    if (!(cosine > 0.0f)) continue;
    const Eigen::Vector3f down = -mirrored(point, facet).normalized();
    if (!path.vertex.faces(down)) continue;
    const Eigen::Array3f reflectance = directReflectance(path.vertex.reflection, down, 0.0f);
    if (!(reflectance.maxCoeff() > 0.0f)) continue;
    const float density =
        scene_.floors->mirroredDensity(facet.z(), cosine) + scatterDensity(path.vertex.reflection, down);
    bundle_.add(path.vertex.origin(down), down, i);
    weights_.push_back(path.throughput * reflectance * disc.light.illuminance.value / density);
    points.push_back(point);
  }
  goOnFromFloors(points);
  throughCloud(disc);
  castAndAdd(disc.day);
}

void Paths::goOnFromFloors(const std::vector<Eigen::Vector3f>& points) {
  hits_.resize(bundle_.path.size());
  scene_.world.visibility->closest(bundle_.rays(), hits_.data());
  Bundle up;
  std::size_t kept = 0;
  for (std::size_t k = 0; k < hits_.size(); ++k) {
    if (hits_[k].triangle == Hit::kMiss) continue;
    const Eigen::Vector3f down = bundle_.direction(k);
    const Vertex floor = scene_.vertices.at(hits_[k], down);
    if (!isPolishedFloor(floor)) continue;
    weights_[k] *= directReflectance(floor.reflection, points[k], 0.0f);
    if (scene_.glass.any())
      weights_[k] *= scene_.glass.through({bundle_.origin(k), down, 0.0f, hits_[k].distance});
    up.add(floor.front, points[k], bundle_.path[k]);
    weights_[kept++] = weights_[k];
  }
  weights_.resize(kept);
  bundle_ = std::move(up);
}

}  // namespace sunlit::light
