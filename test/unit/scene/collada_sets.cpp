// Sets of texture coordinates of COLLADA.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include "scene/collada_sets.h"
#include "support/needs.h"
#include "unit/scene/scene_files.h"

namespace sunlit::scene {
namespace {

std::string source(const std::string& id, const std::string& values, int stride) {
  const std::string names = stride == 3 ? "XYZ" : "ST";
  std::string parameters;
  for (const char name : names) parameters += std::string("<param name='") + name + "' type='float'/>";
  return "<source id='" + id + "'><float_array id='" + id + "-a' count='" + std::to_string(3 * stride) +
         "'>" + values + "</float_array><technique_common><accessor source='#" + id +
         "-a' count='3' stride='" + std::to_string(stride) + "'>" + parameters +
         "</accessor></technique_common></source>";
}

std::string coordinates(const std::string& id, int set) {
  return "<input semantic='TEXCOORD' source='#" + id + "' offset='" + (id == "u" ? "1" : "2") + "' set='" +
         std::to_string(set) + "'/>";
}

std::string bound(const std::string& name, int set) {
  return "<bind_vertex_input semantic='" + name + "' input_semantic='TEXCOORD' input_set='" +
         std::to_string(set) + "'/>";
}

/// A triangle whose set u has s = 0 everywhere, and w has s = 1.
std::string triangleOf(const std::string& effect, const std::string& inputs, const std::string& binds) {
  return "<?xml version='1.0'?><COLLADA xmlns='http://www.collada.org/2005/11/COLLADASchema' version='1.4.1'>"
         "<asset><up_axis>Z_UP</up_axis></asset><library_images><image "
         "id='i'><init_from>paint.png</init_from>"
         "</image></library_images><library_effects><effect id='e'><profile_COMMON><newparam "
         "sid='f'><surface "
         "type='2D'><init_from>i</init_from></surface></newparam><newparam "
         "sid='s'><sampler2D><source>f</source>"
         "</sampler2D></newparam><technique sid='c'><lambert>" +
         effect +
         "</lambert></technique></profile_COMMON></effect></library_effects><library_materials><material "
         "id='m' "
         "name='m'><instance_effect url='#e'/></material></library_materials><library_geometries><geometry "
         "id='g'>"
         "<mesh>" +
         source("p", "0 0 0 1 0 0 0 1 0", 3) + source("u", "0 0 0 0 0 1", 2) + source("w", "1 0 1 0 1 1", 2) +
         "<vertices id='v'><input semantic='POSITION' source='#p'/></vertices><triangles material='x' "
         "count='1'>"
         "<input semantic='VERTEX' source='#v' offset='0'/>" +
         inputs +
         "<p>0 0 0 1 1 1 2 2 2</p></triangles></mesh></geometry></library_geometries><library_visual_scenes>"
         "<visual_scene id='vs'><node id='n'><instance_geometry url='#g'><bind_material><technique_common>"
         "<instance_material symbol='x' target='#m'>" +
         binds +
         "</instance_material></technique_common></bind_material></instance_geometry></node></visual_scene>"
         "</library_visual_scenes><scene><instance_visual_scene url='#vs'/></scene></COLLADA>";
}

std::string textured(const std::string& part, const std::string& name) {
  return "<" + part + "><texture texture='s' texcoord='" + name + "'/></" + part + ">";
}

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
  const std::string both = coordinates("u", 0) + coordinates("w", 1);
  EXPECT_EQ(colorAt(triangleOf(textured("diffuse", "A"), both, bound("A", 0))), 0.0f);
  EXPECT_EQ(colorAt(triangleOf(textured("diffuse", "A"), both, bound("A", 1))), 1.0f);
  EXPECT_EQ(colorAt(triangleOf(textured("diffuse", "A7"), both, bound("A7", 1))), 1.0f);
  EXPECT_EQ(colorAt(triangleOf(textured("diffuse", "A"), both, "")), 0.0f);
  EXPECT_EQ(colorAt(triangleOf(textured("diffuse", "A"), both, bound("A", 5))), 0.0f)
      << "there is no such set";
}

TEST_F(ColladaSets, MayBeginAtOneOrHaveGaps) {
  const std::string from_one = coordinates("u", 1) + coordinates("w", 2);
  EXPECT_EQ(colorAt(triangleOf(textured("diffuse", "A"), from_one, bound("A", 1))), 0.0f);
  EXPECT_EQ(colorAt(triangleOf(textured("diffuse", "A"), from_one, bound("A", 2))), 1.0f);
  EXPECT_EQ(colorAt(triangleOf(textured("diffuse", "A"), coordinates("w", 3), bound("A", 3))), 1.0f);
}

TEST_F(ColladaSets, OfEachTextureAreItsOwn) {
  writeTexture("paint.png");
  const Scene scene = load(
      write("m.dae", triangleOf(textured("emission", "B") + textured("diffuse", "A"),
                                coordinates("u", 0) + coordinates("w", 1), bound("A", 0) + bound("B", 1))),
      {});
  const Mesh& mesh = scene.meshes.at(0);
  EXPECT_EQ(mesh.texture_coordinates.at(0).x(), 0.0f);
  ASSERT_EQ(scene.materials.at(static_cast<std::size_t>(mesh.material)).emission_map.coordinates, 1);
  EXPECT_EQ(mesh.more_texture_coordinates.at(0).at(0).x(), 1.0f);
}

// Corners of two triangles that are one but for the second set, as pictures of a whole house have it.
TEST_F(ColladaSets, KeepVerticesApartThatDifferInTheSecond) {
  std::string text =
      triangleOf(textured("diffuse", "A"), coordinates("u", 0) + coordinates("w", 1), bound("A", 1));
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
  write("m.dae",
        triangleOf(textured("diffuse", "A"), coordinates("u", 0) + coordinates("w", 1), bound("A", 1)));
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
  const std::string whole = "<triangles>" + coordinates("u", 0) + coordinates("w", 1) + "<p/></triangles>";
  EXPECT_EQ(withKnownSets(whole + whole), whole + whole);
}

}  // namespace
}  // namespace sunlit::scene
