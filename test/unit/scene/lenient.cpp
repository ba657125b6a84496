// What a renderer has no use for stops no world, and what is missing stops it only if so wished.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <algorithm>
#include <string>
#include <vector>

#include "unit/scene/measure.h"
#include "unit/scene/scene_files.h"

namespace sunlit::scene {
namespace {

const std::string kBox = "<geometry><box><size>2 4 6</size></box></geometry>";
const std::string kVisual = "<visual name='v'>" + kBox + "</visual>";

std::string model(const std::string& content, const std::string& name = "m") {
  return "<model name='" + name + "'>" + content + "</model>";
}

std::string link(const std::string& content, const std::string& name = "l") {
  return "<link name='" + name + "'>" + content + "</link>";
}

class Lenient : public SceneFiles {
 protected:
  std::string worldFile(const std::string& content, const std::string& version = "1.9") const {
    return write("test.world", "<?xml version='1.0'?>\n<sdf version='" + version + "'>\n<world name='w'>\n" +
                                   content + "\n</world></sdf>");
  }
  Scene loaded(const std::string& content, const std::string& version = "1.9") const {
    SearchPath lenient;
    lenient.missing = Missing::kWarn;
    return load(worldFile(content, version), lenient);
  }
  void includeModel(const std::string& name, const std::string& content,
                    const std::string& version = "1.9") const {
    write("models/" + name + "/model.config",
          "<model><name>" + name + "</name><sdf version='" + version + "'>model.sdf</sdf></model>");
    write("models/" + name + "/model.sdf", "<sdf version='" + version + "'>\n" + content + "\n</sdf>");
  }
  static std::string include(const std::string& name, const std::string& more = "") {
    return "<include><uri>model://" + name + "</uri>" + more + "</include>";
  }
};

TEST_F(Lenient, WhatNoCameraSeesStopsNothing) {
  const std::vector<std::string> contents = {
      model(link("<inertial><mass>-1</mass><inertia><ixx>0</ixx></inertia></inertial>" + kVisual)),
      model(
          link("<inertial><mass>1</mass><inertia><ixx>1</ixx><iyy>9</iyy><izz>1</izz></inertia></inertial>" +
               kVisual)),
      model(link("<gravity>1000</gravity>" + kVisual)),
      model(link("<collision name='c'><geometry><box><size>0 0 x</size></box></geometry></collision>" +
                 kVisual)),
      model(link("<sensor name='s' type='none such'/><sensor name='s' type='camera'/>" + kVisual)),
      model(link(kVisual) + "<joint name='j' type='revolute'><parent>gone</parent><child>l</child></joint>"),
      model(link(kVisual) + "<joint name='l' type='fixed'><parent>world</parent><child>l</child></joint>"),
      model(link(kVisual) + "<plugin name='p'/><plugin/>"),
      "<physics type='none such'><max_step_size>x</max_step_size></physics><gravity>down</gravity>" +
          model(link(kVisual)),
  };
  for (const std::string& content : contents) {
    for (const char* version : {"1.4", "1.6", "1.7", "1.9"}) {
      const Scene scene = load(worldFile(content, version), {});
      EXPECT_EQ(scene.triangleCount(), 12u) << content;
      EXPECT_TRUE(scene.warnings.empty()) << scene.warnings[0];
    }
  }
}

TEST_F(Lenient, NamesThatAreReservedMissingOrTakenAreReplaced) {
  const Scene scene = loaded(model(link(kVisual + kVisual) + link(kVisual)) + model(link(kVisual)) +
                             model(link(kVisual, "__link__"), "world") + "<model><link><visual>" + kBox +
                             "</visual></link></model>");
  EXPECT_EQ(scene.meshes.size(), 6u);
  std::vector<std::string> names;
  for (const Mesh& mesh : scene.meshes) names.push_back(mesh.name);
  EXPECT_EQ(names, (std::vector<std::string>{"m::l::v", "m::l::v-2", "m::l-2::v", "m-2::l::v",
                                             "world-::__link__-::v", "model::link::visual"}));
  ASSERT_EQ(scene.warnings.size(), 1u);
  EXPECT_EQ(
      scene.warnings[0].find("8 names are missing, reserved or given twice, others stand in for them: "), 0u)
      << scene.warnings[0];
  EXPECT_NE(scene.warnings[0].find("m at " + pathOf("test.world") + ":4 is now m-2"), std::string::npos)
      << scene.warnings[0];
}

TEST_F(Lenient, AWorldMayHaveAnyName) {
  for (const char* name : {"world", "__world__", ""}) {
    const Scene scene = load(write("test.world", "<sdf version='1.6'><world name='" + std::string(name) +
                                                     "'>" + model(link(kVisual)) + "</world></sdf>"),
                             {});
    EXPECT_EQ(scene.triangleCount(), 12u);
    EXPECT_TRUE(scene.warnings.empty());
  }
}

TEST_F(Lenient, OfSeveralWorldsInAFileTheFirstIsDrawn) {
  const std::string others = "</world>\n<world name='moon'>" + model(link(kVisual), "crater") +
                             include("none") + "</world><world name='mars'>" + model(link(kVisual));
  const Scene scene = load(worldFile(model(link(kVisual)) + others), {});
  ASSERT_EQ(scene.meshes.size(), 1u);
  EXPECT_EQ(scene.meshes[0].name, "m::l::v");
  ASSERT_EQ(scene.warnings.size(), 1u);
  EXPECT_EQ(scene.warnings[0], "2 worlds were left out, of several in a file the first is drawn: moon at " +
                                   pathOf("test.world") + ":5; mars at " + pathOf("test.world") + ":5");
}

TEST_F(Lenient, WhatAnExplosionOfPhysicsCarriedFarAwayIsLeftOut) {
  const Scene scene =
      loaded(model(link(kVisual)) + model("<pose>1 1 343582.7 0 0 0</pose>" + link(kVisual), "n"));
  EXPECT_EQ(scene.meshes.size(), 1u);
  ASSERT_EQ(scene.warnings.size(), 1u);
  EXPECT_EQ(
      scene.warnings[0],
      "1 meshes reach farther than 100 km from the origin, what of them does was left out (coordinates of "
      "a map, such as UTM's, need an offset taken off): n::l::v");
}

TEST_F(Lenient, TheSameModelTwiceWithoutANameIsDrawnTwice) {
  includeModel("crate", model(link(kVisual), "crate"));
  const Scene scene = loaded(include("crate") + include("crate", "<pose>10 0 0 0 0 0</pose>"));
  EXPECT_FLOAT_EQ(boundsOf(scene).max().x(), 11.0f);
  EXPECT_EQ(scene.meshes.size(), 2u);
}

TEST_F(Lenient, WhatSdfDoesNotKnowAndWhatIsNotDrawnIsNamed) {
  const Scene scene =
      loaded("<actor name='walker'/><population name='trees'/><weather>wet</weather>" +
             model(link("<particle_emitter name='smoke' type='point'/><visuals/>" + kVisual)) +
             model("<lnk/>" + link("<other:thing/>" + kVisual), "n"));
  EXPECT_EQ(scene.triangleCount(), 24u);
  const std::string file = pathOf("test.world");
  EXPECT_EQ(
      scene.warnings,
      (std::vector<std::string>{
          "3 elements were left out, they are of kinds that are not drawn: <actor> walker of " + file +
              ":4; <population> trees of " + file + ":4; <particle_emitter> smoke of " + file + ":4",
          "3 elements were passed over, SDF has none of that name there: <weather> of " + file +
              ":4 in <world>; <visuals> of " + file + ":4 in <link>; <lnk> of " + file + ":4 in <model>"}));
}

TEST_F(Lenient, ANewerVersionIsReadAsTheNewestThatIsKnown) {
  for (const char* version : {"1.10", "1.12", "2.0", "", "new"}) {
    const Scene scene = loaded(model(link(kVisual)), version);
    EXPECT_EQ(scene.triangleCount(), 12u) << version;
    ASSERT_EQ(scene.warnings.size(), 1u) << version;
    EXPECT_EQ(
        scene.warnings[0].find("1 files are of a version of SDF that is not known, they are read as 1.9: "),
        0u);
  }
}

TEST_F(Lenient, AConeIsDrawn) {
  const auto cone = [](const std::string& size) {
    return model(link("<visual name='c'><geometry><cone>" + size + "</cone></geometry></visual>"));
  };
  for (const char* version : {"1.6", "1.9", "1.11"}) {
    const Scene scene = loaded(cone("<radius>2</radius><length>3</length>"), version);
    ASSERT_EQ(scene.meshes.size(), 1u);
    EXPECT_FLOAT_EQ(boundsOf(scene.meshes[0]).max().z(), 1.5f);
    EXPECT_FLOAT_EQ(boundsOf(scene.meshes[0]).max().x(), 2.0f);
    EXPECT_EQ(scene.warnings.size(), std::string(version) == "1.11" ? 1u : 0u);
  }
  EXPECT_FLOAT_EQ(boundsOf(loaded(cone("")).meshes.at(0)).max().z(), 0.5f);
  const Scene flat = loaded(cone("<radius>0</radius>") + model(link(kVisual), "n"));
  EXPECT_EQ(flat.triangleCount(), 12u);
  EXPECT_EQ(flat.warnings.at(0), "1 visuals have no shape that can be drawn: m::l::c");
}

TEST_F(Lenient, AShapeThatIsNotKnownLeavesOutItsVisual) {
  const Scene scene =
      loaded(model(link("<visual name='c'><geometry><torus><radius>1</radius></torus></geometry></visual>"
                        "<visual name='d'/>" +
                        kVisual)));
  EXPECT_EQ(scene.triangleCount(), 12u);
  const auto has = [&](const std::string& line) {
    return std::count(scene.warnings.begin(), scene.warnings.end(), line) == 1;
  };
  EXPECT_TRUE(has("2 visuals have no shape that can be drawn: m::l::c; m::l::d"));
  EXPECT_TRUE(has("1 elements were passed over, SDF has none of that name there: <torus> of " +
                  pathOf("test.world") + ":4 in <geometry>"));
}

TEST_F(Lenient, WhatNoCameraSeesStopsNothingOfOldVersionsEither) {
  const std::string collision =
      "<collision name='c'><geometry><sphere><radius>1</radius></sphere></geometry></collision>";
  for (const char* version : {"1.2", "1.3"}) {
    const std::string content =
        link("<inertial><mass>-1</mass></inertial>" + collision + collision + kVisual);
    EXPECT_EQ(load(worldFile(model(content), version), {}).triangleCount(), 12u) << version;
  }
}

TEST_F(Lenient, AScriptWithoutAFileIsGazebosOwn) {
  const auto painted = [](const std::string& script) {
    return model(
        link("<visual name='v'>" + kBox + "<material><script>" + script + "</script></material></visual>"));
  };
  const Scene red = loaded(painted("<name>Gazebo/Red</name>"));
  EXPECT_EQ(red.materials.at(static_cast<std::size_t>(red.meshes.at(0).material)).base_color.value[0], 1.0f);
  EXPECT_EQ(red.materials.at(static_cast<std::size_t>(red.meshes.at(0).material)).base_color.value[1], 0.0f);
  EXPECT_TRUE(red.warnings.empty());
  const Scene wood = loaded(painted("<name>Gazebo/Wood</name>"));
  ASSERT_EQ(wood.warnings.size(), 1u);
  EXPECT_EQ(
      wood.warnings[0],
      "1 materials have a picture that comes with Gazebo, a colour like it takes its place: Gazebo/Wood");
  EXPECT_EQ(loaded(painted("<uri>__default__</uri><name>Gazebo/Red</name>")).triangleCount(), 12u);
  EXPECT_EQ(loaded(painted("<uri>file://x.material</uri>")).triangleCount(), 12u);
  EXPECT_EQ(loaded(painted("<uri>__default__</uri><name>__default__</name>")).triangleCount(), 12u);
}

TEST_F(Lenient, ACommentMayStandBeforeTheDeclaration) {
  const std::string world = "<sdf version='1.6'><world name='w'>" + model(link(kVisual)) + "</world></sdf>";
  const std::string file = write("late.world", "<!-- a use -->\n<?xml version='1.0' ?>\n" + world);
  EXPECT_EQ(load(file, {}).triangleCount(), 12u);
}

TEST_F(Lenient, APoseMayStillNameAJoint) {
  // A joint stands in its child, here 10 m up, and half a metre beside it.
  const Scene scene =
      loaded(model("<link name='far'><pose>0 0 10 0 0 0</pose></link>"
                   "<joint name='j' type='fixed'><pose>0.5 0 0 0 0 "
                   "0</pose><parent>world</parent><child>far</child></joint>"
                   "<link name='near'><pose relative_to='j'>0 0 1 0 0 0</pose>" +
                   kVisual + "</link>"));
  EXPECT_FLOAT_EQ(boundsOf(scene).max().z(), 14.0f);
  EXPECT_FLOAT_EQ(boundsOf(scene).max().x(), 1.5f);
}

TEST_F(Lenient, APoseOfLessThanSixNumbersEndsInZeros) {
  const Scene scene =
      loaded(model("<pose>10 0 3</pose>" + link("<pose>1 0 0 0 0</pose>" + kVisual)) +
             model("<pose rotation_format='quat_xyzw'>1 2 3 0 0 0 1</pose>" + link(kVisual), "whole"));
  EXPECT_LT((boundsOf(scene).max() - Eigen::Vector3f(12, 4, 6)).norm(), 1e-6f);
  ASSERT_EQ(scene.warnings.size(), 1u);
  EXPECT_EQ(scene.warnings[0].find("2 poses have less than six numbers, the others are 0: 10 0 3 at "), 0u)
      << scene.warnings[0];
  EXPECT_NE(errorOf(worldFile(model("<pose>1 2 3 x</pose>" + link(kVisual)))), "");
}

TEST_F(Lenient, NumbersThatEndInSomethingElseAreNamed) {
  const Scene scene = loaded(model("<pose>1,5 2 3 0 0 0</pose>" + link(kVisual)) +
                             model("<pose>1.5 2 3 0 0 0</pose>" + link(kVisual), "whole"));
  ASSERT_EQ(scene.warnings.size(), 1u);
  EXPECT_EQ(
      scene.warnings[0].find("1 numbers end in what is none, and that is passed over (decimals have a point, "
                             "blanks part numbers): <pose>"),
      0u)
      << scene.warnings[0];
  EXPECT_NE(scene.warnings[0].find(" is 1,5 2 3 0 0 0"), std::string::npos) << scene.warnings[0];
}

TEST_F(Lenient, NumbersOfMetalsAndPlacesMayEndInSomethingElseAndPicturesMayBeginWithANumber) {
  const Scene scene = loaded(
      "<spherical_coordinates><latitude_deg>48,1</latitude_deg></spherical_coordinates>" +
      model(link("<visual name='v'>" + kBox +
                 "<material><pbr><metal><roughness>0,5</roughness></metal></pbr></material></visual>")));
  ASSERT_EQ(scene.warnings.size(), 1u);
  EXPECT_EQ(scene.warnings[0].find("2 numbers end in what is none"), 0u) << scene.warnings[0];
  write("h.pgm", "P2 3 3 9 0 0 0 0 9 0 0 0 0");
  for (const std::string& warning :
       loaded(model(link("<visual name='v'><geometry><heightmap><uri>h.pgm</uri><size>2 2 1</size><texture>"
                         "<diffuse>1_grass.png</diffuse><normal>1_flat.png</normal><size>1</size></texture>"
                         "</heightmap></geometry></visual>")))
           .warnings)
    EXPECT_EQ(warning.find("numbers end"), std::string::npos) << warning;
}

TEST_F(Lenient, LengthsBelowZeroAreTakenAsPositive) {
  const Scene scene = loaded(model(
      link("<visual name='a'><geometry><box><size>-2 4 6</size></box></geometry></visual>"
           "<visual name='b'><geometry><cylinder><radius>-1</radius><length>2</length></cylinder></geometry>"
           "</visual>")));
  ASSERT_EQ(scene.meshes.size(), 2u);
  for (const Mesh& mesh : scene.meshes) {
    EXPECT_GT(volumeOf(mesh), 0.0) << mesh.name << " is inside out";
  }
  ASSERT_EQ(scene.warnings.size(), 1u);
  EXPECT_EQ(scene.warnings[0].find("2 lengths are negative, they are taken as positive: <size>"), 0u)
      << scene.warnings[0];
  EXPECT_NE(scene.warnings[0].find(" is -2 4 6"), std::string::npos) << scene.warnings[0];
}

TEST_F(Lenient, GeometriesOfSeveralShapesAndOutlinesOfNothingAreNamed) {
  const std::string pole = "<sphere><radius>1</radius></sphere>";
  const Scene scene = loaded(
      model(link("<visual name='a'><geometry>" + pole + "<box><size>1 1 1</size></box></geometry></visual>") +
            link("<visual name='b'><geometry><polyline><point>0 0</point><point>1 0</point><height>1</height>"
                 "</polyline></geometry></visual>",
                 "k")));
  EXPECT_EQ(scene.meshes.size(), 1u);
  ASSERT_EQ(scene.warnings.size(), 2u);
  EXPECT_EQ(scene.warnings[0].find("1 geometries hold several shapes, one of them is drawn"), 0u)
      << scene.warnings[0];
  EXPECT_EQ(scene.warnings[1],
            "1 visuals have no shape that can be drawn: m::k::b (outlines that enclose nothing)");
}

// As Gazebo 9 saves models within models; libsdformat's converter asserts that the frame is one of the
// model's.
TEST_F(Lenient, APoseMayNameNoFrame) {
  const Scene scene =
      loaded(model(link(kVisual) + link("<pose frame=''>5 0 0 0 0 0</pose>" + kVisual, "a::l")), "1.6");
  EXPECT_EQ(boundsOf(scene).max().x(), 6.0f);
}

TEST_F(Lenient, AWorldWithNothingToSeeSaysWhy) {
  SearchPath lenient;
  lenient.missing = Missing::kWarn;
  const std::string odd = "<odd/><plugin name='p'/><light name='l' type='area'/>";
  const std::string walker = "<model name='m'><link name='l'><odder/><projector name='p'/></link></model>";
  const std::string error = errorOf(worldFile(odd + walker + include("nowhere")), lenient);
  EXPECT_EQ(error.find(pathOf("test.world") + ": there is nothing to see in this file; "
                                              "1 models are missing and were left out: model://nowhere; "),
            0u)
      << error;
  EXPECT_NE(error.find(" more"), std::string::npos) << error;
}

TEST_F(Lenient, AnErrorStillNamesTheLineOfTheFile) {
  const std::string broken =
      "<!-- two\nlines -->\n<physics>\n</physics>\n" + model(link(kVisual)) + "\n" +
      model(link("<visual name='v'><geometry>\n<box>\n<size>1 1 x</size></box></geometry></visual>"), "n");
#if SUNLIT_SDFORMAT_VERSION < 12
  GTEST_SKIP() << "libsdformat 9 names no lines";
#endif
  EXPECT_EQ(errorOf(worldFile(broken)).find(pathOf("test.world") + ":11: Error reading element <size>"), 0u)
      << errorOf(worldFile(broken));
  includeModel(
      "bad",
      "\n" + model(link("<visual name='v'><geometry><box><size>1 1 x</size></box></geometry></visual>")));
  EXPECT_EQ(errorOf(worldFile(include("bad"))).find(pathOf("models/bad/model.sdf") + ":3: Error reading"), 0u)
      << errorOf(worldFile(include("bad")));
}

TEST_F(Lenient, WhatLibsdformatAssertsIsAnErrorThatNamesTheFile) {
  // A frame of a nested model, as versions before 1.8 write it, attached to something outside: an assertion
  // of its converter, thrown as nothing that C++ knows.
#if SUNLIT_SDFORMAT_VERSION < 12
  GTEST_SKIP() << "libsdformat 9 asserts nothing of that";
#endif
  const std::string file =
      worldFile(model(link(kVisual) + link("", "a::l") + "<frame name='a::f' attached_to='l'/>"), "1.7");
  EXPECT_EQ(errorOf(file).find(file + ": libsdformat gives up: "), 0u) << errorOf(file);
}

TEST_F(Lenient, AFolderOfAModelsNameThatHoldsNoneIsPassedOver) {
  write("rover/CMakeLists.txt", "");
  includeModel("rover", model(link(kVisual), "rover"));  // in models/
  EXPECT_EQ(loaded(include("rover")).meshes.size(), 1u);
}

TEST_F(Lenient, AModelThatIncludesItselfIsAnError) {
  includeModel("a", model(link(kVisual) + include("b"), "a"));
  includeModel("b", model(link(kVisual) + include("a"), "b"));
  const std::string error = errorOf(worldFile(include("a")));
  EXPECT_EQ(error,
            pathOf("models/b/model.sdf") + ":2: " + pathOf("models/a/model.sdf") + " includes itself here");
}

// Ten times as many at each level, of which nothing need be seen.
TEST_F(Lenient, ModelsThatMultiplyAtEachLevelAreAnError) {
  includeModel("m0", model(link(""), "m0"));
  for (int i = 1; i <= 9; ++i) {
    std::string content;
    for (int k = 0; k < (i < 4 ? 10 : 20); ++k)
      content += include("m" + std::to_string(i - 1), "<name>n" + std::to_string(k) + "</name>") + "\n";
    includeModel("m" + std::to_string(i), model(content, "m" + std::to_string(i)));
  }
  // The third has 1111, of which the fourth has 18 before it has too many.
  EXPECT_EQ(errorOf(worldFile(include("m9"))),
            pathOf("models/m4/model.sdf") +
                ":20: the number of models up to here is 21110, but must be from 0 to 20000");
}

TEST_F(Lenient, MissingModelsAndMeshesAreLeftOutWithALineEach) {
  includeModel("broken", "<model");
  std::string content = model(link(kVisual) + include("nowhere"));
  for (int i = 0; i < 100; ++i)
    content += "\n" + include("nowhere", "<name>n" + std::to_string(i) + "</name>");
  content += include("broken") + include("elsewhere") + "<include><pose>0 0 0 0 0 0</pose></include>";
  for (const char* mesh : {"gone.dae", "bad.dae", "bad.obj"})
    content += model(link("<visual name='v'><geometry><mesh><uri>" + std::string(mesh) +
                          "</uri></mesh></geometry></visual>"),
                     mesh);
  write("bad.dae", "<COLLADA");
  write("bad.obj", "");
  const Scene scene = loaded(content);
  EXPECT_EQ(scene.triangleCount(), 12u);
  const auto begins = [&](const std::string& text) {
    return std::count_if(scene.warnings.begin(), scene.warnings.end(),
                         [&](const std::string& line) { return line.compare(0, text.size(), text) == 0; });
  };
  EXPECT_EQ(scene.warnings.size(), 6u);
  EXPECT_EQ(begins("2 models are missing and were left out: model://nowhere; model://elsewhere"), 1);
  EXPECT_EQ(begins("Models were looked for in " + pathOf("").substr(0, pathOf("").size() - 1)), 1);
  EXPECT_EQ(begins("1 models cannot be read and were left out: " + pathOf("models/broken/model.sdf") + ":"),
            1);
  EXPECT_EQ(begins("1 includes were passed over, they have no address: " + pathOf("test.world") + ":104"), 1);
  EXPECT_EQ(begins("1 meshes are missing and were left out: gone.dae of "), 1);
  EXPECT_EQ(begins("2 meshes cannot be read and were left out: " + pathOf("bad.dae")), 1);
}

TEST_F(Lenient, IncludesWithinIncludesStandWhereTheyShould) {
  includeModel("crate", model("<pose>0 0 100 0 0 0</pose>" + link(kVisual), "crate"));
  includeModel("stack",
               "<model name='stack' placement_frame='top'><pose>0 0 7 0 0 0</pose>"
               "<frame name='top'><pose>0 0 20 0 0 0</pose></frame>" +
                   include("crate", "<name>low</name><pose>5 0 0 0 0 1.5707963267948966</pose>") +
                   model(include("crate", "<name>high</name>"), "inner") + "</model>");
  // `top` is put 7 m up, so that the stack's own frame is at −13 m; the upper crate takes its own 100 m.
  const Scene own = loaded(include("stack"));
  ASSERT_EQ(own.meshes.size(), 2u);
  EXPECT_EQ(own.meshes[1].name, "stack::low::l::v");
  EXPECT_EQ(own.meshes[0].name, "stack::inner::high::l::v");
  EXPECT_LT((boundsOf(own.meshes[1]).min() - Eigen::Vector3f(3, -1, -16)).norm(), 1e-5f);
  EXPECT_LT((boundsOf(own.meshes[0]).min() - Eigen::Vector3f(-1, -2, 84)).norm(), 1e-5f);
  // Below a frame of what is included twice removed.
  const Scene on_top = loaded(include("stack", "<name>s</name>") +
                              model("<pose relative_to='s::low::l'>0 0 50 0 0 0</pose>" + link(kVisual)));
  EXPECT_NEAR(boundsOf(on_top.meshes[0]).min().z(), -13.0 + 50.0 - 3.0, 1e-5);
  EXPECT_NEAR(boundsOf(on_top.meshes[0]).min().x(), 5.0 - 2.0, 1e-5);  // turned as the crate
}

TEST_F(Lenient, AWorldMayBeAUrdf) {
  const std::string file =
      write("house.urdf",
            "<robot name='house'><link name='base'/><link name='wall'><visual><geometry><box size='2 4 "
            "6'/></geometry>"
            "</visual></link><joint name='j' type='fixed'><parent link='base'/><child link='wall'/>"
            "<origin xyz='10 0 3' rpy='0 0 1.5707963267948966'/></joint></robot>");
  const Scene scene = load(file, {});
  ASSERT_EQ(scene.meshes.size(), 1u);
  EXPECT_LT((boundsOf(scene).min() - Eigen::Vector3f(8, -1, 0)).norm(), 1e-5f);
  EXPECT_LT((boundsOf(scene).max() - Eigen::Vector3f(12, 1, 6)).norm(), 1e-5f);
  for (std::size_t i = 0; i < scene.meshes[0].triangles.size(); ++i) {
    const auto& triangle = scene.meshes[0].triangles[i];
    EXPECT_GT(faceVector(scene.meshes[0], triangle).dot(scene.meshes[0].normals[triangle[0]].cast<double>()),
              0.0);
  }
}

// Nobody writes to them: whoever opens one to read waits for ever.
TEST_F(Lenient, PipesThatAWorldNamesAreNone) {
  write("models/n/model.sdf", "<sdf version='1.9'>" + model(link(kVisual)) + "</sdf>");
  for (const char* name : {"p.sdf", "p.stl", "p.png", "models/n/model.config"})
    ASSERT_EQ(::mkfifo(pathOf(name).c_str(), 0600), 0);
  const auto visual = [](const std::string& name, const std::string& shape) {
    return model(link("<visual name='v'><geometry>" + shape + "</geometry></visual>"), name);
  };
  const Scene scene =
      loaded("<include><uri>p.sdf</uri></include>" + visual("a", "<mesh><uri>p.stl</uri></mesh>") +
             visual("b", "<heightmap><uri>p.png</uri></heightmap>") + include("n"));
  EXPECT_EQ(scene.triangleCount(), 12u);
  for (const char* name : {"p.sdf", "p.stl", "p.png"}) {
    const std::string refusal = pathOf(name) + ": this is a pipe or a device, and no file";
    EXPECT_TRUE(std::any_of(scene.warnings.begin(), scene.warnings.end(), [&](const std::string& warning) {
      return warning.find(refusal) != std::string::npos;
    })) << name;
  }
}

}  // namespace
}  // namespace sunlit::scene
