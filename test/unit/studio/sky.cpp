#include "sunlit/studio/sky.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "sunlit/astronomy/civil_time.h"
#include "support/message_of.h"
#include "support/patches.h"
#include "support/temporary_folder.h"
#include "support/usual_air.h"

namespace sunlit::studio {
namespace {

/// Sun at 10°.
SkyBodies lowSunOver(double site_elevation_m) {
  SkyBodies bodies{{Direction(Azimuth::degrees(250.0), Angle::degrees(10.0)), 1.0}};
  bodies.site_elevation_m = site_elevation_m;
  return bodies;
}

/// What tells one daylight from another, lx and cd/m².
std::vector<float> figuresOf(const sky::Daylight& day) {
  std::vector<float> figures;
  const auto add = [&](const LinearRgb& rgb) {
    figures.insert(figures.end(), rgb.value.data(), rgb.value.data() + 3);
  };
  add(day.sun().illuminance);
  add(day.groundIlluminance());
  for (const float z : {0.05f, 0.4f, 0.9f})
    add(day.skyLuminance(Eigen::Vector3f(-0.5f, -0.2f, z).normalized()));
  return figures;
}

std::vector<float> figuresAt(double height_m) {
  sky::AtmosphereOptions air;
  air.observer_height_m = height_m;
  return figuresOf(sky::Atmosphere(air, sky::TablesOfThisBuild().store()).daylight(lowSunOver(0.0).sun));
}

TEST(Sky, SaysWhatWeatherTheAirOfASiteCannotHave) {
  const Sky sky({}, {});
  sky::Weather weather;
  weather.visibility_m = 50000.0;
  EXPECT_NO_THROW(sky.requireWeather(weather, 1830.14));
  EXPECT_NE(messageOf([&] { sky.requireWeather(weather, 0.0); }).find("visibility is 50000 m"),
            std::string::npos);
}

TEST(Sky, HasTheAirOfTheSitesElevationMadeOnceForEach) {
  std::vector<std::string> notes;
  Reports reports;
  reports.note = [&](const std::string& line) { notes.push_back(line); };
  Sky sky({}, reports);
  EXPECT_TRUE(notes.empty());  // made when it is needed
  const std::vector<float> high = figuresOf(sky.daylight(lowSunOver(1830.14)));
  EXPECT_EQ(high, figuresAt(1830.14));
  EXPECT_EQ(notes.size(), 1u);
  const std::vector<float> low = figuresOf(sky.daylight(lowSunOver(0.0)));
  EXPECT_EQ(low, figuresAt(0.0));
  EXPECT_EQ(figuresOf(sky.daylight(lowSunOver(1830.14))), high);
  ASSERT_EQ(notes.size(), 2u);
  EXPECT_NE(notes[0].find("1830.14 m"), std::string::npos) << notes[0];
  // Green sunlight: by Kasten & Young's relative air mass of 5.6 at 10°, times a fifth less air above, times
  // its optical depth of about 0.2 with haze, some exp(0.2) more.
  EXPECT_GT(high[1] / low[1], 1.15f);
  EXPECT_LT(high[1] / low[1], 1.8f);
}

/// What one case has made is there for the next one.
SkyOptions kept() {
  static const TemporaryFolder folder;
  SkyOptions options;
  options.cache_dir = folder.path();
  return options;
}

/// The notes of a sky over sites of these elevations.
std::vector<std::string> notesOf(const SkyOptions& options, const std::vector<double>& elevations_m) {
  std::vector<std::string> notes;
  Reports reports;
  reports.note = [&](const std::string& line) { notes.push_back(line); };
  Sky sky(options, reports);
  for (const double elevation_m : elevations_m) sky.prepare(elevation_m);
  return notes;
}

TEST(Sky, BelowTheSeaHasTheAirOfTheSea) {
  EXPECT_EQ(notesOf(kept(), {-430.0, 0.0, 8849.0}),
            (std::vector<std::string>{"Air of a height of 0 m", "Air of a height of 8849 m"}));
}

TEST(Sky, OfAFixedHeightDoesNotHeedTheSite) {
  SkyOptions options = kept();
  options.fixed_height_m = 500.0;
  EXPECT_EQ(notesOf(options, {0.0, 1830.14}), std::vector<std::string>{"Air of a height of 500 m"});
}

light::World snowfield() {
  scene::Scene scene;
  scene.materials.emplace_back();
  scene.materials[0].base_color = LinearRgb(0.8f, 0.8f, 0.8f);
  test::addGround(&scene, 0, 50.0f);
  return light::World(std::make_shared<const scene::Scene>(scene));
}

TEST(Sky, TakesTheLandBeyondFromTheWorldUnlessItIsFixed) {
  std::string said;
  Reports reports;
  reports.note = [&](const std::string& line) { said = line; };
  Sky sky(kept(), reports);
  const float unknown = sky.daylight(lowSunOver(0.0)).skyLuminance(-Eigen::Vector3f::UnitZ()).value[1];
  sky.over({snowfield()});
  EXPECT_NEAR(sky.groundAlbedo(), 0.8, 0.03);  // with what its face mirrors
  EXPECT_NE(said.find(textOf(sky.groundAlbedo())), std::string::npos) << said;
  const float snow = sky.daylight(lowSunOver(0.0)).skyLuminance(-Eigen::Vector3f::UnitZ()).value[1];
  // Four times as bright, and more, since snow brightens its sky.
  EXPECT_GT(snow, 4.0f * unknown);
  EXPECT_LT(snow, 5.5f * unknown);

  SkyOptions options;
  options.fixed_ground_albedo = 0.3;
  Sky fixed(options, reports);
  EXPECT_EQ(fixed.groundAlbedo(), 0.3);
  fixed.over({snowfield()});
  EXPECT_EQ(fixed.groundAlbedo(), 0.3);

  Sky over_nothing({}, reports);
  over_nothing.over({light::World(std::make_shared<const scene::Scene>())});
  EXPECT_EQ(over_nothing.groundAlbedo(), sky::AtmosphereOptions().ground_albedo);
}

TEST(Sky, KeepsAnAirForEachStateOfTheGround) {
  SkyOptions options = kept();
  options.fixed_ground_albedo = options.air.ground_albedo;  // heights are sooner made than albedos
  int made = 0;
  Reports reports;
  reports.note = [&](const std::string& line) { made += line.find("Air of a height") == 0 ? 1 : 0; };
  Sky sky(options, reports);
  constexpr int kStates = 12;
  sky.over(std::vector<light::World>(kStates, snowfield()));
  for (const bool again : {false, true}) {
    for (int state = 0; state < kStates; ++state) {
      EXPECT_EQ(sky.isPrepared(100.0 * state, static_cast<std::size_t>(state)), again) << state;
      sky.prepare(100.0 * state, static_cast<std::size_t>(state));
    }
  }
  EXPECT_EQ(made, kStates);
}

TEST(Sky, ThatFindsItsTablesIsTheSame) {
  const TemporaryFolder folder;
  SkyOptions options;
  options.cache_dir = folder.path();
  const std::vector<float> made = figuresOf(Sky(options).daylight(lowSunOver(0.0)));
  EXPECT_FALSE(std::filesystem::is_empty(folder.path()));
  EXPECT_EQ(figuresOf(Sky(options).daylight(lowSunOver(0.0))), made);
  EXPECT_EQ(made, figuresAt(0.0));
}

TEST(Sky, RefusesAirThatCannotBe) {
  SkyOptions options;
  options.air.turbidity = 0.5;
  EXPECT_NE(messageOf([&] { Sky sky(options); }).find("turbidity"), std::string::npos);
  options.air.turbidity = 2.0;
  options.fixed_height_m = 13000.0;
  EXPECT_NE(messageOf([&] { Sky sky(options); }).find("observer_height"), std::string::npos);
}

TEST(SkyBodies, StandWherePublishedExamplesHaveThem) {
  // Reda & Andreas (2008), table A5.1: zenith 50.111622°, azimuth 194.340241°.
  const CivilDateTime civil{2003, 10, 17, 12, 30, 30.0, -7.0};
  const Site site{Angle::degrees(39.742476), Angle::degrees(-105.1786), 1830.14};
  Air air;
  air.pressure_hpa = 820.0;
  air.temperature_c = 11.0;
  astronomy::EarthRotation earth;
  earth.delta_t_s = 67.0;
  const SkyBodies bodies = bodiesAt(astronomy::instantOf(civil), site, air, earth);
  EXPECT_NEAR(90.0 - bodies.sun.apparent.elevation().deg(), 50.111622, 2e-6);  // printed to 1e-6
  EXPECT_NEAR(bodies.sun.apparent.azimuth().deg(), 194.340241, 2e-6);
  EXPECT_LT(bodies.sun.geometric->elevation(), bodies.sun.apparent.elevation());
  EXPECT_EQ(bodies.site_elevation_m, 1830.14);
  EXPECT_TRUE(bodies.moon && bodies.map_from_celestial);
}

}  // namespace
}  // namespace sunlit::studio
