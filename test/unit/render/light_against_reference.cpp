// The fast picture's light against path-traced light.
#include <gtest/gtest.h>

#include <optional>
#include <string>
#include <vector>

#include "sunlit/light/luminance_error.h"
#include "sunlit/light/transport.h"
#include "support/usual_air.h"
#include "test_scenes.h"

namespace sunlit::test {
namespace {

light::World baked(const scene::Scene& scene) {
  light::World world(shared(scene));
  light::TransportOptions options;
  options.samples = 20000;
  world.transport = light::Transport::bake(world.geometry, options);
  return world;
}

/// Baked once for all that ask for it.
const light::World& bakedYard() {
  static const light::World world = baked(yard());
  return world;
}

TEST(FastLight, AgreesWithPathTracedLightFromNoonToTwilight) {
  const light::World& world = bakedYard();
  const std::vector<double> elevations = {60.0, 20.0, 4.0, -4.0};
  const std::vector<light::LuminanceError> errors =
      errorsAgainstTraced(world, lookingAt({-5.0, -6.0, 1.6}, {4.0, 4.0, 1.5}), elevations, 128);
  for (std::size_t i = 0; i < elevations.size(); ++i) {
    const light::LuminanceError& error = errors[i];
    EXPECT_GT(error.pixels, 1500u);
    // Measured 1.3 to 2.7 %, of which the reference's noise is 1 to 2 %; 5 % is what is promised of whole
    // worlds.
    EXPECT_LT(error.mean, 0.04) << elevations[i];
    EXPECT_LT(error.p95, 0.12) << elevations[i];  // measured 4.6 to 7.6 %
    EXPECT_LT(std::abs(error.bias), 0.03) << elevations[i];
    EXPECT_LT(error.noise, 0.03) << elevations[i];  // or the above would say nothing
  }
}

TEST(FastLight, AgreesWithPathTracedLightUnderGapsAndCloudsAndInFog) {
  const light::World& world = bakedYard();
  std::vector<sky::Daylight> days;
  const auto add = [&](const sky::Weather& weather) {
    days.push_back(sky::usualAir().daylight({Direction(Azimuth::degrees(230.0), Angle::degrees(40.0)), 1.0},
                                            {}, weather));
  };
  float least = 1e9f, most = 0.0f;
  for (int seed = 0; seed < 6; ++seed) {
    sky::Weather broken;
    broken.cover_oktas = 4.0;
    broken.seed = seed;
    add(broken);
    const float through = days.back().throughCloud(days.back().sun(), Eigen::Vector3f::Zero());
    least = std::min(least, through);
    most = std::max(most, through);
  }
  ASSERT_LT(least, 0.2f);  // in the shadow of a cloud,
  ASSERT_GT(most, 1.2f);   // and under a gap
  sky::Weather fog;
  fog.visibility_m = 100.0;
  add(fog);
  const std::vector<light::LuminanceError> errors =
      errorsAgainstTraced(world, lookingAt({-5.0, -6.0, 1.6}, {4.0, 4.0, 1.5}), days, 128);
  for (std::size_t i = 0; i < errors.size(); ++i) {
    EXPECT_LT(errors[i].mean, 0.04) << i;
    EXPECT_LT(std::abs(errors[i].bias), 0.03) << i;
    EXPECT_LT(errors[i].noise, 0.03) << i;
  }
}

/// A sun at that height under weather.
struct Hour {
  std::string name;
  double sun_deg;
  sky::Weather weather;
};

sky::Weather weather(double oktas, std::optional<double> optical_depth = std::nullopt) {
  sky::Weather weather;
  weather.cover_oktas = oktas;
  weather.optical_depth = optical_depth;
  return weather;
}

std::vector<Hour> hours() {
  sky::Weather cie = weather(8.0), rain = weather(8.0), fog;
  cie.overcast = sky::Overcast::kCie;
  rain.rain_mm_per_h = 20.0;
  fog.visibility_m = 200.0;
  return {{"cie", 40.0, cie},
          {"closed layer", 40.0, weather(8.0)},
          {"thin layer", 40.0, weather(8.0, 2.0)},
          {"rain", 40.0, rain},
          {"low sun", 5.0, {}},
          {"low sun under thin cloud", 5.0, weather(8.0, 0.3)},
          {"low sun between clouds", 5.0, weather(4.0)},
          {"low sun in fog", 5.0, fog},
          {"dusk", -4.0, {}},
          {"dusk under a layer", -4.0, weather(8.0)},
          {"dusk in fog", -4.0, fog}};
}

TEST(FastLight, AgreesWithPathTracedLightInAllWeather) {
  const light::World& world = bakedYard();
  std::vector<sky::Daylight> days;
  for (const Hour& hour : hours())
    days.push_back(sky::usualAir().daylight(
        {Direction(Azimuth::degrees(230.0), Angle::degrees(hour.sun_deg)), 1.0}, {}, hour.weather));
  const std::vector<light::LuminanceError> errors =
      errorsAgainstTraced(world, lookingAt({-5.0, -6.0, 1.6}, {4.0, 4.0, 1.5}), days, 128);
  for (std::size_t i = 0; i < errors.size(); ++i) {
    const std::string name = hours()[i].name;
    EXPECT_GT(errors[i].pixels, 1500u) << name;
    // Measured 1.9 to 2.8 %, of which 1.5 to 2.3 % are the reference's noise; in fog some of it is air
    // between corners of tiles, which also makes the p95 there 10 % beside 5.8 to 7.4 %.
    EXPECT_LT(errors[i].mean, 0.04) << name;
    EXPECT_LT(errors[i].p95, 0.12) << name;
    EXPECT_LT(std::abs(errors[i].bias), 0.03) << name;
    EXPECT_LT(errors[i].noise, 0.03) << name;
  }
}

TEST(FastLight, AgreesWithPathTracedLightOfALampInFogUnderTheMoon) {
  scene::Scene scene = yard();
  scene::Lamp lamp;
  lamp.position = {3.0f, 0.0f, 3.0f};
  lamp.intensity = LinearRgb(200.0f, 190.0f, 150.0f);
  scene.lamps = {lamp};
  const light::World world = baked(scene);
  const sky::MoonInSky moon{Direction(Azimuth::degrees(150.0), Angle::degrees(40.0)), std::nullopt, 384400e3,
                            Angle::degrees(10.0)};
  sky::Weather fog;
  fog.visibility_m = 150.0;
  const sky::Daylight night = sky::usualAir().daylight(
      {Direction(Azimuth::degrees(300.0), Angle::degrees(-40.0)), 1.0}, {moon, std::nullopt, nullptr}, fog);
  render::Renderer renderer(world, smallCamera(64, 48, 90.0));
  renderer.look(lookingAt({-5.0, -6.0, 1.6}, {4.0, 4.0, 1.5}));
  const light::Illumination light = light::illumination(world, night);
  ASSERT_NE(light.lamps, nullptr);  // it is dark
  light::ReferenceOptions reference;
  reference.samples_per_pixel = 256;
  reference.lamps = *light.lamps;
  const light::Traced traced = light::traceReference(renderer.surfaces(), world, {night}, reference).front();
  const light::LuminanceError error =
      light::luminanceError(renderer.light(light), traced, renderer.surfaces());
  // Measured 1.8 and 5.6 %, noise 1.4 %: as by day.
  EXPECT_LT(error.mean, 0.04);
  EXPECT_LT(error.p95, 0.12);
  EXPECT_LT(std::abs(error.bias), 0.03);
  EXPECT_LT(error.noise, 0.03);
}

TEST(LuminanceError, IsThatOfAPictureTooBrightByATenth) {
  light::World world(shared(yard()));
  render::Renderer renderer(world, smallCamera(32, 32, 90.0));
  renderer.look(lookingAt({-5.0, -6.0, 1.6}, {4.0, 4.0, 1.5}));
  const image::LinearImage picture = renderer.light(daylightAt(230.0, 30.0));
  light::Traced same{picture, image::Picture<float, 1>(picture.width, picture.height)};
  EXPECT_EQ(light::luminanceError(picture, same, renderer.surfaces()).mean, 0.0);
  image::LinearImage bright = picture;
  for (float& value : bright.data) value *= 1.1f;
  const light::LuminanceError error = light::luminanceError(bright, same, renderer.surfaces());
  for (const double value : {error.mean, error.median, error.p95, error.bias}) EXPECT_NEAR(value, 0.1, 1e-4);
  EXPECT_EQ(error.noise, 0.0);
  // Beside a black reference there is none.
  std::fill(same.luminance.data.begin(), same.luminance.data.end(), 0.0f);
  const light::LuminanceError none = light::luminanceError(bright, same, renderer.surfaces());
  EXPECT_EQ(none.pixels, 0u);
  EXPECT_EQ(none.mean, 0.0);
  EXPECT_THROW(light::luminanceError(image::LinearImage(3, 3), same, renderer.surfaces()),
               std::invalid_argument);
}

}  // namespace
}  // namespace sunlit::test
