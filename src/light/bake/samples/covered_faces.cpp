#include "light/bake/samples/covered_faces.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cstddef>

#include "light/bake/samples/triangle_kinds.h"
#include "light/bake/samples/triangle_places.h"

namespace sunlit::light {
namespace {

using Faces = std::array<std::uint32_t, RayPacket::kSize>;

/// What looks the other way at one place of each of up to a packet of triangles, or HitPacket::kNothing.
Faces facesAt(const Eigen::Vector3f& place, const std::uint32_t* triangles, std::size_t count,
              const RayScene& scene) {
  constexpr float kFrom_m = 2e-3f, kOpposite = -0.999f;
  const Geometry& geometry = scene.geometry();
  RayPacket rays;
  RayReach reach;
  for (std::size_t i = 0; i < RayPacket::kSize; ++i) {
    const std::uint32_t t = triangles[std::min(i, count - 1)];
    // From behind: what looks the other way shows its front there.
    const Eigen::Vector3f& normal = geometry.planes[t].normal;
    rays.set(i, placeOn(geometry, t, place) - kFrom_m * normal, normal, i < count);
    reach.from[i] = kFrom_m - kSamePlace_m;
    reach.to[i] = kFrom_m + kSamePlace_m;
  }
  HitPacket hits;
  scene.castAmong(RayScene::Facing::kTowards, rays, reach, &hits);
  Faces faces;
  faces.fill(HitPacket::kNothing);
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint32_t hit = hits.triangle[i];
    if (hit == HitPacket::kNothing) continue;
    if (geometry.planes[hit].normal.dot(geometry.planes[triangles[i]].normal) < kOpposite) faces[i] = hit;
  }
  return faces;
}

}  // namespace

std::vector<Cover> covers(const RayScene& scene) {
  const Geometry& geometry = scene.geometry();
  std::vector<std::uint32_t> solid;
  for (std::uint32_t t = 0; t < geometry.triangles.size(); ++t)
    if (!isLeaf(triangleKind(geometry, t))) solid.push_back(t);
  std::vector<std::array<std::uint32_t, kTrianglePlaces.size()>> found(solid.size());
  const std::size_t packets = (solid.size() + RayPacket::kSize - 1) / RayPacket::kSize;
  tbb::parallel_for(std::size_t{0}, packets, [&](std::size_t p) {
    const std::size_t first = p * RayPacket::kSize;
    const std::size_t count = std::min<std::size_t>(solid.size() - first, RayPacket::kSize);
    for (std::size_t place = 0; place < kTrianglePlaces.size(); ++place) {
      const Faces faces = facesAt(kTrianglePlaces[place], solid.data() + first, count, scene);
      for (std::size_t i = 0; i < count; ++i) found[first + i][place] = faces[i];
    }
  });
  std::vector<Cover> covers(geometry.triangles.size(), Cover::kNone);
  bool any = false;
  for (std::size_t i = 0; i < solid.size(); ++i) {
    std::size_t covered = 0;
    for (const std::uint32_t face : found[i]) {
      if (face == HitPacket::kNothing) continue;
      ++covered;
      // A large face may be covered where it is not looked at.
      covers[face] = std::max(covers[face], Cover::kPart);
    }
    if (covered == 0) continue;
    any = true;
    covers[solid[i]] = std::max(covers[solid[i]], covered == found[i].size() ? Cover::kWhole : Cover::kPart);
  }
  return any ? covers : std::vector<Cover>();
}

}  // namespace sunlit::light
