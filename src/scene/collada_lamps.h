/// The lights of COLLADA files.
#pragma once

#include <assimp/scene.h>

#include <Eigen/Geometry>
#include <cstddef>
#include <string>

#include "scene/scene_builder.h"

namespace sunlit::scene {

/// `text` in which nodes with lamps that have no name have their id as one, else the name or the id of the
/// light: groups of lamps go by it, and Assimp would number them. Lines stay where they are.
std::string withNamesOfLamps(const std::string& text);

/// `text` from which addColladaLamps() gets the exponents of spots: Assimp 5.2 makes angles of them, by a
/// rule of its own, and of 0 and 1 the same. Lines stay where they are.
std::string withExponentsOfSpots(const std::string& text);

/// Adds the lamps of `scene`, as Assimp reads it from COLLADA with exponents of spots, to the builder; what
/// cannot be lamps here is named.
void addColladaLamps(const aiScene& scene, const Eigen::Affine3d& up_from_file, SceneBuilder& builder);

/// How many of its lights could be lamps: points and spots, of any format.
std::size_t lampsIn(const aiScene& scene);

}  // namespace sunlit::scene
