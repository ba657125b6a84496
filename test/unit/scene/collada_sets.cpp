// Sets of texture coordinates of COLLADA.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include "scene/collada_sets.h"
#include "support/needs.h"
#include "unit/scene/collada_triangle.h"
#include "unit/scene/scene_files.h"

namespace sunlit::scene {
namespace {

class ColladaSets : public SceneFiles {
 protected:
  /// s of the coordinates of its colour.
  float colorAt(const std::string& text) const {
    writeTexture("paint.png");
    const Scene scene = load(write("m.dae", text), {});
    EXPECT_TRUE(scene.warnings.empty()) << scene.warnings[0];
    return scene.meshes.at(0).texture_coordinates.at(0).x();
  }
};

TEST_F(ColladaSets, AreThoseThatMaterialsAreBoundTo) {
  const std::string both = colladaInput("u", 0) + colladaInput("w", 1);
  EXPECT_EQ(colorAt(colladaTriangle(colladaTexture("diffuse", "A"), both, colladaBinding("A", 0))), 0.0f);
  EXPECT_EQ(colorAt(colladaTriangle(colladaTexture("diffuse", "A"), both, colladaBinding("A", 1))), 1.0f);
  EXPECT_EQ(colorAt(colladaTriangle(colladaTexture("diffuse", "A7"), both, colladaBinding("A7", 1))), 1.0f);
  EXPECT_EQ(colorAt(colladaTriangle(colladaTexture("diffuse", "A"), both, "")), 0.0f);
  EXPECT_EQ(colorAt(colladaTriangle(colladaTexture("diffuse", "A"), both, colladaBinding("A", 5))), 0.0f)
      << "there is no such set";
}

TEST_F(ColladaSets, MayBeginAtOneOrHaveGaps) {
  const std::string from_one = colladaInput("u", 1) + colladaInput("w", 2);
  EXPECT_EQ(colorAt(colladaTriangle(colladaTexture("diffuse", "A"), from_one, colladaBinding("A", 1))), 0.0f);
  EXPECT_EQ(colorAt(colladaTriangle(colladaTexture("diffuse", "A"), from_one, colladaBinding("A", 2))), 1.0f);
  EXPECT_EQ(
      colorAt(colladaTriangle(colladaTexture("diffuse", "A"), colladaInput("w", 3), colladaBinding("A", 3))),
      1.0f);
}

TEST_F(ColladaSets, OfEachTextureAreItsOwn) {
  writeTexture("paint.png");
  const Scene scene =
      load(write("m.dae", colladaTriangle(colladaTexture("emission", "B") + colladaTexture("diffuse", "A"),
                                          colladaInput("u", 0) + colladaInput("w", 1),
                                          colladaBinding("A", 0) + colladaBinding("B", 1))),
           {});
  const Mesh& mesh = scene.meshes.at(0);
  EXPECT_EQ(mesh.texture_coordinates.at(0).x(), 0.0f);
  ASSERT_EQ(scene.materials.at(static_cast<std::size_t>(mesh.material)).emission_map.coordinates, 1);
  EXPECT_EQ(mesh.more_texture_coordinates.at(0).at(0).x(), 1.0f);
}

// Corners of two triangles that are one but for the second set, as pictures of a whole house have it.
TEST_F(ColladaSets, KeepVerticesApartThatDifferInTheSecond) {
  std::string text = colladaTriangle(colladaTexture("diffuse", "A"),
                                     colladaInput("u", 0) + colladaInput("w", 1), colladaBinding("A", 1));
  const auto replace = [&text](const std::string& from, const std::string& to) {
    text.replace(text.find(from), from.size(), to);
  };
  replace("count='1'>", "count='2'>");
  replace("<p>0 0 0 1 1 1 2 2 2</p>", "<p>0 0 0 1 1 1 2 2 2 0 0 0 1 1 0 2 2 0</p>");
  replace("1 0 1 0 1 1", "0 0.25 0 0.5 0 0.75");
  writeTexture("paint.png");
  const Scene scene = load(write("m.dae", text), {});
  std::vector<float> of_corners;
  for (const Mesh& mesh : scene.meshes) {
    for (const auto& triangle : mesh.triangles)
      for (const std::uint32_t corner : triangle)
        of_corners.push_back(1.0f - mesh.texture_coordinates.at(corner).y());
  }
  std::sort(of_corners.begin(), of_corners.end());
  EXPECT_EQ(of_corners, (std::vector<float>{0.25f, 0.25f, 0.25f, 0.25f, 0.5f, 0.75f}));
}

TEST_F(ColladaSets, OfAnotherMaterialAreTheFirst) {
  SKIP_WITHOUT_SDF();
  writeTexture("paint.png");
  write("m.dae", colladaTriangle(colladaTexture("diffuse", "A"), colladaInput("u", 0) + colladaInput("w", 1),
                                 colladaBinding("A", 1)));
  const auto withMaterial = [&](const std::string& material) {
    return load(write("w.world",
                      "<sdf version='1.9'><world name='w'><model name='m'><link name='l'><visual name='v'>"
                      "<geometry><mesh><uri>m.dae</uri></mesh></geometry>" +
                          material + "</visual></link></model></world></sdf>"),
                {})
        .meshes.at(0);
  };
  const std::string pbr = "<material><pbr><metal><albedo_map>paint.png</albedo_map></metal></pbr></material>";
  for (const auto& [material, s] : {std::pair{std::string(), 1.0f}, {pbr, 0.0f}}) {
    EXPECT_EQ(withMaterial(material).texture_coordinates.at(0).x(), s);
    EXPECT_TRUE(withMaterial(material).more_texture_coordinates.empty());
  }
}

TEST(ColladaSet, GetsSetsThatPrimitivesLackAndNoOthers) {
  const std::string start = "<triangles><!-- <input semantic='TEXCOORD' offset='9' set='7'> -->";
  const std::string one = "<input semantic='TEXCOORD' source='#u' offset='1' set='1'/>";
  EXPECT_EQ(withKnownSets(start + one + "<p>1</p></triangles>"),
            start + "<input semantic=\"TEXCOORD\" source=\"#u\" offset=\"1\" set=\"0\"/>" + one +
                "<p>1</p></triangles>");
  const std::string whole = "<triangles>" + colladaInput("u", 0) + colladaInput("w", 1) + "<p/></triangles>";
  EXPECT_EQ(withKnownSets(whole + whole), whole + whole);
}

}  // namespace
}  // namespace sunlit::scene
