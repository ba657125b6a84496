// Where lamps of COLLADA stand, and how they fade.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "scene/scene_builder.h"
#include "sunlit/quantity/angle.h"
#include "unit/scene/scene_files.h"

namespace sunlit::scene {
namespace {

std::string movedTo(int x, const std::string& content, const std::string& name) {
  return "<node name='" + name + "'><translate>" + std::to_string(x) + " 0 4</translate>" + content +
         "</node>";
}

const std::string kShines = "<instance_light url='#L'/>";

class ColladaLamps : public SceneFiles {
 protected:
  /// Of a file with a triangle, whose unit is of `unit_m`.
  Scene loaded(const std::string& nodes, const std::string& library = "",
               const std::string& unit_m = "1") const {
    return load(
        write("lamps.dae",
              "<?xml version='1.0'?><COLLADA xmlns='http://www.collada.org/2005/11/COLLADASchema' "
              "version='1.4.1'>"
              "<asset><unit meter='" +
                  unit_m +
                  "'/><up_axis>Z_UP</up_axis></asset><library_lights><light id='L'>"
                  "<technique_common><point><color>1 1 "
                  "1</color><constant_attenuation>0.5</constant_attenuation>"
                  "<linear_attenuation>0.25</linear_attenuation><quadratic_attenuation>0.125</"
                  "quadratic_attenuation>"
                  "</point></technique_common></light></library_lights><library_geometries><geometry "
                  "id='g'><mesh>"
                  "<source id='p'><float_array id='a' count='9'>0 0 0 1 0 0 0 1 "
                  "0</float_array><technique_common>"
                  "<accessor source='#a' count='3' stride='3'><param name='X' type='float'/><param name='Y' "
                  "type='float'/>"
                  "<param name='Z' type='float'/></accessor></technique_common></source><vertices id='v'>"
                  "<input semantic='POSITION' source='#p'/></vertices><triangles count='1'><input "
                  "semantic='VERTEX' "
                  "source='#v' offset='0'/><p>0 1 2</p></triangles></mesh></geometry></library_geometries>" +
                  library +
                  "<library_visual_scenes><visual_scene id='s'><node name='g'><instance_geometry "
                  "url='#g'/></node>" +
                  nodes +
                  "</visual_scene></library_visual_scenes><scene><instance_visual_scene "
                  "url='#s'/></scene></COLLADA>"),
        {});
  }
  /// Of a spot with these elements, and these of extensions.
  Lamp loadedSpot(const std::string& cone, const std::string& extra = "") const {
    const Scene scene = loaded(movedTo(0, "<instance_light url='#S'/>", "Lamp"),
                               "<library_lights><light id='S'><technique_common><spot><color>1 1 1</color>" +
                                   cone + "</spot></technique_common>" + extra + "</light></library_lights>");
    EXPECT_EQ(scene.warnings, std::vector<std::string>());
    EXPECT_EQ(scene.lamps.size(), 1u);
    return scene.lamps.at(0);
  }
  static std::vector<float> placesOf(const Scene& scene) {
    std::vector<float> places;
    for (const Lamp& lamp : scene.lamps) places.push_back(lamp.position.x());
    return places;
  }
};

TEST_F(ColladaLamps, OfOneNameStandEachAtItsOwnNode) {
  const Scene scene =
      loaded(movedTo(0, kShines, "Lamp") + movedTo(10, kShines, "Lamp") + movedTo(20, kShines, "Lamp"));
  EXPECT_EQ(placesOf(scene), (std::vector<float>{0, 10, 20}));
  EXPECT_TRUE(scene.warnings.empty());
  const Scene one = loaded(movedTo(3, kShines, "a") + movedTo(7, kShines, "b"));
  EXPECT_EQ(placesOf(one), (std::vector<float>{3, 7}));
}

TEST_F(ColladaLamps, OfOneNodeThatIsShownTwiceStandAtBothPlaces) {
  const std::string post =
      "<library_nodes><node id='post'>" + movedTo(1, kShines, "bulb") + "</node></library_nodes>";
  const std::string use = "<instance_node url='#post'/>";
  const Scene scene = loaded(movedTo(10, use, "a") + movedTo(20, use, "b"), post);
  EXPECT_EQ(placesOf(scene), (std::vector<float>{11, 21}));
  EXPECT_TRUE(scene.warnings.empty());
}

// Assimp makes those of nodes below a node before its own.
TEST_F(ColladaLamps, BelowOthersOfTheirNameAreNotTakenForThese) {
  const Scene scene = loaded(movedTo(10, kShines + movedTo(5, kShines, "Lamp"), "Lamp"));
  EXPECT_EQ(placesOf(scene), (std::vector<float>{15, 10}));
}

TEST_F(ColladaLamps, ThatShareTheirNameWithWhatIsNoLampAreNamed) {
  const Scene scene = loaded(movedTo(10, kShines, "Lamp") + movedTo(20, "", "Lamp"));
  EXPECT_EQ(placesOf(scene), (std::vector<float>{10}));
  ASSERT_EQ(scene.warnings.size(), 1u);
  EXPECT_EQ(scene.warnings[0],
            "1 lamps share their names with other nodes, they stand where the first of these does: Lamp");
}

TEST_F(ColladaLamps, WhoseNodeHasNoNameGoByItsIdElseByTheLight) {
  const auto node = [](const std::string& attributes, const std::string& light,
                       const std::string& below = "") {
    return "<node" + attributes + "><instance_light url='#" + light + "'/>" + below + "</node>";
  };
  const std::string lights =
      "<library_lights><light id='one' name='A \"1\"'><technique_common><point><color>1 1 1</color></point>"
      "</technique_common></light><light id='two' name='Arm'><technique_common><point><color>1 1 1</color>"
      "</point></technique_common></light></library_lights>";
  const Scene scene =
      loaded(node(" id='bulb'", "one") + node(" id='lamp' name=''", "one") + node("", "one") + node("", "L") +
                 "<node name='Arm'>" + node("", "two") + "</node>" + node(" id='x' name='Named'", "one"),
             lights);
  std::vector<std::string> groups;
  for (const Lamp& lamp : scene.lamps) groups.push_back(lamp.group);
  // Not that of the light where a node has it, whose place the lamp would get.
  EXPECT_EQ(groups, (std::vector<std::string>{"bulb", "lamp", "A \"1\"", "L", "two", "Named"}));
  EXPECT_EQ(scene.warnings, std::vector<std::string>());
}

TEST_F(ColladaLamps, HaveColoursOfADisplayAndAreBrighterThanItAsTheyStand) {
  const auto lit = [&](const std::string& color) {
    return loaded(movedTo(0, "<instance_light url='#P'/>", "Lamp"),
                  "<library_lights><light id='P'><technique_common><point><color>" + color +
                      "</color></point></technique_common></light></library_lights>")
        .lamps.at(0)
        .intensity.value;
  };
  EXPECT_LT((lit("1 0.5 0") - Eigen::Array3f(1.0f, 0.2140f, 0.0f)).abs().maxCoeff(), 2e-4f);
  EXPECT_LT((lit("4 2 0") - Eigen::Array3f(4.0f, 4.0f * 0.2140f, 0.0f)).abs().maxCoeff(), 1e-3f);
}

TEST_F(ColladaLamps, WithoutAnExponentEndSharplyAtTheirCone) {
  for (const char* exponent : {"", "0", "-1", "nan"}) {
    const Lamp lamp = loadedSpot(
        "<falloff_angle>60</falloff_angle>" +
        (*exponent == 0 ? "" : "<falloff_exponent>" + std::string(exponent) + "</falloff_exponent>"));
    EXPECT_NEAR(lamp.outer_rad, kPiFloat / 6.0f, 1e-6f) << exponent;
    EXPECT_EQ(lamp.inner_rad, lamp.outer_rad) << exponent;
  }
  EXPECT_NEAR(loadedSpot("").outer_rad, 0.5f * kPiFloat, 1e-6f);  // the format's default is 180°
  const Scene bare =
      loaded(movedTo(0, "<instance_light url='#S'/>", "Lamp"),
             "<library_lights><light id='S'><technique_common><spot/></technique_common></light>"
             "</library_lights>");
  ASSERT_EQ(bare.lamps.size(), 1u);
  EXPECT_EQ(bare.lamps[0].inner_rad, bare.lamps[0].outer_rad);
}

TEST_F(ColladaLamps, FallOffByTheirExponent) {
  const Lamp half_space =
      loadedSpot("<falloff_angle>180</falloff_angle><falloff_exponent>3</falloff_exponent>");
  EXPECT_EQ(half_space.inner_rad, 0.0f);
  EXPECT_NEAR(half_space.outer_rad, 0.5f * kPiFloat, 1e-6f);
  EXPECT_NEAR(half_space.exponent, 3.0f, 1e-5f);
  for (const double exponent : {0.15, 1.0, 10.0, 50.0}) {
    const Lamp lamp = loadedSpot("<falloff_angle>60</falloff_angle><falloff_exponent>" +
                                 std::to_string(exponent) + "</falloff_exponent>");
    EXPECT_EQ(lamp.inner_rad, 0.0f) << exponent;
    EXPECT_NEAR(lamp.outer_rad, kPiFloat / 6.0f, 1e-6f) << exponent;
    // Flux over 2 π, of ((c − edge) / (1 − edge))ᵉ and of cⁿ.
    const double edge = std::cos(kPi / 6.0);
    EXPECT_NEAR((1.0 - edge) / (static_cast<double>(lamp.exponent) + 1.0),
                (1.0 - std::pow(edge, exponent + 1.0)) / (exponent + 1.0), 1e-7)
        << exponent;
  }
  EXPECT_EQ(loadedSpot("<falloff_exponent>1e30</falloff_exponent>").exponent, 100.0f);
}

TEST_F(ColladaLamps, WithASecondAngleOfAnExtensionFadeUpToIt) {
  const Lamp lamp =
      loadedSpot("<falloff_angle>40</falloff_angle><falloff_exponent>2</falloff_exponent>",
                 "<extra><technique profile='FCOLLADA'><outer_cone>60</outer_cone></technique></extra>");
  EXPECT_NEAR(lamp.inner_rad, kPiFloat / 9.0f, 1e-6f);
  EXPECT_NEAR(lamp.outer_rad, kPiFloat / 6.0f, 1e-6f);
}

TEST_F(ColladaLamps, FadeByDistancesInTheUnitOfTheFile) {
  for (const auto& [unit, unit_m] : {std::pair{"1", 1.0f}, {"0.5", 0.5f}, {"0.01", 0.01f}}) {
    const Scene scene = loaded(movedTo(100, kShines, "Lamp"), "", unit);
    ASSERT_EQ(scene.lamps.size(), 1u);
    const Lamp& lamp = scene.lamps[0];
    EXPECT_NEAR(lamp.position.x(), 100.0f * unit_m, 1e-4f);
    // At 3 units from it.
    const float distance_m = 3.0f * unit_m;
    EXPECT_NEAR(lamp.constant + lamp.linear * distance_m + lamp.quadratic * distance_m * distance_m,
                0.5f + 0.25f * 3.0f + 0.125f * 9.0f, 1e-4f);
  }
}

}  // namespace
}  // namespace sunlit::scene
