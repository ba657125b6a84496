#include "scene/robot/link_meshes.h"

#include <iterator>
#include <stdexcept>

namespace sunlit::scene {

void LinkMeshes::finish(Robot* robot) {
  Scene scene = builder_.finish();
  if (scene.meshes.empty())
    throw std::runtime_error(origin_ + ": there is nothing to see of this robot" + reasonsOf(scene.warnings));
  for (std::size_t i = 0; i < begins_.size(); ++i) {
    const Begin begin = begins_[i];
    const Begin end =
        i + 1 < begins_.size() ? begins_[i + 1] : Begin{0, scene.meshes.size(), scene.lamps.size()};
    RobotLink& link = robot->links[begin.link];
    for (std::size_t k = begin.mesh; k < end.mesh; ++k) link.meshes.push_back(std::move(scene.meshes[k]));
    for (std::size_t k = begin.lamp; k < end.lamp; ++k) link.lamps.push_back(std::move(scene.lamps[k]));
  }
  robot->textures = std::move(scene.textures);
  robot->materials = std::move(scene.materials);
  robot->warnings = std::move(scene.warnings);
}

}  // namespace sunlit::scene
