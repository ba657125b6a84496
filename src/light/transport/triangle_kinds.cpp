#include "light/transport/triangle_kinds.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "light/transport/probe.h"

namespace sunlit::light {
namespace {

constexpr float kLargeEdge_m = 6.0f;
constexpr float kLargeArea_m2 = 0.3f;
constexpr float kLargestLeaf_m2 = 2.0f;
constexpr float kSmallestSpray_m2 = 0.3f;
constexpr float kLargestSpray_m2 = 4.0f;
constexpr float kClear_m = 2e-3f;

/// Shares of what one side of a triangle sees from its middle.
struct Outlook {
  float up = 0.0f, down = 0.0f, backs = 0.0f, fronts = 0.0f;
  float all() const { return up + down + backs + fronts; }
  /// Nothing escapes, and much of what is seen is seen from behind: within a body, maybe a hollow one.
  bool inside() const { return up + down <= 0.0f && backs > 0.4f * all(); }
  /// Within one that nobody looks into.
  bool sealed() const { return inside() && backs > 0.8f * all(); }
  /// Nothing of the scene and nothing of the sky: the underside of the world.
  bool buried() const { return up + backs + fronts <= 0.0f; }
};

using Outlooks = std::array<Outlook, RayPacket::kSize>;

Outlooks outlooks(const Geometry& geometry, const BakeRays& rays, const std::vector<SkyPatches::Ray>& pattern,
                  const std::vector<std::uint32_t>& triangles, std::size_t first, int side) {
  const int count = static_cast<int>(std::min<std::size_t>(RayPacket::kSize, triangles.size() - first));
  std::array<Site, RayPacket::kSize> sites;
  for (int i = 0; i < count; ++i) {
    const std::uint32_t t = triangles[first + static_cast<std::size_t>(i)];
    Site& site = sites[static_cast<std::size_t>(i)];
    site.normal = sideNormal(geometry, t, side);
    site.lifts.fill(kClear_m * site.normal);
    Eigen::Vector3f middle = Eigen::Vector3f::Zero();
    for (std::uint32_t v : geometry.triangles[t]) middle += geometry.positions[v] / 3.0f;
    site.origins.fill(middle);
  }
  Outlooks result;
  probe(rays, pattern, sites.data(), count, [&](int i, std::size_t r, float weight, const HitPacket& hits) {
    Outlook& outlook = result[static_cast<std::size_t>(i)];
    const std::uint32_t hit = hits.triangle[i];
    if (hit == HitPacket::kNothing) {
      (pattern[r].towards.z() > 0.0f ? outlook.up : outlook.down) += weight;
    } else {
      // Leaves turn their backs to all sides.
      const bool back =
          geometry.planes[hit].normal.dot(pattern[r].towards) > 0.0f && !isLeaf(triangleKind(geometry, hit));
      (back ? outlook.backs : outlook.fronts) += weight;
    }
  });
  return result;
}

}  // namespace

TriangleKind triangleKind(const Geometry& geometry, std::uint32_t t) {
  const auto& corners = geometry.triangles[t];
  const Eigen::Vector3f a = geometry.positions[corners[0]];
  const Eigen::Vector3f ab = geometry.positions[corners[1]] - a, ac = geometry.positions[corners[2]] - a;
  const float longest = std::sqrt(std::max({ab.squaredNorm(), ac.squaredNorm(), (ac - ab).squaredNorm()}));
  const float area = 0.5f * ab.cross(ac).norm();
  const scene::Material& material =
      geometry.scene->materials[static_cast<std::size_t>(geometry.materials[t])];
  if (material.alpha_mode == scene::AlphaMode::kMask) {
    const bool leaf = material.transmission > 0.0f;
    if (leaf && area > kLargestSpray_m2) return TriangleKind::kCanopy;
    if (leaf && area > kSmallestSpray_m2) return TriangleKind::kSpray;
    if (area < kLargestLeaf_m2) return TriangleKind::kFoliage;
  }
  return longest < kLargeEdge_m && area < kLargeArea_m2 ? TriangleKind::kSmall : TriangleKind::kLarge;
}

std::vector<TriangleTraits> triangleTraits(const Geometry& geometry, const BakeRays& rays) {
  std::vector<TriangleTraits> traits(geometry.triangles.size());
  std::vector<std::uint32_t> opaque;
  for (std::uint32_t t = 0; t < traits.size(); ++t) {
    traits[t].kind = triangleKind(geometry, t);
    if (!isLeaf(traits[t].kind)) opaque.push_back(t);
  }
  std::vector<SkyPatches::Ray> pattern;
  const SkyPatches patches(1);
  for (std::size_t i = 0; i < patches.coarseRays().size(); i += 6) pattern.push_back(patches.coarseRays()[i]);
  const std::size_t packets = (opaque.size() + RayPacket::kSize - 1) / RayPacket::kSize;
  tbb::parallel_for(std::size_t{0}, packets, [&](std::size_t p) {
    const std::size_t first = p * RayPacket::kSize;
    const std::size_t end = std::min(first + RayPacket::kSize, opaque.size());
    for (int side = 0; side < 2; ++side) {
      const Outlooks seen = outlooks(geometry, rays, pattern, opaque, first, side);
      for (std::size_t i = first; i < end; ++i) {
        const Outlook& outlook = seen[i - first];
        TriangleTraits& to = traits[opaque[i]];
        if (side == 1) to.solid = outlook.inside();
        to.used[side] = !outlook.sealed() && !outlook.buried();
      }
    }
  });
  for (std::uint32_t t = 0; t < traits.size(); ++t) {
    const auto material = static_cast<std::size_t>(geometry.materials[t]);
    if (!geometry.scene->materials[material].double_sided) traits[t].used[1] = false;
  }
  return traits;
}

}  // namespace sunlit::light
