// Where the numbers of glTF files are: in addresses, nowhere, in Draco's data.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "support/base64.h"
#include "unit/scene/measure.h"
#include "unit/scene/scene_files.h"

namespace sunlit::scene {
namespace {

template <typename Number>
std::string bytesOf(const std::vector<Number>& numbers) {
  return {reinterpret_cast<const char*>(numbers.data()), sizeof(Number) * numbers.size()};
}

std::string escaped(const std::string& text, const std::string& letters) {
  const char* const digits = "0123456789ABCDEF";
  std::string out;
  for (const char letter : text) {
    const auto code = static_cast<unsigned char>(letter);
    if (letters.empty() || letters.find(letter) != std::string::npos)
      out += std::string("%") + digits[code >> 4] + digits[code & 15];
    else
      out += letter;
  }
  return out;
}

/// Two triangles, 3 m wide and 2 m high, and coordinates for pictures.
const std::string kTwoTriangles = bytesOf<float>({0, 0, 0, 3, 0, 0, 0, 2, 0, 3, 2, 0}) +
                                  bytesOf<float>({0, 0, 1, 0, 0, 1, 1, 1}) +
                                  bytesOf<std::uint16_t>({0, 1, 2, 2, 1, 3});

struct DataFile {
  std::string uri = "data:;base64," + base64(kTwoTriangles);
  std::string attributes = "", targets = "";  ///< more of them, before and behind a comma
  std::string accessors = "";                 ///< from the fourth on
  std::string material = R"({"name":"m"})";
  std::string more = "";
};

std::string dataGltf(const DataFile& parts) {
  return R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],"materials":[)" +
         parts.material + R"(],"meshes":[{"weights":[1],"primitives":[{"material":0,"indices":2,"attributes":{
"POSITION":0,"TEXCOORD_0":1)" +
         parts.attributes + "}" + parts.targets + R"(}]}],"accessors":[
{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3","min":[0,0,0],"max":[3,2,0]},
{"bufferView":1,"componentType":5126,"count":4,"type":"VEC2"},
{"bufferView":2,"componentType":5123,"count":6,"type":"SCALAR"})" +
         parts.accessors + R"(],"bufferViews":[{"buffer":0,"byteLength":48},
{"buffer":0,"byteOffset":48,"byteLength":32},{"buffer":0,"byteOffset":80,"byteLength":12}],
"buffers":[{"byteLength":92,"uri":")" +
         parts.uri + "\"}]" + parts.more + "}";
}

class GltfData : public SceneFiles {
 protected:
  Scene loaded(const DataFile& parts) const { return load(write("t.gltf", dataGltf(parts)), {}); }
  static void expectWhole(const Scene& scene) {
    EXPECT_TRUE(scene.warnings.empty()) << scene.warnings[0];
    ASSERT_EQ(scene.triangleCount(), 2u);
    EXPECT_EQ(boundsOf(scene).min(), Eigen::Vector3f(0, 0, 0));
    EXPECT_EQ(boundsOf(scene).max(), Eigen::Vector3f(3, 0, 2));  // glTF's y is up
    EXPECT_NEAR(areaOf(scene.meshes[0]), 6.0, 1e-6);
  }
};

// RFC 2397: data are of an address, and escaped as such, or base64, which may be, too.
TEST_F(GltfData, InAddressesMayBeEscaped) {
  for (const std::string& uri :
       {"data:application/octet-stream;base64," + escaped(base64(kTwoTriangles), "+/="),
        "data:application/octet-stream," + escaped(kTwoTriangles, ""),
        "DATA:application/octet-stream;BASE64," + base64(kTwoTriangles)}) {
    DataFile parts;
    parts.uri = uri;
    expectWhole(loaded(parts));
    // Whole numbers are read before Assimp does that.
    parts.accessors = R"(,{"bufferView":2,"componentType":5121,"normalized":true,"count":4,"type":"VEC3"})";
    parts.attributes = R"(,"COLOR_0":3)";
    const Scene scene = loaded(parts);
    expectWhole(scene);
    ASSERT_EQ(scene.meshes[0].colors.size(), 6u);  // each triangle has its own
    EXPECT_FLOAT_EQ(scene.meshes[0].colors[0][2], 1.0f / 255.0f);
  }
}

TEST_F(GltfData, OfPicturesMayBeEscapedToo) {
  writeTexture("paint.png");
  const std::string png = contentOf(pathOf("paint.png"));
  for (const std::string& uri :
       {"data:image/png;base64," + escaped(base64(png), "+/="), "data:image/png," + escaped(png, "")}) {
    DataFile parts;
    parts.material = R"({"pbrMetallicRoughness":{"baseColorTexture":{"index":0}}})";
    parts.more = R"(,"textures":[{"source":0}],"images":[{"uri":")" + uri + "\"}]";
    const Scene scene = loaded(parts);
    expectWhole(scene);
    ASSERT_EQ(scene.textures.size(), 1u);
    EXPECT_EQ(scene.textures[0].rgba[0], 200);
  }
}

