/// Rigid things that move, such as the links of a robot, beside a scene that stands still.
#pragma once

#include <Eigen/Geometry>
#include <memory>
#include <vector>

#include "sunlit/light/geometry.h"

namespace sunlit::light {

class Bodies {
 public:
  /// `meshes_of_bodies` holds one list a body, in the body's frame, with materials of `scene`.
  Bodies(std::shared_ptr<const scene::Scene> scene,
         const std::vector<std::vector<scene::Mesh>>& meshes_of_bodies);

  std::size_t count() const { return first_vertices_.size() - 1; }

  /// All of them where they stand, in `map`: the same triangles in the same order at every call. Throws
  /// std::invalid_argument unless there are count() transforms, all finite.
  std::shared_ptr<const Geometry> placed(const std::vector<Eigen::Isometry3d>& map_from_body) const;
  /// Which body a triangle of placed() belongs to.
  std::uint32_t bodyOf(std::uint32_t triangle) const {
    return body_of_vertex_[at_home_.triangles[triangle][0]];
  }
  /// Around one body of `placed`, a result of placed(); empty if it has no triangle.
  Eigen::AlignedBox3f boxOf(std::size_t body, const Geometry& placed) const;
  /// Of all its triangles, m².
  float surfaceOf(std::size_t body) const { return surfaces_m2_[body]; }

 private:
  Geometry at_home_;                           ///< each body in its own frame
  std::vector<std::uint32_t> first_vertices_;  ///< of each body, and the end; those of a body stand together
  std::vector<std::uint32_t> body_of_vertex_;
  std::vector<float> surfaces_m2_;
};

}  // namespace sunlit::light
