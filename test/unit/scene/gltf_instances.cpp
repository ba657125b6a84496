// Meshes that glTF files show at many places (EXT_mesh_gpu_instancing).
#include <gtest/gtest.h>

#include <cstdint>
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

/// A triangle; where two stand; quarter turns about the file's y, by floats and by bytes; how large they are.
const std::string kNumbers =
    bytesOf<float>({0, 0, 0, 1, 0, 0, 0, 1, 0}) + bytesOf<float>({10, 0, 0, 20, 5, 0}) +
    bytesOf<float>({0, 0, 0, 1, 0, 0.70710678f, 0, 0.70710678f}) +
    bytesOf<std::int8_t>({0, 0, 0, 127, 0, 90, 0, 90}) + bytesOf<float>({1, 1, 1, 2, 3, 2});

std::string gltf(const std::string& attributes, const std::string& more_of_node = "") {
  return R"({"asset":{"version":"2.0"},"extensionsRequired":["EXT_mesh_gpu_instancing"],"extensionsUsed":["EXT_mesh_gpu_instancing"],
"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"name":"tree","mesh":0,"translation":[0,0,-1],"extensions":{
"EXT_mesh_gpu_instancing":{"attributes":{)" +
         attributes + "}}}" + more_of_node + R"(}],"materials":[{"name":"m"}],
"meshes":[{"primitives":[{"material":0,"attributes":{"POSITION":0}}]}],"accessors":[
{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,1,0]},
{"bufferView":1,"componentType":5126,"count":2,"type":"VEC3"},
{"bufferView":2,"componentType":5126,"count":2,"type":"VEC4"},
{"bufferView":3,"componentType":5120,"normalized":true,"count":2,"type":"VEC4"},
{"bufferView":4,"componentType":5126,"count":2,"type":"VEC3"}],"bufferViews":[
{"buffer":0,"byteLength":36},{"buffer":0,"byteOffset":36,"byteLength":24},{"buffer":0,"byteOffset":60,"byteLength":32},
{"buffer":0,"byteOffset":92,"byteLength":8},{"buffer":0,"byteOffset":100,"byteLength":24}],
"buffers":[{"byteLength":124,"uri":"data:;base64,)" +
         base64(kNumbers) + "\"}]}";
}

class GltfInstances : public SceneFiles {
 protected:
  Scene loaded(const std::string& attributes) const { return load(write("t.gltf", gltf(attributes)), {}); }
  std::string errorOfAttributes(const std::string& attributes) const {
    return errorOf(write("t.gltf", gltf(attributes)));
  }
};

/// In `map`: the file's y is up, and its z comes towards the viewer, −y.
void expectBounds(const Mesh& mesh, const Eigen::Vector3f& least, const Eigen::Vector3f& most) {
  EXPECT_LT((boundsOf(mesh).min() - least).norm(), 1e-4f) << boundsOf(mesh).min().transpose();
  EXPECT_LT((boundsOf(mesh).max() - most).norm(), 1e-4f) << boundsOf(mesh).max().transpose();
}

// Each place is below the node: p' = node · T · R · S · p.
TEST_F(GltfInstances, StandWhereTheirAttributesTell) {
  const Scene scene = loaded(R"("TRANSLATION":1,"ROTATION":2,"SCALE":4)");
  EXPECT_TRUE(scene.warnings.empty());
  ASSERT_EQ(scene.meshes.size(), 2u);
  expectBounds(scene.meshes[0], {10, 1, 0}, {11, 1, 1});
  // Twice as wide and three times as high; by a quarter turn its x points along −z, away from the viewer.
  expectBounds(scene.meshes[1], {20, 1, 5}, {20, 3, 8});
  EXPECT_EQ(scene.meshes[0].name, "tree");
}

// 90 of 127 twice is a quarter turn, though not quite of length 1.
TEST_F(GltfInstances, OfTurnsByBytes) {
  const Scene scene = loaded(R"("TRANSLATION":1,"ROTATION":3)");
  ASSERT_EQ(scene.meshes.size(), 2u);
  EXPECT_LT((boundsOf(scene.meshes[1]).max() - Eigen::Vector3f(20, 2, 6)).norm(), 0.01f);
}

// By which they would be scaled: zero to nothing, and 2 by 4.
TEST_F(GltfInstances, AreTurnedByQuaternionsOfAnyLength) {
  std::string numbers = kNumbers;
  numbers.replace(60, 32, bytesOf<float>({0, 0, 0, 0, 0, 1.41421356f, 0, 1.41421356f}));
  std::string text = gltf(R"("TRANSLATION":1,"ROTATION":2)");
  text.replace(text.find(base64(kNumbers)), base64(kNumbers).size(), base64(numbers));
  const Scene scene = load(write("t.gltf", text), {});
  ASSERT_EQ(scene.meshes.size(), 2u);
  expectBounds(scene.meshes[0], {10, 1, 0}, {11, 1, 1});
  expectBounds(scene.meshes[1], {20, 1, 5}, {20, 2, 6});
  EXPECT_EQ(scene.warnings,
            (std::vector<std::string>{
                "1 glTF files turn nodes by quaternions that are not of length 1, which they are "
                "made: 2 instances in " +
                pathOf("t.gltf")}));
}

TEST_F(GltfInstances, WithoutAPlaceTheMeshStandsAtItsNode) {
  const Scene scene = loaded(R"("_COLOR":1)");
  ASSERT_EQ(scene.meshes.size(), 1u);
  expectBounds(scene.meshes[0], {0, 1, 0}, {1, 1, 1});
}

TEST_F(GltfInstances, WhatDoesNotFitIsNamed) {
  const std::string node = pathOf("t.gltf") + ": node 0: EXT_mesh_gpu_instancing: ";
  EXPECT_EQ(errorOfAttributes(R"("TRANSLATION":0,"ROTATION":2)"),
            node + "ROTATION has 2 places, and another attribute 3");
  EXPECT_EQ(errorOfAttributes(R"("ROTATION":1)"), node + "ROTATION must have 4 numbers a place");
  EXPECT_NE(errorOfAttributes(R"("SCALE":9)").find(pathOf("t.gltf") + ": an attribute is not as glTF has it"),
            std::string::npos);
}

// 64 GB of zeros, of which the file has none.
TEST_F(GltfInstances, AttributesOfOtherNumbersAreRefusedBeforeTheyAreRead) {
  std::string text = gltf(R"("TRANSLATION":1,"ROTATION":2)");
  const std::string there = R"({"bufferView":2,"componentType":5126,"count":2,)";
  text.replace(text.find(there), there.size(), R"({"componentType":5126,"count":4000000000,)");
  EXPECT_NE(errorOf(write("t.gltf", text)).find("ROTATION has 4000000000 places, and another attribute 2"),
            std::string::npos);
}

// Before there is a node for each, of a kilobyte.
TEST_F(GltfInstances, OfTooManyMeshesAreRefused) {
  std::string text = gltf(R"("TRANSLATION":1)");
  const auto replace = [&text](const std::string& from, const std::string& to) {
    text.replace(text.find(from), from.size(), to);
  };
  replace(R"({"bufferView":1,"componentType":5126,"count":2,)",
          R"({"bufferView":5,"componentType":5126,"count":100001,)");
  replace(R"("byteLength":24}],)", R"("byteLength":24},{"buffer":1,"byteLength":1200012}],)");
  replace("\"}]}", R"("},{"byteLength":1200012,"uri":"places.bin"}]})");
  write("places.bin", std::string(1200012, '\0'));
  EXPECT_EQ(errorOf(write("t.gltf", text)), pathOf("t.gltf") +
                                                ": node 0: EXT_mesh_gpu_instancing: the number of meshes up "
                                                "to here is 100001, but must be from 0 to "
                                                "100000");
}

}  // namespace
}  // namespace sunlit::scene
