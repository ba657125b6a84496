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

TEST(GazeboMaterial, ReadsHowLargeItsFirstTextureIs) {
  const auto of = [](const std::string& units) {
    const auto material = parseMaterialScript("material A { technique { pass {" + units + "} } }\n", "A");
    return material ? *material : ScriptMaterial();
  };
  const ScriptMaterial once = of("texture_unit {\n texture a.png\n scale 0.5 -2\n }");
  EXPECT_EQ(once.texture_scale[0], 0.5f);
  EXPECT_EQ(once.texture_scale[1], -2.0f);
  EXPECT_TRUE(once.lost.empty());
  // That of another texture is not rendered either.
  EXPECT_EQ(of("texture_unit {\n texture a.png\n }\n texture_unit {\n scale 3 3\n }").texture_scale[0], 1.0f);
  const ScriptMaterial none = of("texture_unit {\n scale 0 1\n }");
  EXPECT_EQ(none.texture_scale[1], 1.0f);
  EXPECT_EQ(none.lost.count("scale"), 1u);
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
