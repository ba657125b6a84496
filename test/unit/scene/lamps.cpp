// The lamps of worlds, mesh files and robots.
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "scene/scene_builder.h"
#include "sunlit/scene/robot.h"
#include "support/needs.h"
#include "unit/scene/scene_files.h"

namespace sunlit::scene {
namespace {

class LampFiles : public SceneFiles {
 protected:
  /// Of a world with one model, a ball, in whose link `in_link` stands, too.
  Scene worldWith(const std::string& in_world, const std::string& in_link = "") const {
    return load(
        write(
            "test.world",
            "<?xml version='1.0'?><sdf version='1.9'><world name='w'>" + in_world +
                "<model name='post'><pose>10 0 0 0 0 1.5707963</pose><link name='l'><pose>0 0 2 0 0 0</pose>"
                "<visual name='v'><geometry><sphere><radius>1</radius></sphere></geometry></visual>" +
                in_link + "</link></model></world></sdf>"),
        {});
  }
};

const std::string kSpot =
    "<light name='lamp' type='spot'><pose>1 0 0 0 0 0</pose><diffuse>1 0.5 0 1</diffuse><direction>1 0 "
    "-1</direction>"
    "<intensity>3</intensity><attenuation><range>20</range><constant>0.2</constant><linear>0.1</linear>"
    "<quadratic>0.01</quadratic></attenuation><spot><inner_angle>0.4</inner_angle><outer_angle>2.2</"
    "outer_angle>"
    "<falloff>2.1</falloff></spot><cast_shadows>false</cast_shadows></light>";

TEST_F(LampFiles, OfLinksStandInTheirFrameAndGoByTheirModel) {
  SKIP_WITHOUT_SDF();
  const Scene scene = worldWith("", kSpot);
  ASSERT_EQ(scene.lamps.size(), 1u);
  const Lamp& lamp = scene.lamps[0];
  EXPECT_EQ(lamp.name, "post::l::lamp");
  EXPECT_EQ(lamp.group, "post");
  EXPECT_LT((lamp.position - Eigen::Vector3f(10.0f, 1.0f, 2.0f)).norm(), 1e-5f);
  EXPECT_LT((lamp.direction - Eigen::Vector3f(0.0f, 1.0f, -1.0f).normalized()).norm(), 1e-6f);
  EXPECT_TRUE(lamp.relative);
  EXPECT_EQ(lamp.intensity.value[0], 3.0f);
  EXPECT_NEAR(lamp.intensity.value[1], 3.0f * 0.2140f, 2e-4f);  // a display value
  EXPECT_FLOAT_EQ(lamp.constant, 0.2f);
  EXPECT_FLOAT_EQ(lamp.linear, 0.1f);
  EXPECT_FLOAT_EQ(lamp.quadratic, 0.01f);
  EXPECT_FLOAT_EQ(lamp.range_m, 20.0f);
  EXPECT_TRUE(lamp.ends_sharply);
  EXPECT_FLOAT_EQ(lamp.inner_rad, 0.2f);  // SDF's are whole angles
  EXPECT_FLOAT_EQ(lamp.outer_rad, 1.1f);
  EXPECT_FLOAT_EQ(lamp.exponent, 2.1f);
  EXPECT_FALSE(lamp.casts_shadows);
}

TEST_F(LampFiles, OfTheWorldArePointsToo) {
  SKIP_WITHOUT_SDF();
  const Scene scene = worldWith(
      "<light name='bulb' type='point'><pose>1 2 3 0 0 0</pose><diffuse>1 1 1 1</diffuse>"
      "<attenuation><range>5</range><constant>1</constant></attenuation></light>");
  ASSERT_EQ(scene.lamps.size(), 1u);
  EXPECT_EQ(scene.lamps[0].group, "bulb");
  EXPECT_FALSE(scene.lamps[0].isSpot());
  EXPECT_EQ(scene.lamps[0].position, Eigen::Vector3f(1.0f, 2.0f, 3.0f));
  EXPECT_TRUE(scene.warnings.empty());
}

TEST_F(LampFiles, GazebosSunIsNamedAndLeftToOurs) {
  SKIP_WITHOUT_SDF();
  const Scene scene = worldWith("<light name='sun' type='directional'><direction>0 0 -1</direction></light>");
  EXPECT_TRUE(scene.lamps.empty());
  ASSERT_EQ(scene.warnings.size(), 1u);
  EXPECT_EQ(scene.warnings[0],
            "1 directional lights were not read: the sun of the sky takes their place: sun");
}

TEST_F(LampFiles, OfATypeThatSdfHasNotAreNamedAndStopNothing) {
  SKIP_WITHOUT_SDF();
  const Scene scene = worldWith(
      "\n<light name='panel' type='area'><pose>8 0 3 0 0 0</pose></light>\n<light name='bulb' type=' point'>"
      "<attenuation><range>5</range></attenuation></light>",
      "\n<light name='bare'/>\n<light type=''/>");
  ASSERT_EQ(scene.lamps.size(), 1u);
  EXPECT_EQ(scene.lamps[0].name, "bulb");
  EXPECT_EQ(scene.meshes.size(), 1u);
  const std::string file = pathOf("test.world");
  EXPECT_EQ(scene.warnings,
            (std::vector<std::string>{"3 lights were left out, they are of none of the types point, spot and "
                                      "directional: <light> panel of " +
                                      file + ":2 has type area; <light> bare of " + file +
                                      ":4 has no type; <light> of " + file + ":5 has no type"}));
}

TEST_F(LampFiles, OfNoTypeThatSdfHasStopNothingFromFilesOfTheirOwn) {
  SKIP_WITHOUT_SDF();
  write("models/panel/model.config", "<model><name>panel</name><sdf version='1.6'>model.sdf</sdf></model>");
  write("models/panel/model.sdf", "<sdf version='1.6'>\n<light name='panel' type='area'/></sdf>");
  const Scene scene = worldWith("<include><uri>model://panel</uri></include>");
  EXPECT_EQ(scene.meshes.size(), 1u);
  EXPECT_EQ(scene.warnings, (std::vector<std::string>{
                                "1 includes were left out, there is no model in them: model://panel at " +
                                    pathOf("test.world") + ":1",
                                "1 lights were left out, they are of none of the types point, spot and "
                                "directional: <light> panel of " +
                                    pathOf("models/panel/model.sdf") + ":2 has type area"}));
}

TEST_F(LampFiles, ThatCannotShineAreNamed) {
  SKIP_WITHOUT_SDF();
  const Scene scene =
      worldWith("<light name='dead' type='point'><attenuation><range>0</range></attenuation></light>");
  EXPECT_TRUE(scene.lamps.empty());
  ASSERT_EQ(scene.warnings.size(), 1u);
  EXPECT_NE(scene.warnings[0].find("dead"), std::string::npos);
}

TEST_F(LampFiles, OfAnIntensityBelowZeroAreNamed) {
  SKIP_WITHOUT_SDF();
  const auto light = [](const std::string& name, const std::string& intensity) {
    return "<light name='" + name + "' type='point'><diffuse>1 1 1 1</diffuse><intensity>" + intensity +
           "</intensity><attenuation><range>5</range></attenuation></light>";
  };
  const Scene scene = worldWith(light("off", "0") + light("below", "-1"));
  ASSERT_EQ(scene.lamps.size(), 1u);
  EXPECT_EQ(scene.lamps[0].name, "off");
  EXPECT_EQ(scene.warnings,
            std::vector<std::string>{"1 lights were left out: their colour and intensity must be at least 0, "
                                     "their range, angle, direction and attenuation above 0, and all finite: "
                                     "below"});
}

TEST_F(LampFiles, ThatAreSwitchedOffAreNamed) {
  SKIP_WITHOUT_SDF();
  const std::string light =
      "<light name='porch' type='point'><attenuation><range>5</range></attenuation><light_on>";
  EXPECT_EQ(worldWith(light + "true</light_on></light>").lamps.size(), 1u);
  const Scene scene = worldWith(light + "false</light_on></light>");
  EXPECT_TRUE(scene.lamps.empty());
  EXPECT_NE(std::find(scene.warnings.begin(), scene.warnings.end(),
                      "1 lights are switched off by <light_on> and were left out: porch"),
            scene.warnings.end());
}

TEST_F(LampFiles, OfNumbersThatNoLampHasAreNamedAndLeftOut) {
  SceneBuilder builder("numbers");
  const auto add = [&](float constant, float linear, float inner) {
    Lamp lamp;
    lamp.name = "wrong";
    lamp.constant = constant;
    lamp.linear = linear;
    lamp.inner_rad = inner;
    builder.addLamp(lamp);
  };
  add(INFINITY, 0.0f, 0.0f);
  add(5.0f, -1.0f, 0.0f);
  add(1.0f, 0.0f, -9e18f);
  const Scene scene = builder.finish();
  EXPECT_TRUE(scene.lamps.empty());
  ASSERT_EQ(scene.warnings.size(), 1u);
  EXPECT_NE(scene.warnings[0].find("wrong"), std::string::npos);
}

TEST_F(LampFiles, ThatPhysicsCarriedFarAwayAreNamed) {
  SKIP_WITHOUT_SDF();
  const Scene scene = worldWith("<light name='lost' type='point'><pose>0 0 -1e7 0 0 0</pose></light>");
  EXPECT_TRUE(scene.lamps.empty());
  ASSERT_EQ(scene.warnings.size(), 1u);
  EXPECT_EQ(scene.warnings[0], "1 lamps farther than 100 km from the origin were left out: lost");
}

TEST_F(LampFiles, OfGltfAreInCandela) {
  const std::string file =
      write("lamp.gltf", R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0,1]}],
    "extensionsUsed":["KHR_lights_punctual"],
    "extensions":{"KHR_lights_punctual":{"lights":[{"name":"torch","type":"spot","color":[1,0.5,0.25],"intensity":40,
      "range":12,"spot":{"innerConeAngle":0.2,"outerConeAngle":0.7}}]}},
    "nodes":[{"mesh":0},{"name":"torch","translation":[1,2,3],"extensions":{"KHR_lights_punctual":{"light":0}}}],
    "meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],
    "accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,1,0]}],
    "bufferViews":[{"buffer":0,"byteLength":36}],
    "buffers":[{"byteLength":36,"uri":"data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}]})");
  const Scene scene = load(file, {});
  for (const std::string& warning : scene.warnings) ADD_FAILURE() << warning;
  ASSERT_EQ(scene.lamps.size(), 1u);
  const Lamp& lamp = scene.lamps[0];
  EXPECT_FALSE(lamp.relative);
  EXPECT_LT((lamp.intensity.value - Eigen::Array3f(40.0f, 20.0f, 10.0f)).abs().maxCoeff(), 1e-4f);
  EXPECT_LT((lamp.position - Eigen::Vector3f(1.0f, -3.0f, 2.0f)).norm(), 1e-5f);  // z up
  EXPECT_LT((lamp.direction - Eigen::Vector3f::UnitY()).norm(), 1e-5f);           // glTF's −z
  EXPECT_FLOAT_EQ(lamp.inner_rad, 0.2f);
  EXPECT_FLOAT_EQ(lamp.outer_rad, 0.7f);
  EXPECT_FLOAT_EQ(lamp.range_m, 12.0f);
  EXPECT_FALSE(lamp.ends_sharply);
  EXPECT_EQ(lamp.constant, 0.0f);
  EXPECT_EQ(lamp.linear, 0.0f);
  EXPECT_EQ(lamp.quadratic, 1.0f);
}

TEST_F(LampFiles, OfGltfThatShareALightStandAtEachOfItsNodes) {
  // One definition for a street of lamps, as modellers write it; two of them on one arm that is turned about
  // y.
  const std::string file =
      write("street.gltf", R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0,1,2]}],
    "extensionsUsed":["KHR_lights_punctual"],
    "extensions":{"KHR_lights_punctual":{"lights":[{"name":"bulb","type":"point","intensity":90},
      {"name":"day","type":"directional"}]}},
    "nodes":[{"mesh":0},{"name":"post","translation":[5,0,0],"extensions":{"KHR_lights_punctual":{"light":0}}},
      {"translation":[0,6,0],"rotation":[0,0.70710678,0,0.70710678],"scale":[2,2,2],"children":[3,4,5]},
      {"name":"left","translation":[1,0,0],"extensions":{"KHR_lights_punctual":{"light":0}}},
      {"name":"right","translation":[-1,0,0],"extensions":{"KHR_lights_punctual":{"light":0}}},
      {"name":"sun","extensions":{"KHR_lights_punctual":{"light":1}}}],
    "meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],
    "accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,1,0]}],
    "bufferViews":[{"buffer":0,"byteLength":36}],
    "buffers":[{"byteLength":36,"uri":"data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}]})");
  const Scene scene = load(file, {});
  ASSERT_EQ(scene.lamps.size(), 3u);
  const std::array<Eigen::Vector3f, 3> places = {Eigen::Vector3f(5, 0, 0), Eigen::Vector3f(0, 2, 6),
                                                 Eigen::Vector3f(0, -2, 6)};
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_LT((scene.lamps[i].position - places[i]).norm(), 1e-5f) << i;
    EXPECT_EQ(scene.lamps[i].intensity.value[1], 90.0f);
    EXPECT_EQ(scene.lamps[i].group, "bulb");
  }
  EXPECT_EQ(scene.lamps[1].name, "left");
  ASSERT_EQ(scene.warnings.size(), 1u);
  EXPECT_EQ(scene.warnings[0], std::string("1 ") + kOtherLights + ": sun");
}

