// Lamps by pencil and paper, and against traced paths.
#include "sunlit/light/lamps.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "built_in_world.h"
#include "lamp_scene.h"
#include "sunlit/light/lamp_surroundings.h"

namespace sunlit::light {
namespace {

double reflectance(const World& world, const Looked& point, const Eigen::Vector3f& lamp) {
  const scene::Material& material =
      world.geometry->scene->materials[static_cast<std::size_t>(point.material)];
  const Reflection reflection{point.normal, point.to_eye, material.base_color.value, material.roughness,
                              material.metalness};
  return static_cast<double>(directReflectance(reflection, (lamp - point.position).normalized(), 0.0f)[1]);
}

TEST(Lamps, GiveTheirIntensityOverTheSquareOfTheDistance) {
  const World world = floorWorld();
  const Eigen::Vector3f at(0.0f, 0.0f, 8.0f);
  std::vector<Looked> points;
  for (const float x : {0.0f, 3.0f, 6.0f, 12.0f}) points.push_back(floorAt(x));
  const std::vector<double> seen = lit(world, {lampAt(at)}, points);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double square = static_cast<double>((at - points[i].position).squaredNorm());
    const double expected = reflectance(world, points[i], at) * 100.0 / square;
    // Single precision, and the highlight widened by 0.05 m / 8 m on a roughness of 1: 0.3 %.
    EXPECT_NEAR(seen[i], expected, 0.01 * expected) << points[i].position.x();
  }
}

TEST(Lamps, OfABallOfLuminanceLGivePiLTimesTheSquareOfItsSine) {
  const World world = floorWorld();
  scene::Lamp ball = lampAt({0.0f, 0.0f, 2.0f}, 0.0f);
  ball.radius_m = 1.0f;
  constexpr double kLuminance = 1000.0;
  const double cd = kPi * kLuminance;  // L π r²
  ball.intensity = LinearRgb(Eigen::Array3f::Constant(static_cast<float>(cd)));
  const Looked below = floorAt(0.0f);
  const double sine2 = 0.25;  // (r / d)²
  const double expected = reflectance(world, below, ball.position) * kPi * kLuminance * sine2;
  // Of the reflectance: the widened highlight of a matt surface.
  EXPECT_NEAR(lit(world, {ball}, {below})[0], expected, 0.03 * expected);
}

TEST(Lamps, Sum) {
  const World world = floorWorld();
  const scene::Lamp a = lampAt({-2.0f, 0.0f, 3.0f}), b = lampAt({4.0f, 1.0f, 5.0f}, 300.0f);
  const std::vector<Looked> points = {floorAt(0.0f), floorAt(1.0f, 2.0f)};
  const std::vector<double> one = lit(world, {a}, points), other = lit(world, {b}, points),
                            both = lit(world, {a, b}, points);
  for (std::size_t i = 0; i < points.size(); ++i) EXPECT_NEAR(both[i], one[i] + other[i], 1e-5 * both[i]);
}

TEST(Lamps, OfACone) {
  const World world = floorWorld();
  scene::Lamp spot = lampAt({0.0f, 0.0f, 10.0f});
  spot.inner_rad = 0.3f;
  spot.outer_rad = 0.6f;
  const auto at = [](double angle) { return floorAt(static_cast<float>(10.0 * std::tan(angle))); };
  scene::Lamp all_around = lampAt(spot.position);
  const std::vector<Looked> points = {at(0.0), at(0.29), at(0.45), at(0.59), at(0.61)};
  const std::vector<double> seen = lit(world, {spot}, points), full = lit(world, {all_around}, points);
  EXPECT_DOUBLE_EQ(seen[0], full[0]);
  EXPECT_DOUBLE_EQ(seen[1], full[1]);
  const double between =
      (std::cos(0.45) - std::cos(0.6)) / (std::cos(0.3) - std::cos(0.6));  // squared, as in glTF
  EXPECT_NEAR(seen[2] / full[2], between * between, 1e-4);
  EXPECT_GT(seen[3], 0.0);
  EXPECT_EQ(seen[4], 0.0);
  spot.range_m = 10.5f;
  spot.ends_sharply = true;
  const std::vector<double> ranged = lit(world, {spot}, points);
  EXPECT_DOUBLE_EQ(ranged[1], seen[1]);  // 10.44 m away
  EXPECT_EQ(ranged[2], 0.0);             // 11.1 m
}

TEST(Lamps, FollowGazebosAttenuation) {
  const World world = floorWorld();
  scene::Lamp lamp = lampAt({0.0f, 0.0f, 10.0f}, 1.0f);
  lamp.constant = 0.2f;
  lamp.linear = 0.01f;
  lamp.quadratic = 0.001f;
  const Looked below = floorAt(0.0f);
  const double expected = reflectance(world, below, lamp.position) / (0.2 + 0.1 + 0.1);
  EXPECT_NEAR(lit(world, {lamp}, {below})[0], expected, 0.005 * expected);
}

/// A floor and a wall of no thickness at x = 1, from 0 to 1 m above it; lamps stand at x = 0.
World wallWorld() {
  scene::Scene scene;
  scene.materials = {paint(0.5f), paint(0.0f)};
  addGround(&scene, 0, 100.0f);
  addPatch(&scene, 1, {1.0f, -50.0f, 0.0f}, {0.0f, 100.0f, 0.0f}, {0.0f, 0.0f, 1.0f});
  return worldOf(std::move(scene));
}

TEST(Lamps, CastShadowsWhosePenumbraHasTheWidthOfSimilarTriangles) {
  const World world = wallWorld();
  scene::Lamp lamp = lampAt({0.0f, 0.0f, 2.0f});
  lamp.radius_m = 0.1f;
  // Rays from the ball's rim over the wall's edge: tangents of the disc across the way to x = 2, where the
  // shadow of its middle ends: d = √8 m away, by 0.1 m up and down at right angles.
  const double up = 0.1 / std::sqrt(2.0);
  const auto end = [](double x, double z) { return x + (1.0 - x) * z / (z - 1.0); };
  const double lit_from = end(-up, 2.0 - up), dark_until = end(up, 2.0 + up);
  const double last_dark = std::min(lit_from, dark_until), first_lit = std::max(lit_from, dark_until);
  std::vector<Looked> points;
  constexpr int kCount = 160;
  for (int i = 0; i < kCount; ++i) points.push_back(floorAt(1.7f + 0.004f * static_cast<float>(i)));
  std::vector<double> seen = lit(world, {lamp}, points);
  scene::Lamp open = lamp;
  open.casts_shadows = false;
  const std::vector<double> unhidden = lit(world, {open}, points);
  double width = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double x = static_cast<double>(points[i].position.x()), share = seen[i] / unhidden[i];
    // Outermost points of the 16 lie within 2 % of the rim, which a band of 6 mm covers.
    if (x < last_dark - 0.006) {
      EXPECT_EQ(share, 0.0) << x;
    }
    if (x > first_lit + 0.006) {
      EXPECT_EQ(share, 1.0) << x;
    }
    width += 0.004 * (share > 0.02 && share < 0.98 ? 1.0 : 0.0);
  }
  // 16 points do not show the first and last 3 % of the width of a disc, and some pixels see no change.
  EXPECT_NEAR(width, first_lit - last_dark, 0.15 * (first_lit - last_dark));
}

