// What glTF files say of their surfaces.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <filesystem>

#include "support/base64.h"
#include "unit/scene/scene_files.h"

namespace sunlit::scene {
namespace {

class GltfMaterial : public SceneFiles {
 protected:
  /// A triangle in the plane of x and y with two sets of coordinates; `material` is the object of its
  /// material, `more` goes to the top.
  std::string file(const std::string& material, const std::string& more = "",
                   const std::string& attributes = "") const {
    std::string bytes;
    const auto add = [&](std::initializer_list<float> numbers) {
      for (const float number : numbers) bytes.append(reinterpret_cast<const char*>(&number), sizeof(number));
    };
    add({0, 0, 0, 1, 0, 0, 0, 1, 0});              // POSITION, 36 bytes
    add({0, 0, 1, 0, 0, 1});                       // TEXCOORD_0, 24
    add({0.5f, 0.5f, 0.75f, 0.5f, 0.5f, 1});       // TEXCOORD_1, 24
    add({0.5f, 0.5f, 0.5f, 1, 1, 1, 0, 0, 0});     // COLOR_0, 36
    add({1, 1, 1, 1, 1, 1, 1, 0.5f, 1, 1, 1, 0});  // another COLOR_0, with alpha, 48
    const auto accessor = [](int view, const char* type) {
      return "{\"bufferView\":" + std::to_string(view) + ",\"componentType\":5126,\"count\":3,\"type\":\"" +
             type + "\"";
    };
    return write(
        "t.gltf",
        "{\"asset\":{\"version\":\"2.0\"},\"scene\":0,\"scenes\":[{\"nodes\":[0]}],\"nodes\":[{\"mesh\":0}],"
        "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0,\"TEXCOORD_0\":1,\"TEXCOORD_1\":2" +
            attributes + "},\"material\":0}]}],\"materials\":[" + material +
            "],\"textures\":[{\"source\":0,\"sampler\":0},{\"source\":1}],"
            "\"samplers\":[{\"wrapS\":33071,\"wrapT\":33648},{\"magFilter\":9728}],"
            "\"images\":[{\"uri\":\"a.png\"},{\"uri\":\"b.png\"}]," +
            more + "\"accessors\":[" + accessor(0, "VEC3") + ",\"min\":[0,0,0],\"max\":[1,1,0]}," +
            accessor(1, "VEC2") + "}," + accessor(2, "VEC2") + "}," + accessor(3, "VEC3") + "}," +
            accessor(4, "VEC4") +
            "}],\"bufferViews\":[{\"buffer\":0,\"byteOffset\":0,\"byteLength\":36},"
            "{\"buffer\":0,\"byteOffset\":36,\"byteLength\":24},{\"buffer\":0,\"byteOffset\":60,"
            "\"byteLength\":24},{\"buffer\":0,\"byteOffset\":84,\"byteLength\":36},{\"buffer\":0,"
            "\"byteOffset\":120,\"byteLength\":48}],"
            "\"buffers\":[{\"byteLength\":168,\"uri\":\"data:application/octet-stream;base64," +
            base64(bytes) + "\"}]}");
  }
  Scene loaded(const std::string& material, const std::string& more = "",
               const std::string& attributes = "") const {
    writeTexture("a.png");
    writeTexture("b.png");
    return load(file(material, more, attributes), {});
  }
  static std::string warningsOf(const Scene& scene) {
    std::string text;
    for (const std::string& line : scene.warnings) text += line + "\n";
    return text;
  }
};

TEST_F(GltfMaterial, WhoseVerticesFadeIsNamedIfItAsksForAlpha) {
  const std::string warning = "alpha of vertex colours was left out";
  const auto warnings = [&](const std::string& mode) {
    return warningsOf(
        loaded("{\"alphaMode\":\"" + mode + "\",\"pbrMetallicRoughness\":{\"baseColorFactor\":[1,1,1,0.5]}}",
               "", ",\"COLOR_0\":4"));
  };
  EXPECT_NE(warnings("BLEND").find(warning), std::string::npos) << warnings("BLEND");
  // Also where nothing else says an alpha.
  for (const char* mode : {"BLEND", "MASK"}) {
    const Scene scene = loaded("{\"alphaMode\":\"" + std::string(mode) + "\"}", "", ",\"COLOR_0\":4");
    EXPECT_NE(warningsOf(scene).find(warning), std::string::npos) << mode << warningsOf(scene);
  }
  EXPECT_EQ(warnings("OPAQUE").find(warning), std::string::npos) << warnings("OPAQUE");
}

TEST_F(GltfMaterial, WhoseCutOutsDoNotRepeatIsNamed) {
  const auto warnings = [&](const std::string& texture) {
    return warningsOf(loaded(
        "{\"alphaMode\":\"MASK\",\"pbrMetallicRoughness\":{\"baseColorTexture\":{\"index\":" + texture +
        "}}}"));
  };
  EXPECT_NE(warnings("0").find("wrap mode of a texture that cuts out"), std::string::npos) << warnings("0");
  EXPECT_EQ(warnings("1").find("wrap mode of a texture that cuts out"), std::string::npos) << warnings("1");
}

TEST_F(GltfMaterial, OfSpecularAndGlossinessIsADielectricAndNamed) {
  const Scene scene = loaded(
      "{\"extensions\":{\"KHR_materials_pbrSpecularGlossiness\":{\"diffuseFactor\":[0.5,0.25,0.125,1],"
      "\"specularFactor\":[0.25,0.5,0.75],\"glossinessFactor\":0.75}}}");
  ASSERT_EQ(scene.warnings.size(), 1u);
  EXPECT_NE(scene.warnings[0].find("material 0: specular and glossiness"), std::string::npos)
      << scene.warnings[0];
  const Material& material = scene.materials[0];
  EXPECT_TRUE((material.base_color.value == Eigen::Array3f(0.5f, 0.25f, 0.125f)).all());
  EXPECT_TRUE((material.dielectric.value == Eigen::Array3f(0.25f, 0.5f, 0.75f)).all());
  EXPECT_EQ(material.roughness, 0.25f);
  EXPECT_EQ(material.metalness, 0.0f);
}

// Alpha is that of the diffuse colour and its texture.
TEST_F(GltfMaterial, OfSpecularAndGlossinessHasTheAlphaOfItsDiffuseColour) {
  const auto older = [&](const std::string& content, const std::string& mode) {
    return loaded("{\"alphaMode\":\"" + mode +
                      "\",\"extensions\":{\"KHR_materials_pbrSpecularGlossiness\":{" + content + "}}}",
                  "\"extensionsUsed\":[\"KHR_materials_pbrSpecularGlossiness\"],");
  };
  const Scene pane = older("\"diffuseFactor\":[1,1,1,0.25]", "BLEND");
  EXPECT_EQ(pane.materials[0].alpha_mode, AlphaMode::kBlend);
  EXPECT_EQ(pane.materials[0].alpha, 0.25f);
  const Scene leaf = older("\"diffuseFactor\":[1,1,1,0.5],\"diffuseTexture\":{\"index\":0}", "MASK");
  EXPECT_EQ(leaf.materials[0].alpha_mode, AlphaMode::kMask);
  EXPECT_EQ(leaf.materials[0].alpha_cutoff, 1.0f);  // 0.5 / 0.5
  EXPECT_NE(warningsOf(leaf).find("wrap mode of a texture that cuts out"), std::string::npos);
}

// Whose factors are 1 unless told, which alone would be a mirror.
TEST_F(GltfMaterial, OfATextureOfSpecularAndGlossinessIsNoMirror) {
  const Scene scene = loaded(
      "{\"extensions\":{\"KHR_materials_pbrSpecularGlossiness\":{\"specularGlossinessTexture\":{\"index\":0}}"
      "}}");
  EXPECT_NEAR(scene.materials[0].dielectric.value.maxCoeff(), 0.04f, 1e-6f);
  EXPECT_EQ(scene.materials[0].roughness, 0.5f);
  EXPECT_NE(warningsOf(scene).find("as if their own texture were 0.04 and one half"), std::string::npos);
}

std::string throughJson(const std::string& diffuse, const std::string& more = "") {
  return "{\"pbrMetallicRoughness\":{\"baseColorFactor\":[0.5,0.25,0.125,1],\"metallicFactor\":0,"
         "\"roughnessFactor\":0},\"extensions\":{\"KHR_materials_diffuse_transmission\":{" +
         diffuse + "}" + more + "}}";
}

TEST_F(GltfMaterial, WhoseLightComesOutInAnotherColourIsNamed) {
  const std::string lost = "a colour of its diffuse transmission";
  const std::string same =
      "\"diffuseTransmissionFactor\":0.5,\"diffuseTransmissionColorFactor\":[0.5,0.25,0.125]";
  EXPECT_EQ(warningsOf(loaded(throughJson(same))), "");
  EXPECT_EQ(warningsOf(loaded(throughJson(""))), "");  // by no share
  const std::string white = warningsOf(loaded(throughJson("\"diffuseTransmissionFactor\":0.5")));
  EXPECT_NE(white.find(lost), std::string::npos) << white;
  const std::string picture =
      warningsOf(loaded(throughJson(same + ",\"diffuseTransmissionColorTexture\":{\"index\":1}")));
  EXPECT_NE(picture.find(lost), std::string::npos) << picture;
}

// Of what transmission leaves, diffuse transmission has its share: of 0.8 here 0.1, of 0.2 then 0.4.
TEST_F(GltfMaterial, OfBothTransmissionsHasTheLargerAndNamesTheOther) {
  const auto both = [&](const std::string& clear) {
    return loaded(
        throughJson("\"diffuseTransmissionFactor\":0.5,\"diffuseTransmissionColorFactor\":[0.5,0.25,0.125]",
                    ",\"KHR_materials_transmission\":{\"transmissionFactor\":" + clear + "}"));
  };
  const Scene glass = both("0.8"), leaf = both("0.2");
  EXPECT_EQ(glass.materials[0].glass, 0.8f);
  EXPECT_EQ(glass.materials[0].transmission, 0.0f);
  EXPECT_NE(warningsOf(glass).find("diffuse transmission beside transmission: without it"),
            std::string::npos);
  EXPECT_EQ(leaf.materials[0].glass, 0.0f);
  EXPECT_EQ(leaf.materials[0].transmission, 0.5f);
  EXPECT_NE(warningsOf(leaf).find("transmission beside diffuse transmission"), std::string::npos);
}

TEST_F(GltfMaterial, OfAVolumeHasTheColourOfItsDepth) {
  const auto bottle = [&](const std::string& volume, const char* sides) {
    return loaded("{\"pbrMetallicRoughness\":{\"metallicFactor\":0,\"roughnessFactor\":0},\"doubleSided\":" +
                  std::string(sides) +
                  ",\"extensions\":{\"KHR_materials_transmission\":{\"transmissionFactor\":1},"
                  "\"KHR_materials_volume\":{" +
                  volume + "}}}");
  };
  const std::string green = "\"attenuationDistance\":0.5,\"attenuationColor\":[0.25,1,0.25]";
  // Twice that distance, once by each of two walls, whatever its sides.
  for (const char* sides : {"false", "true"}) {
    const Scene body = bottle("\"thicknessFactor\":1," + green, sides);
    EXPECT_TRUE(body.materials[0].double_sided);
    EXPECT_NEAR(body.materials[0].base_color.value[0], 0.25f, 1e-6f);
    EXPECT_EQ(body.materials[0].base_color.value[1], 1.0f);
    EXPECT_NE(warningsOf(body).find("a volume: as if it were hollow"), std::string::npos);
  }
  // A thin wall has no depth, and nothing is lost.
  const Scene thin = bottle(green, "false");
  EXPECT_EQ(thin.materials[0].base_color.value[0], 1.0f);
  EXPECT_FALSE(thin.materials[0].double_sided);
  EXPECT_EQ(warningsOf(thin), "");
  EXPECT_EQ(bottle("\"thicknessFactor\":1", "false").materials[0].base_color.value[0], 1.0f);
}

// The texture is 4 × 4 px; of a square of 16, all but its borders have its colour.
TEST_F(GltfMaterial, TexelsWithHardEdgesAreSquares) {
  writeTexture("a.png", 1);
  std::string text = contentOf(file("{\"pbrMetallicRoughness\":{\"baseColorTexture\":{\"index\":0}}}"));
  const std::string usual = "\"sampler\":0";
  text.replace(text.find(usual), usual.size(), "\"sampler\":1");
  const Scene scene = load(write("hard.gltf", text), {});
  EXPECT_EQ(warningsOf(scene), "");
  ASSERT_EQ(scene.textures.size(), 1u);
  const Texture& texture = scene.textures[0];
  ASSERT_EQ(texture.width, 64);
  ASSERT_EQ(texture.height, 64);
  for (const int x : {0, 15, 16, 63})
    EXPECT_EQ(texture.rgba[4 * static_cast<std::size_t>(x) + 3], x < 16 ? 0 : 255);
}

TEST_F(GltfMaterial, PicturesOfOtherFormatsAreNamed) {
  std::string text = contentOf(file("{\"pbrMetallicRoughness\":{\"baseColorTexture\":{\"index\":1}}}",
                                    "\"extensionsUsed\":[\"KHR_texture_basisu\"],"
                                    "\"extensionsRequired\":[\"KHR_texture_basisu\"],"));
  write("b.png", std::string("\xABKTX 20\xBB\r\n\x1A\n", 12) + std::string(80, '\0'));
  const std::string plain = "{\"source\":1}";
  text.replace(text.find(plain), plain.size(), "{\"extensions\":{\"KHR_texture_basisu\":{\"source\":1}}}");
  const Scene scene = load(write("ktx.gltf", text), {});
  const std::string warnings = warningsOf(scene);
  EXPECT_EQ(scene.warnings.size(), 1u) << warnings;
  EXPECT_NE(warnings.find(pathOf("b.png") + ": this is a KTX2 picture"), std::string::npos) << warnings;
}

TEST_F(GltfMaterial, AllItsTexturesAreFound) {
  const Scene scene = loaded(
      "{\"pbrMetallicRoughness\":{\"baseColorTexture\":{\"index\":0},"
      "\"metallicRoughnessTexture\":{\"index\":1,\"texCoord\":1}},"
      "\"normalTexture\":{\"index\":1,\"scale\":0.5},\"occlusionTexture\":{\"index\":1,\"strength\":0.25,"
      "\"texCoord\":1},\"emissiveFactor\":[1,0.5,0],\"emissiveTexture\":{\"index\":0}}");
  ASSERT_EQ(scene.materials.size(), 1u);
  EXPECT_EQ(warningsOf(scene), "");
  const Material& m = scene.materials[0];
  EXPECT_EQ(scene.textures.size(), 2u);
  EXPECT_EQ(m.base_texture, 0);
  EXPECT_EQ(m.emission_map.texture, 0);
  EXPECT_EQ(m.roughness_map.texture, 1);
  EXPECT_EQ(m.roughness_map.channel, 1);
  EXPECT_EQ(m.metalness_map.channel, 2);
  EXPECT_EQ(m.roughness_map.coordinates, 1);
  EXPECT_EQ(m.occlusion_map.coordinates, 1);
  EXPECT_EQ(m.normal_map.coordinates, 0);
  EXPECT_EQ(m.normal_scale, 0.5f);
  EXPECT_EQ(m.occlusion_strength, 0.25f);
  EXPECT_EQ(m.roughness, 1.0f);
  EXPECT_EQ(m.metalness, 1.0f);
  ASSERT_EQ(scene.meshes[0].more_texture_coordinates.size(), 1u);
  EXPECT_EQ(scene.textures[0].wrap_u, Wrap::kClamp);
  EXPECT_EQ(scene.textures[0].wrap_v, Wrap::kMirror);
  EXPECT_EQ(scene.textures[1].wrap_u, Wrap::kRepeat);
}

TEST_F(GltfMaterial, TexturesAreMovedAsTheExtensionSays) {
  // The first example of KHR_texture_transform: the lower left quarter, turned.
  const Scene scene = loaded(
      "{\"pbrMetallicRoughness\":{\"baseColorTexture\":{\"index\":0,\"extensions\":{\"KHR_texture_"
      "transform\":"
      "{\"offset\":[0,1],\"rotation\":1.57079632679,\"scale\":[0.5,0.5]}}}}}",
      "\"extensionsUsed\":[\"KHR_texture_transform\"],");
  EXPECT_EQ(warningsOf(scene), "");
  const Mesh& mesh = scene.meshes[0];
  for (std::size_t i = 0; i < 3; ++i) {
    const Eigen::Vector2f& c = mesh.texture_coordinates[i];
    // glTF's x, y, z are x, z, −y here; u = x and v = y of the corners.
    const float u = mesh.positions[i].x(), v = mesh.positions[i].z();
    EXPECT_LT((c - Eigen::Vector2f(0.5f * v, 1.0f - 0.5f * u)).norm(), 1e-6f);
    EXPECT_TRUE(c.x() >= -1e-6f && c.x() <= 0.5f + 1e-6f && c.y() >= 0.5f - 1e-6f && c.y() <= 1.0f + 1e-6f);
  }
}

TEST_F(GltfMaterial, AlphaIsAsWritten) {
  const std::string quarter = "\"pbrMetallicRoughness\":{\"baseColorFactor\":[1,1,1,0.25]";
  const Scene opaque = loaded("{" + quarter + "}}");
  EXPECT_EQ(opaque.triangleCount(), 1u);
  EXPECT_EQ(opaque.materials[0].alpha_mode, AlphaMode::kOpaque);
  const Scene blend = loaded("{" + quarter + "},\"alphaMode\":\"BLEND\"}");
  EXPECT_EQ(blend.materials[0].alpha_mode, AlphaMode::kBlend);
  EXPECT_EQ(blend.materials[0].alpha, 0.25f);
  EXPECT_EQ(warningsOf(blend), "");
  // Of a cut-out, the factor multiplies the texture: half the cutoff over a quarter.
  const Scene mask = loaded(
      "{\"pbrMetallicRoughness\":{\"baseColorFactor\":[1,1,1,0.5],"
      "\"baseColorTexture\":{\"index\":0}},\"alphaMode\":\"MASK\",\"alphaCutoff\":0.25}");
  EXPECT_EQ(mask.materials[0].alpha_mode, AlphaMode::kMask);
  EXPECT_EQ(mask.materials[0].alpha_cutoff, 0.5f);
  // Nothing is left of a cut-out whose factor alone is below its cutoff.
  const std::string gone = file("{" + quarter + "},\"alphaMode\":\"MASK\"}");
  EXPECT_EQ(errorOf(gone), gone +
                               ": there is not a triangle in this file that could be drawn; 1 materials are "
                               "invisible by their alpha, and left out: material 0");
}

TEST_F(GltfMaterial, EmissionHasItsStrength) {
  const Scene scene = loaded(
      "{\"emissiveFactor\":[1,0.5,0],\"extensions\":{\"KHR_materials_emissive_strength\":"
      "{\"emissiveStrength\":400}}}",
      "\"extensionsUsed\":[\"KHR_materials_emissive_strength\"],");
  EXPECT_EQ(warningsOf(scene), "");
  EXPECT_FLOAT_EQ(scene.materials[0].emission.value[0], 400.0f);
  EXPECT_FLOAT_EQ(scene.materials[0].emission.value[1], 200.0f);
}

TEST_F(GltfMaterial, IndexAndSpecularSetWhatADielectricReflects) {
  const Scene water = loaded("{\"extensions\":{\"KHR_materials_ior\":{\"ior\":1.33}}}");
  EXPECT_NEAR(water.materials[0].dielectric.value[1], 0.02006f, 1e-5f);  // (0.33 / 2.33)²
  EXPECT_EQ(water.materials[0].dielectric_grazing, 1.0f);
  const Scene dull = loaded(
      "{\"extensions\":{\"KHR_materials_specular\":{\"specularFactor\":0.5,\"specularColorFactor\":[1,2,0]}}"
      "}");
  EXPECT_NEAR(dull.materials[0].dielectric.value[0], 0.02f, 1e-6f);
  EXPECT_NEAR(dull.materials[0].dielectric.value[1], 0.04f, 1e-6f);
  EXPECT_EQ(dull.materials[0].dielectric.value[2], 0.0f);
  EXPECT_EQ(dull.materials[0].dielectric_grazing, 0.5f);
}

// Paint and plastics have no gloss beneath a coat of the same index, metal has its own.
TEST_F(GltfMaterial, ClearCoatsAreTheGlossOfWhatMirrorsLess) {
  const auto coated = [&](const std::string& base, const std::string& coat, const std::string& more = "") {
    return loaded("{\"pbrMetallicRoughness\":{" + base + "},\"extensions\":{\"KHR_materials_clearcoat\":{" +
                  coat + "}" + more + "}}");
  };
  const std::string paint = "\"metallicFactor\":0,\"roughnessFactor\":0.75";
  const Scene lacquer = coated(paint, "\"clearcoatFactor\":1,\"clearcoatRoughnessFactor\":0.125");
  EXPECT_EQ(warningsOf(lacquer), "");
  EXPECT_EQ(lacquer.materials[0].roughness, 0.125f);
  EXPECT_EQ(lacquer.materials[0].dielectric.value[0], 0.04f);
  EXPECT_EQ(coated(paint, "\"clearcoatFactor\":1").materials[0].roughness, Material::kSmoothest);
  EXPECT_EQ(coated(paint, "").materials[0].roughness, 0.75f);
  // Its maps are those of what it covers.
  const Scene mapped = coated(paint + ",\"metallicRoughnessTexture\":{\"index\":1}", "\"clearcoatFactor\":1");
  EXPECT_FALSE(mapped.materials[0].roughness_map.given());
  // The gloss of the coat alone.
  const Scene matt =
      coated(paint, "\"clearcoatFactor\":0.75", ",\"KHR_materials_specular\":{\"specularFactor\":0}");
  EXPECT_EQ(warningsOf(matt), "");
  EXPECT_FLOAT_EQ(matt.materials[0].dielectric.value[1], 0.03f);
  EXPECT_EQ(matt.materials[0].dielectric_grazing, 0.75f);

  const auto expectNone = [&](const Scene& scene) {
    EXPECT_NE(warningsOf(scene).find("a clear coat that mirrors less than what it covers: without it"),
              std::string::npos)
        << warningsOf(scene);
    EXPECT_EQ(scene.materials[0].roughness, 0.75f);
  };
  expectNone(coated(paint, "\"clearcoatFactor\":0.375"));
  const std::string metal = "\"metallicFactor\":1,\"roughnessFactor\":0.75,\"baseColorFactor\":";
  expectNone(coated(metal + "[0.5,0.5,0.5,1]", "\"clearcoatFactor\":1"));
  const Scene black = coated(metal + "[0.02,0.02,0.02,1]", "\"clearcoatFactor\":1");
  EXPECT_EQ(warningsOf(black), "");
  EXPECT_EQ(black.materials[0].metalness, 0.0f);
  EXPECT_EQ(black.materials[0].roughness, Material::kSmoothest);
}

TEST_F(GltfMaterial, WhatAClearCoatLosesIsNamed) {
  const auto warnings = [&](const std::string& coat, const std::string& normals = "") {
    return warningsOf(loaded("{\"pbrMetallicRoughness\":{\"metallicFactor\":0}," + normals +
                             "\"extensions\":{\"KHR_materials_clearcoat\":{\"clearcoatFactor\":1" + coat +
                             "}}}"));
  };
  const std::string normals = "\"normalTexture\":{\"index\":1},", texture = "a texture of its clear coat",
                    bumps = "normals of its clear coat: those of what it covers";
  EXPECT_NE(warnings(",\"clearcoatTexture\":{\"index\":0}").find(texture), std::string::npos);
  EXPECT_NE(warnings(",\"clearcoatRoughnessTexture\":{\"index\":0}").find(texture), std::string::npos);
  EXPECT_NE(warnings("", normals).find(bumps), std::string::npos) << warnings("", normals);
  EXPECT_NE(warnings(",\"clearcoatNormalTexture\":{\"index\":1}").find(bumps), std::string::npos);
  EXPECT_EQ(warnings(",\"clearcoatNormalTexture\":{\"index\":1}", normals).find(bumps), std::string::npos);
}

TEST_F(GltfMaterial, WhatIsNotRenderedIsNamedInOneLine) {
  const Scene scene = loaded(
      "{\"name\":\"lacquer\",\"extensions\":{\"KHR_materials_clearcoat\":{\"clearcoatFactor\":1},"
      "\"KHR_materials_sheen\":{\"sheenColorFactor\":[0,0.5,0]},\"KHR_materials_iridescence\":{},"
      "\"KHR_materials_anisotropy\":{\"anisotropyStrength\":0},\"KHR_materials_unlit\":{}}}",
      "\"extensionsUsed\":[\"KHR_materials_clearcoat\",\"EXT_something\"],");
  const std::string warnings = warningsOf(scene);
  EXPECT_EQ(scene.warnings.size(), 2u) << warnings;
  for (const char* part :
       {"3 features of materials are not rendered", "lacquer: a clear coat that mirrors less",
        "sheen: without it", "unlit: lit as matt paint", "EXT_something"})
    EXPECT_NE(warnings.find(part), std::string::npos) << part << " in " << warnings;
}

// Also of the one family of extensions that all others here are of.
TEST_F(GltfMaterial, ExtensionsOfMaterialsThatNobodyKnowsAreNamedOnce) {
  const Scene scene =
      loaded("{\"name\":\"wax\",\"extensions\":{\"KHR_materials_of_mine\":{\"depth\":1},\"VENDOR_toon\":{}}}",
             "\"extensionsUsed\":[\"KHR_materials_of_mine\"],");
  const std::string warnings = warningsOf(scene);
  EXPECT_EQ(warnings,
            "2 features of materials are not rendered: wax: KHR_materials_of_mine: without it; "
            "wax: VENDOR_toon: without it\n");
}

TEST_F(GltfMaterial, PicturesOfWebpStandBeforeOthers) {
  writeTexture("b.png");
  const std::string whole = file("{\"pbrMetallicRoughness\":{\"baseColorTexture\":{\"index\":1}}}",
                                 "\"extensionsRequired\":[\"EXT_texture_webp\"],");
  for (const char* other : {"\"source\":7,", ""}) {
    std::string text = contentOf(whole);
    const std::string plain = "{\"source\":1}";
    text.replace(text.find(plain), plain.size(),
                 std::string("{") + other + "\"extensions\":{\"EXT_texture_webp\":{\"source\":1}}}");
    const Scene scene = load(write("webp.gltf", text), {});
    EXPECT_TRUE(scene.warnings.empty()) << warningsOf(scene);
    ASSERT_EQ(scene.textures.size(), 1u);
    EXPECT_EQ(scene.textures[0].name, pathOf("b.png"));
  }
}

TEST_F(GltfMaterial, AMissingMetallicTextureMakesNoMetal) {
  const Scene scene =
      load(file("{\"pbrMetallicRoughness\":{\"metallicRoughnessTexture\":{\"index\":0}}}"), {});
  EXPECT_EQ(scene.materials[0].metalness, 0.0f);
  EXPECT_NE(warningsOf(scene).find("a.png"), std::string::npos) << warningsOf(scene);
}

TEST_F(GltfMaterial, AMereNameIsNoTextureOfAFolderAboveTheScene) {
  writeTexture("a.png");
  const std::string below = pathOf("below");
  std::filesystem::create_directory(below);
  const std::string inside = below + "/t.gltf";
  std::filesystem::copy_file(file("{\"pbrMetallicRoughness\":{\"baseColorTexture\":{\"index\":0}}}"), inside);
  EXPECT_NE(warningsOf(load(inside, {})).find("a.png"), std::string::npos);
  SearchPath named;
  named.folders = {below + "/.."};
  EXPECT_EQ(warningsOf(load(inside, named)), "");
}

TEST_F(GltfMaterial, VertexColoursAreLinear) {
  const Scene scene = loaded("{}", "", ",\"COLOR_0\":3");
  const auto& colors = scene.meshes[0].colors;
  ASSERT_EQ(colors.size(), 3u);
  EXPECT_TRUE(std::any_of(colors.begin(), colors.end(),
                          [](const Eigen::Array3f& c) { return (c - 0.5f).abs().maxCoeff() < 1e-6f; }));
}

TEST_F(GltfMaterial, WhoseNameIsNoTextIsRefusedByTheNameOfItsFile) {
  const std::string error = errorOf(file("{\"name\":{}}"));
  EXPECT_EQ(error.find(pathOf("t.gltf") + ": "), 0u) << error;
}

}  // namespace
}  // namespace sunlit::scene
