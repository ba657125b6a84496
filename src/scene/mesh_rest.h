/// Shapes that a mesh has at rest, before an animation moves it: morph targets and bones.
#pragma once

#include <assimp/scene.h>

#include "sunlit/scene/scene.h"

namespace sunlit::scene {

/// Adds to `mesh`, made of `source`, what the weights of its morph targets say.
void blendTargets(const aiMesh& source, Mesh& mesh);

/// Whether each bone's joint is there, and no other node is called so. A mesh without bones has all of them.
bool hasItsJoints(const aiMesh& source, const aiScene& scene);

/// Moves `mesh`, made of `source`, to where its bones hold it in the frame of the file, its outside kept
/// where they mirror it. False: it has none. What the node of a mesh with bones says of its place does not
/// count (glTF 2.0, section 3.7.3.1).
bool standOnBones(const aiMesh& source, const aiScene& scene, Mesh& mesh);

}  // namespace sunlit::scene
