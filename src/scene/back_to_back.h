/// Faces that are drawn twice, once for each side.
#pragma once

#include <vector>

#include "scene/mesh_file.h"
#include "scene/scene_builder.h"

namespace sunlit::scene {

/// SketchUp and others write each wall as two triangles at one place, back to back, each with the paint of
/// its side: whoever draws only front faces sees either. Makes those of `parts`, the pieces of one file, that
/// have such a twin one-sided, as pieces of their own.
void partBackToBack(std::vector<MeshPart>& parts, SceneBuilder& builder);

/// Takes out of `mesh` the triangles that stand back to back and look alike from either side: of the same
/// normals, whichever way about, colours and, where `textured`, texture coordinates. Returns them: in the
/// first half one of each pair, in the second the other. Those with tangents stay where `textured`.
Mesh pairsFrom(Mesh& mesh, bool textured);

}  // namespace sunlit::scene
