/// The mesh files of models and robots, each read once.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "scene/mesh_file.h"
#include "scene/resource_finder.h"
#include "scene/scene_builder.h"

namespace sunlit::scene {

class ModelMeshes {
 public:
  /// `looks` as MeshReading::looks.
  ModelMeshes(const ResourceFinder& finder, SceneBuilder& builder, bool looks = true)
      : finder_(finder), builder_(builder), looks_(looks) {}

  /// The parts of the mesh that `from_file` calls `uri`, z up, as RViz and Gazebo have them, whatever axis a
  /// COLLADA file declares. `place` names what shows it in messages. Where the file is missing or cannot be
  /// read, null and a warning, or std::runtime_error, as the finder says.
  const std::vector<MeshPart>* partsOf(const std::string& uri, const std::string& from_file,
                                       const std::string& place);

 private:
  bool read(const std::string& file);

  const ResourceFinder& finder_;
  SceneBuilder& builder_;
  bool looks_;
  std::map<std::string, std::vector<MeshPart>> parts_by_file_;
};

}  // namespace sunlit::scene
