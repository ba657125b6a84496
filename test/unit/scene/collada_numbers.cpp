// COLLADA files whose counts and indices do not fit their arrays: Assimp would read what is not theirs.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "unit/scene/scene_files.h"

namespace sunlit::scene {
namespace {

const std::string kGood =
    "<COLLADA xmlns='http://www.collada.org/2005/11/COLLADASchema' version='1.4.1'><library_geometries>"
    "<geometry id='g' name='g'><mesh><source id='p'><float_array id='a' count='9'>0 0 0 1 0 0 0 1 "
    "0</float_array>"
    "<technique_common><accessor source='#a' count='3' stride='3'><param name='X' type='float'/><param "
    "name='Y' "
    "type='float'/><param name='Z' type='float'/></accessor></technique_common></source><vertices "
    "id='v'><input "
    "semantic='POSITION' source='#p'/></vertices>\n<triangles count='1'><input semantic='VERTEX' source='#v' "
    "offset='0'/><p>0 1 2</p></triangles></mesh></geometry></library_geometries><library_visual_scenes>"
    "<visual_scene id='s'><node id='n'><instance_geometry "
    "url='#g'/></node></visual_scene></library_visual_scenes>"
    "<scene><instance_visual_scene url='#s'/></scene></COLLADA>";

class ColladaNumbers : public SceneFiles {
 protected:
  /// The error of the good file in which `was` is `is`; without the file's name.
  std::string errorWith(const std::string& was, const std::string& is) const {
    std::string text = kGood;
    text.replace(text.find(was), was.size(), is);
    const std::string error = errorOf(write("t.dae", text));
    EXPECT_EQ(error.find(pathOf("t.dae") + ":"), 0u) << error;
    return error.substr(std::min(error.size(), pathOf("t.dae").size() + 1));
  }
};

TEST_F(ColladaNumbers, ThatFitAreRead) {
  EXPECT_EQ(load(write("t.dae", kGood), {}).triangleCount(), 1u);
}

TEST_F(ColladaNumbers, OfAnAccessorBeyondItsArrayAreRefused) {
  EXPECT_EQ(errorWith("stride='3'", "stride='2147483647'"),
            "1: <accessor>: reaches to value 4294967297 of 'a', which has 9");
  EXPECT_EQ(errorWith("count='9'", "count='0.5'"),
            "1: <float_array>: count is '0.5', but must be a whole number from 0 to 2147483647");
  EXPECT_EQ(errorWith("count='3'", "count='-1'"),
            "1: <accessor>: count is '-1', but must be a whole number from 0 to 2147483647");
}

TEST_F(ColladaNumbers, OfPrimitivesMustBeWholeAndAsManyAsCounted) {
  EXPECT_EQ(errorWith("0 1 2<", "0 1 nan<"),
            "2: <p>: holds what is no whole number from 0 to 2147483647 behind 2 others");
  EXPECT_EQ(errorWith("<p>0 1 2</p>", ""),
            "2: <triangles>: count is 1, for which there must be 1 <p>, and there are 0");
  EXPECT_EQ(errorWith("<triangles count='1'", "<triangles count='2147483647'"),
            "2: <triangles>: count is 2147483647, but its <p> have 3 corners");
  EXPECT_EQ(errorWith("offset='0'", "offset='2147483646'"),
            "2: <triangles>: count is 1, but its <p> have 0 corners");
  EXPECT_EQ(errorWith("'VERTEX'", "'NORMAL'"), "2: <triangles>: has no input of VERTEX");
  EXPECT_EQ(errorWith("'POSITION'", "'NORMAL'"),
            "2: <triangles>: its mesh has 0 inputs of POSITION, but must have one");
}

TEST_F(ColladaNumbers, OfCornersOfPolygonsAreNoMoreThanThereAre) {
  const std::string triangles = "<triangles count='1'>", end = "<p>0 1 2</p></triangles>";
  const auto polygons = [&](const std::string& counts) {
    std::string text = kGood;
    text.replace(text.find(triangles), triangles.size(), "<polylist count='1'>");
    return text.replace(text.find(end), end.size(), "<vcount>" + counts + "</vcount><p>0 1 2</p></polylist>");
  };
  EXPECT_EQ(load(write("t.dae", polygons("3")), {}).triangleCount(), 1u);
  EXPECT_EQ(errorOf(write("t.dae", polygons("2147483647"))),
            pathOf("t.dae") + ":2: <vcount>: asks for 2147483647 corners, but <p> has 3");
}

// SketchUp counts lines that it does not write. Memory for them would not be there.
TEST_F(ColladaNumbers, OfLinesMayBeMoreThanThereAre) {
  const std::string triangles = "<triangles count='1'>",
                    input = "<input semantic='VERTEX' source='#v' offset='0'/>",
                    other = "<input semantic='NORMAL' source='#p' offset='1'/>";
  const auto warningsWith = [&](const std::string& lines) {
    std::string text = kGood;
    const Scene scene = load(write("t.dae", text.insert(text.find(triangles), lines)), {});
    EXPECT_EQ(scene.triangleCount(), 1u) << lines;
    return scene.warnings;
  };
  const auto leftOut = [&](const std::string& lines) {
    return std::vector<std::string>{
        "1 files have lines and points, which have no surface and are left out: " + lines + " in " +
        pathOf("t.dae")};
  };
  for (const std::string count : {"3", "2147483647", "99999999999999999999999"}) {
    EXPECT_EQ(warningsWith("<!-- <lines> --><lines count='" + count + "'>" + input +
                           "<p>0 1\n<!-- --></p><p>1\t2 </p></lines>"),
              leftOut("2"))
        << count;
    EXPECT_EQ(
        warningsWith("<lines material='m' count='" + count + "'>" + input + other + "<p>0 0 1 1</p></lines>"),
        leftOut("1"))
        << count;
    EXPECT_EQ(warningsWith("<linestrips count='" + count + "'>" + input + "<p>0 1 2</p></linestrips>"),
              leftOut("2"))
        << count;
    for (const std::string none : {"", "<p></p>", "<p/>", "<p>0</p>"})
      EXPECT_TRUE(warningsWith("<lines count='" + count + "'>" + input + none + "</lines>").empty())
          << count << none;
  }
  EXPECT_EQ(errorWith(triangles, "<lines count='-1'/>" + triangles),
            "2: <lines>: count is '-1', but must be a whole number from 0 to 2147483647");
}

TEST_F(ColladaNumbers, OfNodesThatContainThemselvesAreRefused) {
  EXPECT_EQ(errorWith("<instance_geometry url='#g'/>", "<instance_node url='#n'/>"),
            "2: <node>: contains an instance of itself");
}

// By Assimp ids of a library come first, and then whatever in the scene has that id or name.
TEST_F(ColladaNumbers, OfNodesThatAreCalledAsWhatTheyShowAreNoCircle) {
  const auto withNodes = [](const std::string& library, const std::string& scene) {
    std::string text = kGood;
    const std::string end = "</library_geometries>",
                      node = "<node id='n'><instance_geometry url='#g'/></node>";
    text.replace(text.find(node), node.size(), scene);
    return text.replace(text.find(end), end.size(), end + "<library_nodes>" + library + "</library_nodes>");
  };
  const std::string wheel = "<node id='wheel'><instance_geometry url='#g'/></node>";
  const std::string inside = "><instance_node url='#wheel'/></node>";
  for (const std::string called : {"name", "sid"})
    EXPECT_EQ(load(write("t.dae", withNodes(wheel, "<node id='n' " + called + "='wheel'" + inside)), {})
                  .triangleCount(),
              1u);
  const std::string circle = pathOf("t.dae") + ":2: <node>: contains an instance of itself";
  const std::string second = "<node id='other'>" + wheel + "</node>";
  EXPECT_EQ(errorOf(write("t.dae", withNodes("<node id='wheel'" + inside, "<node id='n'" + inside))), circle);
  EXPECT_NE(errorOf(write("t.dae", withNodes(second, "<node id='n' name='wheel'" + inside))), "")
      << "which Assimp finds only below a scene, not below a node of a library";
  EXPECT_NE(errorWith("<instance_geometry url='#g'/>", "<instance_node url='#s'/>"), "") << "the scene";
}

// Assimp asserts not to meet it.
TEST_F(ColladaNumbers, OfSkewsAreRefused) {
  EXPECT_EQ(errorWith("<instance_geometry url='#g'/>", "<skew>30 1 0 0 0 1 0</skew>"),
            "2: <skew>: is not read: export the node with a <matrix>");
}

// Likewise; elsewhere they are mended.
TEST_F(ColladaNumbers, OfPicturesWithoutAnAddressBehindTheEndOfAnImageInACommentAreRefused) {
  EXPECT_EQ(errorWith("<library_geometries>",
                      "<library_images><image id='i'><!--</image>--><init_from/></image></library_images>"
                      "<library_geometries>"),
            "1: <init_from>: is empty: name a picture there, or leave out the image");
}

/// The good file with these nodes in its scene, and these libraries.
std::string withInstances(const std::string& nodes, const std::string& libraries) {
  std::string text = kGood;
  const std::string end = "</library_geometries>", scene_end = "</visual_scene>";
  text.replace(text.find(scene_end), scene_end.size(), nodes + scene_end);
  return text.replace(text.find(end), end.size(), end + libraries);
}

// Assimp says nothing of them, or refuses the file for one that is of another.
TEST_F(ColladaNumbers, OfInstancesThatShowNothingAreNamed) {
  for (const std::string instance :
       {"<instance_geometry> #gone", "<instance_geometry> parts.dae#g", "<instance_geometry> ",
        "<instance_controller> #gone", "<instance_controller> parts.dae#c", "<instance_node> #gone",
        "<instance_node> parts.dae#n", "<instance_light> #gone", "<instance_light> parts.dae#l"}) {
    const std::string element = instance.substr(0, instance.find('>')),
                      url = instance.substr(instance.find(' ') + 1);
    const std::string node = "\n<node id='o'>" + element + " url='" + url + "'/></node>";
    const Scene scene = load(write("t.dae", withInstances(node, "")), {});
    EXPECT_EQ(scene.triangleCount(), 1u) << instance;
    ASSERT_EQ(scene.warnings.size(), 1u) << instance;
    EXPECT_EQ(
        scene.warnings[0],
        "1 instances refer to nothing that is read from their file, and were left out: " + instance + ":3");
  }
}

TEST_F(ColladaNumbers, OfInstancesThatShowWhatIsNoMeshAreNamed) {
  std::string text = withInstances("<node id='o'><instance_geometry url='#h'/></node>", "");
  const std::string end = "</library_geometries>";
  text.insert(text.find(end), "<geometry id='h'><convex_mesh convex_hull_of='#g'/></geometry>");
  const Scene scene = load(write("t.dae", text), {});
  EXPECT_EQ(scene.triangleCount(), 1u);
  ASSERT_EQ(scene.warnings.size(), 1u);
  EXPECT_EQ(scene.warnings[0], "1 geometries are no <mesh>, and were left out: <convex_mesh> h:2");
}

TEST_F(ColladaNumbers, OfInstancesThatAreFoundOrNotShownAreNotNamed) {
  const std::string lost = "<node id='unused'><instance_geometry url='#gone'/></node>";
  const std::string libraries = "<library_nodes>" + lost +
                                "<node id='used'><instance_geometry url='#g'/></node></library_nodes>"
                                "<library_lights><light id='l'><technique_common><point><color>1 1 1</color>"
                                "</point></technique_common></light></library_lights>";
  const std::string nodes =
      "<node name='called'><instance_light url='#l'/></node><node><instance_node url='#used'/></node>"
      "<node><instance_node url='#called'/><instance_camera url='parts.dae#c'/></node>";
  const Scene scene = load(write("t.dae", withInstances(nodes, libraries)), {});
  EXPECT_EQ(scene.triangleCount(), 2u);
  for (const std::string& warning : scene.warnings)
    EXPECT_EQ(warning.find("instances"), std::string::npos) << warning;
}

// Assimp would show a solid of its own in their place.
TEST_F(ColladaNumbers, WithoutGeometryThereIsNothing) {
  const std::string error = errorWith("<instance_geometry url='#g'/>", "<instance_geometry url='#gone'/>");
  EXPECT_NE(error.find("there is not a triangle in this file"), std::string::npos) << error;
}

}  // namespace
}  // namespace sunlit::scene
