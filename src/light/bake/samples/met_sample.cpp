#include "light/bake/samples/met_sample.h"

#include <algorithm>

namespace sunlit::light {
namespace {

/// Of the side that a ray has met, or else of its other one; LightMesh::kNone where there are no samples.
std::uint32_t rootAt(const BakeScene& scene, const SceneSamples& samples, const LaneHit& hit) {
  const std::uint32_t t = hit.hits.triangle[hit.lane];
  if (t == HitPacket::kNothing) return LightMesh::kNone;
  const std::size_t side = scene.geometry.planes[t].normal.dot(hit.towards) > 0.0f ? 1 : 0;
  if (side == 1 && scene.traits[t].solid) return LightMesh::kNone;
  std::uint32_t root = samples.mesh.roots[t][side];
  if (!LightMesh::isCell(root)) root = samples.mesh.roots[t][1 - side];
  return LightMesh::isCell(root) ? root : LightMesh::kNone;
}

}  // namespace

std::uint32_t sampleOn(const SceneSamples& samples, std::uint32_t root, const Eigen::Vector3f& within) {
  const LightMesh::Place place = samples.mesh.locate(root, {within[0], within[1], within[2]});
  const auto largest = std::max_element(place.weight.begin(), place.weight.end()) - place.weight.begin();
  return samples.nearest_sample[place.node[static_cast<std::size_t>(largest)]];
}

bool hasSampleAt(const BakeScene& scene, const SceneSamples& samples, const LaneHit& hit) {
  return rootAt(scene, samples, hit) != LightMesh::kNone;
}

std::uint32_t sampleAt(const BakeScene& scene, const SceneSamples& samples, const LaneHit& hit) {
  const std::uint32_t root = rootAt(scene, samples, hit);
  if (root == LightMesh::kNone) return LightMesh::kNone;
  const float u = hit.hits.u[hit.lane], v = hit.hits.v[hit.lane];
  return sampleOn(samples, root, {1.0f - u - v, u, v});
}

}  // namespace sunlit::light
