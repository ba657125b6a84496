#include "sunlit/scene/load.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <filesystem>
#include <stdexcept>
#include <utility>
#include <vector>

#include "scene/mesh_file.h"
#include "scene/resource_finder.h"
#include "scene/scene_builder.h"
#include "scene/sdf_world.h"
#include "sunlit/image/files.h"
#include "sunlit/scene/race_track.h"
#include "sunlit/scene/robot.h"

namespace sunlit::scene {
namespace {

/// `warning` without the places where it says of what file it is: the one that is loaded.
std::string withoutPath(std::string warning, const std::string& file) {
  const std::string of_file = " of " + file;
  for (std::size_t at = warning.find(of_file); at != std::string::npos; at = warning.find(of_file, at + 1)) {
    const std::size_t end = at + of_file.size();
    const bool whole = end == warning.size() || std::string(" :;,").find(warning[end]) != std::string::npos;
    if (whole) warning.erase(at, of_file.size());
  }
  return warning;
}

bool isOneOf(const std::string& extension, std::initializer_list<const char*> known) {
  return std::find(known.begin(), known.end(), extension) != known.end();
}

Scene loadMeshFile(const std::string& file, const ResourceFinder& finder) {
  SceneBuilder builder(file);
  for (MeshPart& part : readMeshFile(file, {UpAxis::kAsDeclared}, finder, builder)) {
    leaveCoordinates(true, part);
    builder.addPiece(part.mesh, part.file_from_node);
  }
  Scene scene = builder.finish();
  for (std::string& warning : scene.warnings) warning = withoutPath(std::move(warning), file);
  if (scene.meshes.empty()) {
    throw std::runtime_error(file + ": there is not a triangle in this file that could be drawn" +
                             reasonsOf(scene.warnings));
  }
  return scene;
}

/// A robot at rest, its root link at the origin: how surroundings are spawned where SDF is not at hand.
Scene loadUrdf(const std::string& file, const SearchPath& search_path) {
  const Robot robot = loadRobot(file, search_path);
  Scene scene;
  scene.name = file;
  scene.warnings = robot.warnings;
  const std::vector<Eigen::Isometry3d> map_from_links = robot.baseFromLinks(0);
  std::vector<std::vector<Mesh>> meshes_of_links = addLooks(robot, &scene);
  for (std::size_t i = 0; i < meshes_of_links.size(); ++i) {
    const Eigen::Isometry3f map_from_link = map_from_links[i].cast<float>();
    for (Lamp lamp : robot.links[i].lamps) {
      lamp.position = map_from_link * lamp.position;
      lamp.direction = (map_from_link.linear() * lamp.direction).normalized();
      scene.lamps.push_back(std::move(lamp));
    }
    for (Mesh& mesh : meshes_of_links[i]) {
      for (Eigen::Vector3f& position : mesh.positions) position = map_from_link * position;
      for (Eigen::Vector3f& normal : mesh.normals) normal = (map_from_link.linear() * normal).normalized();
      for (Eigen::Vector4f& tangent : mesh.tangents)
        tangent.head<3>() = map_from_link.linear() * tangent.head<3>();
      mesh.name = robot.links[i].name + "/" + mesh.name;
      scene.meshes.push_back(std::move(mesh));
    }
  }
  try {
    validate(scene);
  } catch (const std::invalid_argument& error) {  // which knows no files
    throw std::runtime_error(file + ": " + error.what());
  }
  return scene;
}

/// The one world in a folder, such as of Fuel. Throws std::runtime_error unless there is just one.
std::string worldIn(const std::string& folder) {
  std::vector<std::string> worlds;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();  // macOS leaves files of its own, ._a.world
    if (name.front() != '.' && isOneOf(extensionOf(name), {".world", ".sdf"})) worlds.push_back(name);
  }
  std::sort(worlds.begin(), worlds.end());
  if (worlds.size() == 1) return (std::filesystem::path(folder) / worlds[0]).string();
  const std::string of_names = " in this folder, of names that end in .world or .sdf";
  if (worlds.empty()) throw std::runtime_error(folder + ": there is no world" + of_names);
  throw std::runtime_error(folder + ": there are " + std::to_string(worlds.size()) + " worlds" + of_names +
                           ", the first of them " + worlds[0] + " and " + worlds[1] + ": name one of them");
}

/// Throws std::runtime_error where there is none.
std::string fileOf(const std::string& world, const SearchPath& search_path) {
  const Found found = ResourceFinder(search_path, world).find(world, world);
  if (!found.file) throw std::runtime_error("there is no world " + world + "; " + placesTried(found));
  const std::string file = std::filesystem::is_directory(*found.file) ? worldIn(*found.file) : *found.file;
  image::requireContent(file);
  if (isOneOf(extensionOf(file), {".world", ".sdf", ".urdf", ".dae", ".gltf", ".glb", ".obj"})) return file;
  refuseMacros(file);
  throw std::runtime_error(file +
                           ": cannot tell its format; its name must end in .world, .sdf, .urdf, .dae, .gltf, "
                           ".glb or .obj");
}

}  // namespace

std::string requireWorld(const std::string& world, const SearchPath& search_path) {
  return world == kRaceTrack ? std::string() : fileOf(world, search_path);
}

Scene load(const std::string& world, const SearchPath& search_path) {
  if (world == kRaceTrack) return raceTrack();
  const std::string file = fileOf(world, search_path);
  const ResourceFinder finder(search_path, file);
  const std::string extension = extensionOf(file);
  if (isOneOf(extension, {".world", ".sdf"})) return loadSdf(file, finder);
  if (extension == ".urdf") return loadUrdf(file, search_path);
  return loadMeshFile(file, finder);
}

}  // namespace sunlit::scene
