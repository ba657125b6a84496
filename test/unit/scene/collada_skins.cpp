// Where the skins of COLLADA files stand.
#include <gtest/gtest.h>

#include <string>

#include "unit/scene/measure.h"
#include "unit/scene/scene_files.h"

namespace sunlit::scene {
namespace {

std::string source(const std::string& id, const std::string& array, const std::string& accessor) {
  return "<source id='" + id + "'>" + array + "<technique_common><accessor source='#" + id + "a' " +
         accessor + "</accessor></technique_common></source>";
}

/// A triangle at the origin whose shape is bound 7 m up and 1 m to the left of a joint of that name, which
/// stands at (10, 5, 0); the node of the skin is far away.
std::string skin(const std::string& joint, const std::string& more_nodes = "",
                 const std::string& weights = "<vcount>1 1 1</vcount><v>0 0 0 0 0 0</v>") {
  return "<COLLADA xmlns='http://www.collada.org/2005/11/COLLADASchema' version='1.4.1'><asset>"
         "<up_axis>Z_UP</up_axis></asset><library_geometries><geometry id='g' name='g'><mesh>" +
         source("p", "<float_array id='pa' count='9'>0 0 0 1 0 0 0 1 0</float_array>",
                "count='3' stride='3'><param name='X' type='float'/><param name='Y' type='float'/>"
                "<param name='Z' type='float'/>") +
         "<vertices id='v'><input semantic='POSITION' source='#p'/></vertices><triangles count='1'>"
         "<input semantic='VERTEX' source='#v' offset='0'/><p>0 1 2</p></triangles></mesh></geometry>"
         "</library_geometries><library_controllers><controller id='c'><skin source='#g'>"
         "<bind_shape_matrix>1 0 0 0 0 1 0 0 0 0 1 7 0 0 0 1</bind_shape_matrix>" +
         source("j", "<Name_array id='ja' count='1'>bone</Name_array>",
                "count='1' stride='1'><param name='JOINT' type='name'/>") +
         source("m", "<float_array id='ma' count='16'>1 0 0 -1 0 1 0 0 0 0 1 0 0 0 0 1</float_array>",
                "count='1' stride='16'><param name='TRANSFORM' type='float4x4'/>") +
         source("w", "<float_array id='wa' count='1'>1</float_array>",
                "count='1' stride='1'><param name='WEIGHT' type='float'/>") +
         "<joints><input semantic='JOINT' source='#j'/><input semantic='INV_BIND_MATRIX' "
         "source='#m'/></joints>"
         "<vertex_weights count='3'><input semantic='JOINT' source='#j' offset='0'/>"
         "<input semantic='WEIGHT' source='#w' offset='1'/>" +
         weights +
         "</vertex_weights></skin></controller></library_controllers><library_visual_scenes>"
         "<visual_scene id='s'><node id='arm' name='arm'><translate>10 0 0</translate>"
         "<node id='bone' sid='bone' " +
         joint + " type='JOINT'><translate>0 5 0</translate></node></node>" + more_nodes +
         "<node id='n' name='n'><translate>99 0 0</translate><instance_controller url='#c'>"
         "<skeleton>#bone</skeleton></instance_controller></node></visual_scene></library_visual_scenes>"
         "<scene><instance_visual_scene url='#s'/></scene></COLLADA>";
}

class ColladaSkin : public SceneFiles {};

TEST_F(ColladaSkin, IsWhereItsJointHoldsItsShape) {
  const Scene scene = load(write("t.dae", skin("name='upper'")), {});
  EXPECT_TRUE(scene.warnings.empty()) << scene.warnings[0];
  EXPECT_LT((boundsOf(scene).min() - Eigen::Vector3f(9, 5, 7)).norm(), 1e-5f);
  EXPECT_LT((boundsOf(scene).max() - Eigen::Vector3f(10, 6, 7)).norm(), 1e-5f);
}

TEST_F(ColladaSkin, MayHaveBlanksBeforeItsNumbers) {
  for (const std::string blanks : {" ", "\n\t", "<!-- of each vertex -->\n"}) {
    const std::string weights = "<vcount>" + blanks + "1 1 1</vcount><v>" + blanks + "0 0 0 0 0 0</v>";
    const Scene scene = load(write("t.dae", skin("name='upper'", "", weights)), {});
    EXPECT_TRUE(scene.warnings.empty()) << scene.warnings[0];
    EXPECT_LT((boundsOf(scene).min() - Eigen::Vector3f(9, 5, 7)).norm(), 1e-5f);
    EXPECT_LT((boundsOf(scene).max() - Eigen::Vector3f(10, 6, 7)).norm(), 1e-5f);
  }
}

TEST_F(ColladaSkin, IsRefusedByWhatItIsWhereItsJointsHaveNoArray) {
  std::string text = skin("name='upper'");
  const std::string array = "source='#ja'";
  ASSERT_NE(text.find(array), std::string::npos);
  text.replace(text.find(array), array.size(), "source='#j'");
  const std::string error = errorOf(write("t.dae", text));
  EXPECT_NE(error.find("<input>: has an accessor that names no array"), std::string::npos) << error;
}

TEST_F(ColladaSkin, StandsAtItsNodeAndIsNamedWhereItsJointIsNotKnown) {
  for (const std::string& text : {skin("name='upper'", "<node id='o' name='upper'/>"), skin("")}) {
    const Scene scene = load(write("t.dae", text), {});
    EXPECT_LT((boundsOf(scene).min() - Eigen::Vector3f(99, 0, 0)).norm(), 1e-5f);
    ASSERT_EQ(scene.warnings.size(), 1u);
    EXPECT_EQ(scene.warnings[0],
              "1 skins have joints that cannot be told apart, they stand where their nodes do: n");
  }
}

/// `text` with a morph that begins with the triangle and ends with another, in the place of what is `in`.
std::string withMorph(std::string text, const std::string& in, const std::string& use) {
  const std::string geometries = "</library_geometries>", controllers = "<library_controllers>";
  const std::string weight = source("mt", "<IDREF_array id='mta' count='1'>h</IDREF_array>",
                                    "count='1' stride='1'><param name='MORPH_TARGET' type='IDREF'/>") +
                             source("mw", "<float_array id='mwa' count='1'>0.5</float_array>",
                                    "count='1' stride='1'><param name='MORPH_WEIGHT' type='float'/>");
  text.replace(text.find(in), in.size(), use);
  const std::size_t begin = text.find("<geometry id='g'");
  std::string other = text.substr(begin, text.find(geometries) - begin);
  other.replace(other.find("'g'"), 3, "'h'");
  text.insert(text.find(geometries), other);
  return text.insert(text.find(controllers) + controllers.size(),
                     "<controller id='mo'>\n<morph source='#g' method='NORMALIZED'>" + weight +
                         "<targets><input semantic='MORPH_TARGET' source='#mt'/><input "
                         "semantic='MORPH_WEIGHT' source='#mw'/></targets></morph></controller>");
}

// Assimp 5.2 reads no mesh of them.
TEST_F(ColladaSkin, AndNodesHaveTheBaseShapeOfMorphs) {
  const std::string instance =
      "<instance_controller url='#c'><skeleton>#bone</skeleton></instance_controller>";
  const std::string warning = "1 meshes have morphs, which are left out: they have their base shape: mo";
  for (const std::string use :
       {"<instance_controller url='#mo'/>",
        "<instance_controller url='#mo'><skeleton>#n</skeleton></instance_controller>"}) {
    const Scene scene = load(write("t.dae", withMorph(skin("name='upper'"), instance, use)), {});
    ASSERT_EQ(scene.triangleCount(), 1u);
    EXPECT_LT((boundsOf(scene).min() - Eigen::Vector3f(99, 0, 0)).norm(), 1e-5f);
    ASSERT_EQ(scene.warnings.size(), 1u);
    EXPECT_EQ(scene.warnings[0], warning);
  }
  const Scene scene =
      load(write("t.dae", withMorph(skin("name='upper'"), "<skin source='#g'>", "<skin source='#mo'>")), {});
  ASSERT_EQ(scene.triangleCount(), 1u);
  EXPECT_LT((boundsOf(scene).min() - Eigen::Vector3f(9, 5, 7)).norm(), 1e-5f);
  ASSERT_EQ(scene.warnings.size(), 1u);
  EXPECT_EQ(scene.warnings[0], warning);
}

}  // namespace
}  // namespace sunlit::scene
