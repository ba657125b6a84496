// Materials of OBJ files that say more than their format means.
#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "scene/color.h"
#include "unit/scene/measure.h"
#include "unit/scene/scene_files.h"

namespace sunlit::scene {
namespace {

class ObjLooks : public SceneFiles {
 protected:
  /// Of a triangle with a material of these lines.
  Scene lookOf(const std::string& lines) const {
    write("m.mtl", "newmtl m\nKd 1 1 1\n" + lines);
    return load(write("m.obj",
                      "mtllib m.mtl\nusemtl m\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nf 1/1 "
                      "2/2 3/3\n"),
                {});
  }
  /// The one warning of a material of these lines.
  void expectOneWarning(const std::string& lines, const std::string& words) const {
    const Scene scene = lookOf(lines);
    ASSERT_EQ(scene.warnings.size(), 1u) << lines;
    EXPECT_NE(scene.warnings[0].find(words), std::string::npos) << scene.warnings[0];
  }
  static const Material& materialOf(const Scene& scene) {
    return scene.materials.at(static_cast<std::size_t>(scene.meshes.at(0).material));
  }
  void paint(const std::string& name, const std::array<std::uint8_t, 3>& color) const {
    image::Rgba8Image picture(1, 1);
    picture.data = {color[0], color[1], color[2], 255};
    write(name, image::encodePng(picture));
  }
};

TEST_F(ObjLooks, EmissionIsBrighterThanAScreenWhereItSaysSo) {
  const Eigen::Array3f five = materialOf(lookOf("Ke 5 5 0\n")).emission.value;
  EXPECT_FLOAT_EQ(five[0], 5.0f * kDisplayWhite_cd_per_m2);
  EXPECT_EQ(five[2], 0.0f);
  EXPECT_FLOAT_EQ(materialOf(lookOf("Ke 1 1 1\n")).emission.value[1], kDisplayWhite_cd_per_m2);
}

TEST_F(ObjLooks, RoughnessAndMetalnessAreNumbersOrPictures) {
#ifdef SUNLIT_OLD_ASSIMP
  GTEST_SKIP() << "Assimp 5.0 does not know Pr and Pm";
#endif
  const Scene numbers = lookOf("Ks 1 1 1\nNs 900\nPr 0.4\nPm 0.75\n");
  EXPECT_TRUE(numbers.warnings.empty());
  EXPECT_FLOAT_EQ(materialOf(numbers).roughness, 0.4f);
  EXPECT_FLOAT_EQ(materialOf(numbers).metalness, 0.75f);
  EXPECT_EQ(materialOf(lookOf("Pr 0\nPm 7\n")).roughness, Material::kSmoothest);
  EXPECT_EQ(materialOf(lookOf("Pr 0\nPm 7\n")).metalness, 1.0f);
  EXPECT_EQ(materialOf(lookOf("")).metalness, 0.0f);
  EXPECT_EQ(materialOf(lookOf("Pr nan\n")).roughness, Material::kSmoothest);

  paint("rough.png", {90, 90, 90});
  paint("metal.png", {200, 200, 200});
  const Scene pictures = lookOf("Pr 0.4\nPm 0.1\nmap_Pr rough.png\nmap_Pm metal.png\n");
  EXPECT_TRUE(pictures.warnings.empty());
  const Material& look = materialOf(pictures);
  ASSERT_TRUE(look.roughness_map.given());
  ASSERT_TRUE(look.metalness_map.given());
  EXPECT_EQ(pictures.textures.at(static_cast<std::size_t>(look.roughness_map.texture)).rgba[0], 90);
  EXPECT_EQ(pictures.textures.at(static_cast<std::size_t>(look.metalness_map.texture)).rgba[0], 200);
  EXPECT_EQ(look.roughness, 1.0f);
  EXPECT_EQ(look.metalness, 1.0f);
}

// As MTL says, and OGRE does in Gazebo and RViz.
TEST_F(ObjLooks, NumbersMultiplyTheirPictures) {
  paint("t.png", {200, 100, 50});
  const auto colorOf = [&](const std::string& lines) {
    write("m.mtl", "newmtl m\n" + lines + "map_Kd t.png\nnewmtl other\nKd 0 1 0\n");
    return materialOf(load(write("m.obj",
                                 "mtllib m.mtl\nusemtl m\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\n"
                                 "vt 0 1\nf 1/1 2/2 3/3\n"),
                           {}))
        .base_color.value;
  };
  EXPECT_LT((colorOf("Kd 1 0.5 0\n") - Eigen::Array3f(1.0f, 0.21404f, 0.0f)).abs().maxCoeff(), 1e-5f);
  EXPECT_TRUE((colorOf("Ka 1 1 1\n") == 1.0f).all()) << "where there is none";
  EXPECT_TRUE((colorOf("\tKd 0 0 0\n") == 1.0f).all()) << "which would leave nothing of the picture";
  const auto glowOf = [&](const std::string& lines) {
    return Eigen::Array3f(materialOf(lookOf(lines)).emission.value / kDisplayWhite_cd_per_m2);
  };
  EXPECT_LT((glowOf("Ke 2 1 0\nmap_Ke t.png\n") - Eigen::Array3f(2.0f, 0.42808f, 0.0f)).abs().maxCoeff(),
            1e-5f)
      << "the brightest channel counts, the others by their share of it";
  EXPECT_TRUE((glowOf("Ke 0 0 0\nmap_Ke t.png\n") == 1.0f).all());
  EXPECT_TRUE((glowOf("Ke 1 1 1\nmap_Ke gone.png\n") == 0.0f).all()) << "not all over";
}

TEST_F(ObjLooks, ClearCoatsAreTheGlossOfPaint) {
#ifdef SUNLIT_OLD_ASSIMP
  GTEST_SKIP() << "Assimp 5.0 does not know Pc";
#endif
  const Scene scene = lookOf("Pr 0.75\nPc 1\nPcr 0.25\n");
  EXPECT_TRUE(scene.warnings.empty()) << scene.warnings[0];
  EXPECT_EQ(materialOf(scene).roughness, 0.25f);
}

TEST_F(ObjLooks, WithoutCoordinatesAreTheMeanOfTheirPicture) {
  image::Rgba8Image picture(2, 1);
  picture.data = {255, 0, 0, 255, 0, 255, 0, 255};
  write("t.png", image::encodePng(picture));
  write("m.mtl", "newmtl m\nKd 1 1 1\nmap_Kd t.png\n");
  const Scene scene =
      load(write("m.obj", "mtllib m.mtl\nusemtl m\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"), {});
  EXPECT_EQ(materialOf(scene).base_texture, Material::kNoTexture);
  EXPECT_TRUE((materialOf(scene).base_color.value == Eigen::Array3f(0.5f, 0.5f, 0.0f)).all());
  ASSERT_EQ(scene.warnings.size(), 1u);
  EXPECT_NE(scene.warnings[0].find("1 meshes have no texture coordinates"), std::string::npos)
      << scene.warnings[0];
}

TEST_F(ObjLooks, WhatMeansSomethingAndIsNotRenderedIsNamed) {
  paint("t.png", {200, 100, 50});
  paint("a.png", {100, 100, 50});
  const std::vector<std::pair<std::string, std::string>> lost = {
      {"illum 0\n", "illum 0"},
      {"illum 4\n", "illum 4, glass"},
      {"Ks 1 1 1\nillum 3\n", "illum 3, a mirror"},
      {"d 0.75\nNi 1.45\n", "what is behind is not bent"},
      {"Ni 1.39\n", "it mirrors by one of 1.5"},
      {"Ni 1.61\n", "it mirrors by one of 1.5"},
      {"Ni 2.4\n", "it mirrors by one of 1.5"},
      {"d 0.75\nTf 1 0.5 0.5\n", "Tf, "},
      {"map_Kd t.png\nmap_Ka a.png\n", "map_Ka"},
      {"map_Ka a.png\n", "map_Ka"},
#ifndef SUNLIT_OLD_ASSIMP
      {"Pc 0.25\n", "a clear coat"},
      {"Pc 1\nPm 1\n", "a clear coat"},
#endif
  };
  for (const auto& [lines, name] : lost) expectOneWarning(lines, name);
  // As exporters write of any material.
  for (const std::string lines :
       {"illum 2\nNi 1.45\nTf 1 1 1\n", "Ni 1.4\n", "Ni 1.6\n", "illum 1\nNi 1\nTf 0 0 0\nPc 0\nPs 0 0 0\n",
        "map_Kd t.png\nmap_Ka t.png\n", "d 0.75\nTf 1 1 1\nNi 1\n"})
    EXPECT_TRUE(lookOf(lines).warnings.empty()) << lookOf(lines).warnings[0];
}

TEST_F(ObjLooks, PicturesOfWhatIsMirroredAreNamed) {
  const Scene scene = lookOf("refl -type sphere sky.png\n");
  ASSERT_EQ(scene.warnings.size(), 1u);
  EXPECT_NE(scene.warnings[0].find("m of " + pathOf("m.mtl") + ": a picture of what it mirrors"),
            std::string::npos)
      << scene.warnings[0];
}

TEST_F(ObjLooks, OpacityIsTheShareThatIsThere) {
  EXPECT_EQ(materialOf(lookOf("d 1\n")).alpha_mode, AlphaMode::kOpaque);
  const Scene tinted = lookOf("d 0.75\n"), faint = lookOf("d 0.25\n");
  EXPECT_EQ(materialOf(tinted).alpha_mode, AlphaMode::kBlend);
  EXPECT_EQ(materialOf(tinted).alpha, 0.75f);
  EXPECT_TRUE(tinted.warnings.empty());
  EXPECT_EQ(materialOf(faint).alpha, 0.25f);
  ASSERT_EQ(faint.warnings.size(), 1u);
  EXPECT_NE(faint.warnings[0].find("their files mean opacity by it: m"), std::string::npos);
}

TEST_F(ObjLooks, OpacityMayBeAPictureOfItsOwn) {
  paint("leaf.png", {10, 200, 30});
  image::Rgba8Image mask(2, 1);
  mask.data = {255, 255, 255, 255, 0, 0, 0, 255};
  write("mask.png", image::encodePng(mask));
  const Scene leaf = lookOf("map_Kd leaf.png\nmap_d mask.png\n");
  ASSERT_EQ(leaf.textures.size(), 1u);
  EXPECT_EQ(materialOf(leaf).alpha_mode, AlphaMode::kMask);
  EXPECT_EQ(leaf.textures[0].rgba[1], 200);
  EXPECT_TRUE(leaf.warnings.empty());
  write("broken.png", "no picture");
  const Scene whole = lookOf("map_Kd leaf.png\nmap_d broken.png\n");
  EXPECT_EQ(whole.textures.at(0).rgba, (std::vector<std::uint8_t>{10, 200, 30, 255}));
  ASSERT_EQ(whole.warnings.size(), 1u);
  EXPECT_NE(whole.warnings[0].find("broken.png"), std::string::npos);
  const Scene shape = lookOf("map_d mask.png\n");
  EXPECT_EQ(materialOf(shape).alpha_mode, AlphaMode::kMask);
  EXPECT_EQ(materialOf(shape).base_color.value[0], 1.0f);
  EXPECT_EQ(shape.textures.at(0).rgba, (std::vector<std::uint8_t>{255, 255, 255, 255, 255, 255, 255, 0}));
  const Scene lost = lookOf("map_Kd leaf.png\nmap_d gone.png\n");
  EXPECT_EQ(materialOf(lost).alpha_mode, AlphaMode::kOpaque);
  ASSERT_EQ(lost.warnings.size(), 1u);
  EXPECT_NE(lost.warnings[0].find("gone.png"), std::string::npos);
}

TEST_F(ObjLooks, PicturesThatAreNoNormalsAreNamed) {
#ifdef SUNLIT_OLD_ASSIMP
  GTEST_SKIP() << "Assimp 5.0 does not know norm";
#endif
  paint("normal.png", {128, 100, 240});
  paint("brick.png", {180, 60, 40});
  EXPECT_TRUE(materialOf(lookOf("norm normal.png\n")).normal_map.given());
  for (const std::string lines : {"norm brick.png\n", "map_Kd normal.png\nnorm normal.png\n"}) {
    const Scene scene = lookOf(lines);
    EXPECT_FALSE(materialOf(scene).normal_map.given()) << lines;
    ASSERT_EQ(scene.warnings.size(), 1u) << lines;
    EXPECT_NE(scene.warnings[0].find("without it"), std::string::npos) << scene.warnings[0];
  }
}

// Objects of several makers in one file.
TEST_F(ObjLooks, VerticesWithoutAColourAreWhiteBesideOthers) {
  const Scene scene = load(write("w.obj",
                                 "o bare\nv 0 0 0\nv 1 0 0 # corner\nv 0 2 0 2\nf 1 2 3\n"
                                 "o red\nv 0 0 1 1 0 0\nv 1 0 1 1 0 0\nv 0 1 1 1 0 0\nf 4 5 6\n"
                                 "o last\nv 0 0 2\nv 1 0 2\nv 0 1 2\nf -3 -2 -1\n"),
                           {});
  ASSERT_EQ(scene.meshes.size(), 3u);
  for (const Mesh& mesh : scene.meshes) {
    const bool red = boundsOf(mesh).max().z() == 1.0f;
    ASSERT_EQ(mesh.colors.size(), 3u);
    for (const Eigen::Array3f& color : mesh.colors)
      EXPECT_TRUE((color == Eigen::Array3f(1.0f, red ? 0.0f : 1.0f, red ? 0.0f : 1.0f)).all())
          << color.transpose();
    EXPECT_EQ(boundsOf(mesh).max().head<2>(), Eigen::Vector2f(1, 1));
  }
}

// Assimp would give up the file for each of these words.
TEST_F(ObjLooks, WordsThatAssimpDoesNotKnowStopNothing) {
  const auto lossesOf = [&](const std::string& lines) {
    const Scene scene = lookOf(lines);
    EXPECT_EQ(scene.triangleCount(), 1u) << lines;
    return scene.warnings;
  };
  const std::vector<std::pair<std::string, std::string>> lost = {
      {"aniso 0.5\n", "aniso, a highlight"},        {"decal paint.png\n", "decal, a picture"},
      {"d -halo 0.8\n", "d -halo, an opacity"},     {"Kd spectral grass.rfl\n", "Kd by spectral"},
      {"Ks xyz 0.5 0.5 0.5\n", "Ks by xyz"},        {"Tf xyz 0.5\n", "Tf by xyz"},
      {"Tf spectral glass.rfl\n", "Tf by spectral"}};
  for (const auto& [lines, name] : lost) {
    const std::vector<std::string> warnings = lossesOf(lines);
    ASSERT_EQ(warnings.size(), 1u) << lines;
    EXPECT_NE(warnings[0].find("m of " + pathOf("m.mtl") + ": " + name), std::string::npos) << warnings[0];
  }
  EXPECT_EQ(materialOf(lookOf("d -halo 0.8\n")).alpha, 0.8f);
  for (const std::string nothing :
       {"aniso 0\nanisor 0.25\n", "Ka spectral grass.rfl\nKa xyz 1\n", "d -halo 1\n"})
    EXPECT_TRUE(lossesOf(nothing).empty()) << nothing;
}

TEST_F(ObjLooks, ALoneNumberOfAColourIsThatOfEachChannel) {
  const auto colorOf = [&](const std::string& color) {
    return Eigen::Array3f(materialOf(lookOf(color)).base_color.value);
  };
  for (const std::string lone : {"Kd 0.5\n", "Kd .5 # grey\n"})
    EXPECT_LT((colorOf(lone) - 0.21404f).abs().maxCoeff(), 1e-5f) << lone;
  EXPECT_TRUE((materialOf(lookOf("Ke 1\n")).emission.value == kDisplayWhite_cd_per_m2).all());
}

TEST_F(ObjLooks, WhatOptionsSayOfPicturesIsNamed) {
  paint("t.png", {200, 100, 50});
  paint("normal.png", {128, 100, 240});
  const std::vector<std::pair<std::string, std::string>> lost = {
      {"map_Kd -mm 0 0.5 t.png\n", "map_Kd -mm"},        {"map_Kd -mm 0.25 1 t.png\n", "map_Kd -mm"},
      {"map_Kd -imfchan r t.png\n", "map_Kd -imfchan"},  {"map_Tr t.png\n", "map_Tr, a picture"},
      {"map_opacity t.png\n", "map_opacity, a picture"}, {"map_Ps t.png\n", "map_Ps, a picture"},
      {"map_RMA t.png\n", "map_RMA, a picture"},         {"map_ORM t.png\n", "map_ORM, a picture"},
#ifndef SUNLIT_OLD_ASSIMP
      {"norm -bm 0.3 normal.png\n", "norm -bm"},
#endif
  };
  for (const auto& [lines, name] : lost) expectOneWarning(lines, "m of " + pathOf("m.mtl") + ": " + name);
  for (const std::string nothing : {"map_Kd -mm 0 1 t.png\n", "map_Kd -cc on t.png\n", "map_aat on\n"})
    EXPECT_TRUE(lookOf(nothing).warnings.empty()) << lookOf(nothing).warnings[0];
  EXPECT_EQ(lookOf("map_Kd -cc off -clamp on t.png\n").textures.size(), 1u);
}

// Assimp writes to the material before the first, which is none.
TEST_F(ObjLooks, AreRefusedWhereWordsStandBeforeTheFirstMaterial) {
  const std::string object = "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
  for (const std::string first : {"0 a", "mtllib a", "f a", " newmtl a", "# newmtl a"}) {
    write("m.mtl", first + "\nKd 1 0 0\nmap_Kd a.png\n");
    const std::string error = errorOf(write("m.obj", object));
    EXPECT_NE(error.find("m.obj: cannot read this mesh: "), std::string::npos) << error;
    EXPECT_NE(error.find("stands before the first newmtl"), std::string::npos) << error;
  }
}

TEST_F(ObjLooks, MaterialsThatAreNotThereAreNamed) {
  const std::string kind = "2 materials are not there, and neutral ones stand for them: ";
  const std::string object = "usemtl red\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nusemtl blue\nf 1 3 2\n";
  const std::string alone = write("w.obj", "mtllib gone.mtl\n" + object);
  const std::string missing = ", whose library is missing: gone.mtl";
  EXPECT_EQ(load(alone, {}).warnings, std::vector<std::string>{kind + "blue" + missing + "; red" + missing});
  write("m.mtl", "newmtl blue\nKd 0 0 1\n");
  const std::string file = write("m.obj", "mtllib m.mtl\n" + object);
  EXPECT_EQ(load(file, {}).warnings, std::vector<std::string>{"1" + kind.substr(1) + "red"});
  EXPECT_TRUE(load(write("n.obj", "usemtl None\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"), {}).warnings.empty())
      << "what Blender writes where there is none";
}

TEST_F(ObjLooks, WithoutAMaterialAreNeutralAndWhiteUnderColoursOfVertices) {
  const std::string faces = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
  const auto colorOf = [&](const std::string& text) {
    return materialOf(load(write("n.obj", text), {})).base_color.value;
  };
  for (const std::string lines : {"", "usemtl None\n", "mtllib gone.mtl\nusemtl gone\n"})
    EXPECT_TRUE((colorOf(lines + faces) == kNeutral.value).all()) << lines;
  EXPECT_TRUE((colorOf("v 0 0 0 1 1 1\nv 1 0 0 1 1 1\nv 0 1 0 1 1 1\nf 1 2 3\n") == 1.0f).all());
  write("m.mtl", "newmtl DefaultMaterial\nKd 0.6 0.6 0.6\n");
  const std::string named = "mtllib m.mtl\nusemtl DefaultMaterial\n";
  EXPECT_NEAR(colorOf(named + faces)[0], 0.31855f, 1e-4f) << "as other programs call one of their own";
}

// By its options Assimp may lose the name of the picture.
TEST_F(ObjLooks, TexturesAreFoundBehindTheirOptions) {
  paint("t.png", {200, 100, 50});
  for (const std::string options : {"-s 2 2", "-s 2 2 1 -o 0.25 0", "-o 0.5", "-clamp on -t 0 0 0"}) {
    const Scene scene = lookOf("map_Kd " + options + " t.png\n");
    EXPECT_NE(materialOf(scene).base_texture, Material::kNoTexture) << options;
    EXPECT_EQ(scene.warnings,
              std::vector<std::string>{"1 libraries of OBJ shift textures or repeat them by -o, -s or "
                                       "-t, which is not read: " +
                                       pathOf("m.mtl")});
  }
  EXPECT_TRUE(lookOf("map_Kd t.png\n").warnings.empty());
}

TEST_F(ObjLooks, CommentsMayStandBehindTextures) {
  paint("t.png", {200, 100, 50});
  for (const std::string lines : {"map_Kd t.png # my picture\n", "map_Kd t.png\t#mine\n"}) {
    const Scene scene = lookOf(lines);
    EXPECT_TRUE(scene.warnings.empty()) << scene.warnings[0];
    EXPECT_EQ(scene.textures.at(0).rgba[0], 200);
  }
  paint("t.png #2.png", {10, 20, 30});
  EXPECT_EQ(lookOf("map_Kd t.png #2.png\n").textures.at(0).rgba[0], 10) << "a file of the whole name";
  const Scene gone = lookOf("map_Kd gone.png # my picture\n");
  ASSERT_EQ(gone.warnings.size(), 1u);
  EXPECT_NE(gone.warnings[0].find("gone.png"), std::string::npos) << gone.warnings[0];
}

TEST_F(ObjLooks, TexturesMayStandBesideTheirLibrary) {
  paint("mats/t.png", {200, 100, 50});
  paint("mats/textures/u.png", {10, 20, 30});
  for (const std::string name : {"t.png", "u.png"}) {
    write("mats/m.mtl", "newmtl m\nmap_Kd " + name + "\n");
    const std::string object = "usemtl m\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nf 1/1 2/2 3/3\n";
    const Scene scene = load(write("m.obj", "mtllib mats/m.mtl\n" + object), {});
    EXPECT_TRUE(scene.warnings.empty()) << scene.warnings[0];
    EXPECT_NE(materialOf(scene).base_texture, Material::kNoTexture);
  }
  // What stands beside the object comes first.
  paint("u.png", {1, 2, 3});
  EXPECT_EQ(load(pathOf("m.obj"), {}).textures.at(0).rgba[0], 1);
}

TEST_F(ObjLooks, AMarkOfByteOrderIsNoVertex) {
  const Scene scene = load(write("b.obj", "\xEF\xBB\xBFv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"), {});
  EXPECT_EQ(scene.triangleCount(), 1u);
}

TEST_F(ObjLooks, DecimalCommasAreRefusedByTheirLine) {
  const std::string error = errorOf(write("c.obj", "# 1,5\nv 0 0 0 # a, b\nv 1,5 0 0\nv 0 1 0\nf 1 2 3\n"));
  EXPECT_NE(error.find("c.obj:3: 'v 1,5 0 0' has a comma"), std::string::npos) << error;
  const std::string of_windows = errorOf(write("c.obj", "v 0 0 0\r\nv 1,5 0 0\r\nv 0 1 0\r\nf 1 2 3\r\n"));
  EXPECT_NE(of_windows.find("c.obj:2: 'v 1,5 0 0' has a comma"), std::string::npos) << of_windows;
}

TEST_F(ObjLooks, OfNumbersThatAreNoneAreRefusedByTheNameOfTheFile) {
  write("m.mtl", "newmtl m\nKd 1 1 1\nKe nan 0 0\n");
  const std::string file = write("m.obj", "mtllib m.mtl\nusemtl m\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  EXPECT_EQ(errorOf(file), file + ": material 'm': emission is nan, but must be at least 0");
}

}  // namespace
}  // namespace sunlit::scene
