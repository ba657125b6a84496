// Attributes that glTF files write as whole numbers.
#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <vector>

#include "support/base64.h"
#include "unit/scene/measure.h"
#include "unit/scene/scene_files.h"

namespace sunlit::scene {
namespace {

template <typename Whole>
std::string bytesOf(const std::vector<Whole>& numbers) {
  return {reinterpret_cast<const char*>(numbers.data()), sizeof(Whole) * numbers.size()};
}

/// Positions of 16 bits in steps of 8 bytes, normals of 8 bits in steps of 4, coordinates of 16 bits: a
/// triangle in the plane of glTF's x and y.
const std::string kNumbers = bytesOf<std::int16_t>({-100, 0, 0, 99, 300, 0, 0, 99, -100, 200, 0, 99}) +
                             bytesOf<std::int8_t>({0, 0, 127, 99, 0, 0, 127, 99, 0, 0, 127, 99}) +
                             bytesOf<std::uint16_t>({0, 0, 65535, 0, 13107, 65535});

struct Parts {
  std::string uri = "\"uri\":\"numbers.bin\",";
  std::string node = R"({"mesh":0,"scale":[0.01,0.01,0.01]})";
  std::string position = R"("componentType":5122,"count":3)";
};

std::string gltf(const Parts& parts) {
  return R"({"asset":{"version":"2.0"},"extensionsRequired":["KHR_mesh_quantization"],"scene":0,"scenes":[{"nodes":[0]}],
"nodes":[)" +
         parts.node + R"(],"materials":[{"name":"m"}],"meshes":[{"primitives":[{"material":0,"attributes":
{"POSITION":0,"NORMAL":1,"TEXCOORD_0":2}}]}],"accessors":[{"bufferView":0,)" +
         parts.position + R"(,"type":"VEC3","min":[-100,0,0],"max":[300,200,0]},
{"bufferView":1,"componentType":5120,"normalized":true,"count":3,"type":"VEC3"},
{"bufferView":2,"componentType":5123,"normalized":true,"count":3,"type":"VEC2"}],"bufferViews":[
{"buffer":0,"byteLength":24,"byteStride":8},{"buffer":0,"byteOffset":24,"byteLength":12,"byteStride":4},
{"buffer":0,"byteOffset":36,"byteLength":12}],"buffers":[{)" +
         parts.uri + R"("byteLength":48}]})";
}

class GltfFloats : public SceneFiles {
 protected:
  Scene loaded(const Parts& parts) const {
    write("numbers.bin", kNumbers);
    return load(write("t.gltf", gltf(parts)), {});
  }
  static void expectTriangle(const Scene& scene) {
    EXPECT_TRUE(scene.warnings.empty());
    ASSERT_EQ(scene.triangleCount(), 1u);
    // glTF's y is up.
    EXPECT_LT((boundsOf(scene).min() - Eigen::Vector3f(-1, 0, 0)).norm(), 1e-6f);
    EXPECT_LT((boundsOf(scene).max() - Eigen::Vector3f(3, 0, 2)).norm(), 1e-6f);
    EXPECT_LT((scene.meshes[0].normals[0] - Eigen::Vector3f(0, -1, 0)).norm(), 1e-6f);
  }
};

TEST_F(GltfFloats, AreWhatWholeNumbersStandFor) {
  const Scene scene = loaded({});
  expectTriangle(scene);
  const std::vector<Eigen::Vector2f>& uv = scene.meshes[0].texture_coordinates;
  ASSERT_EQ(uv.size(), 3u);
  EXPECT_EQ(uv[1].x(), 1.0f);
  EXPECT_EQ(uv[2].x(), 0.2f);  // 13107 / 65535
}

TEST_F(GltfFloats, OfAnAddressThatHoldsThem) {
  Parts parts;
  parts.uri = "\"uri\":\"data:application/octet-stream;base64," + base64(kNumbers) + "\",";
  expectTriangle(loaded(parts));
}

TEST_F(GltfFloats, OfABinaryFile) {
  Parts parts;
  parts.uri = "";
  std::string json = gltf(parts);
  json.resize((json.size() + 3) / 4 * 4, ' ');
  const auto word = [](std::size_t value) {
    return bytesOf<std::uint32_t>({static_cast<std::uint32_t>(value)});
  };
  const std::string glb = "glTF" + word(2) + word(28 + json.size() + kNumbers.size()) + word(json.size()) +
                          "JSON" + json + word(kNumbers.size()) + std::string("BIN\0", 4) + kNumbers;
  expectTriangle(load(write("t.glb", glb), {}));
}

