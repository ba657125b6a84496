// Where SDF puts things.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "unit/scene/measure.h"
#include "unit/scene/scene_files.h"
#include "unit/scene/sdf_texts.h"

namespace sunlit::scene {
namespace {

// Poses come from sines and cosines of typed angles and end as floats of a few metres.
constexpr float kTolerance = 2e-6f;

class Sdf : public SceneFiles {
 protected:
  Scene loaded(const std::string& text, const SearchPath& search_path = {}) {
    return load(write("test.world", text), search_path);
  }
  static void expectBounds(const Scene& scene, const Eigen::Vector3f& low, const Eigen::Vector3f& high) {
    const Eigen::AlignedBox3f box = boundsOf(scene);
    EXPECT_LT((box.min() - low).norm(), kTolerance) << box.min().transpose();
    EXPECT_LT((box.max() - high).norm(), kTolerance) << box.max().transpose();
  }
};

TEST_F(Sdf, PosesOfModelLinkAndVisualAddUp) {
  const Scene scene =
      loaded(world("<model name='m'><pose>10 0 0 0 0 1.5707963267948966</pose><link name='l'>"
                   "<pose>0 0 5 0 0 0</pose>" +
                   boxVisual("1 0 0 0 0 0") + "</link></model>"));
  // The quarter turn carries the visual's metre east to the north and swaps the box's sides.
  expectBounds(scene, {8, 0, 2}, {12, 2, 8});
  EXPECT_EQ(scene.meshes[0].name, "m::l::v");
  EXPECT_TRUE(scene.warnings.empty());
}

TEST_F(Sdf, PosesRelativeToFramesAreResolved) {
  const Scene scene =
      loaded(world("<frame name='f'><pose>100 0 0 0 0 0</pose></frame><model name='m'>"
                   "<pose relative_to='f'>0 10 0 0 0 0</pose><frame name='g'><pose>0 0 50 0 0 0</pose>"
                   "</frame><link name='l'><pose relative_to='g'>0 0 1 0 0 0</pose>" +
                   boxVisual() + "</link></model>"));
  expectBounds(scene, {99, 8, 48}, {101, 12, 54});
}

TEST_F(Sdf, NestedModelsMoveWithTheirParents) {
  const Scene scene =
      loaded(world("<model name='outer'><pose>1 0 0 0 0 0</pose><model name='inner'>"
                   "<pose>0 1 0 0 0 0</pose><link name='l'>" +
                   boxVisual() + "</link></model></model>"));
  expectBounds(scene, {0, -1, -3}, {2, 3, 3});
  EXPECT_EQ(scene.meshes[0].name, "outer::inner::l::v");
}

// Down to the second the library is told what may be in models, below it reads that itself.
TEST_F(Sdf, NestedModelsMayBeDeep) {
  std::string model = "<link name='l'><pose>0 0 1 0 0 0</pose><light name='lamp' type='point'/>" +
                      boxVisual("0 0 1 0 0 0") + "</link>";
  std::string name = "l::v";
  for (const std::string depth : {"f", "e", "d", "c", "b", "a"}) {
    model = "<model name='" + depth + "'><static>1</static><pose relative_to='at'>1 0 0 0 0 0</pose>" +
            model + "<joint name='j' type='fixed'><parent>world</parent><child>l</child></joint></model>";
    model = "<frame name='at'><pose>0 1 0 0 0 0</pose></frame>" + model;
    name = depth + "::" + name;
  }
  const Scene scene = loaded(world(model));
  expectBounds(scene, {5, 4, -1}, {7, 8, 5});
  EXPECT_EQ(scene.meshes[0].name, name);
  EXPECT_EQ(scene.lamps.size(), 1u);
}

TEST_F(Sdf, IncludesAreFoundAndPlaced) {
  write("models/crate/model.config",
        "<?xml version='1.0'?><model><name>crate</name><sdf version='1.6'>model.sdf</sdf></model>");
  write("models/crate/model.sdf",
        "<?xml version='1.0'?><sdf version='1.6'><model name='crate'><link name='l'>" + boxVisual() +
            "</link></model></sdf>");
  const std::string include =
      "<include><uri>model://crate</uri><name>a</name><pose>0 0 3 0 0 0</pose></include>";
  // Once in the world, once in a model as SDF 1.6 worlds do it.
  const std::string text = world(include +
                                     "<model name='b'><include><uri>model://crate</uri></include>"
                                     "<pose>20 0 3 0 0 0</pose></model>",
                                 "1.6");
  const Scene beside = loaded(text);
  expectBounds(beside, {-1, -2, 0}, {21, 2, 6});
  EXPECT_EQ(beside.meshes.size(), 2u);

  std::filesystem::rename(pathOf("models"), pathOf("elsewhere"));
  expectBounds(loaded(text, SearchPath{{pathOf("elsewhere")}}), {-1, -2, 0}, {21, 2, 6});
}

TEST_F(Sdf, IncludesKeepToTheRulesOfPoses) {
  write("models/crate/model.config",
        "<?xml version='1.0'?><model><name>crate</name><sdf version='1.9'>model.sdf</sdf></model>");
  write("models/crate/model.sdf",
        "<?xml version='1.0'?><sdf version='1.9'><model name='crate'><pose>0 0 100 0 0 0</pose>"
        "<frame name='top'><pose>0 0 3 0 0 0</pose></frame><link name='l'>" +
            boxVisual() + "</link></model></sdf>");
  const auto include = [](const std::string& more) {
    return world("<include><uri>model://crate</uri>" + more + "</include>");
  };
  expectBounds(loaded(include("")), {-1, -2, 97}, {1, 2, 103});  // its own pose
  expectBounds(loaded(include("<pose>5 0 0 0 0 0</pose>")), {4, -2, -3},
               {6, 2, 3});  // which the include's replaces
  // The named frame is put at the pose, so the crate hangs below it.
  expectBounds(loaded(include("<placement_frame>top</placement_frame><pose>0 0 0 0 0 0</pose>")),
               {-1, -2, -6}, {1, 2, 0});
  // Something else stands on a frame of what is included.
  const Scene two =
      loaded(world("<include><uri>model://crate</uri><name>a</name><pose>0 0 3 0 0 0</pose></include>"
                   "<model name='b'><pose relative_to='a::top'>0 0 3 0 0 0</pose><link name='l'>" +
                   boxVisual() + "</link></model>"));
  expectBounds(two, {-1, -2, 0}, {1, 2, 12});
}

TEST_F(Sdf, IncludesWithinIncludesAndInModelsAloneAreFound) {
  write("models/crate/model.config",
        "<?xml version='1.0'?><model><name>crate</name><sdf version='1.9'>model.sdf</sdf></model>");
  write("models/crate/model.sdf",
        "<?xml version='1.0'?><sdf version='1.9'><model name='crate'><link name='l'>" + boxVisual() +
            "</link></model></sdf>");
  write("models/stack/model.config",
        "<?xml version='1.0'?><model><name>stack</name><sdf version='1.9'>model.sdf</sdf></model>");
  write("models/stack/model.sdf",
        "<?xml version='1.0'?><sdf version='1.9'><model name='stack'><pose>0 0 1 0 0 "
        "0</pose><include><uri>model://crate</uri>"
        "<name>upper</name><pose>0 0 6 0 0 "
        "0</pose></include><include><uri>model://crate</uri><name>lower</name></include>"
        "</model></sdf>");
  const Scene alone = load(pathOf("models/stack/model.sdf"), {});
  expectBounds(alone, {-1, -2, -2}, {1, 2, 10});
  EXPECT_EQ(alone.meshes.size(), 2u);
  const Scene included =
      loaded(world("<include><uri>model://stack</uri><name>s</name><pose>10 0 3 0 0 0</pose></include>"));
  expectBounds(included, {9, -2, 0}, {11, 2, 12});
  ASSERT_EQ(included.meshes.size(), 2u);
  EXPECT_EQ(included.meshes[0].name, "s::upper::l::v");
}

TEST_F(Sdf, MeshesAreScaledAndChosenByName) {
  write("models/two/meshes/two.obj",
        "o left\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\no right\nv 5 0 0\nv 6 0 0\nv 5 1 0\nf 4 5 6\n");
  const auto visual = [](const std::string& more) {
    return world(
        "<model name='m'><link name='l'><visual "
        "name='v'><geometry><mesh><uri>model://two/meshes/two.obj</uri>" +
        more + "</mesh></geometry></visual></link></model>");
  };
  expectBounds(loaded(visual("<scale>2 3 1</scale>")), {0, 0, 0}, {12, 3, 0});
  expectBounds(loaded(visual("<submesh><name>right</name></submesh>")), {5, 0, 0}, {6, 1, 0});
  expectBounds(loaded(visual("<submesh><name>right</name><center>true</center></submesh>")), {-0.5, -0.5, 0},
               {0.5, 0.5, 0});
}

TEST_F(Sdf, AMirroredMeshStillFacesOutwards) {
  write("t.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  const Scene scene =
      loaded(world("<model name='m'><link name='l'><visual name='v'><geometry><mesh><uri>t.obj</uri>"
                   "<scale>-1 1 1</scale></mesh></geometry></visual></link></model>"));
  const Mesh& mesh = scene.meshes.at(0);
  EXPECT_GT(faceVector(mesh, mesh.triangles[0]).z(), 0.0);
  EXPECT_GT(mesh.normals[0].z(), 0.0f);
}

TEST_F(Sdf, AModelAloneIsAWorld) {
  const Scene scene =
      load(write("model.sdf",
                 "<?xml version='1.0'?><sdf version='1.9'><model name='m'><pose>1 0 0 0 0 0</pose>"
                 "<link name='l'>" +
                     boxVisual() + "</link></model></sdf>"),
           {});
  expectBounds(scene, {0, -2, -3}, {2, 2, 3});
}

TEST_F(Sdf, CollisionsAreNotSeen) {
  const Scene scene =
      loaded(world("<model name='m'><static>true</static><link name='l'><collision name='c'><geometry><box>"
                   "<size>9 9 9</size></box></geometry></collision>" +
                   boxVisual() + "</link></model>"));
  expectBounds(scene, {-1, -2, -3}, {1, 2, 3});
}

TEST_F(Sdf, AMissingIncludeNamesTheFileAndThePlacesOnce) {
  std::string includes;
  for (int i = 0; i < 100; ++i)
    includes += "\n<include><uri>model://nowhere" + std::to_string(i) + "</uri></include>";
  const std::string file = write("test.world", world(includes));
  const std::string error = errorOf(file, SearchPath{{"/some/folder"}});
  EXPECT_EQ(error.find(file + ":2: there is no model://nowhere0, model://nowhere1, "), 0u) << error;
  EXPECT_NE(error.find("(100 in all); looked for in " + pathOf("").substr(0, pathOf("").size() - 1)),
            std::string::npos)
      << error;
  EXPECT_NE(error.find(" and /some/folder; --missing warn (of launch files missing:=warn, of nodes missing: "
                       "warn) draws the rest"),
            std::string::npos)
      << error;
  EXPECT_LT(error.size(), 500u);
}

TEST_F(Sdf, WhatIsOfAPackageThatRosDoesNotKnowSaysSo) {
  SearchPath search_path;
  search_path.package_folder = [](const std::string&) { return std::string(); };
  const std::string uri = "<uri>package://nope/models/box</uri>";
  for (const std::string& content :
       {"<include>" + uri + "</include>", "<model name='m'><link name='l'><visual name='v'><geometry><mesh>" +
                                              uri + "</mesh></geometry></visual></link></model>"}) {
    const std::string error = errorOf(write("test.world", world(content)), search_path);
    EXPECT_NE(error.find("; ROS knows no package nope, neither below ROS_PACKAGE_PATH nor in /usr/share: is "
                         "its workspace sourced?"),
              std::string::npos)
        << error;
  }
}

TEST_F(Sdf, MeshesAreFoundInMediaOfAResourcePath) {
  write("package/Media/models/land.obj", "v 0 0 0\nv 3 0 0\nv 0 1 0\nf 1 2 3\n");
  const std::string file =
      write("package/worlds/test.world",
            world("<model name='m'><link name='l'><visual name='v'><geometry><mesh><uri>file://land.obj</uri>"
                  "</mesh></geometry></visual></link></model>"));
  EXPECT_EQ(boundsOf(load(file, {})).max().x(), 3.0f);
}

TEST_F(Sdf, MeshesAreFoundByBackslashesAndEscapes) {
  write("models/häuser/my house.obj", "v 0 0 0\nv 3 0 0\nv 0 1 0\nf 1 2 3\n");
  for (const char* uri : {"model://häuser/my house.obj", "model://h%C3%A4user/my%20house.obj",
                          "model://häuser\\my house.obj", "häuser\\my%20house.obj"}) {
    const std::string file =
        write("test.world", world("<model name='m'><link name='l'><visual name='v'><geometry><mesh><uri>" +
                                  std::string(uri) + "</uri></mesh></geometry></visual></link></model>"));
    EXPECT_EQ(errorOf(file), "") << uri;
  }
}

TEST_F(Sdf, AnAddressOfAFolderOrOfNothingIsAnErrorThatSaysSo) {
  write("models/house/a.txt", "");
  const auto error_of = [&](const std::string& uri) {
    return errorOf(
        write("test.world", world("<model name='m'><link name='l'><visual name='v'><geometry><mesh><uri>" +
                                  uri + "</uri></mesh></geometry></visual></link></model>")));
  };
  EXPECT_EQ(error_of("model://house"), pathOf("models/house") + ": this is a folder, and no mesh");
  EXPECT_NE(error_of("model://").find("visual m::l::v: there is no mesh model://"), std::string::npos)
      << error_of("model://");
}

TEST_F(Sdf, AMissingMeshNamesTheVisualAndThePlaces) {
  const std::string file = write(
      "test.world", world("<model name='m'><link name='l'><visual name='v'><geometry><mesh>"
                          "<uri>model://house/house.dae</uri></mesh></geometry></visual></link></model>"));
  const std::string error = errorOf(file);
  EXPECT_EQ(
      error.find(file + ": visual m::l::v: there is no mesh model://house/house.dae; it was looked for as " +
                 pathOf("house/house.dae")),
      0u)
      << error;
  const std::string end =
      " in all); --missing warn (of launch files missing:=warn, of nodes missing: warn) draws the rest";
  EXPECT_EQ(error.find(end) + end.size(), error.size()) << error;
  EXPECT_EQ(std::count(error.begin(), error.end(), ','), 2) << error;  // of three places, and of this end
}

TEST_F(Sdf, BrokenXmlNamesTheLine) {
  const std::string file =
      write("test.world",
            "<?xml version='1.0'?>\n<sdf version='1.9'>\n<world name='w'>\n<model>\n</world>\n</sdf>");
  EXPECT_EQ(errorOf(file), file + ":4: the XML is broken here (XML_ERROR_MISMATCHED_ELEMENT)");
}

TEST_F(Sdf, AWrongValueNamesTheLine) {
  const std::string file =
      write("test.world",
            world("\n<model name='m'><link name='l'><visual name='v'><geometry><box><size>1 1 x</size>"
                  "</box></geometry></visual></link></model>"));
#if SUNLIT_SDFORMAT_VERSION < 12  // which names no lines
  EXPECT_EQ(errorOf(file).find(file + ": "), 0u) << errorOf(file);
  EXPECT_NE(errorOf(file).find("Unable to set value [1 1 x"), std::string::npos) << errorOf(file);
  return;
#endif
  EXPECT_EQ(
      errorOf(file),
      file + ":2: Error reading element <size> (Unknown error. Unable to set value [1 1 x ] for key[size])");
}

TEST_F(Sdf, AnythingElseIsNoWorld) {
  const std::string file = write("test.world", "<page/>");
  EXPECT_EQ(errorOf(file), file + ":1: there is no <sdf> element in this file");
}

TEST_F(Sdf, AWorldFileMayBeARobotOfUrdf) {
  const std::string good =
      write("test.world",
            "<robot name='r'><link name='l'><visual><geometry><box size='2 4 6'/></geometry>"
            "</visual><inertial><mass value='1'/><inertia ixx='1' ixy='0' ixz='0' iyy='1' "
            "iyz='0' izz='1'/></inertial></link></robot>");
  expectBounds(load(good, {}), {-1, -2, -3}, {1, 2, 3});
  const std::string bad = write("test.world", "<robot name='r'/>");
  EXPECT_EQ(errorOf(bad).find(bad + ": libsdformat cannot read this URDF: "), 0u) << errorOf(bad);
}

TEST_F(Sdf, AWorldWithNothingToSeeIsAnError) {
  const std::string file = write("test.world", world(""));
  EXPECT_EQ(errorOf(file), file + ": there is nothing to see in this file");
}

std::string state(const std::string& content) {
  return "<state world_name='w'>" + content + "</state>";
}

// A saved world tells twice where its models are: as they were written, and as they stood when it was saved.
TEST_F(Sdf, ModelsOfASavedWorldStandWhereItsStateSays) {
  const std::string model =
      "<model name='m'><pose>10 0 0 0 0 0</pose><link name='l'><pose>0 0 5 0 0 0</pose>" +
      boxVisual("1 0 0 0 0 0") + "</link></model>";
  for (const char* version : {"1.6", "1.9"}) {
    const Scene scene =
        loaded(world(model + state("<model name='m'><pose>-20 0 0 0 0 1.5707963267948966</pose>"
                                   "<scale>1 1 1</scale></model>"),
                     version));
    expectBounds(scene, {-22, 0, 2}, {-18, 2, 8});  // the visual's metre east points north
    EXPECT_TRUE(scene.warnings.empty());
  }
  // Poses of links are of the world, too.
  expectBounds(loaded(world(model + state("<model name='m'><pose>-20 0 0 0 0 0</pose><link name='l'>"
                                          "<pose>30 0 0 0 0 0</pose></link></model>"))),
               {30, -2, -3}, {32, 2, 3});
}

TEST_F(Sdf, NestedModelsAndIncludesStandAsTheStateSays) {
  expectBounds(
      loaded(world("<model name='outer'><pose>1 0 0 0 0 0</pose><model name='inner'><pose>0 1 0 0 0 0"
                   "</pose><link name='l'>" +
                   boxVisual() + "</link></model></model>" +
                   state("<model name='outer'><pose>5 0 0 0 0 0</pose><model name='inner'>"
                         "<pose>50 0 0 0 0 0</pose></model></model>"))),
      {49, -2, -3}, {51, 2, 3});
  write("models/box/model.config", "<model><name>box</name><sdf version='1.9'>model.sdf</sdf></model>");
  write("models/box/model.sdf",
        "<sdf version='1.9'><model name='box'><link name='l'>" + boxVisual() + "</link></model></sdf>");
  const Scene scene =
      loaded(world("<include><uri>model://box</uri><name>here</name><pose>1 0 0 0 0 0</pose></include>"
                   "<include><uri>model://box</uri><name>gone</name><pose>500 0 0 0 0 0</pose></include>" +
                   state("<model name='here'><pose>100 0 0 0 0 0</pose></model>"
                         "<deletions><name>gone</name></deletions>")),
             {{pathOf("models")}});
  expectBounds(scene, {99, -2, -3}, {101, 2, 3});
}

TEST_F(Sdf, WhatAStateInsertsIsInTheWorld) {
  write("models/box/model.config", "<model><name>box</name><sdf version='1.9'>model.sdf</sdf></model>");
  write("models/box/model.sdf",
        "<sdf version='1.9'><model name='box'><link name='l'>" + boxVisual() + "</link></model></sdf>");
  const Scene scene = loaded(world(
      "<model name='m'><link name='l'>" + boxVisual() + "</link></model>" +
      state("<insertions><model name='new'><link name='l'>" + boxVisual() +
            "</link></model><include><uri>model://box</uri><pose>0 50 0 0 0 0</pose></include></insertions>"
            "<model name='new'><pose>100 0 0 0 0 0</pose></model>")));
  EXPECT_EQ(scene.meshes.size(), 3u);
  expectBounds(scene, {-1, -2, -3}, {101, 52, 3});
  EXPECT_TRUE(scene.warnings.empty());
}

// By pencil: a box of 2 × 4 × 6 m, 1 m east of the model's frame, in a model twice as long and half as high.
TEST_F(Sdf, AStateScalesItsModels) {
  const std::string model = "<model name='m'><link name='l'>" + boxVisual("1 0 0 0 0 0") + "</link>";
  const std::string stated = "<model name='m'><pose>10 0 0 0 0 0</pose><scale>2 1 0.5</scale>";
  expectBounds(loaded(world(model + "</model>" + state(stated + "</model>"))), {10, -2, -1.5}, {14, 2, 1.5});
  // A quarter turn of the model turns the axes of the scale with it.
  expectBounds(
      loaded(world(model + "</model>" +
                   state("<model name='m'><pose>0 0 0 0 0 1.5707963267948966</pose><scale>2 1 0.5</scale>"
                         "</model>"))),
      {-2, 0, -1.5}, {2, 4, 1.5});
  // The place of a link, 3 m from its model's, is 6 m in the picture; so is that of a model within.
  const std::string link = "<link name='l'><pose>13 0 0 0 0 0</pose></link></model>";
  expectBounds(loaded(world(model + "</model>" + state(stated + link))), {16, -2, -1.5}, {20, 2, 1.5});
  const Scene within =
      loaded(world("<model name='m'><model name='n'><pose>3 0 0 0 0 0</pose><link name='l'>" + boxVisual() +
                   "</link></model></model>" + state(stated + "</model>")));
  expectBounds(within, {14, -2, -1.5}, {18, 2, 1.5});
  EXPECT_TRUE(within.warnings.empty());
}

TEST_F(Sdf, ABrokenPoseOfAStateIsNamed) {
  EXPECT_EQ(
      errorOf(write("test.world", world("<model name='m'><link name='l'>" + boxVisual() + "</link></model>" +
                                        state("<model name='m'><pose>0 0 nan 0 0 0</pose></model>")))),
      pathOf("test.world") + ": m: its pose in <state> is not 6 finite numbers");
}

TEST_F(Sdf, ModelsOfAStateThatAreNotThereAreNamed) {
  const Scene scene = loaded(world("<model name='m'><link name='l'>" + boxVisual() + "</link></model>" +
                                   "<actor name='walker'/>" +
                                   state("<model name='other'><pose>0 0 0 0 0 0</pose></model>"
                                         "<model name='walker'><pose>0 0 0 0 0 0</pose></model>")));
  ASSERT_EQ(scene.warnings.size(), 2u);
  EXPECT_NE(scene.warnings[0].find("kinds that are not drawn: <actor>"), std::string::npos);
  EXPECT_EQ(scene.warnings[1], "1 models of the <state> are not in the world: other");
}

}  // namespace
}  // namespace sunlit::scene
