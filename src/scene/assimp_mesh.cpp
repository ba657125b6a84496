#include "scene/assimp_mesh.h"

#include <algorithm>
#include <utility>

#include "scene/color.h"

namespace sunlit::scene {
namespace {

/// Colours are linear in glTF, and display values elsewhere.
Eigen::Array3f vertexColor(const aiColor4D& color, bool linear) {
  if (linear) return {color.r, color.g, color.b};
  return linearFromSrgb({color.r, color.g, color.b}).value;
}

std::vector<Eigen::Vector4f> tangentsOf(const aiMesh& source) {
  std::vector<Eigen::Vector4f> tangents;
  if (!source.HasTangentsAndBitangents() || !source.HasNormals()) return tangents;
  for (unsigned i = 0; i < source.mNumVertices; ++i) {
    const aiVector3D &t = source.mTangents[i], &b = source.mBitangents[i], &n = source.mNormals[i];
    const float hand = ((n ^ t) * b) < 0.0f ? -1.0f : 1.0f;
    tangents.emplace_back(t.x, t.y, t.z, hand);
  }
  return tangents;
}

}  // namespace

bool hasSurface(const aiMesh& mesh) {
  return (mesh.mPrimitiveTypes & aiPrimitiveType_TRIANGLE) != 0;
}

bool hasVoidNormals(const aiMesh& mesh) {
  if (!mesh.HasNormals()) return false;
  const auto is_void = [](const aiVector3D& normal) { return !(normal.SquareLength() > 0.0f); };  // NaN too
  return 2 * std::count_if(mesh.mNormals, mesh.mNormals + mesh.mNumVertices, is_void) > mesh.mNumVertices;
}

bool hasAlpha(const aiColor4D* colors, unsigned count) {
  const auto any = [&](auto is) { return colors != nullptr && std::any_of(colors, colors + count, is); };
  return any([](const aiColor4D& color) { return color.a < 1.0f; }) &&
         any([](const aiColor4D& color) { return color.a > 0.0f; });
}

void dropNormals(aiMesh& mesh) {
  delete[] std::exchange(mesh.mNormals, nullptr);
}

void dropColors(aiMesh& mesh) {
  for (aiColor4D*& colors : mesh.mColors) delete[] std::exchange(colors, nullptr);
}

std::vector<Eigen::Vector2f> coordinatesOf(const aiMesh& source, const CoordinateRecipe& recipe, bool gltf) {
  std::vector<Eigen::Vector2f> coordinates;
  auto set = static_cast<unsigned>(recipe.set);
  if (!gltf && (set >= AI_MAX_NUMBER_OF_TEXTURECOORDS || !source.HasTextureCoords(set))) set = 0;
  if (set >= AI_MAX_NUMBER_OF_TEXTURECOORDS || !source.HasTextureCoords(set)) return coordinates;
  for (unsigned i = 0; i < source.mNumVertices; ++i)
    coordinates.push_back(recipe({source.mTextureCoords[set][i].x, source.mTextureCoords[set][i].y}));
  return coordinates;
}

Mesh toMesh(const aiMesh& source, const MeshLook& look, bool gltf) {
  Mesh mesh;
  mesh.material = look.material;
  mesh.positions.reserve(source.mNumVertices);
  for (unsigned i = 0; i < source.mNumVertices; ++i) {
    const aiVector3D& position = source.mVertices[i];
    mesh.positions.emplace_back(position.x, position.y, position.z);
    if (source.HasNormals()) {
      const aiVector3D& normal = source.mNormals[i];
      mesh.normals.emplace_back(normal.x, normal.y, normal.z);
    }
    if (source.HasVertexColors(0)) mesh.colors.push_back(vertexColor(source.mColors[0][i], gltf));
  }
  mesh.texture_coordinates = coordinatesOf(source, look.coordinates.front(), gltf);
  for (std::size_t i = 1; i < look.coordinates.size(); ++i)
    mesh.more_texture_coordinates.push_back(coordinatesOf(source, look.coordinates[i], gltf));
  if (gltf) mesh.tangents = tangentsOf(source);
  mesh.triangles.reserve(source.mNumFaces);
  for (unsigned i = 0; i < source.mNumFaces; ++i) {
    const aiFace& face = source.mFaces[i];
    if (face.mNumIndices == 3)
      mesh.triangles.push_back({face.mIndices[0], face.mIndices[1], face.mIndices[2]});
  }
  return mesh;
}

}  // namespace sunlit::scene
