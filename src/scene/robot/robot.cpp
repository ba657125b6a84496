#include "sunlit/scene/robot.h"

#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>

#include "scene/mesh_file.h"
#include "scene/resource_finder.h"
#include "scene/robot/sdf_robot.h"
#include "sunlit/image/files.h"
#include "sunlit/quantity/utf8.h"
#include "sunlit/scene/material_maps.h"

namespace sunlit::scene {

std::size_t Robot::triangleCount() const {
  std::size_t count = 0;
  for (const RobotLink& link : links) {
    for (const Mesh& mesh : link.meshes) count += mesh.triangles.size();
  }
  return count;
}

std::optional<std::size_t> Robot::indexOf(const std::string& link) const {
  for (std::size_t i = 0; i < links.size(); ++i) {
    if (links[i].name == link) return i;
  }
  return std::nullopt;
}

std::vector<Eigen::Isometry3d> Robot::baseFromLinks(std::size_t base) const {
  std::vector<Eigen::Isometry3d> places(links.size());
  for (std::size_t i = 0; i < links.size(); ++i) {
    const RobotLink& link = links[i];
    places[i] = link.parent < 0 ? link.parent_from_link
                                : places[static_cast<std::size_t>(link.parent)] * link.parent_from_link;
  }
  const Eigen::Isometry3d base_from_root = places[base].inverse();
  for (Eigen::Isometry3d& place : places) place = base_from_root * place;
  return places;
}

Robot loadRobot(const std::string& file, const SearchPath& search_path) {
  const ResourceFinder finder(search_path, file);
  const Found found = finder.find(file, file);
  if (!found.file || std::filesystem::is_directory(*found.file)) {
    throw std::runtime_error("there is no robot " + file + "; " + placesTried(found));
  }
  image::requireContent(*found.file);
  const std::string extension = extensionOf(*found.file);
  if (extension == ".sdf") return loadSdfRobot(*found.file, ResourceFinder(search_path, *found.file));
  if (extension == ".urdf" || extension == ".xml") {
    std::ifstream stream(*found.file, std::ios::binary);
    if (!stream) throw std::runtime_error(*found.file + ": cannot open this file");
    const std::string text = utf8Of({std::istreambuf_iterator<char>(stream), {}}, *found.file);
    return parseUrdf(text, *found.file, search_path);
  }
  refuseMacros(*found.file);
  throw std::runtime_error(*found.file +
                           ": cannot tell its format; its name must end in .urdf, .xml or .sdf");
}

std::vector<std::vector<Mesh>> addLooks(const Robot& robot, Scene* scene) {
  const int first_texture = static_cast<int>(scene->textures.size());
  const int first_material = static_cast<int>(scene->materials.size());
  scene->textures.insert(scene->textures.end(), robot.textures.begin(), robot.textures.end());
  for (Material material : robot.materials) {
    if (material.base_texture != Material::kNoTexture) material.base_texture += first_texture;
    for (TextureUse* map : mapsOf(material)) {
      if (map->given()) map->texture += first_texture;
    }
    scene->materials.push_back(std::move(material));
  }
  std::vector<std::vector<Mesh>> meshes_of_links;
  for (const RobotLink& link : robot.links) {
    std::vector<Mesh> meshes = link.meshes;
    for (Mesh& mesh : meshes) mesh.material += first_material;
    meshes_of_links.push_back(std::move(meshes));
  }
  return meshes_of_links;
}

}  // namespace sunlit::scene