TEST(Lamps, LightThroughWhatLiesInTheirBallOrWhereTheyCastNoShadows) {
  scene::Scene scene;
  scene.materials = {paint(0.5f), paint(0.0f)};
  addGround(&scene, 0, 100.0f);
  addBlock(&scene, 1, {-0.02f, -0.02f, 1.98f}, {0.04f, 0.04f, 0.04f});
  const World world = worldOf(std::move(scene));
  scene::Lamp lamp = lampAt({0.0f, 0.0f, 2.0f});
  EXPECT_GT(lit(world, {lamp}, {floorAt(0.3f)})[0], 0.0);
  lamp.radius_m = 0.005f;
  EXPECT_EQ(lit(world, {lamp}, {floorAt(0.3f)})[0], 0.0);
  lamp.casts_shadows = false;
  EXPECT_GT(lit(world, {lamp}, {floorAt(0.3f)})[0], 0.0);
}

/// As fitToSurroundings() leaves the lamp, in a world of one more material: it glows.
scene::Lamp fitted(const scene::Lamp& lamp, scene::Scene scene, std::size_t enclosed) {
  const World world = worldOf(std::move(scene));
  std::vector<scene::Lamp> lamps = {lamp};
  EXPECT_EQ(fitToSurroundings(world, &lamps).size(), enclosed);
  return lamps[0];
}