TEST_F(LampFiles, OfMeshesOfModelsAreNamedAndLeftOut) {
  SKIP_WITHOUT_SDF();
  write("lit.gltf", R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0,1,2]}],
    "extensionsUsed":["KHR_lights_punctual"],
    "extensions":{"KHR_lights_punctual":{"lights":[{"name":"bulb","type":"point"},{"name":"day","type":"directional"}]}},
    "nodes":[{"mesh":0},{"extensions":{"KHR_lights_punctual":{"light":0}}},
      {"extensions":{"KHR_lights_punctual":{"light":1}}}],
    "meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],
    "accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,1,0]}],
    "bufferViews":[{"buffer":0,"byteLength":36}],
    "buffers":[{"byteLength":36,"uri":"data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}]})");
  const Scene scene =
      worldWith("",
                "<visual name='m'><geometry><mesh><uri>lit.gltf</uri></mesh></geometry></visual>"
                "<visual name='n'><geometry><mesh><uri>lit.gltf</uri></mesh></geometry></visual>");
  EXPECT_TRUE(scene.lamps.empty());
  EXPECT_EQ(scene.warnings,
            std::vector<std::string>{
                "1 meshes of models and robots have lights of their own, which are left out: 1 in " +
                pathOf("lit.gltf")});
}

