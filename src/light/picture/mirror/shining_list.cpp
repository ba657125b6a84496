#include "light/picture/mirror/shining_list.h"

#include <algorithm>
#include <cmath>

#include "light/geometry/corners.h"
#include "sunlit/light/lamps.h"
#include "sunlit/quantity/photometry.h"

namespace sunlit::light {
namespace {

const scene::Material& materialOf(const Geometry& geometry, const scene::Chunk& chunk) {
  return geometry.scene->materials[static_cast<std::size_t>(chunk.material)];
}

bool isListed(const scene::Material& material) {
  return glows(material, {}) && material.alpha_mode == scene::AlphaMode::kOpaque &&
         material.glass == 0.0f;  // which rays pass
}

}  // namespace

ShiningList::ShiningList(const Geometry& geometry) : geometry_(geometry) {
  for (const scene::Chunk& chunk : geometry.chunks) {
    const scene::Material& material = materialOf(geometry, chunk);
    if (!isListed(material)) continue;
    const float luminance = LinearRgb(material.emission.value).luminance();
    for (std::uint32_t t = chunk.first; t < chunk.first + chunk.count; ++t) {
      const auto& [i, j, k] = geometry.triangles[t];
      const Eigen::Vector3f &a = geometry.positions[i], &b = geometry.positions[j],
                            &c = geometry.positions[k];
      const float area_m2 = 0.5f * (b - a).cross(c - a).norm();
      if (area_m2 > 0.0f)
        all_.push_back({t, (a + b + c) / 3.0f, area_m2, longestEdge(geometry, t), luminance * area_m2,
                        material.double_sided});
    }
  }
  if (all_.size() > kMost) {
    const auto isMore = [](const Shining& one, const Shining& other) {
      return one.power != other.power ? one.power > other.power : one.triangle < other.triangle;
    };
    std::nth_element(all_.begin(), all_.begin() + kMost, all_.end(), isMore);
    all_.resize(kMost);
    std::sort(all_.begin(), all_.end(), isMore);
  }
  for (std::uint32_t n = 0; n < all_.size(); ++n) number_.emplace(all_[n].triangle, n);
}

bool ShiningList::anyIn(const Geometry& geometry) {
  return std::any_of(geometry.chunks.begin(), geometry.chunks.end(), [&](const scene::Chunk& chunk) {
    return chunk.count > 0 && isListed(materialOf(geometry, chunk));
  });
}

// Never too little where it may be seen: what a surface lacks of it its rays have to meet by chance.
float ShiningList::chanceOf(const Shining& one, const Eigen::AlignedBox3f& box) const {
  constexpr float kLeastCosine = 0.05f;
  const float reach_m = 0.5f * box.diagonal().norm();
  const Eigen::Vector3f way = box.center() - one.middle;
  const Eigen::Vector3f& normal = geometry_.planes[one.triangle].normal;
  const float before_m = normal.dot(way), distance_m = std::max(way.norm(), 1e-3f);
  if (!one.both_sides && before_m < -reach_m) return 0.0f;
  const float cosine = std::abs(before_m) / distance_m + reach_m / std::max(distance_m, reach_m);
  const float nearest_m = std::max(box.exteriorDistance(one.middle), 0.5f * one.longest_m);
  return one.power * std::clamp(cosine, kLeastCosine, 1.0f) / (nearest_m * nearest_m);
}

ShiningList::Chances::Chances(const ShiningList& list, const Eigen::AlignedBox3f& box) : list_(list) {
  if (box.isEmpty()) return;
  sums_.reserve(list.all_.size());
  float sum = 0.0f;
  for (const Shining& one : list.all_) sums_.push_back(sum += list.chanceOf(one, box));
}

ShiningList::Point ShiningList::Chances::pick(const Eigen::Vector3f& random) const {
  const auto found = std::upper_bound(sums_.begin(), sums_.end() - 1, random.x() * sums_.back());
  const Shining& one = list_.all_[static_cast<std::size_t>(found - sums_.begin())];
  const Geometry& geometry = list_.geometry_;
  float u = random.y(), v = random.z();
  if (u + v > 1.0f) u = 1.0f - u, v = 1.0f - v;
  const auto& [i, j, k] = geometry.triangles[one.triangle];
  const Eigen::Vector3f& a = geometry.positions[i];
  const Eigen::Vector3f at = a + u * (geometry.positions[j] - a) + v * (geometry.positions[k] - a);
  return {{one.triangle, u, v, 0.0f},
          at,
          geometry.planes[one.triangle].normal,
          one.both_sides,
          density(one.triangle)};
}

float ShiningList::Chances::density(std::uint32_t triangle) const {
  const auto found = list_.number_.find(triangle);
  if (found == list_.number_.end() || !any()) return 0.0f;
  const std::uint32_t n = found->second;
  const float own = sums_[n] - (n > 0 ? sums_[n - 1] : 0.0f);
  return own / (sums_.back() * list_.all_[n].area_m2);
}

}  // namespace sunlit::light
