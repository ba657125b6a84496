// Gazebo's material names and OGRE scripts.
#include "scene/gazebo_material.h"

#include <gtest/gtest.h>

namespace sunlit::scene {
namespace {

constexpr const char* kScript = R"(
// material Sand { diffuse 1 1 1 }
material Base
{
  technique
  {
    pass
    {
      ambient 0.1 0.1 0.1 1
      diffuse 1.0 0.0 0.0 1.0
      alpha_rejection greater 128
    }
  }
}
material Sand : Base {
  technique { pass {
    texture_unit { 
      texture sand.png
      filtering anisotropic } } }
}
material Other
{ technique { pass { diffuse 0 1 0 } } }
)";

TEST(GazeboMaterial, KnowsTheColoursByName) {
  ASSERT_TRUE(gazeboLook("Gazebo/Red"));
  EXPECT_EQ(gazeboLook("Gazebo/Red")->color.value[0], 1.0f);
  EXPECT_EQ(gazeboLook("Gazebo/Red")->color.value[1], 0.0f);
  EXPECT_EQ(gazeboLook("Gazebo/Red")->opacity, 1.0f);
  // 0.7 of a display's range is ((0.7 + 0.055) / 1.055)^2.4 = 0.448 of its light.
  EXPECT_NEAR(gazeboLook("Gazebo/Grey")->color.value[0], 0.448f, 0.0005f);
  EXPECT_FALSE(gazeboLook("Gazebo/Plaid"));
  EXPECT_FALSE(gazeboLook("Red"));
}

TEST(GazeboMaterial, ReadsOneMaterialOfAScript) {
  const auto base = parseMaterialScript(kScript, "Base");
  ASSERT_TRUE(base && base->diffuse);
  EXPECT_EQ(base->diffuse->value[0], 1.0f);
  EXPECT_TRUE(base->alpha_rejection);
  EXPECT_FALSE(base->texture);
  EXPECT_FALSE(parseMaterialScript(kScript, "Gravel"));
}

const float kGreen[3] = {0.0f, 1.0f, 0.0f};

void expectGreen(const std::optional<ScriptMaterial>& material) {
  ASSERT_TRUE(material && material->diffuse);
  for (int c = 0; c < 3; ++c) EXPECT_EQ(material->diffuse->value[c], kGreen[c]);
}

TEST(MaterialScript, HasCommentsOfTwoKindsAndWordsInQuotes) {
  const std::string script = R"(
/* material A { technique { pass { diffuse 1 0 0 1 } } }
   { */
material "Two // Words" { technique { pass {
  /* diffuse 1 0 0 1
  */ diffuse 0 1 0 1 // diffuse 1 0 0 1
  texture_unit { texture "some /* picture.png" } } } }
material Child:"Two // Words" { }
)";
  EXPECT_FALSE(parseMaterialScript(script, "A"));
  for (const char* name : {"Two // Words", "Child"}) {
    const auto material = parseMaterialScript(script, name);
    expectGreen(material);
    EXPECT_EQ(material->texture.value_or(""), "some /* picture.png");
    EXPECT_TRUE(material->lost.empty());
  }
}

TEST(MaterialScript, OfAMaterialEndsWithIt) {
  const std::string script = R"(
abstract pass Green { diffuse 0 1 0 1 }
material Plain
{
  technique { pass { ambient 1 1 1 1 } }
}
abstract pass Red { diffuse 1 0 0 1 }
vertex_program Deep glsl { default_params { param_named deepColor float4 0 0 0 1 } }
material Heir { technique { pass : Green { } } }
)";
  const auto plain = parseMaterialScript(script, "Plain");
  ASSERT_TRUE(plain);
  EXPECT_FALSE(plain->diffuse);
  EXPECT_TRUE(plain->lost.empty());
  const auto heir = parseMaterialScript(script, "Heir");
  ASSERT_TRUE(heir);
  EXPECT_EQ(heir->lost, std::set<std::string>{"what its pass has of Green"});
}

TEST(MaterialScript, HasVariables) {
  const auto material = parseMaterialScript(
      "material A { technique { pass {\nset $picture \"a b.png\"\ntexture_unit {\ntexture $picture\n} } } }",
      "A");
  ASSERT_TRUE(material);
  EXPECT_EQ(material->texture.value_or(""), "a b.png");
  const std::string script = R"(
material A { set $green "0 1 0"
  set $paint $green
  technique { pass { diffuse $paint
  } } }
material B { technique { pass { diffuse $blue
  } } }
)";
  expectGreen(parseMaterialScript(script, "A"));
  EXPECT_TRUE(parseMaterialScript(script, "A")->lost.empty());
  EXPECT_EQ(parseMaterialScript(script, "B")->lost,
            std::set<std::string>{"variable $blue, which is not set before"});
}

TEST(MaterialScript, InheritsFromWhatComesWithGazeboAndNamesAParentThatIsNotThere) {
  const auto red = parseMaterialScript("material A : Gazebo/Red\n{\n}\n", "A");
  ASSERT_TRUE(red && red->diffuse);
  EXPECT_TRUE((red->diffuse->value == gazeboLook("Gazebo/Red")->color.value).all());
  EXPECT_TRUE(red->lost.empty());
  const auto orphan = parseMaterialScript("material A : Base\n{\n}\n", "A");
  ASSERT_TRUE(orphan);
  ASSERT_EQ(orphan->lost.size(), 1U);
  EXPECT_EQ(*orphan->lost.begin(), "its parent Base, which no script has");
}

