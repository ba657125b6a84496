#include "scene/mesh_file.h"

#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <assimp/Importer.hpp>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <optional>
#include <stdexcept>
#include <utility>

#include "scene/assimp_mesh.h"
#include "scene/assimp_nodes.h"
#include "scene/back_to_back.h"
#include "scene/collada_check.h"
#include "scene/collada_effects.h"
#include "scene/collada_instances.h"
#include "scene/collada_lamps.h"
#include "scene/collada_morphs.h"
#include "scene/collada_sets.h"
#include "scene/collada_text.h"
#include "scene/mesh_material.h"
#include "scene/mesh_rest.h"
#include "scene/mesh_vertices.h"
#include "scene/obj_input.h"
#include "scene/stl_faces.h"
#include "scene/triangle_budget.h"
#include "scene/uri_text.h"
#include "sunlit/image/files.h"
#include "sunlit/quantity/utf8.h"

namespace sunlit::scene {
namespace {

constexpr unsigned kSteps = aiProcess_Triangulate |  // polygons to triangles
                            aiProcess_SortByPType |  // so that points and lines can be left out
                            aiProcess_FlipUVs;       // texture coordinates from the top left corner

/// Where a file without normals has edges, and where it is round.
constexpr float kCrease_deg = 35.0f;

/// glTF's +Y up (x right, z towards the viewer) to z up.
Eigen::Affine3d zUpFromYUp() {
  Eigen::Affine3d rotation = Eigen::Affine3d::Identity();
  rotation.linear() << 1, 0, 0,  //
      0, 0, -1,                  //
      0, 1, 0;
  return rotation;
}

bool isGltf(const std::string& extension) {
  return extension == ".gltf" || extension == ".glb";
}

void setUp(Assimp::Importer& importer, UpAxis up_axis) {
  importer.SetPropertyBool(AI_CONFIG_IMPORT_COLLADA_IGNORE_UP_DIRECTION, up_axis == UpAxis::kZ);
  importer.SetPropertyBool(AI_CONFIG_IMPORT_COLLADA_USE_COLLADA_NAMES, true);
  importer.SetPropertyBool(AI_CONFIG_IMPORT_NO_SKELETON_MESHES, true);  // in the place of what is not there
  importer.SetPropertyFloat(AI_CONFIG_PP_GSN_MAX_SMOOTHING_ANGLE, kCrease_deg);
}

/// The scene that `importer` has read, as it is used here; null where Assimp fails.
const aiScene* prepared(Assimp::Importer& importer, const std::string& extension) {
  const aiScene* const scene = importer.GetScene();
  if (scene == nullptr) return nullptr;
  const bool gltf = isGltf(extension);
  bool has_more = false;  // than one set of texture coordinates a vertex
  for (unsigned i = 0; i < scene->mNumMeshes; ++i) {
    aiMesh& mesh = *scene->mMeshes[i];
    if (extension == ".stl") dropColors(mesh);
    has_more = has_more || mesh.HasVertexColors(0) || mesh.GetNumUVChannels() > 1;
    if (hasVoidNormals(mesh)) dropNormals(mesh);
  }
  unsigned steps = kSteps;
  if (!gltf) {
    steps |= aiProcess_GenSmoothNormals;
    // COLLADA and OBJ index each array apart. Assimp 5.2 joins vertices of different colours or further sets
    // of texture coordinates, too.
    if (!has_more) steps |= aiProcess_JoinIdenticalVertices;
  }
  return importer.ApplyPostProcessing(steps);
}

/// The parts below `node`, in the order of the file.
struct Collector {
  const aiScene& scene;
  const std::vector<std::optional<MeshLook>>& looks;  ///< by material
  bool gltf;
  const Eigen::Affine3d up_from_file;
  std::vector<MeshPart> parts = {};
  std::size_t lines_and_points = 0;           ///< left out
  std::vector<std::string> fading = {};       ///< names of parts that lose the alpha of vertex colours
  std::vector<std::string> loose_skins = {};  ///< names of parts whose joints are not known

