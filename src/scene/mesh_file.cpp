#include "scene/mesh_file.h"

#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <assimp/Importer.hpp>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>
#include <regex>
#include <stdexcept>

#include "scene/color.h"
#include "scene/mesh_material.h"

namespace sunlit::scene {
namespace {

constexpr unsigned kSteps = aiProcess_Triangulate |            // polygons to triangles
                            aiProcess_JoinIdenticalVertices |  // COLLADA and OBJ index each array apart
                            aiProcess_GenSmoothNormals |       // where the file has none
                            aiProcess_SortByPType |            // so that points and lines can be left out
                            aiProcess_FlipUVs;                 // texture coordinates from the top left corner

/// glTF's +Y up (x right, z towards the viewer) to z up.
Eigen::Affine3d zUpFromYUp() {
  Eigen::Affine3d rotation = Eigen::Affine3d::Identity();
  rotation.linear() << 1, 0, 0,  //
      0, 0, -1,                  //
      0, 1, 0;
  return rotation;
}

Eigen::Affine3d toEigen(const aiMatrix4x4& matrix) {
  Eigen::Affine3d affine = Eigen::Affine3d::Identity();
  affine.matrix() << matrix.a1, matrix.a2, matrix.a3, matrix.a4, matrix.b1, matrix.b2, matrix.b3, matrix.b4,
      matrix.c1, matrix.c2, matrix.c3, matrix.c4, 0.0, 0.0, 0.0, 1.0;
  return affine;
}

Mesh toMesh(const aiMesh& source) {
  Mesh mesh;
  mesh.positions.reserve(source.mNumVertices);
  for (unsigned i = 0; i < source.mNumVertices; ++i) {
    const aiVector3D& position = source.mVertices[i];
    mesh.positions.emplace_back(position.x, position.y, position.z);
    if (source.HasNormals()) {
      const aiVector3D& normal = source.mNormals[i];
      mesh.normals.emplace_back(normal.x, normal.y, normal.z);
    }
    if (source.HasTextureCoords(0)) {
      const aiVector3D& coordinate = source.mTextureCoords[0][i];
      mesh.texture_coordinates.emplace_back(coordinate.x, coordinate.y);
    }
    if (source.HasVertexColors(0)) {
      const aiColor4D& color = source.mColors[0][i];
      mesh.colors.emplace_back(color.r, color.g, color.b);
    }
  }
  mesh.triangles.reserve(source.mNumFaces);
  for (unsigned i = 0; i < source.mNumFaces; ++i) {
    const aiFace& face = source.mFaces[i];
    if (face.mNumIndices == 3)
      mesh.triangles.push_back({face.mIndices[0], face.mIndices[1], face.mIndices[2]});
  }
  return mesh;
}

/// Lines and points have no surface to light.
bool hasSurface(const aiMesh& mesh) {
  return (mesh.mPrimitiveTypes & aiPrimitiveType_TRIANGLE) != 0;
}

/// The parts below `node`, in the order of the file.
struct Collector {
  const aiScene& scene;
  const std::vector<std::optional<int>>& material_indices;
  std::vector<MeshPart> parts;
  std::size_t lines_and_points = 0;  ///< left out

