/// The lights of COLLADA files.
#pragma once

#include <assimp/scene.h>

#include <Eigen/Geometry>
#include <cstddef>

#include "scene/scene_builder.h"

namespace sunlit::scene {

/// Adds the lamps of `scene`, as Assimp reads it from COLLADA, to the builder; what cannot be lamps here is
/// named.
void addColladaLamps(const aiScene& scene, const Eigen::Affine3d& up_from_file, SceneBuilder& builder);

/// How many of its lights could be lamps: points and spots, of any format.
std::size_t lampsIn(const aiScene& scene);

}  // namespace sunlit::scene
