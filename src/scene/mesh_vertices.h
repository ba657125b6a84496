/// Which vertices a mesh has.
#pragma once

#include "sunlit/scene/scene.h"

namespace sunlit::scene {

/// Drops the vertices that no triangle uses.
void keepUsed(Mesh& mesh);

/// Gives each triangle three vertices of its own, so that those without normals get its own.
void partTriangles(Mesh& mesh);

}  // namespace sunlit::scene