// 1 of a byte is −1 … 1 by 127, and −128 is −1, too (glTF 2.0, section 3.6.2.2).
TEST_F(GltfFloats, LowestBytesAreNotBelowMinusOne) {
  Parts parts;
  parts.node = R"({"mesh":0})";
  parts.position = R"("componentType":5120,"normalized":true,"count":3)";
  std::string bytes = kNumbers;
  for (const std::size_t corner : {0, 1, 2})
    bytes.replace(8 * corner, 3,
                  bytesOf<std::int8_t>({static_cast<std::int8_t>(corner == 0 ? -128 : 127),
                                        static_cast<std::int8_t>(corner == 2 ? 127 : 0), 0}));
  parts.uri = "\"uri\":\"data:;base64," + base64(bytes) + "\",";
  const Scene scene = loaded(parts);
  EXPECT_EQ(boundsOf(scene).min().x(), -1.0f);
  EXPECT_EQ(boundsOf(scene).max(), Eigen::Vector3f(1, 0, 1));
}

/// A view more, of numbers that a sparse accessor tells, and `sparse` in that of the positions.
std::string sparse(const std::string& base, const std::string& of_it) {
  const std::string numbers = bytesOf<std::uint16_t>({2, 0}) + bytesOf<std::int16_t>({100, 200, 0, 0});
  Parts parts;
  parts.position = R"("componentType":5122,"count":3,"sparse":)" + of_it;
  std::string text = gltf(parts);
  const auto replace = [&text](const std::string& from, const std::string& to) {
    text.replace(text.find(from), from.size(), to);
  };
  replace(R"({"bufferView":0,"componentType":5122)", "{" + base + R"("componentType":5122)");
  replace(R"("byteLength":12}],)",
          R"("byteLength":12},{"buffer":1,"byteLength":2},{"buffer":1,"byteOffset":4,"byteLength":6}],)");
  replace(R"("byteLength":48})",
          R"("byteLength":48},{"byteLength":12,"uri":"data:;base64,)" + base64(numbers) + "\"}");
  return text;
}

// Section 3.6.2.3: what changes, by its number, and what it becomes.
TEST_F(GltfFloats, OfSparseAccessorsAreThoseThatAreChanged) {
  write("numbers.bin", kNumbers);
  const std::string one =
      R"({"count":1,"indices":{"bufferView":3,"componentType":5123},"values":{"bufferView":4}})";
  const Scene changed = load(write("t.gltf", sparse(R"("bufferView":0,)", one)), {});
  EXPECT_TRUE(changed.warnings.empty());
  EXPECT_LT((boundsOf(changed).min() - Eigen::Vector3f(-1, 0, 0)).norm(), 1e-6f);
  EXPECT_LT((boundsOf(changed).max() - Eigen::Vector3f(3, 0, 2)).norm(), 1e-6f);
  EXPECT_NEAR(areaOf(changed.meshes[0]), 4.0, 1e-6);  // the third corner is (1, 2) instead of (−1, 2)
  EXPECT_NEAR(changed.meshes[0].positions[2].x(), 1.0f, 1e-6f);

  const std::string beyond =
      R"({"count":1,"indices":{"bufferView":4,"componentType":5123},"values":{"bufferView":4}})";
  EXPECT_EQ(errorOf(write("t.gltf", sparse("", beyond))),
            pathOf("t.gltf") + ": a sparse attribute changes element 100 of 3");
}

