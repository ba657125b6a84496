// What is exported comes back the same.
#include "sunlit/scene/export.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "support/message_of.h"
#include "unit/scene/measure.h"
#include "unit/scene/scene_files.h"

namespace sunlit::scene {
namespace {

Scene sample() {
  Scene scene;
  Texture texture{"leaf \"1\"", 3, 2, {}};
  for (int i = 0; i < 24; ++i) texture.rgba.push_back(static_cast<std::uint8_t>(10 * i));
  scene.textures.push_back(texture);
  Material leaf;
  leaf.name = "leaf";
  leaf.base_texture = 0;
  leaf.base_color = LinearRgb(0.1f, 0.2f, 0.3f);
  leaf.alpha_mode = AlphaMode::kMask;
  leaf.alpha_cutoff = 0.375f;
  leaf.double_sided = true;
  Material lamp;
  lamp.name = "lamp";
  lamp.roughness = 0.25f;
  lamp.metalness = 0.75f;
  lamp.emission = LinearRgb(100.0f, 400.0f, 50.0f);
  lamp.double_sided = false;
  scene.materials = {leaf, lamp};

  Mesh mesh;
  mesh.name = "tree\\1";
  mesh.material = 0;
  mesh.positions = {
      {0.1f, -2.3f, 4.5f}, {1.7f, 0.2f, 0.3f}, {-7.1f, 8.9f, 1e-3f}, {1234.567f, -765.4321f, 88.8f}};
  for (int i = 0; i < 4; ++i) {
    mesh.normals.push_back(Eigen::Vector3f(0.1f * static_cast<float>(i), 0.5f, 1.0f).normalized());
    mesh.texture_coordinates.emplace_back(0.3f * static_cast<float>(i), -1.7f * static_cast<float>(i));
    mesh.colors.emplace_back(0.25f * static_cast<float>(i), 0.5f, 1.0f);
  }
  mesh.triangles = {{0, 1, 2}, {3, 2, 1}};
  scene.meshes.push_back(mesh);
  mesh.name = "lamp";
  mesh.material = 1;
  mesh.texture_coordinates.clear();
  mesh.colors.clear();
  scene.meshes.push_back(mesh);
  return scene;
}

class ExportGltf : public SceneFiles {};

/// Every corner of every triangle in order. Vertices may be merged and renumbered on the way.
void expectSameCorners(const Mesh& a, const Mesh& b) {
  ASSERT_EQ(a.triangles.size(), b.triangles.size());
  ASSERT_EQ(a.texture_coordinates.empty(), b.texture_coordinates.empty());
  ASSERT_EQ(a.colors.empty(), b.colors.empty());
  for (std::size_t i = 0; i < a.triangles.size(); ++i) {
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const std::uint32_t from = a.triangles[i][corner];
      const std::uint32_t to = b.triangles[i][corner];
      // Swapping axes and signs loses nothing.
      EXPECT_EQ(a.positions[from], b.positions[to]);
      // Normals are made of length 1 again, texture coordinates are turned upside down twice: float rounding.
      EXPECT_LT((a.normals[from] - b.normals[to]).norm(), 1e-6f);
      if (!a.texture_coordinates.empty()) {
        EXPECT_LT((a.texture_coordinates[from] - b.texture_coordinates[to]).norm(), 1e-6f);
      }
      if (!a.colors.empty()) {
        EXPECT_LT((a.colors[from] - b.colors[to]).abs().maxCoeff(), 1e-6f);
      }
    }
  }
}

TEST_F(ExportGltf, GeometryComesBack) {
  const Scene scene = sample();
  writeGltf(scene, pathOf("scene.glb"));
  const Scene back = load(pathOf("scene.glb"), {});
  ASSERT_EQ(back.warnings.size(), 1u);  // see EmissionKeepsItsColour
  ASSERT_EQ(back.meshes.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(back.meshes[i].name, scene.meshes[i].name);
    expectSameCorners(scene.meshes[i], back.meshes[i]);
  }
}

TEST_F(ExportGltf, MaterialsAndTexturesComeBack) {
  const Scene scene = sample();
  writeGltf(scene, pathOf("scene.glb"));
  const Scene back = load(pathOf("scene.glb"), {});
  ASSERT_EQ(back.materials.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    const Material& a = scene.materials[i];
    const Material& b = back.materials[i];
    EXPECT_EQ(a.name, b.name);
    EXPECT_TRUE((a.base_color.value == b.base_color.value).all());
    EXPECT_EQ(a.base_texture, b.base_texture);
    EXPECT_EQ(a.roughness, b.roughness);
    EXPECT_EQ(a.metalness, b.metalness);
    EXPECT_EQ(a.alpha_mode, b.alpha_mode);
    EXPECT_EQ(a.double_sided, b.double_sided);
  }
  EXPECT_EQ(back.materials[0].alpha_cutoff, 0.375f);
  ASSERT_EQ(back.textures.size(), 1u);
  EXPECT_EQ(back.textures[0].width, 3);
  EXPECT_EQ(back.textures[0].rgba, scene.textures[0].rgba);
}

TEST_F(ExportGltf, MaterialsComeBackWhateverTheCaseOfTheEnding) {
  writeGltf(sample(), pathOf("scene.glb"));
  std::filesystem::rename(pathOf("scene.glb"), pathOf("SCENE.GLB"));
  const Scene back = load(pathOf("SCENE.GLB"), {});
  ASSERT_EQ(back.materials.size(), 2u);
  EXPECT_FLOAT_EQ(back.materials[1].roughness, 0.25f);
  EXPECT_FLOAT_EQ(back.materials[1].metalness, 0.75f);
}

TEST_F(ExportGltf, EmissionKeepsItsColourAndSaysThatItLostItsStrength) {
  writeGltf(sample(), pathOf("scene.glb"));
  const Scene back = load(pathOf("scene.glb"), {});
  EXPECT_LT((back.materials[1].emission.value - Eigen::Array3f(0.25f, 1.0f, 0.125f)).abs().maxCoeff(), 1e-6f);
  EXPECT_EQ(back.warnings.at(0),
            pathOf("scene.glb") + ": glTF extension KHR_materials_emissive_strength is not read");
}

TEST_F(ExportGltf, WritesTransmissionAndSaysThatItIsNotReadBack) {
  Scene scene = sample();
  scene.materials[0].transmission = 0.25f;
  writeGltf(scene, pathOf("scene.glb"));
  std::ifstream stream(pathOf("scene.glb"), std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  EXPECT_NE(text.find("\"KHR_materials_diffuse_transmission\":{\"diffuseTransmissionFactor\":0.25"),
            std::string::npos);
  const Scene back = load(pathOf("scene.glb"), {});
  ASSERT_FALSE(back.warnings.empty());
  EXPECT_EQ(back.warnings.front(),
            pathOf("scene.glb") + ": glTF extension KHR_materials_diffuse_transmission is not read");
}

TEST_F(ExportGltf, WritesTheSameBytesEachTime) {
  const auto bytes = [&](const std::string& name) {
    writeGltf(sample(), pathOf(name));
    std::ifstream stream(pathOf(name), std::ios::binary);
    return std::string(std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>());
  };
  EXPECT_EQ(bytes("a.glb"), bytes("b.glb"));
}

TEST_F(ExportGltf, NamesAFileThatCannotBeWritten) {
  const std::string file = pathOf("no/such/folder/scene.glb");
  const std::string error = messageOf<std::runtime_error>([&] { writeGltf(sample(), file); });
  EXPECT_EQ(error.find(file), 0u) << error;
}

}  // namespace
}  // namespace sunlit::scene
