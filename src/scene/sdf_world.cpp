#include "scene/sdf_world.h"

#include <cstddef>
#include <map>
#include <sdf/Root.hh>
#include <sdf/World.hh>
#include <stdexcept>
#include <string>

#include "scene/scene_builder.h"
#include "scene/sdf_files.h"
#include "scene/sdf_state.h"
#include "scene/sdf_visuals.h"

namespace sunlit::scene {
namespace {

/// Of materials that share a name, each by the first mesh that has it, too.
void nameApart(Scene& scene) {
  std::map<int, std::string> mesh_by_material;
  std::map<std::string, int> users_by_name;
  for (const Mesh& mesh : scene.meshes) {
    if (mesh_by_material.emplace(mesh.material, mesh.name).second)
      ++users_by_name[scene.materials[static_cast<std::size_t>(mesh.material)].name];
  }
  for (const auto& [material, mesh] : mesh_by_material) {
    std::string& name = scene.materials[static_cast<std::size_t>(material)].name;
    if (users_by_name[name] > 1 && name != mesh) name += " of " + mesh;
  }
}

}  // namespace

Scene loadSdf(const std::string& file, const ResourceFinder& finder) {
  SceneBuilder builder(file);
  SdfFiles files(finder, builder);
  const SdfFile& read = files.read(file);
  SdfVisuals visuals(file, finder, builder);
  if (read.state) visuals.standAs(SdfState(*read.state, read.path));
  visuals.addFile(read);
  for (std::uint64_t i = 0; i < read.root.WorldCount(); ++i) {
    const sdf::World& world = *read.root.WorldByIndex(i);
    for (std::uint64_t k = 0; k < world.LightCount(); ++k) {
      const sdf::Light& light = *world.LightByIndex(k);
      visuals.addLight(light, Eigen::Affine3d::Identity(), {light.Name(), light.Name()});
    }
  }
  for (const std::string& model : visuals.state().unknownModels())
    builder.warn("models of the <state> are not in the world", model);
  Scene scene = builder.finish();
  if (scene.meshes.empty())
    throw std::runtime_error(file + ": there is nothing to see in this file" + reasonsOf(scene.warnings));
  nameApart(scene);
  return scene;
}

}  // namespace sunlit::scene
