// What of SDF is not drawn, and not missed either.
#include <gtest/gtest.h>

#include <optional>
#include <string>
#include <vector>

#include "sunlit/scene/world_site.h"
#include "unit/scene/scene_files.h"
#include "unit/scene/sdf_texts.h"

namespace sunlit::scene {
namespace {

class SdfLeftOut : public SceneFiles {
 protected:
  /// Of a world with one box.
  Scene boxWith(const std::string& content, const std::string& version = "1.6") const {
    return load(
        write("test.world",
              world(content + "<model name='m'><link name='l'>" + boxVisual() + "</link></model>", version)),
        {});
  }
};

TEST_F(SdfLeftOut, ModelsThatAreMissingInWhatIsNotDrawnStopNothing) {
  const std::string gone = "<include><uri>model://gone</uri></include>";
  for (const std::string kind : {"population", "plugin", "gui", "actor"}) {
    const std::string begin = "<" + kind + " name='p'>", end = "</" + kind + ">";
    EXPECT_EQ(boxWith(begin + gone + end).meshes.size(), 1u) << kind;
    EXPECT_EQ(boxWith(begin + "<model name='can'>" + gone + "</model>" + end).meshes.size(), 1u) << kind;
  }
  EXPECT_NE(errorOf(write("test.world", world("<model name='n'>" + gone + "</model>")))
                .find("there is no model://gone"),
            std::string::npos);
}

TEST_F(SdfLeftOut, TexturesOfAMeshThatIsMissingAreNotLookedFor) {
  SearchPath lenient;
  lenient.missing = Missing::kWarn;
  const std::string mesh = "<geometry><mesh><uri>gone.dae</uri></mesh></geometry>";
  const std::string texture =
      "<material><pbr><metal><albedo_map>gone.png</albedo_map></metal></pbr></material>";
  const std::string visual = "<visual name='v'>" + mesh + texture + "</visual>";
  const Scene scene = load(write("test.world", world("<model name='m'><link name='l'>" + boxVisual() +
                                                     "</link><link name='n'>" + visual + "</link></model>")),
                           lenient);
  ASSERT_EQ(scene.warnings.size(), 1u) << scene.warnings[1];
  EXPECT_EQ(scene.warnings[0].find("1 meshes are missing and were left out: gone.dae"), 0u)
      << scene.warnings[0];
}

TEST_F(SdfLeftOut, TheHeadingOfAWorldIsNamed) {
  const auto turnedTo = [&](const std::string& heading) {
    return boxWith("\n<spherical_coordinates><latitude_deg>-33.7</latitude_deg><heading_deg>" + heading +
                   "</heading_deg></spherical_coordinates>")
        .warnings;
  };
  EXPECT_TRUE(turnedTo("0").empty());  // its site is a matter of siteOf()
  EXPECT_EQ(turnedTo("1e-3").size(), 1u);
  const std::vector<std::string> named = turnedTo("90");
  ASSERT_EQ(named.size(), 1u);
  EXPECT_EQ(
      named[0],
      "1 worlds have <heading_deg>, which is not taken: here x points east, so that the sun stands on the "
      "wrong side by as much, unless the poses of models and path are turned: " +
          pathOf("test.world") + ":2: 90");
}

TEST_F(SdfLeftOut, TheSiteOfAWorldIsThereUnlessItIsNowhere) {
  const auto at = [&](const std::string& latitude, const std::string& longitude) {
    boxWith("\n<spherical_coordinates><surface_model>EARTH_WGS84</surface_model><latitude_deg>" + latitude +
            "</latitude_deg><longitude_deg>" + longitude +
            "</longitude_deg><elevation>12</elevation></spherical_coordinates>");
    return siteOf(pathOf("test.world"), {});
  };
  EXPECT_FALSE(at("0", "0.0"));
  EXPECT_FALSE(at("nowhere", ""));
  EXPECT_TRUE(at("1", "0"));
  EXPECT_TRUE(at("0", "-1"));
  const std::optional<WorldSite> named = at("-33.7244456", "150.67903");
  ASSERT_TRUE(named);
  EXPECT_DOUBLE_EQ(named->site.latitude.deg(), -33.7244456);
  EXPECT_DOUBLE_EQ(named->site.longitude.deg(), 150.67903);
  EXPECT_EQ(named->site.elevation_m, 12.0);
  EXPECT_EQ(named->place, pathOf("test.world") + ":2");
  boxWith("<spherical_coordinates/>");
  EXPECT_FALSE(siteOf(pathOf("test.world"), {}));
  EXPECT_FALSE(siteOf(kRaceTrack, {}));
}

}  // namespace
}  // namespace sunlit::scene