  void collect(const aiNode& node, const Eigen::Affine3d& up_from_parent) {
    const Eigen::Affine3d up_from_node = up_from_parent * toEigen(node.mTransformation);
    for (unsigned i = 0; i < node.mNumMeshes; ++i) {
      const aiMesh& source = *scene.mMeshes[node.mMeshes[i]];
      const std::optional<MeshLook>& look = looks[source.mMaterialIndex];
      if (!hasSurface(source)) lines_and_points += source.mNumFaces;
      if (!look || !hasSurface(source)) continue;
      MeshPart part{node.mName.C_Str(), source.mName.C_Str(), {}, up_from_node};
      part.mesh = toMesh(source, *look, gltf);
      part.bare = look->bare;
      part.has_spare = !(look->coordinates.front() == CoordinateRecipe());
      if (part.has_spare) part.mesh.more_texture_coordinates.push_back(coordinatesOf(source, {}, gltf));
      takeRest(source, part);
      part.mesh.name = part.node.empty() ? part.geometry : part.node;
      if (look->fades && hasAlpha(source.mColors[0], source.mNumVertices)) fading.push_back(part.mesh.name);
      parts.push_back(std::move(part));
    }
    for (unsigned i = 0; i < node.mNumChildren; ++i) collect(*node.mChildren[i], up_from_node);
  }

