// Scenes with pencil-and-paper answers: how bright, and where the shadows lie.
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "sunlit/light/illumination.h"
#include "sunlit/quantity/angle.h"
#include "support/usual_air.h"
#include "test_scenes.h"

namespace sunlit::test {
namespace {

/// Reflectance of the ground for one light at normal view, by hand: Lambert with what Fresnel leaves, and a
/// GGX lobe of roughness 1, whose distribution is 1 / π everywhere and whose visibility term is 1 / (2 (n·l +
/// n·v)).
Eigen::Array3f byHand(const Eigen::Array3f& albedo, float n_l, float n_v, float v_h) {
  const float fresnel = 0.04f + 0.96f * std::pow(1.0f - v_h, 5.0f);
  return (albedo / kPiFloat * (1.0f - fresnel) + fresnel / kPiFloat * 0.5f / (n_l + n_v)) * n_l;
}

TEST(Ground, IsAsBrightAsItsAlbedoTimesTheSunsCosine) {
  scene::Scene scene;
  const Eigen::Array3f albedo(0.5f, 0.3f, 0.1f);
  addGround(&scene, addMaterial(&scene, albedo), 50.0f);
  render::Renderer renderer(shared(scene), smallCamera());
  renderer.look(lookingAt({0.0, 0.0, 5.0}, {0.0, 0.0, 0.0}));
  for (double elevation_deg : {60.0, 30.0, 10.0}) {
    const sky::Daylight day = daylightAt(140.0, elevation_deg);
    const Eigen::Array3f seen = at(renderer.light(day), 80, 60);
    const auto sine = static_cast<float>(std::sin(elevation_deg * kRadPerDeg));
    // Half way between the eye (straight up) and the sun.
    const auto v_h = static_cast<float>(std::cos(0.5 * (90.0 - elevation_deg) * kRadPerDeg));
    const Eigen::Array3f sun = byHand(albedo, sine, 1.0f, v_h) * day.sun().illuminance.value;
    // The sky's mirror part depends on a fitted lobe: of 4 % reflectance it can add 0.04 / π, or take that
    // share of the diffuse part.
    const Eigen::Array3f sky = skyPart(day, Eigen::Vector3f::UnitZ(), albedo);
    const Eigen::Array3f lobe = 0.04f / kPiFloat * day.skyIlluminance(Eigen::Vector3f::UnitZ()).value;
    for (int c = 0; c < 3; ++c) {
      EXPECT_NEAR(seen[c], sun[c] + sky[c], lobe[c]) << elevation_deg << " deg, channel " << c;
    }
  }
}

TEST(Ground, OfAlbedoZeroAndFullMetalIsBlack) {
  scene::Scene scene;
  const int material = addMaterial(&scene, Eigen::Array3f::Zero());
  scene.materials[static_cast<std::size_t>(material)].metalness = 1.0f;
  addGround(&scene, material, 50.0f);
  render::Renderer renderer(shared(scene), smallCamera());
  renderer.look(lookingAt({0.0, 0.0, 5.0}, {0.0, 0.0, 0.0}));
  const sky::Daylight day = daylightAt(140.0, 40.0);
  // Schlick's share of a black mirror is (1 − cos θ)^5 at half the angle between eye and light: of the sky at
  // most 0.0021 (of its horizon), of the sun (25°) 8e-6 a lux.
  const float limit = 0.0021f * day.skyIlluminance(Eigen::Vector3f::UnitZ()).value.maxCoeff() / kPiFloat +
                      1e-5f * day.sun().illuminance.value.maxCoeff();
  EXPECT_LT(at(renderer.light(day), 80, 60).maxCoeff(), limit);
}

TEST(Emission, ComesOnTopOfReflectedLight) {
  scene::Scene scene;
  const int material = addMaterial(&scene, Eigen::Array3f(0.2f, 0.2f, 0.2f));
  addGround(&scene, material, 50.0f);
  const sky::Daylight day = daylightAt(140.0, 40.0);
  render::Renderer dark(shared(scene), smallCamera());
  scene.materials[static_cast<std::size_t>(material)].emission = LinearRgb(1000.0f, 2000.0f, 3000.0f);
  render::Renderer glowing(shared(scene), smallCamera());
  for (auto* renderer : {&dark, &glowing}) renderer->look(lookingAt({0.0, 0.0, 5.0}, {0.0, 0.0, 0.0}));
  const Eigen::Array3f difference = at(glowing.light(day), 80, 60) - at(dark.light(day), 80, 60);
  const Eigen::Array3f air = day.airOver({0.0f, 0.0f, -1.0f}, 5.0f).transmittance;
  // Single precision of luminances of some thousand, 1 in 10^6, and air interpolated between distances: 0.5 %
  // of the 0.1 % that 5 m take away.
  EXPECT_NEAR(difference[0], 1000.0f * air[0], 0.1f);
  EXPECT_NEAR(difference[1], 2000.0f * air[1], 0.1f);
  EXPECT_NEAR(difference[2], 3000.0f * air[2], 0.1f);
}

TEST(Emission, IsSeenThroughThePartOfItsWayThatLiesInFog) {
  // A square at 300 m that the camera looks down on from 120 m above it, under fog of 30 m.
  scene::Scene scene;
  const int material = addMaterial(&scene, Eigen::Array3f::Constant(0.2f));
  addPatch(&scene, material, {-200.0f, -200.0f, 300.0f}, {400.0f, 0.0f, 0.0f}, {0.0f, 400.0f, 0.0f});
  const light::World dark(shared(scene));
  scene.materials[static_cast<std::size_t>(material)].emission = LinearRgb(1e5f, 1e5f, 1e5f);
  const light::World glowing(shared(scene));
  sky::Weather weather;
  weather.visibility_m = 50.0;
  weather.fog_top_m = 30.0;
  const sky::Daylight day =
      sky::usualAir().daylight({Direction(Azimuth::degrees(140.0), Angle::degrees(40.0)), 1.0}, {}, weather);
  const auto seen = [&](const light::World& world, double height_m) {
    render::Renderer renderer(world, smallCamera());
    renderer.look(lookingAt({0.0, 0.0, 300.0 + height_m}, {0.0, 1e-3, 300.0}));
    return at(renderer.light(light::illumination(world, day)), 80, 60)[1];
  };
  for (const double height_m : {120.0, 60.0, 20.0}) {
    const double depth = std::min(height_m, 30.0) * static_cast<double>(day.fog().per_m);
    const double passed = static_cast<double>((seen(glowing, height_m) - seen(dark, height_m)) / 1e5f);
    // Air that is not fog takes 1 %, and what the camera looks at askew another.
    EXPECT_NEAR(passed / std::exp(-depth), 1.0, 0.02) << height_m;
  }
}

TEST(Leaf, LitFromBehindGlowsByWhatItLetsThrough) {
  // A sheet across the sun's way, seen from its shady side: of the direct light only the transmitted share
  // comes, without acne.
  scene::Scene scene;
  const int material = addMaterial(&scene, Eigen::Array3f(0.5f, 0.5f, 0.5f));
  addPatch(&scene, material, {-50.0f, 5.0f, -50.0f}, {100.0f, 0.0f, 0.0f}, {0.0f, 0.0f, 100.0f});
  const sky::Daylight day = daylightAt(0.0, 20.0);
  render::Renderer opaque(shared(scene), smallCamera());
  scene.materials[0].transmission = 0.4f;
  render::Renderer thin(shared(scene), smallCamera());
  for (auto* renderer : {&opaque, &thin}) renderer->look(lookingAt({0.0, 0.0, 0.0}, {0.0, 5.0, 0.0}));
  const image::LinearImage shade = opaque.light(day), glow = thin.light(day);
  const float cosine = static_cast<float>(std::cos(Angle::degrees(20.0).rad()));
  const Eigen::Array3f through = 0.4f * 0.5f / kPiFloat * cosine * day.sun().illuminance.value;
  const Eigen::Array3f sky =
      day.skyIlluminance({0.0f, 1.0f, 0.0f}).value.max(day.skyIlluminance({0.0f, -1.0f, 0.0f}).value);
  for (const int x : {20, 80, 140}) {
    // What of the sky's light changes sides is less than all that a Lambert sheet could send on.
    const Eigen::Array3f error = (at(glow, x, 60) - at(shade, x, 60) - through).abs();
    EXPECT_TRUE((error <= 0.4f * 0.5f / kPiFloat * sky + 1e-3f * through).all()) << x;
  }
}

/// Straight down on the ground from 100 m, 10 px a metre, north up: pixel of a point of the ground.
struct MapView {
  render::RenderOptions options;
  MapView() {
    options.camera = image::PinholeCamera{400, 400, 1000.0, 1000.0, 199.5, 199.5};
    options.supersampling = 2;
  }
  Eigen::Isometry3d pose() const { return lookingAt({0.0, 0.0, 100.0}, {0.0, 0.0, 0.0}); }
  static int column(double east_m) { return static_cast<int>(std::lround(199.5 + 10.0 * east_m)); }
  static int row(double north_m) { return static_cast<int>(std::lround(199.5 - 10.0 * north_m)); }
};

TEST(Shadow, LiesOppositeTheSunInMapCoordinates) {
  scene::Scene scene;
  const int material = addMaterial(&scene, Eigen::Array3f(0.5f, 0.5f, 0.5f));
  addGround(&scene, material, 50.0f);
  // A pole 4 m high, 1 m wide, east by north of the centre: the scene has no symmetry.
  addBlock(&scene, material, {4.5f, 1.5f, 0.0f}, {1.0f, 1.0f, 4.0f});
  MapView view;
  render::Renderer renderer(shared(scene), view.options);
  renderer.look(view.pose());
  // Sun in the north-east at 45°: the shadow reaches 4 m to the south-west, (−2.83, −2.83) m.
  const sky::Daylight day = daylightAt(45.0, 45.0);
  const image::LinearImage image = renderer.light(day);
  const auto ground = [&](double east, double north) {
    return at(image, MapView::column(east), MapView::row(north))[1];
  };
  const float lit = ground(-10.0, 10.0);
  const float shaded = ground(5.0 - 2.0, 2.0 - 2.0);
  EXPECT_LT(shaded, 0.5f * lit);
  EXPECT_NEAR(ground(5.0 + 2.0, 2.0 + 2.0), lit, 0.01f * lit);  // towards the sun
  EXPECT_NEAR(ground(5.0 - 2.0, 2.0 + 2.0), lit, 0.01f * lit);
  EXPECT_NEAR(ground(5.0 + 2.0, 2.0 - 2.0), lit, 0.01f * lit);
  EXPECT_NEAR(ground(5.0 - 4.2, 2.0 - 4.2), lit,
              0.01f * lit);  // beyond its end: 2.83 + half the pole's diagonal 0.71
}

/// Width of the run of ground from which the sun goes from 10 % to 90 % visible, m.
double penumbraWidth(double edge_height_m) {
  scene::Scene scene;
  const int material = addMaterial(&scene, Eigen::Array3f(0.5f, 0.5f, 0.5f));
  addGround(&scene, material, 50.0f);
  // A roof over all that is west of x = 0; the camera looks from below it.
  addPatch(&scene, material, {-200.0f, -200.0f, static_cast<float>(edge_height_m)}, {200.0f, 0.0f, 0.0f},
           {0.0f, 400.0f, 0.0f});
  render::RenderOptions options;
  options.camera =
      image::PinholeCamera{400, 16, 2000.0, 2000.0, 199.5, 7.5};  // 2.5 mm a pixel on the ground 5 m below
  options.supersampling = 4;
  render::Renderer renderer(shared(scene), options);
  renderer.look(lookingAt({0.0, 0.0, 5.0}, {0.0, 0.0, 0.0}));
  const sky::Daylight day = daylightAt(180.0, 90.0);
  const image::LinearImage image = renderer.light(day);
  // Mean over the rows takes out the grain.
  std::vector<double> profile(400, 0.0);
  for (int y = 0; y < 16; ++y) {
    for (int x = 0; x < 400; ++x) profile[static_cast<std::size_t>(x)] += at(image, x, y)[1];
  }
  const double dark = profile.front(), bright = profile.back();
  int begin = 0, end = 0;
  for (int x = 0; x < 400; ++x) {
    const double share = (profile[static_cast<std::size_t>(x)] - dark) / (bright - dark);
    if (share < 0.1) begin = x;
    if (share < 0.9) end = x;
  }
  return (end - begin) * 5.0 / 2000.0;
}

TEST(Penumbra, IsAsWideAsTheSunsDiscMakesIt) {
  // A straight edge at height h hides a disc of radius r gradually over 2 h tan r; a disc is cut to 10 % and
  // to 90 % of its area by lines 0.687 r from its centre. h = 20 m, r = 0.2666°: 0.128 m.
  const double expected = 2.0 * 20.0 * std::tan(0.2666 * kRadPerDeg) * 0.687;
  // 16 points of the disc and 16 rows of pixels leave some 5 %.
  EXPECT_NEAR(penumbraWidth(20.0), expected, 0.1 * expected);
}

TEST(Sun, BelowTheHorizonLightsNothingFromBelow) {
  scene::Scene scene;
  const int material = addMaterial(&scene, Eigen::Array3f(0.5f, 0.5f, 0.5f));
  // An awning seen from below, with no ground beneath it.
  addPatch(&scene, material, {-50.0f, -50.0f, 10.0f}, {100.0f, 0.0f, 0.0f}, {0.0f, 100.0f, 0.0f});
  render::Renderer renderer(shared(scene), smallCamera());
  renderer.look(lookingAt({0.0, 0.0, 5.0}, {0.0, 0.0, 10.0}));
  const sky::Daylight day = daylightAt(140.0, -10.0);
  EXPECT_EQ(day.sun().illuminance.value.maxCoeff(), 0.0f);
  const Eigen::Array3f seen = at(renderer.light(day), 80, 60);
  const Eigen::Array3f sky = skyPart(day, -Eigen::Vector3f::UnitZ(), Eigen::Array3f::Constant(0.5f));
  EXPECT_LT(seen.maxCoeff(), 1.1f * sky.maxCoeff() + 1e-6f);
}

TEST(Underside, OfASunlitSheetIsNotLitByTheSun) {
  scene::Scene scene;
  const int material = addMaterial(&scene, Eigen::Array3f(0.5f, 0.5f, 0.5f));
  addPatch(&scene, material, {-50.0f, -50.0f, 10.0f}, {100.0f, 0.0f, 0.0f}, {0.0f, 100.0f, 0.0f});
  render::Renderer renderer(shared(scene), smallCamera());
  const sky::Daylight day = daylightAt(140.0, 50.0);
  renderer.look(lookingAt({0.0, 0.0, 5.0}, {0.0, 0.0, 10.0}));
  const float below = at(renderer.light(day), 80, 60)[1];
  renderer.look(lookingAt({0.0, 0.0, 15.0}, {0.0, 0.0, 10.0}));
  const float above = at(renderer.light(day), 80, 60)[1];
  const float sun = 0.5f / kPiFloat * day.sun().illuminance.value[1] * 0.766f;  // sin 50°
  EXPECT_GT(above, 0.9f * sun);
  // Light from the ground and no more; a tenth of it for the fitted mirror part.
  EXPECT_LT(below, 1.1f * skyPart(day, -Eigen::Vector3f::UnitZ(), Eigen::Array3f::Constant(0.5f))[1]);
}

/// The brightest pixel over the darkest, within a window of the picture.
float contrast(const image::LinearImage& image, int x0, int y0, int x1, int y1) {
  float low = 1e30f, high = 0.0f;
  for (int y = y0; y < y1; ++y) {
    for (int x = x0; x < x1; ++x) {
      low = std::min(low, at(image, x, y)[1]);
      high = std::max(high, at(image, x, y)[1]);
    }
  }
  return high / low;
}

TEST(Walls, LetNoSunThroughTheirSeams) {
  for (const double offset :
       {0.0, 3000.0}) {  // near the origin of `map`, and where single precision is 0.2 mm
    scene::Scene scene;
    const int material = addMaterial(&scene, Eigen::Array3f(0.5f, 0.5f, 0.5f));
    const auto o = static_cast<float>(offset);
    addBlock(&scene, material, {o - 4.0f, o - 4.0f, 0.0f}, {8.0f, 8.0f, 3.0f});
    render::Renderer renderer(shared(scene), smallCamera(160, 120, 100.0));
    for (const double azimuth_deg : {10.0, 100.0, 200.0}) {
      for (const double yaw : {0.3, 2.0, 4.0}) {
        const Eigen::Vector3d eye(offset, offset, 1.5);
        renderer.look(lookingAt(eye, eye + Eigen::Vector3d(std::cos(yaw), std::sin(yaw), -0.1)));
        const sky::Daylight day = daylightAt(azimuth_deg, 20.0);
        // One sunlit sample among the four of a pixel would add at least 0.5/π E sin(20°) / 4.
        const float one_leak = 0.25f * 0.5f / kPiFloat * day.sun().illuminance.value[1] * 0.34f;
        const image::LinearImage image = renderer.light(day);
        float brightest = 0.0f;
        for (std::size_t i = 1; i < image.data.size(); i += 3) brightest = std::max(brightest, image.data[i]);
        const float sky = 0.6f / kPiFloat * day.skyIlluminance(Eigen::Vector3f::UnitZ()).value.maxCoeff();
        const float ground = 0.6f / kPiFloat * day.skyIlluminance(-Eigen::Vector3f::UnitZ()).value.maxCoeff();
        float side = 0.0f;
        for (int k = 0; k < 4; ++k) {
          const Eigen::Vector3f n(k == 0   ? 1.0f
                                  : k == 1 ? -1.0f
                                           : 0.0f,
                                  k == 2   ? 1.0f
                                  : k == 3 ? -1.0f
                                           : 0.0f,
                                  0.0f);
          side = std::max(side, 0.6f / kPiFloat * day.skyIlluminance(n).value.maxCoeff());
        }
        EXPECT_LT(brightest, std::max({sky, ground, side}) + one_leak)
            << "offset " << offset << ", sun at " << azimuth_deg << ", yaw " << yaw;
        // A wall is as bright as itself elsewhere but for what its mirror part varies by: measured 1.1 %.
        std::vector<float> greens;
        for (std::size_t i = 1; i < image.data.size(); i += 3) greens.push_back(image.data[i]);
        std::nth_element(greens.begin(), greens.end() - 500, greens.end());
        EXPECT_LT(brightest, 1.05f * *(greens.end() - 500)) << "sun at " << azimuth_deg << ", yaw " << yaw;
      }
    }
  }
}

TEST(Ground, HasNoAcneUnderALowSunFarFromTheOrigin) {
  scene::Scene scene;
  const int material = addMaterial(&scene, Eigen::Array3f(0.5f, 0.5f, 0.5f));
  // Uneven facets by the hundred; all face the sun.
  for (int j = 0; j < 12; ++j) {
    for (int i = 0; i < 12; ++i) {
      addPatch(&scene, material, {4000.0f + 2.0f * i, 4000.0f + 2.0f * j, 7.3f}, {2.0f, 0.0f, 0.0f},
               {0.0f, 2.0f, 0.0f});
    }
  }
  render::Renderer renderer(shared(scene), smallCamera(160, 120, 60.0));
  renderer.look(lookingAt({4012.0, 4004.0, 8.5}, {4012.0, 4012.0, 7.3}));
  const image::LinearImage image = renderer.light(daylightAt(140.0, 2.0));
  // The lower part sees nothing but level ground. The mirror part of the sky varies with the angle of view, a
  // shadowed sample would take away a quarter at least.
  for (int y = 70; y < 119; ++y) {
    for (int x = 0; x < 159; ++x) {
      ASSERT_LT(contrast(image, x, y, x + 2, y + 2), 1.05f) << "pixel " << x << ", " << y;
    }
  }
}

}  // namespace
}  // namespace sunlit::test