TEST_F(LampFiles, OfAUrdfStandInItsGazeboElements) {
  SKIP_WITHOUT_SDF();
  const Robot robot = parseUrdf(
      "<?xml version='1.0'?><robot name='r'><link name='base'><visual><geometry><box size='1 1 "
      "1'/></geometry>"
      "</visual></link><link name='head'/><joint name='j' type='fixed'><parent link='base'/><child "
      "link='head'/>"
      "</joint><gazebo reference='head'>" +
          kSpot + "</gazebo></robot>",
      "some.urdf", {});
  for (const std::string& warning : robot.warnings) ADD_FAILURE() << warning;
  ASSERT_EQ(robot.links.size(), 2u);
  EXPECT_TRUE(robot.links[0].lamps.empty());
  ASSERT_EQ(robot.links[1].lamps.size(), 1u);
  EXPECT_EQ(robot.links[1].lamps[0].group, "head");
  EXPECT_EQ(robot.links[1].lamps[0].position, Eigen::Vector3f(1.0f, 0.0f, 0.0f));
  EXPECT_EQ(robot.links[1].lamps[0].intensity.value[0], 3.0f);
}

TEST_F(LampFiles, OfAnSdfRobotStandInItsLinks) {
  SKIP_WITHOUT_SDF();
  const std::string file =
      write("robot.sdf",
            "<?xml version='1.0'?><sdf version='1.9'><model name='r'><link name='l'><pose>0 0 1 0 0 0</pose>"
            "<visual name='v'><geometry><sphere><radius>1</radius></sphere></geometry></visual>" +
                kSpot + "</link></model></sdf>");
  const Robot robot = loadRobot(file, {});
  const std::vector<Lamp>& lamps = robot.links[robot.indexOf("l").value()].lamps;
  ASSERT_EQ(lamps.size(), 1u);
  EXPECT_EQ(lamps[0].position, Eigen::Vector3f(1.0f, 0.0f, 0.0f));
}

}  // namespace
}  // namespace sunlit::scene
