#include "scene/sdf_world.h"

#include <Eigen/Geometry>
#include <sdf/Model.hh>
#include <sdf/Root.hh>
#include <sdf/World.hh>
#include <stdexcept>

#include "scene/scene_builder.h"
#include "scene/sdf_file.h"
#include "scene/sdf_includes.h"
#include "scene/sdf_pose.h"
#include "scene/sdf_state.h"
#include "scene/sdf_visuals.h"

namespace sunlit::scene {
namespace {

void addWorld(const sdf::World& world, SdfVisuals& visuals, SceneBuilder& builder) {
  for (std::uint64_t i = 0; i < world.ModelCount(); ++i) {
    visuals.addModel(*world.ModelByIndex(i), Eigen::Isometry3d::Identity(), "");
  }
  if (world.LightCount() > 0) builder.count("lights of the world were not read", world.LightCount());
  if (world.ActorCount() > 0) builder.count("actors of the world were not read", world.ActorCount());
}

}  // namespace

Scene loadSdf(const std::string& file, const ResourceFinder& finder) {
  SdfIncludes includes(file, finder);
  SceneBuilder builder(file);
  sdf::Root root;
  readSdf(includes, SdfSharing::kShared, root, builder);
  SdfVisuals visuals(file, finder, builder);
  // What was included counts as of the only world that files have in practice.
  const SdfState state = root.WorldCount() > 0 ? SdfState(*root.WorldByIndex(0), builder) : SdfState();
  visuals.standAs(state);
  for (std::uint64_t i = 0; i < root.WorldCount(); ++i) addWorld(*root.WorldByIndex(i), visuals, builder);
  if (root.Model() != nullptr) visuals.addModel(*root.Model(), Eigen::Isometry3d::Identity(), "");
  for (const SdfIncludes::Instance& instance : includes.instances()) {
    visuals.addModelAt(*instance.model, toEigen(instance.pose), instance.name);
  }
  if (state.unknownModels() > 0)
    builder.count("models of the <state> are not in the world", state.unknownModels());
  Scene scene = builder.finish();
  if (scene.meshes.empty()) throw std::runtime_error(file + ": there is nothing to see in this file");
  return scene;
}

}  // namespace sunlit::scene
