// Effects of COLLADA: where their colour and opacity stand.
#include <gtest/gtest.h>

#include <string>

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

}  // namespace
}  // namespace sunlit::scene
