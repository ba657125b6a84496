/// What rays see through: what blends, and glass.
#pragma once

#include <Eigen/Geometry>
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
  bool hasEvenBlends() const { return has_even_; }
  /// See Visibility.
  bool hasDark() const { return has_dark_; }
  /// Of a triangle of `geometry`: see light::blendsEvenly().
  bool blendsEvenly(std::uint32_t triangle) const {
    return even_[static_cast<std::size_t>(geometry_.materials[triangle])];
  }
  /// Adds what `sight` meets, nearest first, at most Visibility::kMostVeils, its triangles numbered from
  /// `first_triangle` on.
  void add(const Visibility::Sight& sight, std::uint32_t first_triangle, std::vector<Hit>* hits) const;

 private:
  const Geometry& geometry_;
  std::vector<std::uint32_t> triangles_;
  Eigen::AlignedBox3f box_;  ///< about all of them, and a little more
  std::vector<bool> even_;   ///< of each material that is used: whether it blends evenly
  bool has_glass_ = false, has_even_ = false, has_dark_ = false;
  ScenePointer scene_;  ///< null: there are none
};

}  // namespace sunlit::light
