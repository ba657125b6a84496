#include "sunlit/scene/scene_bytes.h"

#include <gtest/gtest.h>

#include <memory>
#include <stdexcept>
#include <string>

#include "sunlit/image/files.h"
#include "support/temporary_folder.h"

namespace sunlit::scene {
namespace {

std::string bytesOf(const FlatScene& flat) {
  std::string bytes;
  writeBytes(flat,
             [&](const void* data, std::size_t size) { bytes.append(static_cast<const char*>(data), size); });
  return bytes;
}

FlatScene read(const std::string& bytes) {
  return flatSceneOf(reinterpret_cast<const std::byte*>(bytes.data()), bytes.size());
}

/// With something in every list.
Scene small() {
  Scene scene;
  scene.name = "small";
  scene.textures = {{"dots", 2, 1, {1, 2, 3, 4, 5, 6, 7, 8}, Wrap::kMirror, Wrap::kClamp}};
  scene.materials.resize(2);
  scene.materials[1].name = "pane";
  scene.materials[1].base_color = LinearRgb(0.1f, 0.2f, 0.3f);
  scene.materials[1].normal_map = {0, 1, 2};
  scene.materials[1].alpha_mode = AlphaMode::kBlend;
  scene.materials[1].lamp_group = "windows";
  scene.materials[1].double_sided = false;
  scene.materials[1].detail = {0.1f, 4.0f, 0.02f, 0.7f, {1.0f, 0.5f, 0.25f}};
  Mesh mesh;
  mesh.name = "triangle";
  mesh.material = 1;
  mesh.positions = {{0.0f, 0.0f, 0.0f}, {1.0f, 0.0f, 0.0f}, {0.0f, 1.0f, -0.0f}};
  mesh.normals.assign(3, Eigen::Vector3f::UnitZ());
  mesh.more_texture_coordinates = {{}, {{0.0f, 0.5f}, {1.0f, 0.5f}, {2.0f, 0.5f}}};
  mesh.tangents.assign(3, Eigen::Vector4f(1.0f, 0.0f, 0.0f, -1.0f));
  mesh.colors.assign(3, Eigen::Array3f(0.1f, 0.2f, 2.0f));
  mesh.triangles = {{0, 1, 2}};
  scene.meshes = {mesh, {}};
  scene.lamps.resize(1);
  scene.lamps[0].group = "windows";
  scene.lamps[0].casts_shadows = false;
  scene.warnings = {"one", ""};
  return scene;
}

TEST(SceneLooks, TellAllOfAMaterialButItsName) {
  const auto looksOf = [](const Scene& scene) {
    std::string bytes;
    writeLooks(scene, [&](const void* data, std::size_t size) {
      bytes.append(static_cast<const char*>(data), size);
    });
    return bytes;
  };
  const std::string looks = looksOf(small());
  Scene other = small();
  other.textures[0].name = other.materials[1].name = other.lamps[0].name = "else";
  EXPECT_EQ(looksOf(other), looks);
  other = small();
  other.materials[1].normal_map.channel = 1;
  EXPECT_NE(looksOf(other), looks);
  other = small();
  other.lamps[0].casts_shadows = true;
  EXPECT_NE(looksOf(other), looks);
}

TEST(SceneBytes, MakeTheSameSceneAgain) {
  const FlatScene flat = flattened(small());
  const auto [scene, shape] = read(bytesOf(flat));
  EXPECT_EQ(bytesOf({scene, shape}), bytesOf(flat));
  EXPECT_EQ(scene.name, "small");
  EXPECT_EQ(scene.textures.at(0).rgba, flat.scene.textures[0].rgba);
  EXPECT_EQ(scene.textures[0].wrap_v, Wrap::kClamp);
  EXPECT_EQ(scene.materials.at(1).lamp_group, "windows");
  EXPECT_EQ(scene.materials[1].normal_map.channel, 2);
  EXPECT_FALSE(scene.materials[1].double_sided);
  EXPECT_EQ(scene.materials[1].detail.tint[2], 0.25f);
  EXPECT_TRUE(scene.meshes.empty());
  const Mesh mesh = small().meshes[0];
  EXPECT_EQ(shape.positions, image::KeptArray(mesh.positions));
  EXPECT_EQ(shape.more_texture_coordinates.at(1), image::KeptArray(mesh.more_texture_coordinates[1]));
  EXPECT_EQ(shape.tangents, image::KeptArray(mesh.tangents));
  EXPECT_EQ(shape.triangles, image::KeptArray(mesh.triangles));
  EXPECT_EQ(shape.planes[0].normal, Eigen::Vector3f::UnitZ().eval());
  EXPECT_EQ(shape.chunks[0].material, 1);
  EXPECT_FALSE(scene.lamps.at(0).casts_shadows);
  EXPECT_EQ(scene.warnings, flat.scene.warnings);
}

TEST(SceneBytes, StayWhereTheyAreForWhoeverOwnsThem) {
  const std::string text = bytesOf(flattened(small()));
  const TemporaryFolder folder;
  image::writeFileAtomically(folder.file("scene"), text);
  const auto bytes = std::make_shared<const image::FileBytes>(folder.file("scene"));
  const std::byte* const data = bytes->data();
  FlatScene flat = flatSceneOf(data, bytes->size(), bytes);
  const auto isThere = [&](const auto& values) {
    const auto* const first = reinterpret_cast<const std::byte*>(values.data());
    const auto* const end = reinterpret_cast<const std::byte*>(values.end());
    return first >= data && end <= data + bytes->size() &&
           static_cast<std::size_t>(first - data) % image::kKeptAlignment == 0;
  };
  const Shape& shape = flat.shape;
  EXPECT_TRUE(isThere(shape.normals) && isThere(shape.tangents) && isThere(shape.planes));
  ASSERT_TRUE(isThere(shape.positions));
  EXPECT_LT(reinterpret_cast<const std::byte*>(shape.positions.end()) + sizeof(float), data + bytes->size());
  const Texture copy = flat.scene.textures.at(0);
  EXPECT_EQ(copy.rgba, small().textures[0].rgba);
  EXPECT_TRUE(isThere(copy.rgba));
  copy.rgba.letGo();
  EXPECT_EQ(copy.rgba, small().textures[0].rgba);
  flat.scene.textures[0].rgba.own()[1] = 20;  // from now on its own
  EXPECT_EQ(flat.scene.textures[0].rgba, Texels({1, 20, 3, 4, 5, 6, 7, 8}));
  EXPECT_EQ(copy.rgba, small().textures[0].rgba);
  EXPECT_EQ(bytesOf(flatSceneOf(data, bytes->size())), text);
  flat = FlatScene();
  EXPECT_EQ(bytes.use_count(), 2);  // the copy's
}

TEST(SceneBytes, ThatEndTooSoonOrGoOnAreRefused) {
  const std::string bytes = bytesOf(flattened(small()));
  for (std::size_t size = 0; size < bytes.size(); ++size)
    EXPECT_THROW(read(bytes.substr(0, size)), std::runtime_error) << size;
  EXPECT_THROW(read(bytes + '\0'), std::runtime_error);
  // A count of a whole address space is not asked for.
  EXPECT_THROW(read(std::string(bytes.size(), '\xff')), std::runtime_error);
}

}  // namespace
}  // namespace sunlit::scene
