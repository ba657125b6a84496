// What is exported comes back the same.
#include "sunlit/scene/export.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "support/message_of.h"
#include "unit/scene/measure.h"
#include "unit/scene/scene_files.h"

namespace sunlit::scene {
namespace {

Scene sample() {
  Scene scene;
  Texture texture{"leaf \"1\"", 3, 2, {}};
  for (int i = 0; i < 24; ++i) texture.rgba.own().push_back(static_cast<std::uint8_t>(10 * i));
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
  EXPECT_TRUE(back.warnings.empty());
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

// Files of other tools have names in Latin-1, and JSON is UTF-8.
TEST_F(ExportGltf, NamesAreTextWhateverTheirBytes) {
  Scene scene = sample();
  scene.meshes[0].name = "caf\xE9 \x01\n\x1F\t";
  scene.materials[0].name = "\xFF\"";
  scene.textures[0].name = "gr\xC3\xB6\xC3";  // ö, and half of a letter
  writeGltf(scene, pathOf("scene.glb"));
  const std::string text = contentOf(pathOf("scene.glb"));
  EXPECT_NE(text.find("\"name\":\"caf\xEF\xBF\xBD \\u0001\\n\\u001f\\t\""), std::string::npos);
  EXPECT_NE(text.find("\"name\":\"\xEF\xBF\xBD\\\"\""), std::string::npos);
  EXPECT_NE(text.find("\"name\":\"gr\xC3\xB6\xEF\xBF\xBD\""), std::string::npos);
  EXPECT_EQ(load(pathOf("scene.glb"), {}).meshes.size(), 2u);
}

TEST_F(ExportGltf, MaterialsComeBackWhateverTheCaseOfTheEnding) {
  writeGltf(sample(), pathOf("scene.glb"));
  std::filesystem::rename(pathOf("scene.glb"), pathOf("SCENE.GLB"));
  const Scene back = load(pathOf("SCENE.GLB"), {});
  ASSERT_EQ(back.materials.size(), 2u);
  EXPECT_FLOAT_EQ(back.materials[1].roughness, 0.25f);
  EXPECT_FLOAT_EQ(back.materials[1].metalness, 0.75f);
}

TEST_F(ExportGltf, EmissionComesBackWithItsStrength) {
  writeGltf(sample(), pathOf("scene.glb"));
  const Scene back = load(pathOf("scene.glb"), {});
  // Divided by its strength and multiplied again: rounding.
  EXPECT_LT((back.materials[1].emission.value - Eigen::Array3f(100.0f, 400.0f, 50.0f)).abs().maxCoeff(),
            1e-4f);
  EXPECT_TRUE(back.warnings.empty());
}

TEST_F(ExportGltf, TransmissionComesBack) {
  Scene scene = sample();
  scene.materials[0].transmission = 0.25f;
  writeGltf(scene, pathOf("scene.glb"));
  std::ifstream stream(pathOf("scene.glb"), std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  EXPECT_NE(text.find("\"KHR_materials_diffuse_transmission\":{\"diffuseTransmissionFactor\":0.25"),
            std::string::npos);
  EXPECT_NE(text.find("\"diffuseTransmissionColorTexture\":{\"index\":0,"), std::string::npos);
  const Scene back = load(pathOf("scene.glb"), {});
  EXPECT_TRUE(back.warnings.empty());
  EXPECT_EQ(back.materials[0].transmission, 0.25f);
}

TEST_F(ExportGltf, MapsAndBlendingComeBack) {
  Scene scene = sample();
  Material& lamp = scene.materials[1];
  scene.textures.push_back(scene.textures[0]);
  scene.textures[1].wrap_u = Wrap::kClamp;
  scene.textures[1].wrap_v = Wrap::kMirror;
  scene.meshes[1].texture_coordinates.assign(4, Eigen::Vector2f(0.25f, 0.5f));
  scene.meshes[1].more_texture_coordinates.emplace_back(4, Eigen::Vector2f(0.75f, 0.125f));
  scene.meshes[1].tangents.assign(4, Eigen::Vector4f(1.0f, 0.0f, 0.0f, -1.0f));
  lamp.roughness_map = {1, 1, 1};
  lamp.metalness_map = {1, 1, 2};
  lamp.normal_map = {0, 0, 0};
  lamp.normal_scale = 0.5f;
  lamp.occlusion_map = {1, 0, 0};
  lamp.occlusion_strength = 0.25f;
  lamp.emission_map = {0, 1, 0};
  lamp.alpha_mode = AlphaMode::kBlend;
  lamp.alpha = 0.5f;
  lamp.dielectric = LinearRgb(0.02f, 0.01f, 0.0f);
  lamp.dielectric_grazing = 0.5f;
  writeGltf(scene, pathOf("scene.glb"));
  const Scene back = load(pathOf("scene.glb"), {});
  EXPECT_TRUE(back.warnings.empty());
  const Material& m = back.materials[1];
  const auto expectSame = [](const TextureUse& a, const TextureUse& b) {
    EXPECT_EQ(a.given(), b.given());
    EXPECT_EQ(a.channel, b.channel);
  };
  expectSame(m.roughness_map, lamp.roughness_map);
  expectSame(m.metalness_map, lamp.metalness_map);
  expectSame(m.normal_map, lamp.normal_map);
  expectSame(m.occlusion_map, lamp.occlusion_map);
  expectSame(m.emission_map, lamp.emission_map);
  const Mesh& mesh = back.meshes[1];
  const auto coordinates = [&](const TextureUse& use) {
    const auto more = static_cast<std::size_t>(use.coordinates);
    return use.coordinates == 0 ? mesh.texture_coordinates.at(0)
                                : mesh.more_texture_coordinates.at(more - 1)[0];
  };
  EXPECT_LT((coordinates(m.roughness_map) - Eigen::Vector2f(0.75f, 0.125f)).norm(), 1e-6f);
  EXPECT_LT((coordinates(m.normal_map) - Eigen::Vector2f(0.25f, 0.5f)).norm(), 1e-6f);
  EXPECT_EQ(back.textures[static_cast<std::size_t>(m.roughness_map.texture)].wrap_u, Wrap::kClamp);
  EXPECT_EQ(back.textures[static_cast<std::size_t>(m.roughness_map.texture)].wrap_v, Wrap::kMirror);
  EXPECT_EQ(m.normal_scale, 0.5f);
  EXPECT_EQ(m.occlusion_strength, 0.25f);
  EXPECT_EQ(m.alpha_mode, AlphaMode::kBlend);
  EXPECT_EQ(m.alpha, 0.5f);
  EXPECT_LT((m.dielectric.value - lamp.dielectric.value).abs().maxCoeff(), 1e-6f);
  EXPECT_EQ(m.dielectric_grazing, 0.5f);
  ASSERT_EQ(mesh.tangents.size(), mesh.positions.size());
  EXPECT_LT((mesh.tangents[0] - Eigen::Vector4f(1.0f, 0.0f, 0.0f, -1.0f)).norm(), 1e-6f);
}

Lamp spot() {
  Lamp lamp;
  lamp.name = "mast 3";
  lamp.group = "masts";
  lamp.position = {3.5f, -7.25f, 15.0f};
  lamp.direction = Eigen::Vector3f(0.3f, -0.4f, -0.8f).normalized();
  lamp.intensity = LinearRgb(4000.0f, 3000.0f, 2000.0f);
  lamp.range_m = 80.0f;
  lamp.inner_rad = 0.25f;
  lamp.outer_rad = 0.75f;
  return lamp;
}

void expectSame(const Lamp& a, const Lamp& b) {
  EXPECT_EQ(a.name, b.name);
  EXPECT_EQ(a.group, b.group);
  EXPECT_LT((a.position - b.position).norm(), 1e-5f);
  if (a.isSpot()) {
    EXPECT_LT((a.direction - b.direction).norm(), 1e-6f);
  }
  // Of a colour and its strength.
  EXPECT_LT((a.intensity.value / b.intensity.value - 1.0f).abs().maxCoeff(), 1e-6f);
  EXPECT_FALSE(b.relative);
  EXPECT_EQ(a.range_m, b.range_m);
  EXPECT_EQ(a.inner_rad, b.inner_rad);
  EXPECT_EQ(a.outer_rad, b.outer_rad);
  EXPECT_EQ(a.exponent, b.exponent);
  EXPECT_EQ(std::vector<float>({b.constant, b.linear, b.quadratic}), std::vector<float>({0, 0, 1}));
}

TEST_F(ExportGltf, LampsComeBack) {
  Scene scene = sample();
  Lamp point;
  point.name = point.group = "bulb";
  point.position = {1.0f, 2.0f, 3.0f};
  point.intensity = LinearRgb(100.0f, 90.0f, 80.0f);
  Lamp straight_up = spot();
  straight_up.direction = Eigen::Vector3f::UnitZ();
  scene.lamps = {point, spot(), straight_up};
  EXPECT_TRUE(writeGltf(scene, pathOf("scene.glb")).empty());
  const Scene back = load(pathOf("scene.glb"), {});
  EXPECT_TRUE(back.warnings.empty());
  EXPECT_EQ(back.meshes.size(), scene.meshes.size());
  ASSERT_EQ(back.lamps.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) expectSame(scene.lamps[i], back.lamps[i]);
}

TEST_F(ExportGltf, LampsThatFallOffOtherwiseAreAsBrightOnTheGroundAndNamed) {
  Scene scene = sample();
  Lamp lamp = spot();
  lamp.constant = 0.5f;
  lamp.linear = 0.1f;
  lamp.quadratic = 0.01f;
  lamp.exponent = 1.0f;
  lamp.radius_m = 0.5f;
  lamp.casts_shadows = false;
  scene.lamps = {lamp};
  const std::vector<std::string> lost = writeGltf(scene, pathOf("scene.glb"));
  EXPECT_EQ(lost.size(), 4u);
  for (const std::string& line : lost) {
    EXPECT_EQ(line.find("1 lamps"), 0u) << line;
    EXPECT_NE(line.find("mast 3"), std::string::npos) << line;
  }
  const Scene back = load(pathOf("scene.glb"), {});
  ASSERT_EQ(back.lamps.size(), 1u);
  // 15 m above z = 0: 0.5 + 1.5 + 2.25.
  EXPECT_NEAR(back.lamps[0].intensity.value[0] / (15.0f * 15.0f), 4000.0f / 4.25f, 0.01f);
}

TEST_F(ExportGltf, RefusesLampsWithoutAUnit) {
  Scene scene = sample();
  scene.lamps = {spot()};
  scene.lamps[0].relative = true;
  EXPECT_NE(messageOf([&] { writeGltf(scene, pathOf("scene.glb")); }).find("mast 3"), std::string::npos);
}

TEST_F(ExportGltf, RoughnessAndMetalnessOfTexturesOfTheirOwnArePackedIntoOne) {
  Scene scene = sample();
  Texture coarse{"rough", 1, 1, {7, 8, 9, 200}};
  Texture fine{"metal", 2, 1, {10, 20, 30, 255, 40, 50, 60, 255}};
  scene.textures = {scene.textures[0], coarse, fine};
  scene.materials[1].roughness_map = {1, 0, 3};
  scene.materials[1].metalness_map = {2, 0, 0};
  scene.materials[0].metalness_map = {2, 0, 1};
  scene.meshes[1].texture_coordinates = scene.meshes[0].texture_coordinates;
  EXPECT_TRUE(writeGltf(scene, pathOf("scene.glb")).empty());
  const Scene back = load(pathOf("scene.glb"), {});
  const auto texels = [&](const TextureUse& use) {
    std::vector<int> values;
    const Texture& texture = back.textures.at(static_cast<std::size_t>(use.texture));
    for (std::size_t i = 0; i < texture.rgba.size(); i += 4)
      values.push_back(texture.rgba[i + static_cast<std::size_t>(use.channel)]);
    return values;
  };
  EXPECT_EQ(texels(back.materials[1].roughness_map), (std::vector<int>{200, 200}));
  EXPECT_EQ(texels(back.materials[1].metalness_map), (std::vector<int>{10, 40}));
  EXPECT_EQ(texels(back.materials[0].roughness_map), (std::vector<int>{255, 255}));
  EXPECT_EQ(texels(back.materials[0].metalness_map), (std::vector<int>{20, 50}));
}

TEST_F(ExportGltf, NamesWhatOtherProgramsDoNotKnow) {
  Scene scene = sample();
  scene.materials[1].lamp_group = "masts";
  scene.materials[0].detail.contrast = 0.2f;
  scene.materials[0].occlusion_map = {0, 0, 2};
  scene.materials[0].roughness_map = {0, 0, 1};
  scene.materials[0].metalness_map = {0, 1, 2};
  scene.meshes[0].colors[0][0] = 1.5f;
  const std::vector<std::string> lost = writeGltf(scene, pathOf("scene.glb"));
  EXPECT_EQ(lost.size(), 5u);
  for (const char* what : {"occlusion", "glow", "fractal detail", "metalness", "vertex colours"}) {
    EXPECT_TRUE(std::any_of(lost.begin(), lost.end(), [&](const std::string& line) {
      return line.find(what) != std::string::npos;
    })) << what;
  }
}

TEST_F(ExportGltf, GlassComesBackAsTransmission) {
  Scene scene = sample();
  scene.materials[1].metalness = 0.0f;
  scene.materials[1].glass = 0.75f;
  writeGltf(scene, pathOf("scene.glb"));
  std::ifstream stream(pathOf("scene.glb"), std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  EXPECT_NE(text.find("\"KHR_materials_transmission\":{\"transmissionFactor\":0.75}"), std::string::npos);
  const Scene back = load(pathOf("scene.glb"), {});
  EXPECT_EQ(back.materials[1].glass, 0.75f);
  EXPECT_EQ(back.materials[1].alpha_mode, AlphaMode::kOpaque);
}

TEST_F(ExportGltf, MaterialsComeBackInWhateverOrderMeshesUseThem) {
  Scene scene = sample();
  for (const float red : {0.125f, 0.25f, 0.5f}) {
    Material paint;
    paint.name = "paint";  // all alike
    paint.base_color = LinearRgb(red, 0.0f, 0.0f);
    scene.materials.push_back(paint);
  }
  scene.materials[4].base_texture = 0;
  const Mesh mesh = scene.meshes[0];
  scene.meshes.clear();
  for (const int material : {4, 1, 3, 0, 4}) {  // and one that none uses
    scene.meshes.push_back(mesh);
    scene.meshes.back().material = material;
  }
  writeGltf(scene, pathOf("scene.glb"));
  const Scene back = load(pathOf("scene.glb"), {});
  EXPECT_TRUE(back.warnings.empty()) << back.warnings[0];
  ASSERT_EQ(back.meshes.size(), scene.meshes.size());
  for (std::size_t i = 0; i < scene.meshes.size(); ++i) {
    const Material& a = scene.materials[static_cast<std::size_t>(scene.meshes[i].material)];
    const Material& b = back.materials[static_cast<std::size_t>(back.meshes[i].material)];
    EXPECT_EQ(a.name, b.name) << i;
    EXPECT_TRUE((a.base_color.value == b.base_color.value).all()) << i;
    EXPECT_EQ(a.base_texture == Material::kNoTexture, b.base_texture == Material::kNoTexture) << i;
  }
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
