/// What a picture is of, as far as its texels tell.
#pragma once

#include <Eigen/Core>

#include "sunlit/scene/scene.h"

namespace sunlit::scene {

/// Of normals x, y and z are hardly equal anywhere: they would lean by 55°.
bool isGrey(const Texture& texture);

/// Normals lean by less than 60° in the mean; what does more is a picture of something else.
bool leansLittle(const Texture& texture);

/// Linear colour, of what is there by alpha, and alpha.
Eigen::Array4f meanOf(const Texture& texture);

}  // namespace sunlit::scene