  void collect(const aiNode& node, const Eigen::Affine3d& up_from_parent) {
    const Eigen::Affine3d up_from_node = up_from_parent * toEigen(node.mTransformation);
    for (unsigned i = 0; i < node.mNumMeshes; ++i) {
      const aiMesh& source = *scene.mMeshes[node.mMeshes[i]];
      const std::optional<int> material = material_indices[source.mMaterialIndex];
      if (!hasSurface(source)) lines_and_points += source.mNumFaces;
      if (!material || !hasSurface(source)) continue;
      MeshPart part{node.mName.C_Str(), source.mName.C_Str(), {}, up_from_node};
      part.mesh = toMesh(source);
      part.mesh.name = part.node.empty() ? part.geometry : part.node;
      part.mesh.material = *material;
      parts.push_back(std::move(part));
    }
    for (unsigned i = 0; i < node.mNumChildren; ++i) collect(*node.mChildren[i], up_from_node);
  }
};

/// By their index in `scene`; none for those that no mesh uses, which Assimp adds of its own too.
std::vector<std::optional<int>> addMaterials(const aiScene& scene, const MeshFileContext& context) {
  std::vector<std::optional<int>> indices(scene.mNumMaterials);
  std::vector<bool> used(scene.mNumMaterials, false);
  for (unsigned i = 0; i < scene.mNumMeshes; ++i) {
    if (hasSurface(*scene.mMeshes[i])) used[scene.mMeshes[i]->mMaterialIndex] = true;
  }
  for (unsigned i = 0; i < scene.mNumMaterials; ++i) {
    if (used[i]) indices[i] = addMeshMaterial(*scene.mMaterials[i], scene, context);
  }
  return indices;
}

/// COLLADA colours may be brighter than a screen.
LinearRgb colorOf(const aiColor3D& color, bool gltf) {
  const Eigen::Array3f value(color.r, color.g, color.b);
  if (gltf) return LinearRgb(value);
  const float peak = std::max(value.maxCoeff(), 1.0f);
  LinearRgb linear = linearFromSrgb({color.r / peak, color.g / peak, color.b / peak});
  linear.value *= peak;
  return linear;
}

/// Where a node stands in the file, to z up, and what it holds besides. Null: there is no such node.
const aiNode* findNode(const aiScene& scene, const aiString& name, const Eigen::Affine3d& up_from_file,
                       Eigen::Affine3d* up_from_node) {
  const aiNode* const found = scene.mRootNode->FindNode(name);
  Eigen::Affine3d file_from_node = Eigen::Affine3d::Identity();
  for (const aiNode* node = found; node != nullptr; node = node->mParent)
    file_from_node = toEigen(node->mTransformation) * file_from_node;
  *up_from_node = up_from_file * file_from_node;
  return found;
}

/// glTF gives cd and half angles (KHR_lights_punctual), COLLADA colours without a unit and whole cones.
Lamp lampOf(const aiLight& light, const aiNode& node, const Eigen::Affine3d& up_from_node, bool gltf) {
  Lamp lamp;
  lamp.name = light.mName.C_Str();
  lamp.relative = !gltf;
  lamp.intensity = colorOf(light.mColorDiffuse, gltf);
  const aiVector3D &at = light.mPosition, &to = light.mDirection;
  lamp.position = (up_from_node * Eigen::Vector3d(at.x, at.y, at.z)).cast<float>();
  float range = 0.0f;
  if (gltf && node.mMetaData && node.mMetaData->Get("PBR_LightRange", range) && range > 0.0f)
    lamp.range_m = range;
  if (!gltf) {
    lamp.constant = light.mAttenuationConstant;
    lamp.linear = light.mAttenuationLinear;
    lamp.quadratic = light.mAttenuationQuadratic;
  }
  if (light.mType != aiLightSource_SPOT) return lamp;
  lamp.direction = (up_from_node.linear() * Eigen::Vector3d(to.x, to.y, to.z)).normalized().cast<float>();
  const float share = gltf ? 1.0f : 0.5f;
  lamp.outer_rad = std::clamp(share * light.mAngleOuterCone, 0.0f, Lamp::kAllAround_rad);
  lamp.inner_rad = std::clamp(share * light.mAngleInnerCone, 0.0f, lamp.outer_rad);
  return lamp;
}

void addLamps(const aiScene& scene, const Eigen::Affine3d& up_from_file, bool gltf, SceneBuilder& builder) {
  for (unsigned i = 0; i < scene.mNumLights; ++i) {
    const aiLight& light = *scene.mLights[i];
    if (light.mType != aiLightSource_POINT && light.mType != aiLightSource_SPOT) {
      builder.warn("lights that are no points and no spots were not read: the sky takes their place",
                   light.mName.C_Str());
      continue;
    }
    Eigen::Affine3d up_from_node;
    const aiNode* const node = findNode(scene, light.mName, up_from_file, &up_from_node);
    if (node == nullptr) continue;  // stands nowhere in the scene
    Lamp lamp = lampOf(light, *node, up_from_node, gltf);
    lamp.group = lamp.name;
    if (lamp.constant + lamp.linear + lamp.quadratic > 0.0f && lamp.intensity.value.allFinite() &&
        lamp.outer_rad > 0.0f && lamp.direction.norm() > 0.5f) {
      builder.addLamp(std::move(lamp));
    } else {
      builder.warn("lights were left out: their angle, direction and attenuation must be above 0 and finite",
                   lamp.name);
    }
  }
}

/// Assimp leaves out extensions that it does not know without a word.
void warnAboutExtensions(const std::string& file, SceneBuilder& builder) {
  std::ifstream stream(file, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  const std::size_t key = text.find("\"extensionsUsed\"");
  if (key == std::string::npos) return;
  const std::size_t begin = text.find('[', key);
  if (begin == std::string::npos) return;
  const std::string list = text.substr(begin, text.find(']', begin) - begin);
  const std::regex quoted("\"([^\"]*)\"");
  for (std::sregex_iterator name(list.begin(), list.end(), quoted), end; name != end; ++name) {
    if ((*name)[1] == "KHR_lights_punctual") continue;
    builder.warn(file + ": glTF extension " + (*name)[1].str() + " is not read");
  }
}

/// The text of a COLLADA file that Assimp may take: it wants the numbers of a colour right behind the tag,
/// and XML does not.
std::string withoutBlanksBeforeColors(const std::string& file) {
  std::ifstream stream(file, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  std::string mended;
  std::size_t copied = 0;
  for (std::size_t tag = text.find("<color"); tag != std::string::npos; tag = text.find("<color", copied)) {
    const std::size_t end = text.find('>', tag);
    if (end == std::string::npos) break;
    mended.append(text, copied, end + 1 - copied);
    copied = std::min(text.size(), text.find_first_not_of(" \t\r\n", end + 1));
  }
  return mended.append(text, copied, std::string::npos);
}

}  // namespace

std::string extensionOf(const std::string& file) {
  std::string extension = std::filesystem::path(file).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
  return extension;
}

std::vector<MeshPart> readMeshFile(const std::string& file, UpAxis up_axis, const ResourceFinder& finder,
                                   SceneBuilder& builder) {
  const std::string extension = extensionOf(file);
  const bool collada = extension == ".dae";
  const bool gltf = extension == ".gltf" || extension == ".glb";
  Assimp::Importer importer;
  importer.SetPropertyBool(AI_CONFIG_IMPORT_COLLADA_IGNORE_UP_DIRECTION, up_axis == UpAxis::kZ);
  importer.SetPropertyBool(AI_CONFIG_IMPORT_COLLADA_USE_COLLADA_NAMES, true);
  const aiScene* scene = importer.ReadFile(file, kSteps);
  if (scene == nullptr && collada) {
    const std::string text = withoutBlanksBeforeColors(file);
    scene = importer.ReadFileFromMemory(text.data(), text.size(), kSteps, "dae");
  }
  if (scene == nullptr || scene->mRootNode == nullptr) {
    throw std::runtime_error(file + ": cannot read this mesh: " + importer.GetErrorString());
  }

  if (gltf) warnAboutExtensions(file, builder);
  const std::vector<std::optional<int>> material_indices =
      addMaterials(*scene, MeshFileContext{file, gltf, finder, builder});
  // Assimp turns a COLLADA file whose up_axis it honours to +Y up.
  const bool y_up = gltf || (collada && up_axis == UpAxis::kAsDeclared);
  const Eigen::Affine3d up_from_file = y_up ? zUpFromYUp() : Eigen::Affine3d::Identity();
  Collector collector{*scene, material_indices, {}};
  collector.collect(*scene->mRootNode, up_from_file);
  if (up_axis == UpAxis::kAsDeclared) addLamps(*scene, up_from_file, gltf, builder);
  if (collector.lines_and_points > 0) {
    builder.warn(file + ": " + std::to_string(collector.lines_and_points) +
                 " lines and points have no surface and are left out");
  }
  return std::move(collector.parts);
}

}  // namespace sunlit::scene
