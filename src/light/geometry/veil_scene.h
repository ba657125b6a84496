/// What rays see through: what blends, and glass.
#pragma once

#include <cstdint>
#include <vector>

#include "light/geometry/triangle_mesh.h"
#include "sunlit/light/visibility.h"

namespace sunlit::light {

class VeilScene {
 public:
  /// Keeps a reference to `geometry`, and the device alive.
  VeilScene(const Geometry& geometry, RTCDevice device);

  bool any() const { return !triangles_.empty(); }
  bool hasGlass() const { return has_glass_; }
  /// Adds what `sight` meets, nearest first, at most Visibility::kMostVeils, its triangles numbered from
  /// `first_triangle` on.
  void add(const Visibility::Sight& sight, std::uint32_t first_triangle, std::vector<Hit>* hits) const;

 private:
  const Geometry& geometry_;
  std::vector<std::uint32_t> triangles_;
  bool has_glass_ = false;
  ScenePointer scene_;  ///< null: there are none
};

}  // namespace sunlit::light