TEST(LampSurroundings, KeepABallFromReachingThroughACeiling) {
  scene::Scene scene;
  const Eigen::Vector3f up = Eigen::Vector3f::UnitZ();
  scene.materials = {paint(0.5f), paint(0.0f, 100.0f)};
  addPatch(&scene, 0, {-2.0f, -2.0f, 2.03f}, {0.0f, 4.0f, 0.0f}, {4.0f, 0.0f, 0.0f});
  const scene::Lamp lamp = lampAt({0.0f, 0.0f, 2.0f});
  scene::Scene with_roof = scene;
  addPatch(&with_roof, 0, {-2.0f, -2.0f, 2.5f}, {0.0f, 4.0f, 0.0f}, {4.0f, 0.0f, 0.0f});
  const Looked roof = {{0.0f, 0.0f, 2.5f}, -up, -up, 0};
  const scene::Lamp below = fitted(lamp, scene, 0);
  EXPECT_NEAR(below.radius_m, 0.015f, 0.002f);
  EXPECT_GT(lit(worldOf(with_roof), {lamp}, {roof})[0], 0.0);
  EXPECT_EQ(lit(worldOf(with_roof), {below}, {roof})[0], 0.0);
  // A disc that glows below it is its bulb.
  addPatch(&scene, 1, {-0.1f, -0.1f, 1.97f}, {0.0f, 0.2f, 0.0f}, {0.2f, 0.0f, 0.0f});
  EXPECT_EQ(fitted(lamp, scene, 0).radius_m, lamp.radius_m);
}

TEST(LampSurroundings, LetALampShineThroughItsHousing) {
  scene::Scene scene;
  scene.materials = {paint(0.5f), paint(0.0f)};
  addGround(&scene, 0, 100.0f);
  const scene::Lamp lamp = lampAt({0.0f, 0.0f, 4.0f});
  scene::Scene housed = scene;
  addBlock(&housed, 1, {-0.4f, -0.4f, 3.7f}, {0.8f, 0.8f, 0.5f});
  const World world = worldOf(housed);
  const Looked floor = floorAt(1.0f);
  EXPECT_EQ(lit(world, {lamp}, {floor})[0], 0.0);
  const scene::Lamp shines = fitted(lamp, housed, 1);
  EXPECT_EQ(lit(world, {shines}, {floor})[0], lit(worldOf(scene), {lamp}, {floor})[0]);
  // What is farther off than a metre is a room.
  addBlock(&scene, 1, {-1.2f, -1.2f, 2.8f}, {2.4f, 2.4f, 2.4f});
  EXPECT_EQ(fitted(lamp, scene, 0).housing_m, 0.0f);
  // Open below, it throws its shadow.
  scene::Lamp spot = lamp;
  spot.outer_rad = 0.3f;
  spot.inner_rad = 0.2f;
  scene::Scene shade;
  shade.materials = {paint(0.5f)};
  addPatch(&shade, 0, {0.02f, -0.5f, 3.5f}, {1.0f, 0.0f, 0.0f}, {0.0f, 0.0f, 1.0f});
  EXPECT_EQ(fitted(spot, shade, 0).housing_m, 0.0f);
}

