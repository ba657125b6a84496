// What of SDF is not drawn, and not missed either.
#include <gtest/gtest.h>

#include <string>
#include <vector>

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

TEST_F(SdfLeftOut, TheSiteOfAWorldIsNamedUnlessItIsNowhere) {
  const auto at = [&](const std::string& latitude, const std::string& longitude, const std::string& heading) {
    return boxWith("\n<spherical_coordinates><surface_model>EARTH_WGS84</surface_model><latitude_deg>" +
                   latitude + "</latitude_deg><longitude_deg>" + longitude +
                   "</longitude_deg><elevation>12</elevation>"
                   "<heading_deg>" +
                   heading + "</heading_deg></spherical_coordinates>")
        .warnings;
  };
  EXPECT_TRUE(at("0", "0.0", "0").empty());
  EXPECT_TRUE(boxWith("<spherical_coordinates/>").warnings.empty());
  const std::vector<std::string> named = at("-33.7244456", "150.67903", "90");
  ASSERT_EQ(named.size(), 2u);
  EXPECT_EQ(
      named[0],
      "1 worlds have <heading_deg>, which is not taken: here x points east, so that the sun stands on the "
      "wrong side by as much, unless the poses of models and path are turned: " +
          pathOf("test.world") + ":2: 90");
  EXPECT_EQ(
      named[1],
      "1 worlds have <spherical_coordinates>, which are not taken: the site is a parameter: " +
          pathOf("test.world") +
          ":2: --site -33.7244456,150.67903,12, of launch files site:=\"[-33.7244456, 150.67903, 12]\"");
  for (const auto& one : {at("1", "0", "0"), at("0", "-1", "0"), at("0", "0", "1e-3")})
    EXPECT_EQ(one.size(), 1u);
}

}  // namespace
}  // namespace sunlit::scene
