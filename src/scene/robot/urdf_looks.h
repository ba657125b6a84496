/// Materials that a URDF's <gazebo> elements write as SDF does.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "scene/resource_finder.h"
#include "scene/scene_builder.h"

namespace sunlit::scene {

class UrdfLooks {
 public:
  /// `origin` is the file of the URDF: its pictures are looked for from there.
  UrdfLooks(const std::string& origin, const ResourceFinder& finder, SceneBuilder& builder);
  ~UrdfLooks();

  /// Index in the builder of what this <material> element says, the same for equal ones. None, with a warning
  /// naming `place`, where nothing comes of it.
  std::optional<int> add(const std::string& element, const std::string& place);

  /// Gives `mesh` a material of the builder; one of add() with its texture as large as it says.
  void put(int material, Mesh& mesh) const;

 private:
  class Reader;
  std::unique_ptr<Reader> reader_;
  SceneBuilder& builder_;
};

}  // namespace sunlit::scene
