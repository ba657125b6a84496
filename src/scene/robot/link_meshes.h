/// Tells which of the meshes in a builder belong to which link.
#pragma once

#include <string>
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
  void begin(std::size_t link) { begins_.push_back({link, builder_.meshCount(), builder_.lampCount()}); }
  /// Fills in meshes, lamps, materials, textures and warnings. Throws std::runtime_error if there is nothing
  /// to see.
  void finish(Robot* robot);

 private:
  struct Begin {
    std::size_t link, mesh, lamp;  ///< its first ones
  };
  std::string origin_;
  SceneBuilder builder_;
  std::vector<Begin> begins_;
};

}  // namespace sunlit::scene
