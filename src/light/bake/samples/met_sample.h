/// Which sample stands for what a ray has met.
#pragma once

#include "light/bake/samples/scene_samples.h"

namespace sunlit::light {

/// The sample that counts most at a place of a triangle's side, given by the root of its cells and
/// barycentric coordinates.
std::uint32_t sampleOn(const SceneSamples& samples, std::uint32_t root, const Eigen::Vector3f& within);

/// One lane of rays that were cast.
struct LaneHit {
  const HitPacket& hits;
  int lane;
  const Eigen::Vector3f& towards;
};
/// Whether a ray has met what has samples: not for the inside of a body, nor for nothing.
bool hasSampleAt(const BakeScene& scene, const SceneSamples& samples, const LaneHit& hit);

/// The sample nearest to where a ray has met a triangle; LightMesh::kNone where there is none.
std::uint32_t sampleAt(const BakeScene& scene, const SceneSamples& samples, const LaneHit& hit);

}  // namespace sunlit::light