/// A triangle of floats, each vertex followed by 8 bytes of something else, whose last two are told anew.
std::string sparseFloats(const std::string& offset) {
  const float other = 77.0f;
  const std::string numbers =
      bytesOf<float>({0, 0, 0, other, other, 1, 0, 0, other, other, 0, 1, 0, other, other}) +
      bytesOf<std::uint16_t>({1, 2}) + bytesOf<float>({5, 0, 0, 0, 7, 0});
  return R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],"meshes":[
{"primitives":[{"attributes":{"POSITION":0}}]}],"accessors":[{"bufferView":0,)" +
         offset +
         R"("componentType":5126,"count":3,"type":"VEC3","sparse":{"count":2,"indices":{"bufferView":1,
"componentType":5123},"values":{"bufferView":2}}}],"bufferViews":[{"buffer":0,"byteLength":60,"byteStride":20},
{"buffer":0,"byteOffset":60,"byteLength":4},{"buffer":0,"byteOffset":64,"byteLength":24}],"buffers":[
{"byteLength":88,"uri":"data:;base64,)" +
         base64(numbers) + "\"}]}";
}

// Assimp would copy what stands between them.
TEST_F(GltfFloats, OfSparseAccessorsMayStandAmongOthers) {
  for (const std::string offset : {"", "\"byteOffset\":0,"}) {
    const Scene scene = load(write("t.gltf", sparseFloats(offset)), {});
    ASSERT_EQ(scene.meshes.at(0).positions.size(), 3u);
    const std::vector<Eigen::Vector3f> expected = {{0, 0, 0}, {5, 0, 0}, {0, 0, 7}};  // glTF's y is up
    for (std::size_t i = 0; i < 3; ++i)
      EXPECT_LT((scene.meshes[0].positions[i] - expected[i]).norm(), 1e-6f) << i;
  }
}

// Unsigned bytes, normalised whether the file says so or not; three of them in four.
TEST_F(GltfFloats, OfColoursAreSharesOfTheirLargest) {
  for (const char* const normalized : {R"("normalized":true,)", ""}) {
    Parts parts;
    std::string text = gltf(parts);
    const auto replace = [&text](const std::string& from, const std::string& to) {
      text.replace(text.find(from), from.size(), to);
    };
    replace(R"("TEXCOORD_0":2)", R"("TEXCOORD_0":2,"COLOR_0":3)");
    replace(R"("type":"VEC2"}])", R"("type":"VEC2"},{"bufferView":3,"componentType":5121,)" +
                                      std::string(normalized) + R"("count":3,"type":"VEC3"}])");
    replace(R"("byteLength":12}],)", R"("byteLength":12},{"buffer":1,"byteLength":12,"byteStride":4}],)");
    replace(R"("byteLength":48})",
            R"("byteLength":48},{"byteLength":12,"uri":"data:;base64,)" +
                base64(bytesOf<std::uint8_t>({51, 102, 255, 7, 51, 102, 255, 7, 0, 0, 0, 7})) + "\"}");
    write("numbers.bin", kNumbers);
    const Scene scene = load(write("t.gltf", text), {});
    EXPECT_TRUE(scene.warnings.empty());
    ASSERT_EQ(scene.meshes.at(0).colors.size(), 3u);
    EXPECT_LT((scene.meshes[0].colors[0] - Eigen::Array3f(0.2f, 0.4f, 1.0f)).abs().maxCoeff(), 1e-6f);
    EXPECT_EQ(scene.meshes[0].colors[2].maxCoeff(), 0.0f);
  }
}

TEST_F(GltfFloats, OfOtherScenesAreNotShownAndTheseAreNamed) {
  Parts parts;
  std::string text = gltf(parts);
  const std::string one = R"({"nodes":[0]})",
                    all = R"({"name":"night","nodes":[]},)" + one + R"(,{"nodes":[0]})";
  text.replace(text.find(one), one.size(), all);
  text.replace(text.find("\"scene\":0"), 9, "\"scene\":1");
  write("numbers.bin", kNumbers);
  const Scene scene = load(write("t.gltf", text), {});
  EXPECT_EQ(scene.triangleCount(), 1u);
  EXPECT_EQ(scene.warnings,
            std::vector<std::string>{"2 scenes were left out, of several in a glTF file the one that "
                                     "it names is shown, or the first: night; scene 2"});
}

TEST_F(GltfFloats, WhatIsNotThereIsNamed) {
  const auto error = [&](const Parts& parts) {
    write("numbers.bin", kNumbers);
    return errorOf(write("t.gltf", gltf(parts)));
  };
  Parts parts;
  parts.uri = "\"uri\":\"gone.bin\",";
  EXPECT_EQ(error(parts), pathOf("t.gltf") + ": " + pathOf("gone.bin") + ": cannot read this file");
  parts.uri = "\"uri\":\"data:;base64,AAAA\",";
  EXPECT_EQ(error(parts), pathOf("t.gltf") + ": an attribute reaches beyond its buffer");
  parts.uri = "";
  EXPECT_EQ(error(parts), pathOf("t.gltf") + ": a buffer has no address, and the file no bytes of its own");
}

}  // namespace
}  // namespace sunlit::scene