  /// Its shape at rest, and the vertices for that.
  void takeRest(const aiMesh& source, MeshPart& part) {
    if (gltf) blendTargets(source, part.mesh);
    // COLLADA may leave joints without a name, or with one that others have, too.
    if (!gltf && !hasItsJoints(source, scene))
      loose_skins.push_back(part.node.empty() ? part.geometry : part.node);
    else if (standOnBones(source, scene, part.mesh))
      part.file_from_node = up_from_file;
    if (!gltf) return;
    if (part.mesh.normals.empty())
      partTriangles(part.mesh);  // glTF 2.0, section 3.7.2.1: flat
    else
      keepUsed(part.mesh);  // several primitives may share the vertices of all
  }
};

std::uint64_t trianglesIn(const aiScene& scene) {
  std::uint64_t count = 0;
  for (unsigned i = 0; i < scene.mNumMeshes; ++i)
    count += hasSurface(*scene.mMeshes[i]) ? scene.mMeshes[i]->mNumFaces : 0;
  return count;
}

/// Asks for what is made of `node` and those below it: a mesh of a file may be shown by any number of nodes.
void askFor(const aiNode& node, const aiScene& scene, const std::string& file, TriangleBudget& budget) {
  for (unsigned i = 0; i < node.mNumMeshes; ++i) {
    const aiMesh& mesh = *scene.mMeshes[node.mMeshes[i]];
    if (!hasSurface(mesh)) continue;
    // Vertices that no face has are not kept: primitives may share those of a whole file.
    const std::uint64_t triangles = mesh.mNumFaces;
    budget.take(triangles, std::min<std::uint64_t>(mesh.mNumVertices, 3 * triangles),
                file + ": node " + node.mName.C_Str());
  }
  for (unsigned i = 0; i < node.mNumChildren; ++i) askFor(*node.mChildren[i], scene, file, budget);
}

std::vector<std::string> namesOfMaterials(const aiScene& scene) {
  std::vector<std::string> names;
  for (unsigned i = 0; i < scene.mNumMaterials; ++i)
    names.emplace_back(scene.mMaterials[i]->GetName().C_Str());
  return names;
}

/// By their index in `scene`; none for those that no mesh uses, which Assimp adds of its own too.
std::vector<std::optional<MeshLook>> addMaterials(const aiScene& scene, const MeshFileContext& context) {
  warnOf(context.effects, context.file, context.builder);
  std::vector<std::optional<MeshLook>> looks(scene.mNumMaterials);
  std::vector<bool> used(scene.mNumMaterials, false);
  for (unsigned i = 0; i < scene.mNumMeshes; ++i) {
    if (hasSurface(*scene.mMeshes[i])) used[scene.mMeshes[i]->mMaterialIndex] = true;
  }
  for (unsigned i = 0; i < scene.mNumMaterials; ++i) {
    if (used[i]) looks[i] = addMeshMaterial(i, scene, context);
  }
  return looks;
}

/// In their place, where nobody wants them. Texture coordinates are as they stand in the file.
std::vector<std::optional<MeshLook>> plainLooks(const aiScene& scene, SceneBuilder& unused) {
  const MeshLook plain{unused.addMaterial({}, AlphaRule::kDeclared), {CoordinateRecipe()}};
  return std::vector<std::optional<MeshLook>>(scene.mNumMaterials, plain);
}

/// Has Assimp read a COLLADA file, as it stands or, where it refuses that, mended.
ColladaEffects readCollada(const std::string& file, Assimp::Importer& importer, SceneBuilder& builder) {
  std::ifstream stream(file, std::ios::binary);
  const ColladaMorphs still =
      withoutMorphs(withoutAnimations(utf8Of({std::istreambuf_iterator<char>(stream), {}}, file)));
  for (const std::string& morph : still.names)
    builder.warn("meshes have morphs, which are left out: they have their base shape", morph + " of " + file);
  std::string text = withAddressesOfImages(withCountedLines(still.text));
  warnOfLostInstances(*checkedCollada(text, file)->RootElement(), file, builder);
  text = withParameters(withKnownSets(withInstancesWithin(text)));
  ColladaEffects effects = effectsOf(text);
  text = withExponentsOfSpots(
      withNamesOfLamps(withWeightsAtOnce(withBareMaterials(text, effects.without_effect))));
  if (importer.ReadFileFromMemory(text.data(), text.size(), 0, "dae") != nullptr) return effects;
  const ColladaText readable = readableCollada(text);
  const aiScene* const scene =
      importer.ReadFileFromMemory(readable.text.data(), readable.text.size(), 0, "dae");
  if (scene != nullptr && readable.holes > 0)
    builder.warn("meshes have polygons with holes, which are filled", file);
  return effects;
}

/// Has Assimp read any file.
ColladaEffects readInto(Assimp::Importer& importer, const std::string& file, SceneBuilder& builder) {
  if (extensionOf(file) == ".dae") return readCollada(file, importer, builder);
  const std::string faces = extensionOf(file) == ".stl" ? countedFacesOfStl(file) : "";
  if (faces.empty())
    importer.ReadFile(file, 0);
  else
    importer.ReadFileFromMemory(faces.data(), faces.size(), 0, "stl");
  return {};
}

/// What of the parts is lost.
void warnOfLosses(const Collector& collector, const std::string& file, SceneBuilder& builder) {
  for (const std::string& mesh : collector.fading)
    builder.warn("alpha of vertex colours was left out", mesh + " of " + file);
  for (const std::string& skin : collector.loose_skins)
    builder.warn("skins have joints that cannot be told apart, they stand where their nodes do",
                 skin + " of " + file);
  if (collector.lines_and_points > 0) {
    builder.warn("files have lines and points, which have no surface and are left out",
                 std::to_string(collector.lines_and_points) + " in " + file);
  }
}

/// Lamps of models and robots are elements of their own.
void warnOfLamps(const aiScene& scene, const std::string& file, SceneBuilder& builder) {
  if (const std::size_t lamps = lampsIn(scene); lamps > 0)
    builder.warn("meshes of models and robots have lights of their own, which are left out",
                 std::to_string(lamps) + " in " + file);
}

/// What of them is lost is named.
ObjLibraries readLibraries(const std::string& file, SceneBuilder& builder) {
  ObjLibraries libraries = librariesOfObj(file);
  for (const std::string& material : libraries.missing)
    builder.warn("materials are not there, and neutral ones stand for them", material);
  for (const std::string& material : libraries.not_rendered) builder.warn(kNotRendered, material);
  for (const std::string& shape : libraries.not_read)
    builder.warn("shapes of OBJ are none of three corners or more, they are left out", shape);
  for (const std::string& library : libraries.placed)
    builder.warn("libraries of OBJ shift textures or repeat them by -o, -s or -t, which is not read",
                 library);
  return libraries;
}

/// Assimp would find no reader for a folder, and miss anything but content in an empty file.
void requireContent(const std::string& file) {
  image::requireContent(file);
  std::error_code error;
  if (std::filesystem::is_directory(file, error))
    throw std::runtime_error(file + ": this is a folder, and no mesh");
  if (std::filesystem::file_size(file, error) == 0 && !error)
    throw std::runtime_error(file + ": this file is empty");
}

void addLamps(const aiScene& scene, const MeshFileContext& context, UpAxis up_axis,
              const Eigen::Affine3d& up_from_file) {
  if (up_axis != UpAxis::kAsDeclared)
    warnOfLamps(scene, context.file, context.builder);
  else if (context.gltf != nullptr)
    context.gltf->addLights(up_from_file);
  else
    addColladaLamps(scene, up_from_file, context.builder);
}

}  // namespace

void leaveCoordinates(bool of_own_material, MeshPart& part) {
  if (!std::exchange(part.has_spare, false)) return;
  std::vector<std::vector<Eigen::Vector2f>>& more = part.mesh.more_texture_coordinates;
  if (!of_own_material) part.mesh.texture_coordinates = std::move(more.back());
  more.pop_back();
}

std::string extensionOf(const std::string& file) {
  return lowerCase(std::filesystem::path(file).extension().string());
}

void refuseMacros(const std::string& file) {
  if (extensionOf(file) == ".xacro")
    throw std::runtime_error(file + ": this is a macro file; turn it into a URDF or a world first, by xacro");
}

std::vector<MeshPart> readMeshFile(const std::string& file, const MeshReading& reading,
                                   const ResourceFinder& finder, SceneBuilder& builder) {
  requireContent(file);
  SceneBuilder unused(file);
  SceneBuilder& look_builder = reading.looks ? builder : unused;
  const std::string extension = extensionOf(file);
  const bool gltf = isGltf(extension);
  Assimp::Importer importer;
  std::optional<GltfMaterials> gltf_materials;
  ObjLibraries libraries;
  if (gltf) {
    gltf_materials.emplace(file, builder);
    importer.SetIOHandler(gltf_materials->input().release());
  } else if (extension == ".obj") {
    importer.SetIOHandler(std::make_unique<ObjInput>().release());
    libraries = readLibraries(file, look_builder);
  }
  setUp(importer, reading.up_axis);
  ColladaEffects effects = readInto(importer, file, builder);
  const aiScene* const scene = prepared(importer, extension);
  if (scene == nullptr || scene->mRootNode == nullptr) {
    throw std::runtime_error(file + ": cannot read this mesh: " + importer.GetErrorString() +
                             (gltf ? gltf_materials->whatItNeeds() : ""));
  }

  if (gltf) gltf_materials->nameTheRest(trianglesIn(*scene));
  const MeshFileContext context{
      file,
      gltf ? &*gltf_materials : nullptr,
      finder,
      builder,
      gltf ? gltf_materials->order(namesOfMaterials(*scene)) : std::vector<std::size_t>(),
      std::move(libraries.files),
      std::move(libraries.materials),
      std::move(effects)};
  const std::vector<std::optional<MeshLook>> looks =
      reading.looks ? addMaterials(*scene, context) : plainLooks(*scene, unused);
  // Assimp turns a COLLADA file whose up_axis it honours to +Y up. glTF always is.
  const bool y_up = (gltf || extension == ".dae") && reading.up_axis == UpAxis::kAsDeclared;
  const Eigen::Affine3d up_from_file = y_up ? zUpFromYUp() : Eigen::Affine3d::Identity();
  TriangleBudget budget;
  askFor(*scene->mRootNode, *scene, file, budget);
  Collector collector{*scene, looks, gltf, up_from_file};
  collector.collect(*scene->mRootNode, up_from_file);
  warnOfLosses(collector, file, builder);
  addLamps(*scene, context, reading.up_axis, up_from_file);
  if (!gltf) partBackToBack(collector.parts, look_builder);  // which says itself what is one-sided
  return std::move(collector.parts);
}

}  // namespace sunlit::scene
