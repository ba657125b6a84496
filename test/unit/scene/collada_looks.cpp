// Effects of COLLADA: where their colour and opacity stand.
#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "scene/collada_effects.h"
#include "scene/color.h"
#include "unit/scene/collada_triangle.h"
#include "unit/scene/scene_files.h"

namespace sunlit::scene {
namespace {

void replaceIn(std::string& text, const std::string& from, const std::string& to) {
  ASSERT_NE(text.find(from), std::string::npos) << from;
  text.replace(text.find(from), from.size(), to);
}

class ColladaLooks : public SceneFiles {
 protected:
  Scene loaded(const std::string& text) const { return load(write("m.dae", text), {}); }
  static const Material& materialOf(const Scene& scene) {
    return scene.materials.at(static_cast<std::size_t>(scene.meshes.at(0).material));
  }
};

std::string withoutMaterials() {
  std::string text = colladaTriangle("<diffuse/>", colladaInput("u", 0) + colladaInput("w", 1), "");
  for (const std::string library : {"images", "effects", "materials"}) {
    const std::size_t begin = text.find("<library_" + library), end = text.find("</library_" + library);
    text.erase(begin, text.find('>', end) + 1 - begin);
  }
  const std::size_t begin = text.find("<bind_material>"), end = text.find("</bind_material>");
  return text.erase(begin, end + 16 - begin);
}

TEST_F(ColladaLooks, WithoutAMaterialAreNeutralAndWhiteUnderColoursOfVertices) {
  std::string text = withoutMaterials();
  EXPECT_TRUE((materialOf(loaded(text)).base_color.value == kNeutral.value).all());
  replaceIn(text, "<vertices id='v'>", colladaSource("c", "1 1 1 1 1 1 1 1 1", 3) + "<vertices id='v'>");
  replaceIn(text, "<p>", "<input semantic='COLOR' source='#c' offset='1'/><p>");
  const Scene scene = loaded(text);
  EXPECT_TRUE((materialOf(scene).base_color.value == 1.0f).all());
  EXPECT_TRUE((scene.meshes.at(0).colors.at(0) == 1.0f).all());
  // As programs call one of their own.
  text = colladaTriangle("<diffuse><color>0.6 0.6 0.6 1</color></diffuse>",
                         colladaInput("u", 0) + colladaInput("w", 1), "");
  replaceIn(text, "name='m'", "name='DefaultMaterial'");
  EXPECT_NEAR(materialOf(loaded(text)).base_color.value[0], 0.31855f, 1e-4f);
}

TEST_F(ColladaLooks, WithoutAMaterialHaveNoneOfTheOthersOfTheirFile) {
  const std::string whole = colladaTriangle("<diffuse><color>0.8 0 0 1</color></diffuse>",
                                            colladaInput("u", 0) + colladaInput("w", 1), "");
  EXPECT_GT(materialOf(loaded(whole)).base_color.value[0], 0.5f);
  for (const std::string none : {"", "material='unbound' "}) {
    std::string text = whole;
    replaceIn(text, "material='x' ", none);
    EXPECT_TRUE((materialOf(loaded(text)).base_color.value == kNeutral.value).all()) << none;
    replaceIn(text, "<vertices id='v'>", colladaSource("c", "1 0 0 1 0 0 1 0 0", 3) + "<vertices id='v'>");
    replaceIn(text, "<p>0 0 0 1 1 1 2 2 2",
              "<input semantic='COLOR' source='#c' offset='0'/><p>0 0 0 1 1 1 2 2 2");
    EXPECT_TRUE((materialOf(loaded(text)).base_color.value == 1.0f).all()) << none;
  }
  // Named by its id, where nothing binds it.
  std::string text = whole;
  replaceIn(text, "material='x' ", "material='m' ");
  EXPECT_GT(materialOf(loaded(text)).base_color.value[0], 0.5f);
}

// Assimp looked for it in a list that may be empty.
TEST_F(ColladaLooks, OfMaterialsWhoseEffectIsMissingAreAsWithoutOneAndNamed) {
  const std::string whole = colladaTriangle("<diffuse><color>0.8 0 0 1</color></diffuse>",
                                            colladaInput("u", 0) + colladaInput("w", 1), "");
  const std::size_t begin = whole.find("<instance_effect"), end = whole.find("/>", begin) + 2;
  const std::string effects = whole.substr(
      whole.find("<library_effects"), whole.find("</library_effects>") + 18 - whole.find("<library_effects"));
  for (const std::string instance : {"<instance_effect url='#gone'/>", "<instance_effect url='#'/>", ""}) {
    for (const bool none : {false, true}) {
      std::string text = whole;
      text.replace(begin, end - begin, instance);
      if (none) replaceIn(text, effects, "");
      const Scene scene = loaded(text);
      EXPECT_TRUE((materialOf(scene).base_color.value == kNeutral.value).all()) << instance << none;
      ASSERT_EQ(scene.warnings.size(), 1u) << instance << none;
      EXPECT_NE(scene.warnings[0].find("1 materials have no effect in their file"), std::string::npos)
          << scene.warnings[0];
    }
  }
}

// Section 7, "Determining Transparency (Opacity)": ZERO is where a picture is opaque.
TEST_F(ColladaLooks, PicturesOfTransparencyAreNoOpacity) {
  image::Rgba8Image picture(2, 1);
  picture.data = {255, 255, 255, 255, 0, 0, 0, 0};
  write("paint.png", image::encodePng(picture));
  const auto alphasOf = [&](const std::string& opaque, const std::string& share) {
    const std::string effect = "<diffuse><color>1 1 1 1</color></diffuse><transparent opaque='" + opaque +
                               "'><texture texture='s' texcoord='A'/></transparent><transparency><float>" +
                               share + "</float></transparency>";
    const Scene scene = loaded(colladaTriangle(effect, colladaInput("u", 0) + colladaInput("w", 1), ""));
    EXPECT_TRUE(scene.warnings.empty()) << scene.warnings[0];
    const Texels& rgba = scene.textures.at(0).rgba;
    return std::pair<int, int>(rgba[3], rgba[7]);
  };
  using Alphas = std::pair<int, int>;
  EXPECT_EQ(alphasOf("A_ONE", "1"), Alphas(255, 0));
  EXPECT_EQ(alphasOf("RGB_ONE", "1"), Alphas(255, 0));
  EXPECT_EQ(alphasOf("A_ZERO", "1"), Alphas(0, 255));
  EXPECT_EQ(alphasOf("RGB_ZERO", "1"), Alphas(0, 255));
  EXPECT_EQ(alphasOf("A_ZERO", "0.4"), Alphas(153, 255));
  EXPECT_EQ(alphasOf("RGB_ZERO", "0.4"), Alphas(153, 255));
  // Colours count, whatever alpha says.
  picture.data = {255, 255, 255, 0, 0, 0, 0, 255};
  write("paint.png", image::encodePng(picture));
  EXPECT_EQ(alphasOf("RGB_ZERO", "1"), Alphas(0, 255));
  EXPECT_EQ(alphasOf("A_ZERO", "1"), Alphas(255, 0));
}

TEST_F(ColladaLooks, PicturesThatLeaveNothingAreCalledByTheirFile) {
  image::Rgba8Image picture(1, 1);
  picture.data = {255, 255, 255, 255};
  write("paint.png", image::encodePng(picture));
  const Scene scene = loaded(
      colladaTriangle("<transparent opaque='RGB_ZERO'><texture texture='s' texcoord='A'/></transparent>",
                      colladaInput("u", 0) + colladaInput("w", 1), ""));
  EXPECT_EQ(materialOf(scene).alpha_mode, AlphaMode::kOpaque);
  ASSERT_EQ(scene.warnings.size(), 1u);
  EXPECT_NE(scene.warnings[0].find("m: " + pathOf("paint.png") + ", whose alpha is 0"), std::string::npos)
      << scene.warnings[0];
}

TEST_F(ColladaLooks, OneAndTheSamePictureOfColourAndTransparencyIsNamed) {
  writeTexture("paint.png", 2);
  const Scene scene = loaded(
      colladaTriangle(colladaTexture("diffuse", "A") +
                          "<transparent opaque='RGB_ZERO'><texture texture='s' texcoord='A'/></transparent>",
                      colladaInput("u", 0) + colladaInput("w", 1), ""));
  EXPECT_EQ(scene.textures.at(0).rgba[3], 0);
  ASSERT_EQ(scene.warnings.size(), 1u);
  EXPECT_NE(scene.warnings[0].find("a picture of colour that is one of transparency, too"), std::string::npos)
      << scene.warnings[0];
}

TEST_F(ColladaLooks, ColoursMayStandInParameters) {
  const std::string parameter = "<newparam sid='d'><float4>1 0\n0 1</float4></newparam>",
                    before = "<technique sid='c'>";
  for (const std::string reference : {"<param ref='d'/>", "<param ref='d'></param>"}) {
    std::string text = colladaTriangle("<diffuse>" + reference + "</diffuse>",
                                       colladaInput("u", 0) + colladaInput("w", 1), "");
    replaceIn(text, before, parameter + before);
    const Scene scene = loaded(text);
    EXPECT_TRUE(scene.warnings.empty()) << scene.warnings[0];
    EXPECT_TRUE((materialOf(scene).base_color.value == Eigen::Array3f(1.0f, 0.0f, 0.0f)).all());
    EXPECT_EQ(withParameters(text).find(reference), std::string::npos);
  }
  std::string glass = colladaTriangle(
      "<transparent opaque='A_ONE'><color>1 1 1 1</color></transparent>"
      "<transparency><param ref='t'/></transparency>",
      colladaInput("u", 0) + colladaInput("w", 1), "");
  replaceIn(glass, before, "<newparam sid='t'><float>0.75</float></newparam>" + before);
  EXPECT_FLOAT_EQ(materialOf(loaded(glass)).alpha, 0.75f);
  const std::string other =
      "<effect id='a'><newparam sid='d'><float>1</float></newparam></effect>"
      "<effect id='b'><param ref='d'/></effect>";
  EXPECT_EQ(withParameters(other), other) << "of another effect";
}

TEST_F(ColladaLooks, WithoutADiffuseColourAreNoGreyOfAssimp) {
  const std::string inputs = colladaInput("u", 0) + colladaInput("w", 1);
  const auto colorOf = [&](const std::string& text) { return materialOf(loaded(text)).base_color.value; };
  const std::string glow = "<emission><color>0 1 0 1</color></emission>",
                    grey = "<diffuse><color>0.6 0.6 0.6 1</color></diffuse>";
  for (const std::string diffuse : {"", "<diffuse/>", "<diffuse><param ref='none'/></diffuse>"}) {
    EXPECT_TRUE((colorOf(colladaTriangle(glow + diffuse, inputs, "")) == 0.0f).all()) << diffuse;
    std::string text = colladaTriangle("<ambient><color>1 0 0 1</color></ambient>" + diffuse, inputs, "");
    EXPECT_TRUE((colorOf(text) == kNeutral.value).all()) << diffuse;
    replaceIn(text, "<vertices id='v'>", colladaSource("c", "1 1 1 1 1 1 1 1 1", 3) + "<vertices id='v'>");
    replaceIn(text, "<p>", "<input semantic='COLOR' source='#c' offset='1'/><p>");
    EXPECT_TRUE((colorOf(text) == 1.0f).all()) << diffuse;
  }
  EXPECT_NEAR(colorOf(colladaTriangle(glow + grey, inputs, ""))[0], 0.31855f, 1e-4f);
}

TEST_F(ColladaLooks, OfMaterialsThatSetParametersAreNamed) {
  const auto warningsOf = [&](const std::string& set) {
    std::string text = colladaTriangle("<diffuse><param ref='d'/></diffuse>",
                                       colladaInput("u", 0) + colladaInput("w", 1), "");
    replaceIn(text, "<technique sid='c'>",
              "<newparam sid='d'><float4>1 0 0 1</float4></newparam><technique sid='c'>");
    replaceIn(text, "<instance_effect url='#e'/>",
              "<instance_effect url='#e'><setparam ref='" + set +
                  "'><float4>0 1 0 1</float4></setparam></instance_effect>");
    return loaded(text).warnings;
  };
  const std::vector<std::string> warnings = warningsOf("d");
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_NE(warnings[0].find("<setparam>, which is not read: m"), std::string::npos) << warnings[0];
  EXPECT_TRUE(warningsOf("of_another_profile").empty());
}

TEST_F(ColladaLooks, OfConstantShadingHaveTheColourOfTheirEmission) {
  writeTexture("paint.png");
  for (const bool pictured : {false, true}) {
    std::string text = colladaTriangle(
        pictured ? colladaTexture("emission", "A") : "<emission><color>0 1 0 1</color></emission>",
        colladaInput("u", 0) + colladaInput("w", 1), "");
    for (const std::string mark : {"<lambert>", "</lambert>"})
      replaceIn(text, mark, mark[1] == '/' ? "</constant>" : "<constant>");
    const Scene scene = loaded(text);
    const Material& look = materialOf(scene);
    EXPECT_TRUE((look.emission.value == 0.0f).all());
    EXPECT_FALSE(look.emission_map.given());
    EXPECT_EQ(look.base_texture != Material::kNoTexture, pictured);
    EXPECT_EQ(look.base_color.value[0], pictured ? 1.0f : 0.0f);
    EXPECT_EQ(look.base_color.value[1], 1.0f);
    ASSERT_EQ(scene.warnings.size(), 1u);
    EXPECT_NE(scene.warnings[0].find("<constant>, a colour without any light"), std::string::npos)
        << scene.warnings[0];
  }
}

}  // namespace
}  // namespace sunlit::scene