TEST(Lamps, LookAsByTracedPaths) {
  const World world = wallWorld();
  scene::Lamp soft = lampAt({0.0f, 0.0f, 2.0f});
  soft.radius_m = 0.2f;
  scene::Lamp spot = lampAt({5.0f, 3.0f, 4.0f}, 500.0f);
  spot.inner_rad = 0.5f;
  spot.outer_rad = 1.0f;
  const std::vector<scene::Lamp> lamps = {soft, spot};
  std::vector<Looked> points;
  for (int i = 0; i < 40; ++i) points.push_back(floorAt(-2.0f + 0.2f * static_cast<float>(i) + 0.05f));
  ReferenceOptions options;
  options.samples_per_pixel = 4096;
  options.lamps = lamps;
  options.bounces = 0;  // the wall is black and the floor flat: there is nothing more
  const Surfaces surfaces = rowOf(points, *world.geometry->scene);
  const std::vector<double> slow =
      rowValues(traceReference(surfaces, world, {uniformDay(0.0f)}, options)[0].luminance);
  const std::vector<double> fast = lit(world, lamps, points);
  for (std::size_t i = 0; i < points.size(); ++i) {
    // A sixteenth of the soft lamp in its penumbra, which is 0.8 m wide; elsewhere 1 % of lobes widened, and,
    // as the pixels are 0.2 m apart, the shadow of a lamp that gives less than 2 % may be that beside it.
    const bool penumbra = std::abs(points[i].position.x() - 2.0f) < 0.6f;
    EXPECT_NEAR(fast[i], slow[i], (penumbra ? 0.08 : 0.03) * slow[i] + 1e-3) << points[i].position.x();
  }
}

TEST(Lamps, AreLeftOutOnlyWhereTheyMatterLittle) {
  const World world = floorWorld();
  std::vector<scene::Lamp> row;
  for (int i = 0; i < 200; ++i) row.push_back(lampAt({10.0f * static_cast<float>(i - 100), 4.0f, 6.0f}));
  std::vector<Looked> points;
  for (int i = 0; i < 16; ++i) points.push_back(floorAt(2.0f * static_cast<float>(i)));
  std::vector<double> sum(points.size(), 0.0);
  for (const scene::Lamp& lamp : row) {
    const std::vector<double> one = lit(world, {lamp}, points);
    for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += one[i];
  }
  const std::vector<double> all = lit(world, row, points);
  for (std::size_t i = 0; i < sum.size(); ++i) {
    EXPECT_NEAR(all[i], sum[i], 0.01 * sum[i]);  // LampLight::kLeftOut
    EXPECT_LE(all[i], sum[i] * 1.00001);
  }
}

/// A sun of 100 klx and no sky.
sky::Daylight noon() {
  sky::UniformSky sky;
  sky.sun = onlySun(180.0, 60.0).sun();
  sky.sun.illuminance = LinearRgb(1e5f, 1e5f, 1e5f);
  return sky::uniformDaylight(sky);
}

TEST(Lamps, AreLeftOutByTheDaylightThatReachesASurface) {
  // A hall without walls, whose roof ends above the middle of the row: the sun, in the south, reaches the
  // floor from 10 m / tan 60° = 5.8 m beyond it on.
  scene::Scene scene;
  scene.materials = {paint(0.5f), paint(0.0f)};
  addGround(&scene, 0, 100.0f);
  addPatch(&scene, 1, {-100.0f, -100.0f, 10.0f}, {0.0f, 100.0f, 0.0f}, {200.0f, 0.0f, 0.0f});
  const World world = worldOf(std::move(scene));
  std::vector<scene::Lamp> row;  // each gives less than 0.1 % of the sun, at most
  for (int i = -2; i <= 2; ++i) row.push_back(lampAt({2.0f * static_cast<float>(i), -8.0f, 6.0f}, 1500.0f));
  std::vector<Looked> points;
  for (int i = 0; i < 8; ++i) points.push_back(floorAt(0.0f, -8.0f));
  for (int i = 0; i < 8; ++i) points.push_back(floorAt(0.0f, 8.0f));
  const Surfaces surfaces = rowOf(points, *world.geometry->scene);
  const auto seen = [&](const sky::Daylight& day, const std::vector<scene::Lamp>& lamps) {
    Illumination light(day);
    light.lamps = std::make_shared<const std::vector<scene::Lamp>>(lamps);
    return rowValues(surfaces, world, light);
  };
  const std::vector<double> night = seen(uniformDay(0.0f), row), sun = seen(noon(), {}),
                            both = seen(noon(), row);
  for (std::size_t i = 0; i < points.size(); ++i) {
    EXPECT_TRUE(i < 8 ? sun[i] == 0.0 : sun[i] > 100.0 * night[i]) << i;
    EXPECT_NEAR(both[i], sun[i] + night[i], 0.01 * (sun[i] + night[i])) << i;  // LampLight::kLeftOut
  }
}