// glTF 2.0, section 3.6.2.2: they are zeros, of any type.
TEST_F(GltfData, ThatAreNowhereAreZeros) {
  DataFile parts;
  parts.targets = R"(,"targets":[{"POSITION":3}])";
  parts.attributes = R"(,"COLOR_0":4,"TEXCOORD_1":5)";
  parts.accessors = R"(,{"componentType":5126,"count":4,"type":"VEC3","min":[0,0,0],"max":[0,0,0]},
{"componentType":5121,"normalized":true,"count":4,"type":"VEC3"},{"componentType":5126,"count":4,"type":"VEC2"})";
  const Scene scene = loaded(parts);
  expectWhole(scene);
  ASSERT_EQ(scene.meshes[0].colors.size(), 6u);  // each triangle has its own
  for (const Eigen::Array3f& color : scene.meshes[0].colors) EXPECT_TRUE((color == 0.0f).all());
}

TEST_F(GltfData, ThatAreNowhereAreNoMoreThanAGibibyte) {
  DataFile parts;
  parts.attributes = R"(,"COLOR_0":3)";
  parts.accessors = R"(,{"componentType":5121,"normalized":true,"count":100000000,"type":"VEC3"})";
  EXPECT_EQ(errorOf(write("t.gltf", dataGltf(parts))),
            pathOf("t.gltf") + ": accessor 3 is in no view, so all of zeros, and of more than 1 GiB");
}

/// The same triangles as Draco has them (its bitstream 2.2), one after another and not packed any further.
std::string dracoData() {
  const std::string header("DRACO\x02\x02\x01\x00\x00\x00", 11);  // 2.2, a mesh, in sequence, no metadata
  const std::string faces("\x02\x04\x01\x00\x01\x02\x02\x01\x03", 9);  // of 4 points, by plain indices
  // One decoder of one attribute: positions, of floats, 3 each, not normalized, number 0, as they stand.
  const std::string attribute("\x01\x01\x00\x09\x03\x00\x00\x00", 8);
  return header + faces + attribute + kTwoTriangles.substr(0, 48);
}

std::string dracoGltf(const std::string& told) {
  const std::string data = dracoData(), length = std::to_string(data.size());
  return R"({"asset":{"version":"2.0"},"extensionsUsed":["KHR_draco_mesh_compression"],"extensionsRequired":
["KHR_draco_mesh_compression"],"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],"materials":[{"name":"m"}],
"meshes":[{"primitives":[{"material":0,"indices":1,"attributes":{"POSITION":0},"extensions":
{"KHR_draco_mesh_compression":{"bufferView":0,"attributes":{"POSITION":0}}}}]}],"accessors":[
{"componentType":5126,"count":)" +
         told +
         R"(,"type":"VEC3","min":[0,0,0],"max":[3,2,0]},{"componentType":5123,"count":6,"type":"SCALAR"}],
"bufferViews":[{"buffer":0,"byteLength":)" +
         length + R"(}],"buffers":[{"byteLength":)" + length + R"(,"uri":"data:;base64,)" + base64(data) +
         "\"}]}";
}

TEST_F(GltfData, OfDracoThatAreMoreThanTheFileTellsAreNamed) {
  const std::string error = errorOf(write("t.gltf", dracoGltf("4")));
  if (error.find("KHR_draco_mesh_compression") != std::string::npos ||
      error.find("Draco") != std::string::npos)
    GTEST_SKIP() << "Assimp was built without Draco";
  ASSERT_EQ(error, "");
  expectWhole(load(pathOf("t.gltf"), {}));
  const Scene scene = load(write("t.gltf", dracoGltf("3")), {});
  EXPECT_EQ(scene.triangleCount(), 1u);
  ASSERT_EQ(scene.warnings.size(), 1u);
  EXPECT_EQ(scene.warnings[0],
            "1 files have triangles of vertices that are not there, they are left out: 1 in " +
                pathOf("t.gltf") + ", whose Draco data have other counts than it tells");
}

}  // namespace
}  // namespace sunlit::scene
