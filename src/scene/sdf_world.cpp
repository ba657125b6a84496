#include "scene/sdf_world.h"

#include <sdf/Root.hh>
#include <sdf/World.hh>
#include <stdexcept>

#include "scene/scene_builder.h"
#include "scene/sdf_files.h"
#include "scene/sdf_state.h"
#include "scene/sdf_visuals.h"

namespace sunlit::scene {

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
  return scene;
}

}  // namespace sunlit::scene