TEST(Lamps, GiveTheSameBitsForAnyNumberOfThreads) {
  const World world = wallWorld();
  std::vector<Looked> points;
  for (int i = 0; i < 500; ++i) points.push_back(floorAt(-2.0f + 0.01f * static_cast<float>(i)));
  const std::vector<double> many = lit(world, {lampAt({0.0f, 0.0f, 2.0f})}, points);
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  EXPECT_EQ(lit(world, {lampAt({0.0f, 0.0f, 2.0f})}, points), many);
}

/// By the level of a sun in the east or in the west.
sky::Daylight dayOf(double azimuth_deg, float lx) {
  sky::UniformSky sky;
  sky.sun.towards = Direction(Azimuth::degrees(azimuth_deg), Angle::degrees(90.0 - 60.0));
  sky.sun.illuminance = LinearRgb(2.0f * lx, 2.0f * lx, 2.0f * lx);  // sin 30° of it on the ground
  return sky::uniformDaylight(sky);
}

TEST(DuskSwitch, GoesByTheLightAndWhetherTheSunRises) {
  LampOptions options;
  EXPECT_TRUE(burnUnder(options, dayOf(270.0, 29.0f)));
  EXPECT_FALSE(burnUnder(options, dayOf(270.0, 31.0f)));
  EXPECT_TRUE(burnUnder(options, dayOf(90.0, 44.0f)));
  EXPECT_FALSE(burnUnder(options, dayOf(90.0, 46.0f)));
  options.mode = LampMode::kOn;
  EXPECT_TRUE(burnUnder(options, dayOf(90.0, 1e4f)));
  options.mode = LampMode::kOff;
  EXPECT_FALSE(burnUnder(options, dayOf(90.0, 0.0f)));
}

TEST(LampGroups, AreSwitchedOffByName) {
  scene::Lamp post = lampAt({0, 0, 5}), sign = lampAt({0, 0, 3});
  post.group = "posts";
  sign.group = "signs";
  sign.relative = true;
  LampOptions options;
  options.off = {"posts"};
  options.colour_lx = 2.0;
  const std::vector<scene::Lamp> left = burning({post, sign}, options);
  ASSERT_EQ(left.size(), 1u);
  EXPECT_EQ(left[0].group, "signs");
  EXPECT_FALSE(left[0].relative);
  EXPECT_FLOAT_EQ(left[0].intensity.value[0], 200.0f);
}

TEST(LampGroups, OfTheBuiltInWorldsWindowsDarkenItsPanes) {
  const scene::Scene& world = builtInWorld();
  std::size_t panes = 0;
  const auto shining = [&](const LampOptions& options) {
    const std::vector<scene::Lamp> lamps = burning(world.lamps, options);
    std::size_t count = 0;
    panes = 0;
    for (const scene::Material& material : world.materials) {
      if (material.lamp_group != "windows") continue;
      ++panes;
      count += glows(material, lamps) ? 1 : 0;
    }
    return count;
  };
  LampOptions options;
  EXPECT_EQ(shining(options), panes);
  EXPECT_GT(panes, 0u);
  options.off = {"street_lamps", "grandstand"};
  EXPECT_EQ(shining(options), panes);
  options.off = {"windows"};
  EXPECT_EQ(shining(options), 0u);
  // By day nothing burns at all.
  for (const scene::Material& material : world.materials) EXPECT_FALSE(glows(material, {})) << material.name;
}

}  // namespace
}  // namespace sunlit::light
