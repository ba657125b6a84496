/// Where materials of Gazebo classic's scripts and their pictures are found.
#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "scene/gazebo_material.h"
#include "scene/resource_finder.h"
#include "scene/scene_builder.h"

namespace sunlit::scene {

/// A <script> of SDF.
struct ScriptUse {
  std::string name;               ///< of the material
  std::vector<std::string> uris;  ///< of folders and files
  std::string from_file;          ///< in which it is written
};

/// Gazebo classic reads the addresses of a script and media/materials/scripts of all its folders into one
/// heap. Here the addresses come first, so that equal names of different models stay apart.
class MaterialScripts {
 public:
  MaterialScripts(const ResourceFinder& finder, SceneBuilder& builder) : finder_(finder), builder_(builder) {}

  /// None where no script has it. Its parents may be in any script that is looked through, or beside it.
  std::optional<ScriptMaterial> find(const ScriptUse& use);

  /// The picture of what find() gave: beside the script that names it, in the folders of the addresses, or
  /// in media/materials/textures. None where there is none.
  std::optional<std::string> texture(const ScriptMaterial& material, const ScriptUse& use) const;

 private:
  using Files = std::vector<std::string>;
  std::optional<ScriptMaterial> materialIn(const Files& files, const std::string& name,
                                           std::set<std::string>& open);
  const std::string& textOf(const std::string& file);

  const ResourceFinder& finder_;
  SceneBuilder& builder_;
  std::map<std::string, std::string> texts_;  ///< by file
};

}  // namespace sunlit::scene
