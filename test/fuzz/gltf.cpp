// glTF, as text and binary.
#include <cstring>
#include <initializer_list>

#include "fuzz/reader.h"
#include "fuzz/scene_extras.h"
#include "sunlit/scene/export.h"
#include "sunlit/scene/load.h"
#include "support/base64.h"

namespace sunlit::fuzz {
namespace {

/// Positions, coordinates, and a target; joints and weights; a matrix. With indices of two bytes.
std::string buffer() {
  std::string bytes;
  for (const float number : std::initializer_list<float>{
           0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 1, 0, 2, 0, 0, 2, 0, 0, 2,  0, 1, 0,
           0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, -1, 0, 0, 1})
    bytes.append(reinterpret_cast<const char*>(&number), sizeof(number));
  return bytes + std::string(24, '\0') + std::string("\0\0\1\0\2\0\0\0", 8);
}

std::string text() {
  return R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0,3]}],
"extensionsUsed":["KHR_lights_punctual","KHR_texture_transform"],
"extensions":{"KHR_lights_punctual":{"lights":[{"type":"spot","name":"s","color":[1,0.9,0.8],"intensity":100,
"range":20,"spot":{"innerConeAngle":0.1,"outerConeAngle":0.5}}]}},
"nodes":[{"children":[1,2],"translation":[0,0,1]},{"mesh":0,"skin":0,"name":"n"},{"rotation":[0,0,0,1],"scale":[1,2,1]},
{"mesh":0,"matrix":[1,0,0,0,0,1,0,0,0,0,1,0,3,0,0,1],"extensions":{"KHR_lights_punctual":{"light":0}}}],
"skins":[{"joints":[2],"inverseBindMatrices":4}],
"meshes":[{"name":"t","weights":[0.5],"primitives":[{"mode":4,"indices":6,"material":0,"attributes":{"POSITION":0,
"TEXCOORD_0":1,"JOINTS_0":5,"WEIGHTS_0":3},"targets":[{"POSITION":2}]}]}],
"materials":[{"name":"m","doubleSided":true,"alphaMode":"MASK","alphaCutoff":0.4,"pbrMetallicRoughness":{"baseColorFactor":
[1,0.5,0.25,0.9],"metallicFactor":0.2,"roughnessFactor":0.7,"baseColorTexture":{"index":0,"texCoord":0,"extensions":
{"KHR_texture_transform":{"offset":[0.1,0.2],"rotation":0.5,"scale":[2,2]}}},"metallicRoughnessTexture":{"index":0}},
"normalTexture":{"index":0,"scale":0.5},"occlusionTexture":{"index":0,"strength":0.3},"emissiveFactor":[1,0,0],
"emissiveTexture":{"index":0},"extensions":{"KHR_materials_emissive_strength":{"emissiveStrength":5},
"KHR_materials_transmission":{"transmissionFactor":0.5},"KHR_materials_ior":{"ior":1.4},
"KHR_materials_specular":{"specularFactor":0.5,"specularColorFactor":[1,1,1]}}}],
"textures":[{"source":0,"sampler":0}],"samplers":[{"wrapS":33071,"wrapT":33648,"magFilter":9729}],
"images":[{"uri":"paint.png"}],
"accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,1,0]},
{"bufferView":0,"byteOffset":36,"componentType":5126,"count":3,"type":"VEC2"},
{"bufferView":0,"byteOffset":60,"componentType":5126,"count":3,"type":"VEC3"},
{"bufferView":0,"byteOffset":96,"componentType":5126,"count":3,"type":"VEC4"},
{"bufferView":0,"byteOffset":144,"componentType":5126,"count":1,"type":"MAT4"},
{"bufferView":0,"byteOffset":208,"componentType":5123,"count":3,"type":"VEC4"},
{"bufferView":0,"byteOffset":232,"componentType":5123,"count":3,"type":"SCALAR"}],
"bufferViews":[{"buffer":0,"byteOffset":0,"byteLength":240}],
"buffers":[{"byteLength":240,"uri":"data:application/octet-stream;base64,)" +
         base64(buffer()) + "\"}]}";
}

/// As our own export writes it.
std::string binary() {
  scene::Scene scene;
  scene.textures.push_back({"t", 2, 1, {1, 2, 3, 255, 200, 210, 220, 255}});
  scene::Material material;
  material.name = "m";
  material.base_texture = 0;
  material.emission = LinearRgb(10.0f, 5.0f, 0.0f);
  material.glass = 0.3f;
  scene.materials = {material};
  scene::Mesh mesh;
  mesh.name = "t";
  mesh.positions = {{0.0f, 0.0f, 0.0f}, {1.0f, 0.0f, 0.0f}, {0.0f, 1.0f, 0.0f}};
  mesh.normals.assign(3, Eigen::Vector3f::UnitZ());
  mesh.texture_coordinates = {{0.0f, 0.0f}, {1.0f, 0.0f}, {0.0f, 1.0f}};
  mesh.colors.assign(3, Eigen::Array3f(1.0f, 0.5f, 0.25f));
  mesh.triangles = {{0, 1, 2}};
  scene.meshes = {mesh};
  scene::Lamp lamp;
  lamp.name = lamp.group = "lamp";
  lamp.intensity = LinearRgb(10.0f, 10.0f, 10.0f);
  scene.lamps = {lamp};
  const TemporaryFolder folder;
  scene::writeGltf(scene, folder.file("seed.glb"));
  return contentOf(folder.file("seed.glb"));
}

}  // namespace

std::vector<std::string> seeds() {
  std::string whole = text();  // coordinates as whole numbers
  const std::string floats = R"("byteOffset":36,"componentType":5126)";
  whole.replace(whole.find(floats), floats.size(),
                R"("byteOffset":36,"componentType":5123,"normalized":true)");
  std::string instances = text();  // two, at the first two corners
  const std::string node = R"({"mesh":0,"skin":0,"name":"n"})";
  instances.replace(
      instances.find(node), node.size(),
      R"({"mesh":0,"name":"n","extensions":{"EXT_mesh_gpu_instancing":{"attributes":{"TRANSLATION":0,
"SCALE":2,"ROTATION":3}}}})");
  const std::string worlds = SUNLIT_SOURCE_DIR "/test/support/worlds/";
  return {text(),
          whole,
          instances,
          binary(),
          contentOf(worlds + "interior.gltf"),
          contentOf(worlds + "packed.gltf")};
}

void read(const std::string& input) {
  layExtras();
  const bool is_binary = input.compare(0, 4, "glTF") == 0;
  const std::string file = is_binary ? "./input.glb" : "./input.gltf";
  setContent(file, input);
  requireGood(scene::load(file.substr(2), {}));
}

std::string named() {
  return "input.gl";
}

}  // namespace sunlit::fuzz
