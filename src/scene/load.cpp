#include "sunlit/scene/load.h"

#include <algorithm>
#include <filesystem>
#include <stdexcept>

#include "scene/mesh_file.h"
#include "scene/resource_finder.h"
#include "scene/scene_builder.h"
#include "scene/sdf_world.h"
#include "sunlit/scene/race_track.h"

namespace sunlit::scene {
namespace {

bool isOneOf(const std::string& extension, std::initializer_list<const char*> known) {
  return std::find(known.begin(), known.end(), extension) != known.end();
}

Scene loadMeshFile(const std::string& file, const ResourceFinder& finder) {
  SceneBuilder builder(file);
  for (const MeshPart& part : readMeshFile(file, UpAxis::kAsDeclared, finder, builder)) {
    builder.addMesh(part.mesh, part.file_from_node);
  }
  Scene scene = builder.finish();
  if (scene.meshes.empty()) throw std::runtime_error(file + ": there is not a triangle in this file");
  return scene;
}

}  // namespace

Scene load(const std::string& world, const SearchPath& search_path) {
  if (world == kRaceTrack) return raceTrack();
  const ResourceFinder finder(search_path, world);
  const Found found = finder.find(world, world);
  if (!found.file || std::filesystem::is_directory(*found.file)) {
    throw std::runtime_error("there is no world " + world + "; it was looked for as " + placesTried(found));
  }
  const std::string extension = extensionOf(*found.file);
  if (isOneOf(extension, {".world", ".sdf"}))
    return loadSdf(*found.file, ResourceFinder(search_path, *found.file));
  if (isOneOf(extension, {".dae", ".gltf", ".glb", ".obj"})) {
    return loadMeshFile(*found.file, ResourceFinder(search_path, *found.file));
  }
  throw std::runtime_error(*found.file +
                           ": cannot tell its format; its name must end in .world, .sdf, .dae, .gltf, .glb "
                           "or .obj");
}

}  // namespace sunlit::scene
