#include "scene/robot/link_meshes.h"

#include <iterator>
#include <stdexcept>

namespace sunlit::scene {

void LinkMeshes::finish(Robot* robot) {
  Scene scene = builder_.finish();
  if (scene.meshes.empty()) throw std::runtime_error(origin_ + ": there is nothing to see of this robot");
  for (std::size_t i = 0; i < begins_.size(); ++i) {
    const auto [link, first] = begins_[i];
    const std::size_t end = i + 1 < begins_.size() ? begins_[i + 1].second : scene.meshes.size();
    std::vector<Mesh>& meshes = robot->links[link].meshes;
    for (std::size_t k = first; k < end; ++k) meshes.push_back(std::move(scene.meshes[k]));
  }
  robot->textures = std::move(scene.textures);
  robot->materials = std::move(scene.materials);
  robot->warnings = std::move(scene.warnings);
}

}  // namespace sunlit::scene
