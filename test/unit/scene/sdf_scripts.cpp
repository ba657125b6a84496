// Where scripts of Gazebo classic and their pictures are found.
#include <gtest/gtest.h>

#include <string>

#include "unit/scene/scene_files.h"

namespace sunlit::scene {
namespace {

class SdfScripts : public SceneFiles {
 protected:
  /// Of a box with a <script> of these addresses, in worlds/w.world; "share" is in the search path.
  Scene loaded(const std::string& name, const std::string& uris) const {
    return load(
        write("worlds/w.world",
              "<?xml version='1.0'?><sdf version='1.6'><world name='w'><model name='m'><link name='l'>"
              "<visual name='v'><geometry><box><size>1 1 1</size></box></geometry><material><script>" +
                  uris + "<name>" + name +
                  "</name></script></material></visual></link></model></world></sdf>"),
        {{pathOf("share")}});
  }
  static const Material& look(const Scene& scene) {
    return scene.materials.at(static_cast<std::size_t>(scene.meshes.at(0).material));
  }
  static std::string script(const std::string& name, const std::string& body) {
    return "material " + name + "\n{ technique { pass {\n" + body + "\n} } }\n";
  }
  static std::string pictured(const std::string& picture) {
    return "texture_unit {\n texture " + picture + "\n }";
  }
  static std::string uri(const std::string& address) { return "<uri>" + address + "</uri>"; }
};

const std::string kNoSuchScript = "<uri>file://media/materials/scripts/gazebo.material</uri>";

TEST_F(SdfScripts, AreFoundInMediaOfTheSearchPathAndAboveTheWorld) {
  write("share/media/materials/scripts/own.material", script("My/Red", "diffuse 1 0 0 1"));
  write("media/materials/scripts/near.material", script("My/Blue", "diffuse 0 0 1 1"));
  const Scene red = loaded("My/Red", kNoSuchScript), blue = loaded("My/Blue", "");
  EXPECT_TRUE(red.warnings.empty()) << red.warnings[0];
  EXPECT_TRUE((look(red).base_color.value == Eigen::Array3f(1, 0, 0)).all());
  EXPECT_TRUE(blue.warnings.empty()) << blue.warnings[0];
  EXPECT_TRUE((look(blue).base_color.value == Eigen::Array3f(0, 0, 1)).all());
  EXPECT_EQ(loaded("My/Green", kNoSuchScript).warnings,
            std::vector<std::string>{
                "1 material scripts are not known, a neutral material takes their place: My/Green"});
}

TEST_F(SdfScripts, MayStandBesideFoldersOfSuchNames) {
  write("share/m/scripts/a.material/readme.txt", "My/Paint");
  write("share/m/scripts/own.material", script("My/Paint", "diffuse 0 1 0 1"));
  EXPECT_EQ(look(loaded("My/Paint", uri("model://m/scripts"))).base_color.value[1], 1.0f);
}

TEST_F(SdfScripts, BesideOthersThatCannotBeReadAreFound) {
  const std::string utf16("\xff\xfem\0a\0t\0", 8);
  write("share/m/scripts/._own.material", utf16);  // as macOS leaves one of each
  write("share/m/scripts/broken.material", utf16);
  write("share/m/scripts/own.material", script("My/Paint", "diffuse 0 1 0 1"));
  const Scene scene = loaded("My/Paint", uri("model://m/scripts"));
  EXPECT_EQ(look(scene).base_color.value[1], 1.0f);
  ASSERT_EQ(scene.warnings.size(), 1u);
  EXPECT_EQ(scene.warnings[0].find("1 material scripts cannot be read: " +
                                   pathOf("share/m/scripts/broken.material")),
            0u)
      << scene.warnings[0];
}

TEST_F(SdfScripts, OfTheAddressesComeBeforeThoseOfMedia) {
  write("share/media/materials/scripts/own.material", script("My/Paint", "diffuse 1 0 0 1"));
  write("share/m/scripts/own.material", script("My/Paint", "diffuse 0 1 0 1"));
  for (const std::string address : {"model://m/scripts", "model://m/scripts/own.material"})
    EXPECT_EQ(look(loaded("My/Paint", uri("model://none") + uri(address))).base_color.value[1], 1.0f);
}

TEST_F(SdfScripts, PicturesMayBeInOtherAddressesOrInMedia) {
  write("share/a/own.material", script("My/Wall", pictured("wall.png")));
  writeTexture("share/b/wall.png");
  const Scene other = loaded("My/Wall", uri("model://a/own.material") + uri("model://b"));
  EXPECT_TRUE(other.warnings.empty()) << other.warnings[0];
  EXPECT_EQ(look(other).base_texture, 0);
  const Scene none = loaded("My/Wall", uri("model://a"));
  ASSERT_EQ(none.warnings.size(), 1u);
  EXPECT_NE(none.warnings[0].find("wall.png of " + pathOf("share/a/own.material")), std::string::npos)
      << none.warnings[0];
  writeTexture("share/media/materials/textures/wall.png");
  EXPECT_TRUE(loaded("My/Wall", uri("model://a")).warnings.empty());
}

// OGRE's texture units modulate what is lit, unless the script says otherwise.
TEST_F(SdfScripts, TintTheirTextureByTheirDiffuseColour) {
  writeTexture("share/m/wall.png");
  const auto tint = [&](const std::string& body) {
    write("share/m/own.material", body);
    const Scene scene = loaded("My/Wall", uri("model://m"));
    EXPECT_EQ(look(scene).base_texture, 0) << body;
    return look(scene).base_color.value;
  };
  const auto inPass = [&](const std::string& pass, const std::string& in_unit = "") {
    return script("My/Wall", pass + "\ntexture_unit {\n texture wall.png\n " + in_unit + "\n }");
  };
  const auto isWhite = [](const Eigen::Array3f& color) { return (color == 1.0f).all(); };
  // ((0.5 + 0.055) / 1.055)^2.4 and ((0.8 + 0.055) / 1.055)^2.4
  const std::string diffuse = "ambient 0.1 0.1 0.1\ndiffuse 0.5 1 0.8 1";
  const auto isTinted = [](const Eigen::Array3f& color) {
    return ((color - Eigen::Array3f(0.21404f, 1.0f, 0.60383f)).abs() < 1e-4f).all();
  };
  EXPECT_TRUE(isTinted(tint(inPass(diffuse))));
  for (const char* modulate : {"colour_op modulate", "colour_op_ex modulate src_texture src_current"})
    EXPECT_TRUE(isTinted(tint(inPass(diffuse, modulate)))) << modulate;
  EXPECT_TRUE(isTinted(tint(inPass(diffuse) + "material My/Other { technique { pass {\nlighting off } } }")));
  EXPECT_TRUE(
      isTinted(tint(script("My/Base", diffuse) + "material My/Wall : My/Base\n{ technique { pass {\n" +
                    pictured("wall.png") + "\n} } }")));
  for (const char* none : {"", "diffuse vertexcolour", "diffuse 0 0 0 1"})
    EXPECT_TRUE(isWhite(tint(inPass(none)))) << none;
  EXPECT_TRUE(isWhite(tint(inPass(diffuse + "\nlighting off"))));
  for (const char* other :
       {"colour_op replace", "colour_op add", "colour_op_ex source1 src_texture src_current"})
    EXPECT_TRUE(isWhite(tint(inPass(diffuse, other)))) << other;
  EXPECT_TRUE(isWhite(tint("material My/Wall { technique { pass {\n" + pictured("wall.png") +
                           "\n}\npass {\n" + diffuse + "\n} } }")))
      << "of another pass";
  EXPECT_TRUE(isWhite(
      tint("material My/Wall : Gazebo/Bricks\n{ technique { pass {\n" + pictured("wall.png") + "\n} } }")))
      << "a colour that stands for a picture";
}

TEST_F(SdfScripts, LookAtAPicturesAlphaWhereTheySaySo) {
  writeTexture("share/a/wall.png", 3);
  const auto mode = [&](const std::string& words) {
    write("share/a/wall.material", script("My/Wall", words + "\n" + pictured("wall.png")));
    const Scene scene = loaded("My/Wall", uri("model://a"));
    EXPECT_TRUE(scene.warnings.empty()) << scene.warnings[0];
    return look(scene).alpha_mode;
  };
  EXPECT_EQ(mode(""), AlphaMode::kOpaque);
  EXPECT_EQ(mode("alpha_rejection always_pass 0"), AlphaMode::kOpaque);
  EXPECT_EQ(mode("alpha_rejection greater 128"), AlphaMode::kMask);
  EXPECT_EQ(mode("scene_blend alpha_blend"), AlphaMode::kBlend);
}

TEST_F(SdfScripts, InheritFromOtherFiles) {
  write("share/a/base.material", script("My/Base", "diffuse 0 1 0 1\n" + pictured("base.png")));
  writeTexture("share/a/base.png");
  write("share/b/child.material", "material My/Child : My/Base\n{\n}\n");
  write("share/a/near.material", "material My/Near : My/Base\n{\n}\n");
  const std::string both = uri("model://b") + uri("model://a");
  for (const auto& [name, uris] :
       {std::pair{"My/Child", both}, {"My/Near", uri("model://a/near.material")}}) {
    const Scene scene = loaded(name, uris);
    EXPECT_TRUE(scene.warnings.empty()) << scene.warnings[0];
    EXPECT_EQ(look(scene).base_texture, 0) << name;
  }
  const Scene orphan = loaded("My/Child", uri("model://b"));
  ASSERT_EQ(orphan.warnings.size(), 1u);
  EXPECT_NE(orphan.warnings[0].find("its parent My/Base, which no script has"), std::string::npos)
      << orphan.warnings[0];
}

TEST_F(SdfScripts, ThatInheritFromEachOtherEnd) {
  write("share/a/1.material", "material A : B\n{\n}\n");
  write("share/a/2.material", "material B : A\n{\n}\n");
  const Scene scene = loaded("A", uri("model://a"));
  ASSERT_EQ(scene.warnings.size(), 1u);
  EXPECT_NE(scene.warnings[0].find("its parent A, which no script has"), std::string::npos)
      << scene.warnings[0];
}

}  // namespace
}  // namespace sunlit::scene
