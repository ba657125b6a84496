/// Tells which of the meshes in a builder belong to which link.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "scene/scene_builder.h"
#include "sunlit/scene/robot.h"

namespace sunlit::scene {

class LinkMeshes {
 public:
  /// `origin` is the file of the robot, or what stands for it.
  explicit LinkMeshes(const std::string& origin) : origin_(origin), builder_(origin) {}

  SceneBuilder& builder() { return builder_; }
  /// What is added from now on belongs to this index into Robot::links.
  void begin(std::size_t link) { begins_.emplace_back(link, builder_.meshCount()); }
  /// Fills in meshes, materials, textures and warnings. Throws std::runtime_error if there is nothing to see.
  void finish(Robot* robot);

 private:
  std::string origin_;
  SceneBuilder builder_;
  std::vector<std::pair<std::size_t, std::size_t>> begins_;  ///< link, its first mesh
};

}  // namespace sunlit::scene
