// What SDF visuals look like.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "unit/scene/measure.h"
#include "unit/scene/scene_files.h"

namespace sunlit::scene {
namespace {

class SdfLook : public SceneFiles {
 protected:
  Scene loaded(const std::string& material, const std::string& more = "",
               const std::string& geometry = "<sphere><radius>1</radius></sphere>") {
    return load(
        write("test.world",
              "<?xml version='1.0'?><sdf version='1.9'><world name='w'><model name='m'><link name='l'>"
              "<visual name='v'>" +
                  more + "<geometry>" + geometry + "</geometry>" + material +
                  "</visual></link></model></world></sdf>"),
        {});
  }
  static const Material& look(const Scene& scene) {
    return scene.materials.at(static_cast<std::size_t>(scene.meshes.at(0).material));
  }
};

TEST_F(SdfLook, PlainColoursAreDisplayValues) {
  const Scene scene = loaded("<material><ambient>0 0 0 1</ambient><diffuse>1 0.5 0 1</diffuse></material>");
  EXPECT_EQ(look(scene).base_color.value[0], 1.0f);
  EXPECT_NEAR(look(scene).base_color.value[1], 0.2140f, 5e-5f);  // ((0.5 + 0.055) / 1.055)^2.4
  EXPECT_EQ(look(scene).base_color.value[2], 0.0f);
}

TEST_F(SdfLook, AlphaOfDiffuseLetsThrough) {
  const Scene pane = loaded("<material><diffuse>1 1 1 0.3</diffuse></material>");
  EXPECT_EQ(look(pane).alpha_mode, AlphaMode::kBlend);
  // A ray meets two faces of a sphere, which let 0.7 through together.
  EXPECT_NEAR(1.0f - look(pane).alpha, std::sqrt(0.7f), 1e-6f);
  const Scene forgotten = loaded("<material><diffuse>1 1 1 0</diffuse></material>");
  EXPECT_EQ(look(forgotten).alpha_mode, AlphaMode::kOpaque);
  ASSERT_EQ(forgotten.warnings.size(), 1u);
}

TEST_F(SdfLook, LightingThatIsOffAndNormalMapsOfShadersAreNamed) {
  const Scene scene = loaded(
      "<material><lighting>false</lighting><diffuse>1 1 1 1</diffuse>"
      "<shader type='normal_map_tangent_space'><normal_map>n.png</normal_map></shader></material>");
  ASSERT_EQ(scene.warnings.size(), 1u);
  EXPECT_NE(scene.warnings[0].find("<lighting> false"), std::string::npos) << scene.warnings[0];
  EXPECT_NE(scene.warnings[0].find("<shader>"), std::string::npos) << scene.warnings[0];
}

TEST_F(SdfLook, WithoutMaterialIsNeutral) {
  EXPECT_EQ(look(loaded("")).base_color.value[1], 0.18f);
  EXPECT_TRUE(loaded("").warnings.empty());
}

TEST_F(SdfLook, KnownScriptsHaveTheirColour) {
  const Scene scene = loaded(
      "<material><script><uri>file://media/materials/scripts/gazebo.material</uri>"
      "<name>Gazebo/Red</name></script></material>");
  EXPECT_EQ(look(scene).base_color.value[0], 1.0f);
  EXPECT_EQ(look(scene).base_color.value[2], 0.0f);
  EXPECT_TRUE(scene.warnings.empty());
}

TEST_F(SdfLook, UnknownScriptsAreANamedWarning) {
  const Scene scene =
      loaded("<material><script><uri>file://x.material</uri><name>Plaid</name></script></material>");
  ASSERT_EQ(scene.warnings.size(), 1u);
  EXPECT_EQ(scene.warnings[0],
            "1 material scripts are not known, a neutral material takes their place: Plaid");
}

TEST_F(SdfLook, ScriptsOfModelsAreRead) {
  write("models/field/materials/scripts/field.material",
        "material Field/Sand\n{\n  technique\n  {\n    pass\n    {\n      texture_unit\n      {\n        "
        "texture sand.png\n      }\n    }\n  }\n}\n");
  writeTexture("models/field/materials/textures/sand.png");
  const Scene scene = loaded(
      "<material><script><uri>model://field/materials/scripts</uri>"
      "<uri>model://field/materials/textures</uri><name>Field/Sand</name></script></material>");
  EXPECT_TRUE(scene.warnings.empty()) << scene.warnings[0];
  ASSERT_EQ(scene.textures.size(), 1u);
  EXPECT_EQ(look(scene).base_texture, 0);
}

TEST_F(SdfLook, TexturesOfScriptsRepeatAsTheirScaleSays) {
  write("models/field/materials/scripts/field.material",
        "material Field/Sand\n{ technique { pass { texture_unit {\n texture sand.png\n scale 0.25 0.5\n } } "
        "} }\n");
  writeTexture("models/field/materials/textures/sand.png");
  const std::string plane = "<plane><size>2 2</size></plane>";
  const Scene plain = loaded("", "", plane);
  const Scene scene = loaded(
      "<material><script><uri>model://field/materials/scripts</uri><name>Field/Sand</name></script></"
      "material>",
      "", plane);
  EXPECT_TRUE(scene.warnings.empty()) << scene.warnings[0];
  const std::vector<Eigen::Vector2f>& usual = plain.meshes.at(0).texture_coordinates;
  ASSERT_EQ(scene.meshes.at(0).texture_coordinates.size(), usual.size());
  // About the middle of the texture, four times to the side and twice up.
  for (std::size_t i = 0; i < usual.size(); ++i) {
    EXPECT_EQ(scene.meshes[0].texture_coordinates[i].x(), 4.0f * (usual[i].x() - 0.5f) + 0.5f);
    EXPECT_EQ(scene.meshes[0].texture_coordinates[i].y(), 2.0f * (usual[i].y() - 0.5f) + 0.5f);
  }
}

TEST_F(SdfLook, PbrMetalIsRead) {
  writeTexture("metal.png");
  const Scene scene = loaded(
      "<material><pbr><metal><albedo_map>metal.png</albedo_map><roughness>0.25</roughness>"
      "<metalness>0.75</metalness></metal></pbr></material>");
  EXPECT_FLOAT_EQ(look(scene).roughness, 0.25f);
  EXPECT_FLOAT_EQ(look(scene).metalness, 0.75f);
  EXPECT_EQ(look(scene).base_texture, 0);
  EXPECT_EQ(look(scene).base_color.value[0], 1.0f);
}

TEST_F(SdfLook, MapsOfPbrMetalAreRead) {
  for (const char* name : {"n.png", "r.png", "m.png", "e.png", "o.png"}) writeTexture(name);
  const Scene scene = loaded(
      "<material><pbr><metal><normal_map>n.png</normal_map><roughness_map>r.png</roughness_map>"
      "<metalness_map>m.png</metalness_map><emissive_map>e.png</emissive_map>"
      "<ambient_occlusion_map>o.png</ambient_occlusion_map><environment_map>n.png</environment_map>"
      "</metal></pbr></material>");
  const Material& m = look(scene);
  EXPECT_TRUE(m.normal_map.given() && m.occlusion_map.given());
  EXPECT_TRUE(m.roughness_map.given() && m.metalness_map.given());
  EXPECT_EQ(m.roughness, 1.0f);
  EXPECT_EQ(m.metalness, 1.0f);
  EXPECT_EQ(m.emission.value[0], 80.0f);  // the white of a display, times the map
  ASSERT_EQ(scene.warnings.size(), 1u);
  EXPECT_NE(scene.warnings[0].find("an environment map"), std::string::npos) << scene.warnings[0];
}

TEST_F(SdfLook, NormalMapsInTheSpaceOfTheirObjectAreNamed) {
  writeTexture("n.png");
  const auto with = [&](const std::string& type) {
    return loaded("<material><pbr><metal><normal_map" + type +
                  ">n.png</normal_map></metal></pbr></material>");
  };
  EXPECT_TRUE(look(with(" type='tangent'")).normal_map.given());
  EXPECT_FALSE(look(with(" type='object'")).normal_map.given());
  ASSERT_EQ(with(" type='object'").warnings.size(), 1u);
  EXPECT_NE(with(" type='object'").warnings[0].find("in the space of its object"), std::string::npos);
}

TEST_F(SdfLook, VisibilityForSomeCamerasAloneIsNamed) {
  EXPECT_TRUE(loaded("", "<visibility_flags>4294967295</visibility_flags>").warnings.empty());
  const Scene scene = loaded("", "<visibility_flags>1</visibility_flags>");
  EXPECT_EQ(scene.meshes.size(), 1u);
  ASSERT_EQ(scene.warnings.size(), 1u);
  EXPECT_NE(scene.warnings[0].find("every camera sees them"), std::string::npos) << scene.warnings[0];
}

TEST_F(SdfLook, WhatAWorldsSceneAsksForIsNamedWhereItIsNotUsual) {
  const auto warningsOf = [&](const std::string& scene) {
    return load(
               write("scene.world",
                     "<sdf version='1.6'><world name='w'><scene>" + scene +
                         "</scene><model name='m'><link name='l'><visual name='v'><geometry><sphere><radius>1"
                         "</radius></sphere></geometry></visual></link></model></world></sdf>"),
               {})
        .warnings;
  };
  EXPECT_TRUE(
      warningsOf("<ambient>0.4 0.4 0.4 1</ambient><background>0.7 0.7 0.7 1</background><shadows>1</shadows>"
                 "<fog><type>none</type></fog>")
          .empty());
  EXPECT_TRUE(warningsOf("<background>0.8 0.8 0.8</background>").empty());
  EXPECT_TRUE(warningsOf("<background>0 0 1 1</background><sky/>").empty());
  for (const std::string lost :
       {"<background>0 0 1 1</background>", "<shadows>false</shadows>", "<fog><type>linear</type></fog>"}) {
    ASSERT_EQ(warningsOf(lost).size(), 1u) << lost;
    EXPECT_NE(warningsOf(lost)[0].find("1 elements of <scene> are not rendered: <"), std::string::npos)
        << warningsOf(lost)[0];
  }
}

TEST_F(SdfLook, EmissiveGlowsAsADisplayWould) {
  const Scene scene = loaded("<material><diffuse>1 1 1 1</diffuse><emissive>1 0.5 0 1</emissive></material>");
  EXPECT_NEAR(look(scene).emission.value[0], 80.0f, 1e-3f);
  EXPECT_NEAR(look(scene).emission.value[1], 80.0f * 0.2140f, 5e-3f);
  EXPECT_TRUE(scene.warnings.empty());
}

TEST_F(SdfLook, WhatScriptsSayAndIsNotRenderedIsNamed) {
  write("models/field/materials/scripts/field.material",
        "material Field/Glass\n{\n  technique\n  {\n    pass\n    {\n      diffuse 1 0 0 1\n      "
        "emissive 1 1 1 1\n      scene_blend add\n    }\n  }\n}\n");
  const Scene scene = loaded(
      "<material><script><uri>model://field/materials/scripts</uri><name>Field/Glass</name></script>"
      "</material>");
  EXPECT_EQ(look(scene).emission.value[0], 80.0f);
  ASSERT_EQ(scene.warnings.size(), 1u);
  EXPECT_NE(scene.warnings[0].find("script Field/Glass: scene_blend: without it"), std::string::npos)
      << scene.warnings[0];
}

TEST_F(SdfLook, AColourBesideAScriptComesAfterIt) {
  const std::string grey = "<script><name>Gazebo/Grey</name></script>";
  EXPECT_EQ(look(loaded("<material>" + grey + "<diffuse>1 0 0 1</diffuse></material>")).base_color.value[1],
            0.0f);
  EXPECT_GT(look(loaded("<material>" + grey + "<ambient>1 0 0 1</ambient></material>")).base_color.value[1],
            0.0f);
  const Scene unknown =
      loaded("<material><script><name>No/Such</name></script><diffuse>1 0 0 1</diffuse></material>");
  EXPECT_EQ(look(unknown).base_color.value[0], 1.0f);
}

TEST_F(SdfLook, AMapOfEmissionThatIsMissingLeavesNothingThatShines) {
  const Scene scene = loaded(
      "<material><emissive>1 1 1 "
      "1</emissive><pbr><metal><emissive_map>none.png</emissive_map></metal></pbr></material>");
  EXPECT_TRUE(look(scene).emission.value.isZero());
  write("broken.png", "no picture");
  const Scene undecoded =
      loaded("<material><pbr><metal><emissive_map>broken.png</emissive_map></metal></pbr></material>");
  EXPECT_TRUE(look(undecoded).emission.value.isZero());
  EXPECT_FALSE(look(undecoded).emission_map.given());
}

TEST_F(SdfLook, AMeshKeepsItsOwnMaterialUnlessTheVisualHasOne) {
  write("red.mtl", "newmtl red\nKd 1 0 0\n");
  write("t.obj", "mtllib red.mtl\nusemtl red\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  const std::string mesh = "<mesh><uri>t.obj</uri></mesh>";
  EXPECT_EQ(look(loaded("", "", mesh)).base_color.value[1], 0.0f);
  // A bare shader, as many models have, says nothing about the colour.
  const std::string shader =
      "<material><shader type='pixel'><normal_map>__default__</normal_map></shader></material>";
  EXPECT_EQ(look(loaded(shader, "", mesh)).base_color.value[1], 0.0f);
  EXPECT_EQ(look(loaded("<material><diffuse>0 1 0 1</diffuse></material>", "", mesh)).base_color.value[1],
            1.0f);
}

TEST_F(SdfLook, OfLooksThatAreReplacedNothingIsSaid) {
  const std::string own = "<material><script><name>Gazebo/Grey</name></script></material>";
  write("roof.mtl", "newmtl tiles\nmap_Kd gone.png\n");
  write("roof.obj", "mtllib roof.mtl\nusemtl tiles\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  writeTexture("there.png");
  write("wall.mtl", "newmtl paint\nmap_Kd there.png\n");
  write("wall.obj", "mtllib wall.mtl\nusemtl paint\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  const std::string roof = "<mesh><uri>roof.obj</uri></mesh>";
  const Scene grey = loaded(own, "", roof), wall = loaded(own, "", "<mesh><uri>wall.obj</uri></mesh>");
  EXPECT_TRUE(grey.warnings.empty()) << grey.warnings[0];
  EXPECT_TRUE(wall.textures.empty());
  for (const Scene& scene : {grey, wall}) {
    EXPECT_EQ(look(scene).name, "Gazebo/Grey");
    EXPECT_EQ(scene.triangleCount(), 1u);
  }
  const std::vector<std::string> missing = {
      "1 textures are missing, neutral ones take their place: gone.png of " + pathOf("roof.obj")};
  EXPECT_EQ(loaded("", "", roof).warnings, missing);
  // Of three visuals that show the same file, the last.
  const Scene both = loaded(own, "",
                            roof + "</geometry></visual><visual name='u'><geometry>" + roof +
                                "</geometry></visual><visual name='t'><geometry>" + roof);
  EXPECT_EQ(both.triangleCount(), 3u);
  EXPECT_EQ(both.warnings, missing);
}

// A ray meets two faces of a box, and one of a plane; what is left of the light behind is the transparency.
TEST_F(SdfLook, TransparentVisualsAreSeenThrough) {
  const auto opacity = [&](const std::string& geometry, const std::string& transparency) {
    const Scene scene = loaded("", "<transparency>" + transparency + "</transparency>", geometry);
    EXPECT_TRUE(scene.warnings.empty());
    EXPECT_EQ(look(scene).alpha_mode, AlphaMode::kBlend);
    return look(scene).alpha;
  };
  const std::string box = "<box><size>1 1 1</size></box>", plane = "<plane><size>1 1</size></plane>";
  write("t.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  EXPECT_NEAR(opacity(box, "0.36"), 1.0f - 0.6f, 1e-6f);
  EXPECT_NEAR(opacity(plane, "0.36"), 0.64f, 1e-6f);
  EXPECT_NEAR(opacity("<mesh><uri>t.obj</uri></mesh>", "0.9"), 0.1f, 1e-6f);
  EXPECT_EQ(look(loaded("", "<transparency>0</transparency>", box)).alpha_mode, AlphaMode::kOpaque);
}

TEST_F(SdfLook, MaterialsAreCalledApart) {
  EXPECT_EQ(look(loaded("<material><diffuse>1 0 0 1</diffuse></material>")).name, "m::l::v");
  for (const std::string name : {"a", "b"}) {
    write(name + ".mtl", "newmtl red\nKd 1 0 0\n");
    write(name + ".obj", "mtllib " + name + ".mtl\nusemtl red\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  }
  const auto mesh = [](const std::string& name) { return "<mesh><uri>" + name + ".obj</uri></mesh>"; };
  EXPECT_EQ(look(loaded("", "", mesh("a"))).name, "red");
  const Scene both =
      loaded("", "<geometry>" + mesh("a") + "</geometry></visual><visual name='w'>", mesh("b"));
  ASSERT_EQ(both.meshes.size(), 2u);
  for (const Mesh& one : both.meshes)
    EXPECT_EQ(both.materials[static_cast<std::size_t>(one.material)].name, "red of " + one.name);
}

TEST_F(SdfLook, ATransparentSheetOfTwoSidesIsOne) {
  const std::string points = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n";
  write("t.obj", points + "f 3 2 1 4\n");
  const std::string mesh = "<mesh><uri>t.obj</uri></mesh>";
  for (const std::string material : {"", "<material><diffuse>1 0 0 1</diffuse></material>"}) {
    const Scene scene = loaded(material, "<transparency>0.5</transparency>", mesh);
    EXPECT_EQ(scene.triangleCount(), 2u) << material;
    EXPECT_TRUE(look(scene).double_sided) << material;
    EXPECT_EQ(look(scene).alpha, 0.5f);
    EXPECT_EQ(loaded(material, "", mesh).triangleCount(), 4u) << material;
  }
  // Each of its faces has a share of what all of a shape of SDF covers.
  const std::string flat = "<box><size>1 1 0</size></box>";
  EXPECT_EQ(loaded("", "<transparency>0.5</transparency>", flat).triangleCount(),
            loaded("", "", flat).triangleCount());
}

TEST_F(SdfLook, AMaterialIsOpaqueInOneVisualAndNotInAnother) {
  const Scene scene = loaded("<material><diffuse>1 0 0 1</diffuse></material>",
                             "<geometry><box><size>1 1 1</size></box></geometry></visual><visual name='w'>"
                             "<transparency>0.5</transparency>");
  ASSERT_EQ(scene.meshes.size(), 2u);
  const auto of = [&](std::size_t mesh) {
    return scene.materials[static_cast<std::size_t>(scene.meshes[mesh].material)];
  };
  EXPECT_EQ(of(0).alpha_mode, AlphaMode::kOpaque);
  EXPECT_EQ(of(1).alpha_mode, AlphaMode::kBlend);
}

TEST_F(SdfLook, WhollyTransparentVisualsAreLeftOut) {
  const std::string two =
      "<transparency>1</transparency><geometry><box><size>9 9 9</size></box></geometry></visual><visual "
      "name='w'>";
  const Scene scene = loaded("", two);
  EXPECT_EQ(scene.meshes.size(), 1u);
  ASSERT_EQ(scene.warnings.size(), 1u);
  EXPECT_EQ(scene.warnings[0], "1 visuals were left out, they are wholly transparent: m::l::v");
}

TEST_F(SdfLook, ShadowsThatSomebodyWouldSeeAreNamed) {
  const std::string none = "<cast_shadows>false</cast_shadows>";
  EXPECT_EQ(loaded("", none).warnings,
            std::vector<std::string>{
                "1 visuals cast shadows although their files say that they should not: m::l::v"});
  const auto plane = [](const std::string& normal) {
    return "<plane><normal>" + normal + "</normal><size>9 9</size></plane>";
  };
  EXPECT_TRUE(loaded("", none, plane("0 0 1")).warnings.empty());
  EXPECT_EQ(loaded("", none, plane("1 0 0")).warnings.size(), 1u);
}

TEST_F(SdfLook, ScriptsBlendByTheirAlpha) {
  write("models/field/materials/scripts/field.material",
        "material Field/Glass\n{ technique { pass {\n scene_blend alpha_blend\n diffuse 1 0 0 0.25\n } } }\n"
        "material Field/Film\n{ technique { pass {\n scene_blend alpha_blend\n diffuse 1 0 0 1\n"
        " texture_unit {\n alpha_op_ex source1 src_manual src_current 0.5\n } } } }\n"
        "material Field/Wall\n{ technique { pass {\n scene_blend alpha_blend\n diffuse 1 0 0 1\n } } }\n");
  const auto of = [&](const std::string& name) {
    const Scene scene = loaded("<material><script><uri>model://field/materials/scripts</uri><name>" + name +
                                   "</name></script></material>",
                               "", "<plane><size>1 1</size></plane>");
    EXPECT_TRUE(scene.warnings.empty()) << scene.warnings[0];
    return look(scene);
  };
  EXPECT_EQ(of("Field/Glass").alpha_mode, AlphaMode::kBlend);
  EXPECT_EQ(of("Field/Glass").alpha, 0.25f);
  EXPECT_EQ(of("Field/Film").alpha, 0.5f);
  EXPECT_EQ(of("Field/Wall").alpha_mode, AlphaMode::kOpaque);
  EXPECT_EQ(of("Gazebo/BlueTransparent").alpha, 0.5f);
  EXPECT_EQ(of("Gazebo/WhiteGlow").emission.value[1], 80.0f);
  EXPECT_EQ(of("Gazebo/WhiteGlow").alpha_mode, AlphaMode::kOpaque);
}

TEST_F(SdfLook, WarningsOfTheParserAreCollected) {
  ::testing::internal::CaptureStderr();
  const Scene scene = loaded("<material><diffuse shade='dark'>1 0 0 1</diffuse></material>");
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
  ASSERT_EQ(scene.warnings.size(), 1u);
  EXPECT_EQ(scene.warnings[0].find("1 × libsdformat: XML Attribute[…] in element[…] not defined in SDF"), 0u)
      << scene.warnings[0];
  EXPECT_NE(scene.warnings[0].find("XML Attribute[shade] in element[diffuse]"), std::string::npos)
      << scene.warnings[0];
}

}  // namespace
}  // namespace sunlit::scene
