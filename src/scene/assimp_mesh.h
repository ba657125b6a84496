/// Meshes as Assimp hands them on.
#pragma once

#include <assimp/mesh.h>

#include <vector>

#include "scene/mesh_material.h"
#include "sunlit/scene/scene.h"

namespace sunlit::scene {

/// Lines and points have no surface to light.
bool hasSurface(const aiMesh& mesh);

/// Whether most of its normals are of no length, as STL has them where it leaves them to its reader.
bool hasVoidNormals(const aiMesh& mesh);

/// Assimp gives colours without an alpha one of 0.
bool hasAlpha(const aiColor4D* colors, unsigned count);

void dropNormals(aiMesh& mesh);
/// Of the vertices. Bytes behind the faces of STL pass for such, of which each program knows a meaning of its
/// own: with a header of Materialise's bit 15 says that there is none, and Assimp reads black.
void dropColors(aiMesh& mesh);

/// Of COLLADA, the first set stands for one that the mesh has not: its materials may but guess its number.
std::vector<Eigen::Vector2f> coordinatesOf(const aiMesh& source, const CoordinateRecipe& recipe, bool gltf);

/// Its triangles.
Mesh toMesh(const aiMesh& source, const MeshLook& look, bool gltf);

}  // namespace sunlit::scene
