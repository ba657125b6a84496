// COLLADA, glTF and OBJ files: size, orientation, textures, and what is done about broken ones.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <string>
#include <utility>

#include "scene/scene_builder.h"
#include "support/utf16.h"
#include "unit/scene/measure.h"
#include "unit/scene/scene_files.h"

namespace sunlit::scene {
namespace {

/// A triangle whose corners are 1, 2 and 3 units along x, y and z, in a COLLADA file.
std::string collada(const std::string& asset, const std::string& image = "",
                    const std::string& positions = "1 0 0 0 2 0 0 0 3") {
  const std::string texture =
      image.empty() ? "<color>1 0 0 1</color>" : "<texture texture='picture-sampler' texcoord='uv'/>";
  const std::string parameters =
      image.empty()
          ? ""
          : "<newparam sid='picture-surface'><surface "
            "type='2D'><init_from>picture</init_from></surface></newparam>"
            "<newparam "
            "sid='picture-sampler'><sampler2D><source>picture-surface</source></sampler2D></newparam>";
  const std::string images = image.empty()
                                 ? ""
                                 : "<library_images><image id='picture' name='picture'><init_from>" + image +
                                       "</init_from></image></library_images>";
  return "<?xml version='1.0'?><COLLADA xmlns='http://www.collada.org/2005/11/COLLADASchema' "
         "version='1.4.1'><asset>" +
         asset + "</asset>" + images + "<library_effects><effect id='paint-fx'><profile_COMMON>" +
         parameters + "<technique sid='common'><lambert><diffuse>" + texture +
         "</diffuse></lambert></technique></profile_COMMON></effect></library_effects>"
         "<library_materials><material id='paint' name='paint'><instance_effect url='#paint-fx'/></material>"
         "</library_materials><library_geometries><geometry id='g' name='g'><mesh>"
         "<source id='p'><float_array id='pa' count='9'>" +
         positions +
         "</float_array><technique_common><accessor source='#pa' count='3' stride='3'><param name='X' "
         "type='float'/>"
         "<param name='Y' type='float'/><param name='Z' type='float'/></accessor></technique_common></source>"
         "<source id='t'><float_array id='ta' count='6'>0 0 1 0 0.25 0.75</float_array><technique_common>"
         "<accessor source='#ta' count='3' stride='2'><param name='S' type='float'/><param name='T' "
         "type='float'/>"
         "</accessor></technique_common></source>"
         "<vertices id='v'><input semantic='POSITION' source='#p'/></vertices>"
         "<triangles material='m' count='1'><input semantic='VERTEX' source='#v' offset='0'/>"
         "<input semantic='TEXCOORD' source='#t' offset='1' set='0'/><p>0 0 1 1 2 "
         "2</p></triangles></mesh></geometry>"
         "</library_geometries><library_visual_scenes><visual_scene id='s'><node id='n' name='n'>"
         "<instance_geometry url='#g'><bind_material><technique_common><instance_material symbol='m' "
         "target='#paint'>"
         "<bind_vertex_input semantic='uv' input_semantic='TEXCOORD' input_set='0'/></instance_material>"
         "</technique_common></bind_material></instance_geometry></node></visual_scene></"
         "library_visual_scenes>"
         "<scene><instance_visual_scene url='#s'/></scene></COLLADA>";
}

/// The same where alpha of its picture is to be seen.
std::string seenThrough(std::string collada) {
  const std::string end = "</diffuse>";
  return collada.insert(
      collada.find(end) + end.size(),
      "<transparent opaque='A_ONE'><texture texture='picture-sampler' texcoord='uv'/></transparent>");
}

const std::string kCentimetresZUp = "<unit meter='0.01' name='centimeter'/><up_axis>Z_UP</up_axis>";

/// A PNG of one colour.
std::string evenPicture(std::uint8_t red_and_green, std::uint8_t blue) {
  image::Rgba8Image picture(4, 4);
  for (int y = 0; y < 4; ++y) {
    for (int x = 0; x < 4; ++x) {
      std::uint8_t* texel = picture.at(x, y);
      texel[0] = texel[1] = red_and_green;
      texel[2] = blue;
      texel[3] = 255;
    }
  }
  return image::encodePng(picture);
}

class MeshFile : public SceneFiles {
 protected:
  void expectOneWarning(const Scene& scene, const std::string& part) {
    ASSERT_EQ(scene.warnings.size(), 1u);
    EXPECT_NE(scene.warnings[0].find(part), std::string::npos) << scene.warnings[0];
  }
};

TEST_F(MeshFile, ColladaUnitsAndUpAxisAreHonoured) {
  const Scene z_up = load(write("z.dae", collada(kCentimetresZUp)), {});
  // 1, 2 and 3 cm along x, y and z; 1e-7 is float rounding of 0.03.
  EXPECT_LT((boundsOf(z_up).max() - Eigen::Vector3f(0.01f, 0.02f, 0.03f)).norm(), 1e-7f);
  EXPECT_TRUE(z_up.warnings.empty());

  const Scene y_up = load(write("y.dae", collada("<unit meter='1'/><up_axis>Y_UP</up_axis>")), {});
  // y up: 2 m along y is height, 3 m along z points to the south.
  EXPECT_LT((boundsOf(y_up).max() - Eigen::Vector3f(1.0f, 0.0f, 2.0f)).norm(), 1e-6f);
  EXPECT_LT((boundsOf(y_up).min() - Eigen::Vector3f(0.0f, -3.0f, 0.0f)).norm(), 1e-6f);
}

TEST_F(MeshFile, TextureCoordinatesStartAtTheTopLeft) {
  writeTexture("paint.png");
  const Scene scene = load(write("t.dae", collada(kCentimetresZUp, "paint.png")), {});
  ASSERT_EQ(scene.meshes.size(), 1u);
  // COLLADA's t runs upwards: the corner with s, t = 0.25, 0.75 is a quarter from the left and from the top.
  const Mesh& mesh = scene.meshes[0];
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    if (mesh.positions[i].z() > 0.02f) {
      EXPECT_LT((mesh.texture_coordinates[i] - Eigen::Vector2f(0.25f, 0.25f)).norm(), 1e-6f);
    }
  }
  EXPECT_EQ(scene.materials[0].base_color.value[0], 1.0f);  // the texture alone is the colour
  EXPECT_EQ(scene.textures[0].rgba[0], 200);
  EXPECT_EQ(scene.textures[0].rgba[2], 50);
}

TEST_F(MeshFile, ColoursAreTakenForDisplayValues) {
  const Scene scene = load(write("c.dae", collada(kCentimetresZUp)), {});
  EXPECT_EQ(scene.materials[0].name, "paint");
  EXPECT_NEAR(scene.materials[0].base_color.value[0], 1.0f, 1e-6f);
  EXPECT_EQ(scene.materials[0].base_color.value[1], 0.0f);
  EXPECT_EQ(scene.materials[0].base_texture, Material::kNoTexture);
}

TEST_F(MeshFile, ShiftedTexturesOfColladaAreNamed) {
  writeTexture("paint.png");
  const auto loaded = [&](const std::string& repeats) {
    std::string text = collada(kCentimetresZUp, "paint.png");
    const std::string use = "texcoord='uv'/>";
    text.replace(text.find(use), use.size(),
                 "texcoord='uv'><extra><technique profile='MAYA'><wrapU>1</wrapU><repeatU>" + repeats +
                     "</repeatU></technique></extra></texture>");
    return load(write("t.dae", text), {});
  };
  EXPECT_TRUE(loaded("1").warnings.empty());
  expectOneWarning(loaded("4"), "paint: textures that are shifted, turned or repeated");
}

TEST_F(MeshFile, ColladaShinesOnlyWhereItSaysSo) {
  const auto roughnessOf = [&](const std::string& shading, const std::string& highlight) {
    std::string text = collada(kCentimetresZUp);
    for (const std::string mark : {"<lambert>", "</lambert>"}) {
      const bool end = mark[1] == '/';
      text.replace(text.find(mark), mark.size(),
                   end ? highlight + "</" + shading + ">" : "<" + shading + ">");
    }
    return load(write("h.dae", text), {}).materials.at(0).roughness;
  };
  const std::string highlight =
      "<specular><color>0.2 0.2 0.2 1</color></specular><shininess><float>50</float></shininess>";
  // What these two have no element for does not count.
  for (const char* shading : {"lambert", "constant"}) {
    EXPECT_EQ(roughnessOf(shading, ""), 0.9f) << shading;
    EXPECT_EQ(roughnessOf(shading, highlight), 0.9f) << shading;
  }
  for (const char* shading : {"phong", "blinn"}) {
    EXPECT_EQ(roughnessOf(shading, ""), 0.9f) << shading;
    EXPECT_LT(roughnessOf(shading, highlight), 0.5f) << shading;
  }
}

TEST_F(MeshFile, TexturesAreLookedForInTheUsualPlaces) {
  const std::string mesh = write("model/meshes/t.dae", collada(kCentimetresZUp, "C:\\artist\\paint.png"));
  writeTexture("model/materials/textures/paint.png");
  EXPECT_TRUE(load(mesh, {}).warnings.empty());
}

TEST_F(MeshFile, TexturesAreFoundInTheSearchPath) {
  const std::string mesh = write("t.dae", collada(kCentimetresZUp, "pictures/paint.png"));
  writeTexture("elsewhere/pictures/paint.png");
  EXPECT_EQ(load(mesh, {}).warnings.size(), 1u);
  EXPECT_TRUE(load(mesh, SearchPath{{pathOf("elsewhere")}}).warnings.empty());
}

TEST_F(MeshFile, ATextureInOtherCaseIsFoundWithAWarning) {
  writeTexture("PAINT.png");
  const Scene scene = load(write("t.dae", collada(kCentimetresZUp, "paint.png")), {});
  expectOneWarning(scene, "paint.png is " + pathOf("PAINT.png"));
  EXPECT_EQ(scene.textures.size(), 1u);
}

TEST_F(MeshFile, AMissingTextureIsANamedWarningAndANeutralMaterial) {
  const Scene scene = load(write("t.dae", collada(kCentimetresZUp, "gone.png")), {});
  expectOneWarning(scene, "1 textures are missing, neutral ones take their place: gone.png");
  EXPECT_TRUE(scene.textures.empty());
  EXPECT_EQ(scene.materials[0].base_color.value[0], 0.18f);
}

TEST_F(MeshFile, ABlankBeforeAColourIsRead) {
  std::string text = collada(kCentimetresZUp, "");
  const std::string color = "<color>";
  ASSERT_NE(text.find(color), std::string::npos);
  text.replace(text.find(color), color.size(), "<color>\n  ");
  const Scene scene = load(write("t.dae", text), {});
  EXPECT_NEAR(scene.materials[0].base_color.value[0], 1.0f, 1e-6f);
}

TEST_F(MeshFile, CommentsWithinVerticesAreRead) {
  std::string text = collada(kCentimetresZUp);
  const std::string vertices = "<vertices id='v'>";
  text.replace(text.find(vertices), vertices.size(), vertices + "<!-- <input semantic='NORMAL'/> -->");
  EXPECT_EQ(load(write("t.dae", text), {}).triangleCount(), 1u);
}

TEST_F(MeshFile, HolesOfPolygonsAreFilledAndNamed) {
  std::string text = collada(kCentimetresZUp);
  const std::string begin = "<triangles material='m' count='1'>", end = "<p>0 0 1 1 2 2</p></triangles>";
  text.replace(text.find(begin), begin.size(), "<polygons material='m' count='1'>");
  ASSERT_NE(text.find(end), std::string::npos);
  text.replace(text.find(end), end.size(), "<ph><p>0 0 1 1 2 2</p><h>0 0 1 1 2 2</h></ph></polygons>");
  const Scene scene = load(write("t.dae", text), {});
  EXPECT_EQ(scene.triangleCount(), 1u);
  expectOneWarning(scene, "1 meshes have polygons with holes, which are filled: " + pathOf("t.dae"));
}

TEST_F(MeshFile, ATextureWithHolesIsCutOut) {
  writeTexture("paint.png", 1);
  const Scene holes = load(write("t.dae", collada(kCentimetresZUp, "paint.png")), {});
  EXPECT_EQ(holes.materials[0].alpha_mode, AlphaMode::kMask);
  writeTexture("paint.png", 0);
  EXPECT_EQ(load(pathOf("t.dae"), {}).materials[0].alpha_mode, AlphaMode::kOpaque);
}

TEST_F(MeshFile, ATextureThatIsNowhereSolidIsNoCutOut) {
  const std::string mesh = write("t.dae", seenThrough(collada(kCentimetresZUp, "paint.png")));
  const auto loaded = [&](std::uint8_t alpha) {
    image::Rgba8Image picture(4, 4);
    for (std::size_t i = 0; i < picture.data.size(); ++i) picture.data[i] = i % 4 == 3 ? alpha : 200;
    write("paint.png", image::encodePng(picture));
    return load(mesh, {});
  };
  const Scene tinted = loaded(80), unused = loaded(0);
  EXPECT_EQ(tinted.materials[0].alpha_mode, AlphaMode::kBlend);
  EXPECT_EQ(unused.materials[0].alpha_mode, AlphaMode::kOpaque);
  for (const Scene& scene : {tinted, unused}) {
    ASSERT_EQ(scene.warnings.size(), 1u);
    EXPECT_NE(scene.warnings[0].find("paint.png, whose alpha is "), std::string::npos) << scene.warnings[0];
  }
}

TEST_F(MeshFile, WhatIsPaintedBelowAlphaIsOpaqueUnlessTheFileAsksForIt) {
  image::Rgba8Image painted(4, 4),
      nearly_all(5, 5);  // hidden: two rows of many colours, and 24 texels of one
  for (std::size_t i = 0; i < painted.data.size(); ++i)
    painted.data[i] = i % 4 == 3 ? (i < 32 ? 0 : 255) : static_cast<std::uint8_t>(i);
  for (std::size_t i = 0; i < nearly_all.data.size(); ++i) nearly_all.data[i] = i % 4 == 3 && i > 4 ? 0 : 255;
  write("m.mtl", "newmtl a\nmap_Kd paint.png\n");
  write("t.obj",
        "mtllib m.mtl\nusemtl a\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nf 1/1 2/2 3/3\n");
  write("t.dae", collada(kCentimetresZUp, "paint.png"));
  write("asks.dae", seenThrough(collada(kCentimetresZUp, "paint.png")));
  for (const image::Rgba8Image& picture : {painted, nearly_all}) {
    write("paint.png", image::encodePng(picture));
    for (const char* name : {"t.obj", "t.dae"}) {
      const Scene scene = load(pathOf(name), {});
      EXPECT_EQ(scene.materials[0].alpha_mode, AlphaMode::kOpaque) << name;
      ASSERT_EQ(scene.warnings.size(), 1u) << name;
      EXPECT_NE(scene.warnings[0].find("paint.png, of whose alpha the file says nothing: drawn as opaque"),
                std::string::npos)
          << scene.warnings[0];
    }
    const Scene asked = load(pathOf("asks.dae"), {});
    EXPECT_EQ(asked.materials[0].alpha_mode, AlphaMode::kMask);
    EXPECT_TRUE(asked.warnings.empty());
  }
}

TEST_F(MeshFile, ABrokenTextureIsANamedWarningAndANeutralMaterial) {
  const std::string mesh = write("t.dae", collada(kCentimetresZUp, "paint.png"));
  for (const char* content : {"this is not a picture", ""}) {
    write("paint.png", content);
    const Scene scene = load(mesh, {});
    expectOneWarning(scene, "1 textures cannot be decoded, neutral ones take their place: " +
                                pathOf("paint.png") + ": cannot decode this picture");
    EXPECT_EQ(scene.materials[0].base_texture, Material::kNoTexture);
    EXPECT_EQ(scene.materials[0].base_color.value[0], 0.18f);
  }
}

TEST_F(MeshFile, ATextureThatIsTooLargeIsScaledDownWithAWarning) {
  image::Rgba8Image picture(2 * kLongestTextureSide, 2);
  std::fill(picture.data.begin(), picture.data.end(), std::uint8_t{255});
  write("paint.png", image::encodePng(picture));
  const Scene scene = load(write("t.dae", collada(kCentimetresZUp, "paint.png")), {});
  ASSERT_EQ(scene.textures.size(), 1u);
  EXPECT_EQ(scene.textures[0].width, kLongestTextureSide);
  EXPECT_EQ(scene.textures[0].height, 1);
  expectOneWarning(scene, "1 textures were scaled down to a longest side of 8192 px: " + pathOf("paint.png") +
                              " of 16384 × 2 px");
}

TEST_F(MeshFile, AHundredWarningsOfAKindAreOneLine) {
  std::string materials, faces = "v 0 0 0\nv 1 0 0\nv 0 1 0\nmtllib m.mtl\n";
  for (int i = 100; i < 200; ++i) {
    const std::string number = std::to_string(i);
    materials += "newmtl m" + number + "\nmap_Kd gone" + number + ".png\n";
    faces += "usemtl m" + number + "\nf 1 2 3\n";
  }
  write("m.mtl", materials);
  const std::string mesh = write("t.obj", faces);
  expectOneWarning(load(mesh, {}),
                   "100 textures are missing, neutral ones take their place: gone100.png; "
                   "gone101.png; gone102.png; …");
}

TEST_F(MeshFile, ExamplesOfAKindAreOfDifferentSubjects) {
  SceneBuilder builder("");
  for (const char* where : {"a: 1", "a: 2", "a: 3", "b: 1", "b: 2", "c: 1", "d: 1"})
    builder.warn("flaws", where);
  EXPECT_EQ(builder.finish().warnings, std::vector<std::string>{"7 flaws: a: 1; b: 1; c: 1; …"});
}

TEST_F(MeshFile, ObjIsTakenAsZUpAndGetsNormals) {
  const Scene scene = load(write("roof.obj", "v 0 0 1\nv 2 0 1\nv 2 3 1\nv 0 3 1\nf 1 2 3 4\n"), {});
  EXPECT_EQ(scene.triangleCount(), 2u);  // the quadrilateral cut in two
  EXPECT_EQ(boundsOf(scene).max(), Eigen::Vector3f(2, 3, 1));
  for (const Eigen::Vector3f& normal : scene.meshes[0].normals) EXPECT_EQ(normal, Eigen::Vector3f(0, 0, 1));
}

TEST_F(MeshFile, VertexColoursOfObjAreDisplayValues) {
  const std::string file = write("colors.obj",
                                 "v 0 0 0 0.5 1 0\nv 1 0 0 0.5 1 0\nv 0 1 0 0.5 1 0\n"
                                 "vn 0 0 1\nf 1//1 2//1 3//1\n");
  const Scene scene = load(file, {});
  ASSERT_EQ(scene.meshes.size(), 1u);
  ASSERT_EQ(scene.meshes[0].colors.size(), 3u);
  // IEC 61966-2-1: ((0.5 + 0.055) / 1.055)^2.4.
  for (const Eigen::Array3f& color : scene.meshes[0].colors)
    EXPECT_LT((color - Eigen::Array3f(0.21404f, 1.0f, 0.0f)).abs().maxCoeff(), 1e-4f);
}

TEST_F(MeshFile, EmissionOfObjIsThatOfADisplay) {
  write("glow.mtl", "newmtl glow\nKd 0.5 0.5 0.5\nKe 1 0.5 0\n");
  const std::string file = write("glow.obj",
                                 "mtllib glow.mtl\nusemtl glow\nv 0 0 0\nv 1 0 0\nv 0 1 0\n"
                                 "vn 0 0 1\nf 1//1 2//1 3//1\n");
  const Scene scene = load(file, {});
  ASSERT_EQ(scene.meshes.size(), 1u);
  const Material& glow = scene.materials[static_cast<std::size_t>(scene.meshes[0].material)];
  // White of the reference display is 80 cd/m², half of its code 21.4 % of that.
  EXPECT_LT((glow.emission.value - Eigen::Array3f(80.0f, 80.0f * 0.21404f, 0.0f)).abs().maxCoeff(), 0.05f)
      << glow.emission.value.transpose();
}

TEST_F(MeshFile, MapsOfMtlAreRenderedOrNamed) {
  writeTexture("glow.png");
  write("normal.png", evenPicture(128, 255));
  const std::string triangle =
      "mtllib m.mtl\nusemtl m\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nvn 0 0 1\n"
      "f 1/1/1 2/2/1 3/3/1\n";
  const auto materialOf = [&](const std::string& maps) {
    write("m.mtl", "newmtl m\nKd 0.5 0.5 0.5\n" + maps);
    return load(write("m.obj", triangle), {});
  };
  const Scene shining = materialOf("Ke 0 0 0\nmap_Ke glow.png\n");
  const Material& glow = shining.materials.at(static_cast<std::size_t>(shining.meshes.at(0).material));
  ASSERT_TRUE(glow.emission_map.given());
  EXPECT_FLOAT_EQ(glow.emission.value.minCoeff(), 80.0f);
  EXPECT_TRUE(shining.warnings.empty());

  for (const char* word : {"norm", "map_Kn"}) {
    const Scene scene = materialOf(word + std::string(" normal.png\n"));
    const Material& bumpy = scene.materials.at(static_cast<std::size_t>(scene.meshes.at(0).material));
    ASSERT_TRUE(bumpy.normal_map.given()) << word;
    EXPECT_NE(scene.textures.at(static_cast<std::size_t>(bumpy.normal_map.texture)).name.find("normal.png"),
              std::string::npos);
    EXPECT_TRUE(scene.warnings.empty()) << word << ": " << scene.warnings[0];
  }
  for (const char* word : {"bump", "map_bump", "map_Bump", "map_Bump -bm 0.5"}) {
    const Scene scene = materialOf(word + std::string(" normal.png\n"));
    EXPECT_FALSE(
        scene.materials.at(static_cast<std::size_t>(scene.meshes.at(0).material)).normal_map.given());
    expectOneWarning(scene, ": m: a bump map: without it");
  }
  // Beside a normal map, too.
  expectOneWarning(materialOf("norm normal.png\nmap_Bump glow.png\n"), ": m: a bump map: without it");
}

TEST_F(MeshFile, MapsOfColladaAreRenderedOrNamed) {
  writeTexture("glow.png");
  write("normal.png", evenPicture(128, 255));
  write("grey.png", evenPicture(90, 90));
  const std::string sampled = "<texture texture='picture-sampler' texcoord='uv'/>";
  const auto withEffect = [&](const std::string& picture, const std::string& old_part,
                              const std::string& new_part) {
    std::string text = collada(kCentimetresZUp, picture);
    const std::size_t at = text.find(old_part);
    EXPECT_NE(at, std::string::npos);
    return load(write("m.dae", text.replace(at, old_part.size(), new_part)), {});
  };
  const auto lookOf = [](const Scene& scene) {
    return scene.materials.at(static_cast<std::size_t>(scene.meshes.at(0).material));
  };
  const std::string diffuse = "<diffuse>" + sampled + "</diffuse>";
  const Scene shining = withEffect("glow.png", diffuse, "<emission>" + sampled + "</emission>" + diffuse);
  EXPECT_TRUE(lookOf(shining).emission_map.given());
  EXPECT_FLOAT_EQ(lookOf(shining).emission.value.minCoeff(), 80.0f);
  const Scene coloured =
      withEffect("glow.png", diffuse, "<emission><color>1 0.5 0 1</color></emission>" + diffuse);
  EXPECT_FALSE(lookOf(coloured).emission_map.given());
  EXPECT_LT(
      (lookOf(coloured).emission.value - Eigen::Array3f(80.0f, 80.0f * 0.21404f, 0.0f)).abs().maxCoeff(),
      0.05f);

  // As OpenCOLLADA and Blender write it, in either of the two places.
  const auto bump = [&](const std::string& profile, const std::string& type) {
    return "<extra><technique profile='" + profile + "'><bump" + type + ">" + sampled +
           "</bump></technique></extra>";
  };
  const std::string end = "</lambert></technique>";
  // The picture of the colour is none of normals.
  expectOneWarning(withEffect("normal.png", end, "</lambert>" + bump("FCOLLADA", "") + "</technique>"),
                   ": a bump map, ");
  for (const std::string& extra :
       {bump("FCOLLADA", ""), bump("OpenCOLLADA3dsMax", " bumptype='NORMALMAP'")}) {
    const Scene scene = withEffect("normal.png", diffuse + end, "</lambert>" + extra + "</technique>");
    EXPECT_TRUE(lookOf(scene).normal_map.given()) << extra;
    EXPECT_TRUE(scene.warnings.empty()) << extra << scene.warnings[0];
  }
  // Heights, which are grey, are no normals.
  for (const std::string& extra :
       {bump("FCOLLADA", ""), bump("OpenCOLLADA3dsMax", " bumptype='HEIGHTFIELD'")}) {
    const Scene scene = withEffect("grey.png", end, "</lambert>" + extra + "</technique>");
    EXPECT_FALSE(lookOf(scene).normal_map.given()) << extra;
    expectOneWarning(scene, ": a bump map, ");
  }
}

TEST_F(MeshFile, ReflectionOfColladaIsNamedWhereItIsAny) {
  const auto with = [&](const std::string& reflection) {
    std::string text = collada(kCentimetresZUp);
    return load(write("m.dae", text.insert(text.find("</lambert>"), reflection)), {});
  };
  const auto reflection = [](const std::string& color, const std::string& share, const std::string& index) {
    return "<reflective><color>" + color + "</color></reflective><reflectivity><float>" + share +
           "</float></reflectivity><index_of_refraction><float>" + index + "</float></index_of_refraction>";
  };
  expectOneWarning(with(reflection("1 1 1 1", "0.2", "1")), "<reflective>");
  expectOneWarning(with(reflection("0 0 0 1", "0", "2.4")), "an index of refraction");
  for (const std::string& nothing :
       {reflection("0 0 0 1", "0.5", "1"), reflection("1 1 1 1", "0", "1.45"), std::string()})
    EXPECT_TRUE(with(nothing).warnings.empty()) << with(nothing).warnings[0];
}

TEST_F(MeshFile, BrokenTrianglesAreLeftOutAndCounted) {
  const Scene scene = load(
      write("b.obj",
            "o wall\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 2 0 0\nv nan 0 0\nf 1 2 3\nf 1 2 4\nf 2 1 4\nf 1 2 5\n"),
      {});
  EXPECT_EQ(scene.triangleCount(), 1u);
  ASSERT_EQ(scene.warnings.size(), 2u);
  EXPECT_EQ(scene.warnings[0], "1 triangles with coordinates that are not finite were left out: wall");
  EXPECT_EQ(scene.warnings[1], "2 triangles without area were left out: wall");
}

TEST_F(MeshFile, TextureCoordinatesOutOfAllRangeAreSetToZeroAndCounted) {
  const Scene scene = load(
      write("b.obj", "o wall\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 1e12 0\nvt 0 0.5\nvt 0 -2e6\nf 1/1 2/2 3/3\n"),
      {});
  ASSERT_EQ(scene.warnings.size(), 1u);
  EXPECT_EQ(scene.warnings[0], "2 texture coordinates outside -1e6 … 1e6 were set to 0: wall");
  EXPECT_NO_THROW(validate(scene));
}

TEST_F(MeshFile, LinesAndPointsAreLeftOutAndCounted) {
  const Scene scene = load(write("wires.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nl 1 2\nl 2 3\np 1\n"), {});
  EXPECT_EQ(scene.triangleCount(), 1u);
  ASSERT_EQ(scene.warnings.size(), 1u);
  EXPECT_EQ(
      scene.warnings[0],
      "1 files have lines and points, which have no surface and are left out: 3 in " + pathOf("wires.obj"));
}

TEST_F(MeshFile, ABrokenFileIsAnErrorNamingIt) {
  for (const char* name : {"b.dae", "b.glb", "b.gltf", "b.obj"}) {
    const std::string file = write(name, "<COLLADA this is nonsense");
    EXPECT_EQ(errorOf(file).find(file + ": "), 0u) << errorOf(file);
  }
}

TEST_F(MeshFile, APictureWithoutAFileIsAMissingTexture) {
  std::string text = collada(kCentimetresZUp, "paint.png");
  const std::string file = "<init_from>paint.png</init_from>";
  text.replace(text.find(file), file.size(), "<!--" + file + "-->");
  const Scene scene = load(write("t.dae", text), {});
  EXPECT_EQ(scene.triangleCount(), 1u);
  expectOneWarning(scene,
                   "1 textures are missing, neutral ones take their place: image picture (which names "
                   "no file)");
}

// As Cinema 4D writes it.
TEST_F(MeshFile, APictureWithAnEmptyAddressIsAMissingTexture) {
  const std::string whole = collada(kCentimetresZUp, "paint.png");
  const std::string file = "<init_from>paint.png</init_from>";
  for (const std::string empty : {"<init_from/>", "<init_from></init_from>", "<init_from>\n </init_from>",
                                  "<init_from sid='s'> <!--none--> </init_from>"}) {
    std::string text = whole;
    text.replace(text.find(file), file.size(), empty);
    const Scene scene = load(write("t.dae", text), {});
    EXPECT_EQ(scene.triangleCount(), 1u) << empty;
    expectOneWarning(scene,
                     "1 textures are missing, neutral ones take their place: image picture (which names "
                     "no file)");
  }
}

TEST_F(MeshFile, EmptyAnimationsEndWhereTheyBegin) {
  std::string text = collada(kCentimetresZUp);
  const std::string geometries = "<library_geometries>", scenes = "<library_visual_scenes>";
  text.insert(text.find(scenes), "<library_animations><animation/></library_animations>");
  text.insert(text.find(geometries), "<library_animations/><library_animations id='none' />");
  const Scene scene = load(write("t.dae", text), {});
  EXPECT_EQ(scene.triangleCount(), 1u);
  EXPECT_TRUE(scene.warnings.empty());
}

TEST_F(MeshFile, AnEmptyFileIsSaidToBeEmpty) {
  for (const char* name : {"e.dae", "e.glb", "e.gltf", "e.obj"})
    EXPECT_EQ(errorOf(write(name, "")), pathOf(name) + ": this file is empty");
}

TEST_F(MeshFile, AMissingFileNamesThePlaces) {
  const std::string error = errorOf("worlds/nowhere.dae", SearchPath{{"/some/folder"}});
  EXPECT_EQ(error.find("there is no world worlds/nowhere.dae; it was looked for as "), 0u) << error;
  EXPECT_NE(error.find("worlds/nowhere.dae … ("), std::string::npos) << error;
  EXPECT_EQ(error.substr(error.size() - 8), " in all)") << error;
}

TEST_F(MeshFile, AnUnknownEndingIsAnError) {
  const std::string file = write("world.blend", "");
  EXPECT_EQ(errorOf(file).find(file + ": cannot tell its format"), 0u) << errorOf(file);
  const std::string macros = write("yard.world.xacro", "");
  EXPECT_EQ(errorOf(macros).find(macros + ": this is a macro file"), 0u) << errorOf(macros);
}

TEST_F(MeshFile, InUtf16IsRefusedByName) {
  const std::string triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
  for (const auto& [name, text] : {std::pair<std::string, std::string>("t.obj", triangle),
                                   {"t.dae", "<?xml version='1.0'?><COLLADA/>"},
                                   {"t.gltf", "{}"}}) {
    const std::string file = write(name, utf16Of(text));
    EXPECT_EQ(errorOf(file), refusalOfUtf16(file));
  }
  const std::string library = write("l.mtl", utf16Of("newmtl m\nKd 1 0 0\n"));
  const std::string object = write("u.obj", "mtllib l.mtl\nusemtl m\n" + triangle);
  EXPECT_EQ(errorOf(object), object + ": its library " + refusalOfUtf16(library));
}

TEST_F(MeshFile, APipeIsRefusedInsteadOfWaitedFor) {
  // Nobody writes to them: whoever opens one to read waits for ever.
  for (const char* name : {"p.world", "p.sdf", "p.urdf", "p.dae", "p.glb", "p.gltf", "p.obj", "p"}) {
    const std::string pipe = pathOf(name);
    ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
    const std::string refusal = pipe + ": this is a pipe or a device, and no file";
    EXPECT_EQ(errorOf(pipe), refusal);
    EXPECT_EQ(messageOf<std::runtime_error>([&] { requireWorld(pipe, {}); }), refusal);
  }
}

TEST_F(MeshFile, APipeThatAFileNamesIsRefusedInsteadOfWaitedFor) {
  const auto refusal = [this](const std::string& name) {
    return pathOf(name) + ": this is a pipe or a device, and no file";
  };
  for (const char* name : {"p.png", "p.bin", "p.mtl"}) ASSERT_EQ(::mkfifo(pathOf(name).c_str(), 0600), 0);
  expectOneWarning(load(write("t.dae", collada(kCentimetresZUp, "p.png")), {}),
                   "1 textures cannot be decoded, neutral ones take their place: " + refusal("p.png"));
  EXPECT_EQ(errorOf(write("t.obj", "mtllib p.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")),
            pathOf("t.obj") + ": its library " + refusal("p.mtl"));
  // Floats are read by Assimp, whole numbers before it.
  for (const std::string type : {"5126", "5122"}) {
    const std::string error =
        errorOf(write("t.gltf", R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],
"nodes":[{"mesh":0}],"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],
"accessors":[{"bufferView":0,"componentType":)" +
                                    type + R"(,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,1,0]}],
"bufferViews":[{"buffer":0,"byteLength":36}],"buffers":[{"byteLength":36,"uri":"p.bin"}]})"));
    EXPECT_NE(error.find(refusal("p.bin")), std::string::npos) << error;
  }
}

}  // namespace
}  // namespace sunlit::scene
