/// Samples on both sides of a wall.
#pragma once

#include "light/bake/samples/scene_samples.h"

namespace sunlit::light {

/// Whether a wall stands between a sample of no use, at the foot of a wall or within it, and another one.
/// Keeps references.
class PartingWalls {
 public:
  PartingWalls(const BakeScene& scene, const SceneSamples& samples) : scene_(scene), samples_(samples) {}
  bool operator()(std::uint32_t useless, std::uint32_t other) const;

 private:
  const BakeScene& scene_;
  const SceneSamples& samples_;
};

}  // namespace sunlit::light