TEST(GazeboMaterial, BlendsByAlphaHoweverThatIsWritten) {
  const auto of = [](const std::string& blend) {
    return parseMaterialScript("material A { technique { pass { scene_blend " + blend + " } } }\n", "A")
        .value();
  };
  EXPECT_TRUE(of("alpha_blend").blends);
  EXPECT_TRUE(of("src_alpha one_minus_src_alpha").blends);
  EXPECT_TRUE(of("alpha_blend").lost.empty());
  EXPECT_FALSE(of("add").blends);
  EXPECT_EQ(of("add").lost.count("scene_blend"), 1u);
}

TEST(GazeboMaterial, ReadsHowLargeItsFirstTextureIs) {
  const auto of = [](const std::string& units) {
    const auto material = parseMaterialScript("material A { technique { pass {" + units + "} } }\n", "A");
    return material ? *material : ScriptMaterial();
  };
  const ScriptMaterial once = of("texture_unit {\n texture a.png\n scale 0.5 -2\n }");
  EXPECT_EQ(once.texture_scale->x(), 0.5f);
  EXPECT_EQ(once.texture_scale->y(), -2.0f);
  EXPECT_TRUE(once.lost.empty());
  // That of another texture is not rendered either.
  for (const std::string units : {"texture_unit {\n texture a.png\n }\n texture_unit {\n scale 3 3\n }",
                                  "texture_unit {\n scale 0 1\n }", "scale 2 2\n"}) {
    EXPECT_FALSE(of(units).texture_scale) << units;
    EXPECT_EQ(of(units).lost.count("scale"), 1u) << units;
  }
}

TEST(GazeboMaterial, ATextureUnitMayBeAPlainColour) {
  const auto of = [](const std::string& first, const std::string& unit) {
    return *parseMaterialScript("material A { technique { pass { diffuse 0 0 1 1\n" + first +
                                    "\ntexture_unit {\n" + unit + "\n} } } }",
                                "A");
  };
  const ScriptMaterial orange = of("", "colour_op_ex source1 src_manual src_current 1 0.5 0");
  ASSERT_TRUE(orange.diffuse);
  EXPECT_EQ(orange.diffuse->value[0], 1.0f);
  EXPECT_NEAR(orange.diffuse->value[1], 0.2140f, 5e-5f);  // ((0.5 + 0.055) / 1.055)^2.4
  EXPECT_EQ(orange.diffuse->value[2], 0.0f);
  EXPECT_TRUE(orange.lost.empty());
  const std::string pictured = "texture_unit {\n texture a.png\n}";
  for (const ScriptMaterial& other : {of("", "colour_op_ex source1 src_manual src_current"),
                                      of("", "colour_op_ex source2 src_manual src_current 1 0 0"),
                                      of(pictured, "colour_op_ex source1 src_manual src_current 1 0 0")}) {
    EXPECT_EQ(other.diffuse->value[2], 1.0f);
    EXPECT_EQ(other.lost, std::set<std::string>{"colour_op_ex"});
  }
}

TEST(GazeboMaterial, ANormalMapOfAShaderIsNoColour) {
  const std::string shader =
      "fragment_program_ref Waves {\n param_named deepColor float4 0 0.05 0.2 1\n param_named BumpMap int "
      "0\n "
      "param_named cubeMap int 1\n }\n";
  const std::string bumps = "texture_unit {\n texture bumps.dds\n scale 0.1 0.1\n }\n";
  const auto of = [](const std::string& pass) {
    return parseMaterialScript("material A { technique { pass {\n" + pass + "} } }\n", "A").value();
  };
  for (const ScriptMaterial& waves : {of(shader + bumps), of(bumps + shader)}) {
    EXPECT_FALSE(waves.texture);
    EXPECT_FALSE(waves.texture_scale);
    EXPECT_FALSE(waves.diffuse);
    EXPECT_EQ(waves.lost, (std::set<std::string>{"deepColor, a colour of a shader", "fragment_program_ref",
                                                 "texture bumps.dds, a normal map of a shader"}));
  }
  const ScriptMaterial painted =
      of("diffuse 1 0 0\n" + shader + bumps + "texture_unit {\n texture a.png\n }\n");
  EXPECT_EQ(painted.texture, "a.png");
  EXPECT_EQ(painted.diffuse->value[0], 1.0f);
  EXPECT_TRUE(painted.tints);
  EXPECT_EQ(of(bumps).texture, "bumps.dds");  // which nothing tells
}

TEST(GazeboMaterial, InheritsWhatItDoesNotSet) {
  const auto sand = parseMaterialScript(kScript, "Sand");
  ASSERT_TRUE(sand && sand->texture && sand->diffuse);
  EXPECT_EQ(*sand->texture, "sand.png");
  EXPECT_EQ(sand->diffuse->value[0], 1.0f);
  EXPECT_TRUE(sand->alpha_rejection);
}

}  // namespace
}  // namespace sunlit::scene
