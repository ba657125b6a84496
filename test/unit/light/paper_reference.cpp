// The path-traced reference by scenes with pencil-and-paper answers.
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "paper_scene.h"

namespace sunlit::light {
namespace {

const Eigen::Vector3f kUp = Eigen::Vector3f::UnitZ();

Eigen::Vector3f tilted(double zenith_deg, double azimuth_deg = 30.0) {
  const double z = zenith_deg * kRadPerDeg, a = azimuth_deg * kRadPerDeg;
  return Eigen::Vector3d(std::sin(z) * std::cos(a), std::sin(z) * std::sin(a), std::cos(z)).cast<float>();
}

/// A box of 4 m about the origin, seen from inside.
scene::Scene room(const scene::Material& material) {
  scene::Scene scene;
  scene.materials = {material};
  addRoom(&scene, 0, {-2.0f, -2.0f, -2.0f}, {4.0f, 4.0f, 4.0f});
  return scene;
}

TEST(Furnace, ASheetInLightFromAllSidesShowsItsAlbedoTimesThatLight) {
  for (const float roughness : {0.3f, 1.0f}) {
    for (const float metalness : {0.0f, 1.0f}) {
      for (const float transmission : {0.0f, 0.4f}) {
        scene::Scene scene;
        scene::Material material = paint(0.6f);
        material.roughness = roughness;
        material.metalness = metalness;
        material.transmission = transmission;
        scene.materials = {material};
        addGround(&scene, 0, 1.0f);
        const std::vector<Looked> points = {{{0.1f, 0.2f, 0.0f}, kUp, tilted(20.0)},
                                            {{0.1f, 0.2f, 0.0f}, kUp, tilted(65.0)}};
        const std::vector<double> seen = traced(worldOf(scene), points, uniformDay(100.0f, 1.0), 4096);
        for (std::size_t i = 0; i < points.size(); ++i) {
          const double expected = 100.0 * albedoTowards(material, points[i].to_eye);
          // 4096 paths weighed by two densities leave less than half a percent; the sum over the sphere 0.3
          // %.
          EXPECT_NEAR(seen[i], expected, 0.008 * expected)
              << roughness << " " << metalness << " " << transmission << " view " << i;
        }
      }
    }
  }
}

TEST(Furnace, AGlowingRoomFillsUpToItsEmissionOverWhatItSwallows) {
  for (const float albedo : {0.2f, 0.5f, 0.8f}) {
    const scene::Material material = paint(albedo, 100.0f);
    const std::vector<Looked> points = {{{0.3f, 0.2f, -2.0f}, kUp, tilted(20.0)},
                                        {{-1.9f, -1.9f, -2.0f}, kUp, tilted(20.0)}};
    const std::vector<double> seen = traced(worldOf(room(material)), points, uniformDay(0.0f), 2048);
    // Where all walls are alike, L = e + R L. R depends on direction: its mean over the hemisphere by cosine
    // is what bounces see, its value towards the eye what the eye sees.
    double mean = 0.0;
    constexpr int kRings = 16;
    for (int i = 0; i < kRings; ++i) {
      const double sine2 = (i + 0.5) / kRings;
      mean += albedoTowards(material, tilted(std::asin(std::sqrt(sine2)) / kRadPerDeg)) / kRings;
    }
    const double expected = 100.0 + albedoTowards(material, points[0].to_eye) * 100.0 / (1.0 - mean);
    for (const double value : seen) {
      // 2 %: R lies within 2 % of its mean but at grazing angles, and a path's end is left to chance.
      EXPECT_NEAR(value, expected, 0.02 * expected) << albedo;
    }
  }
}

TEST(Panel, OfAHandsWidthLightsTheFloorOfAHallByItsSolidAngle) {
  scene::Scene scene;
  scene.materials = {paint(0.5f), paint(0.0f, 10000.0f)};
  scene.materials[1].double_sided = false;
  addGround(&scene, 0, 20.0f);
  addPatch(&scene, 1, {-0.05f, -0.05f, 8.0f}, {0.0f, 0.1f, 0.0f}, {0.1f, 0.0f, 0.0f});
  addPatch(&scene, 1, {4.95f, -0.05f, 4.0f}, {0.1f, 0.0f, 0.0f}, {0.0f, 0.1f, 0.0f});  // faces the sky
  const Looked below{{0.0f, 0.0f, 0.0f}, kUp, kUp};
  const Reflection reflection{kUp, kUp, Eigen::Array3f::Constant(0.5f), 1.0f, 0.0f};
  const double expected =
      static_cast<double>(directReflectance(reflection, kUp, 0.0f)[1]) * 10000.0 * 0.01 / 64.0;
  // Half of the points lie on the other panel, which shows its back: by 20,000 of them, 0.7 %; three times
  // that.
  EXPECT_NEAR(traced(worldOf(scene), {below}, uniformDay(0.0f), 20000)[0], expected, 0.02 * expected);
}

TEST(Lamps, ShowInMirrorsAsBrightAsTheyAre) {
  scene::Scene scene;
  scene::Material mirror = paint(0.8f);
  mirror.metalness = 1.0f;
  mirror.roughness = scene::Material::kSmoothest;
  scene.materials = {mirror};
  addGround(&scene, 0, 20.0f);
  const World world = worldOf(scene);
  scene::Lamp lamp;
  lamp.name = "lamp";
  lamp.position = {2.0f, 0.0f, 4.0f};
  lamp.radius_m = 0.5f;
  lamp.intensity = LinearRgb(100.0f, 100.0f, 100.0f);
  // Its image is a disc of 0.5 m across the way: amid it, and beside it.
  const Eigen::Vector3f to_eye = Eigen::Vector3f(-2.0f, 0.0f, 4.0f).normalized();
  std::vector<Looked> points;
  for (const float y : {0.0f, 0.1f, -0.2f, 2.0f}) points.push_back({{0.0f, y, 0.0f}, kUp, to_eye});
  const Surfaces surfaces = rowOf(points, scene);
  ReferenceOptions options;
  options.samples_per_pixel = 200;
  options.lamps = {lamp};
  const std::vector<double> seen =
      rowValues(traceReference(surfaces, world, {uniformDay(0.0f)}, options)[0].luminance);
  const double luminance = 100.0 / (kPi * 0.5 * 0.5);  // of a disc: I = L pi r2
  // 2 %: of its facets a few per mille look beside it, and the more of 0.8 by Fresnel is 0.001 %. By points
  // on the lamp alone 0 to 8 times that, for a hundredth of them lies within what a pixel's facets show.
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(seen[i], 0.8 * luminance, 0.02 * luminance) << i;
  EXPECT_NEAR(seen[3], 0.0, 0.001 * luminance);
}

TEST(Plates, TwoParallelOnesPassLightOnWithoutEnd) {
  // Two plates so wide that hardly anything leaves between them: as in the room, but the geometric series
  // goes to and fro between two surfaces, of which only one glows: L1 = e + R L2, L2 = R L1.
  const double half = 500.0;
  scene::Scene scene;
  scene.materials = {paint(0.5f, 100.0f), paint(0.5f)};
  const auto width = static_cast<float>(2.0 * half);
  addPatch(&scene, 0, {-500.0f, -500.0f, 0.0f}, {width, 0.0f, 0.0f}, {0.0f, width, 0.0f});
  addPatch(&scene, 1, {-500.0f, -500.0f, 1.0f}, {0.0f, width, 0.0f}, {width, 0.0f, 0.0f});
  const Eigen::Vector3f down(0.0f, 0.0f, -1.0f);
  const Eigen::Vector3f eye_above = tilted(20.0), eye_below = -tilted(20.0);
  const std::vector<double> seen = traced(
      worldOf(scene), {{{0.0f, 0.0f, 0.0f}, kUp, eye_above, 0}, {{0.0f, 0.0f, 1.0f}, down, eye_below, 1}},
      uniformDay(0.0f), 4096);
  const double r = albedoTowards(scene.materials[1], eye_above);
  const double glowing = 100.0 / (1.0 - r * r);
  EXPECT_NEAR(seen[0], glowing, 0.01 * glowing);  // as above
  EXPECT_NEAR(seen[1], r * glowing, 0.015 * r * glowing);
}

TEST(Sun, OfKnownElevationGivesLevelGroundItsSine) {
  scene::Scene scene;
  scene.materials = {paint(0.5f)};
  addGround(&scene, 0, 50.0f);
  const World world = worldOf(scene);
  for (const double elevation : {60.0, 30.0, 10.0, 3.0}) {
    const double seen = traced(world, {{{1.0f, 2.0f, 0.0f}, kUp, kUp}}, onlySun(140.0, elevation), 256)[0];
    // By hand for an eye straight above: Lambert with what Fresnel leaves, plus a GGX lobe of roughness 1,
    // whose distribution is 1 / π everywhere and whose visibility term is 1 / (2 (n·l + n·v)).
    const double sine = std::sin(elevation * kRadPerDeg);
    const double v_h = std::cos(0.5 * (90.0 - elevation) * kRadPerDeg);
    const double fresnel = 0.04 + 0.96 * std::pow(1.0 - v_h, 5.0);
    const double expected = sine / kPi * (0.5 * (1.0 - fresnel) + fresnel * 0.5 / (sine + 1.0));
    // The disc has a width of 0.53°: at 3° its mean sine is exact, the lobe's change across it is not seen.
    EXPECT_NEAR(seen, expected, 0.004 * expected) << elevation;
  }
}

TEST(Sun, BehindALeafShinesThroughByItsShare) {
  scene::Scene scene;
  scene.materials = {paint(0.4f)};
  scene.materials[0].transmission = 0.3f;
  addGround(&scene, 0, 50.0f);
  const Eigen::Vector3f down(0.0f, 0.0f, -1.0f);
  const double seen = traced(worldOf(scene), {{{1.0f, 2.0f, 0.0f}, down, down}}, onlySun(140.0, 30.0), 64)[0];
  const double expected = 0.3 * 0.4 * std::sin(30.0 * kRadPerDeg) / kPi;  // Lambert on the far side
  EXPECT_NEAR(seen, expected, 0.002 * expected);
}

TEST(UniformSky, LightsAnOpenPlaneByItsAlbedo) {
  scene::Scene scene;
  scene.materials = {paint(0.5f)};
  addGround(&scene, 0, 50.0f);
  const sky::Daylight day = uniformDay(100.0f);
  EXPECT_NEAR(day.skyIlluminance(kUp).value[1], 100.0 * kPi, 0.1);  // rounding of a sum of 2,560 patches
  const double seen = traced(worldOf(scene), {{{1.0f, 2.0f, 0.0f}, kUp, kUp}}, day, 1024)[0];
  const double expected = 100.0 * albedoTowards(scene.materials[0], kUp);
  EXPECT_NEAR(seen, expected, 0.01 * expected);
  // A rough dielectric is Lambert but for its 4 % of mirror: between albedo · L and that plus a twentieth of
  // L.
  EXPECT_GT(seen, 0.5 * 100.0 * 0.94);
  EXPECT_LT(seen, 0.5 * 100.0 + 5.0);
}

// Walls that only hide: what they reflect is left out by tracing no bounce.

TEST(WallFoot, SeesTheSkyThatTheWallLeaves) {
  constexpr float kHeight = 3.0f;
  scene::Scene scene;
  scene.materials = {paint(0.5f), paint(0.5f)};
  addGround(&scene, 0, 3000.0f);
  addPatch(&scene, 1, {0.0f, -3000.0f, 0.0f}, {0.0f, 6000.0f, 0.0f}, {0.0f, 0.0f, kHeight});
  std::vector<Looked> points;
  const std::vector<float> distances = {0.02f, 0.3f, 1.0f, 3.0f, 10.0f};
  for (const float distance : distances) points.push_back({{distance, 0.0f, 0.0f}, kUp, kUp});
  const std::vector<double> seen = traced(worldOf(scene), points, uniformDay(100.0f), 4096, 0);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto distance = static_cast<double>(distances[i]);
    const double top = kHeight / distance;  // tangent of the wall's elevation straight ahead
    const auto open = [&](const Eigen::Vector3f& w) {
      return w.z() > 0.0f &&
             !(w.x() < 0.0f && static_cast<double>(w.z()) < -top * static_cast<double>(w.x()));
    };
    const double expected = 100.0 * underSky(scene.materials[0], kUp, open);
    // 4096 paths leave less than half a percent, the sum over the sphere 0.3 %.
    EXPECT_NEAR(seen[i], expected, 0.008 * expected) << distances[i];
    // And by view factor: an endless wall of elevation α hides (1 − cos α) / 2 of a Lambert surface's sky.
    const double lambert = 1.0 - 0.5 * (1.0 - 1.0 / std::hypot(1.0, top));
    const double whole = 100.0 * albedoTowards(scene.materials[0], kUp);
    EXPECT_NEAR(seen[i], lambert * whole, 0.03 * lambert * whole) << distances[i];  // its mirror part
  }
}

TEST(BoxCorner, SeesAQuarterOfTheSkyAndOpensWithDistance) {
  // Two walls meet at the origin; the ground before them is seen at equal distances to both.
  constexpr float kHeight = 3.0f;
  scene::Scene scene;
  scene.materials = {paint(0.5f), paint(0.5f)};
  addGround(&scene, 0, 3000.0f);
  addPatch(&scene, 1, {0.0f, 0.0f, 0.0f}, {0.0f, 3000.0f, 0.0f}, {0.0f, 0.0f, kHeight});
  addPatch(&scene, 1, {0.0f, 0.0f, 0.0f}, {0.0f, 0.0f, kHeight}, {3000.0f, 0.0f, 0.0f});
  std::vector<Looked> points;
  const std::vector<float> distances = {0.01f, 1.0f, 5.0f};
  for (const float distance : distances) points.push_back({{distance, distance, 0.0f}, kUp, kUp});
  const std::vector<double> seen = traced(worldOf(scene), points, uniformDay(100.0f), 4096, 0);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const float d = distances[i];
    const auto open = [&](const Eigen::Vector3f& w) {
      if (w.z() <= 0.0f) return false;
      // Where the ray crosses each wall's plane: at what height, and whether the wall is there.
      const float to_x = w.x() < 0.0f ? -d / w.x() : -1.0f, to_y = w.y() < 0.0f ? -d / w.y() : -1.0f;
      const bool hits_x = to_x > 0.0f && to_x * w.z() < kHeight && d + to_x * w.y() > 0.0f;
      const bool hits_y = to_y > 0.0f && to_y * w.z() < kHeight && d + to_y * w.x() > 0.0f;
      return !hits_x && !hits_y;
    };
    const double expected = 100.0 * underSky(scene.materials[0], kUp, open);
    EXPECT_NEAR(seen[i], expected, 0.008 * expected) << d;  // as at the wall's foot
  }
  EXPECT_NEAR(seen[0] / (100.0 * albedoTowards(scene.materials[0], kUp)), 0.25, 0.01);
}

TEST(Penumbra, IsAsWideAsTheDistanceOfItsEdgeTimesTheSunsDiameter) {
  // Sun overhead, a roof's edge 10 m up: u radii of the disc's image from the edge's plumb line, the disc is
  // covered up to a chord.
  constexpr double kHeight = 10.0;
  scene::Scene scene;
  scene.materials = {paint(0.5f), paint(0.5f)};
  addGround(&scene, 0, 50.0f);
  addPatch(&scene, 1, {-50.0f, -50.0f, 10.0f}, {50.0f, 0.0f, 0.0f}, {0.0f, 100.0f, 0.0f});
  const double radius = kHeight * std::tan(sky::kSunRadiusAtOneAu.rad());
  std::vector<Looked> points;
  const std::vector<double> offsets = {-1.5, -0.8, -0.4, 0.0, 0.4, 0.8, 1.5};
  for (const double u : offsets) points.push_back({{static_cast<float>(u * radius), 0.0f, 0.0f}, kUp, kUp});
  const World world = worldOf(scene);
  const std::vector<double> seen = traced(world, points, onlySun(0.0, 90.0), 1024, 0);
  const double full = seen.back();
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double u = std::clamp(offsets[i], -1.0, 1.0);
    const double share = 0.5 + (u * std::sqrt(1.0 - u * u) + std::asin(u)) / kPi;
    EXPECT_NEAR(seen[i] / full, share, 0.01) << u;  // 1024 evenly spread points of the disc
  }
}

TEST(Reference, GivesTheSameBitsOnAnyNumberOfThreads) {
  const World world = worldOf(room(paint(0.5f, 10.0f)));
  std::vector<Looked> points(40, {{0.3f, 0.2f, -2.0f}, kUp, tilted(20.0)});
  const sky::Daylight day = uniformDay(100.0f);
  const std::vector<double> many = traced(world, points, day, 64);
  tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  EXPECT_EQ(many, traced(world, points, day, 64));
}

TEST(Reference, TracesManySunsAsItTracesEachAlone) {
  scene::Scene scene = room(paint(0.5f));
  scene.meshes.erase(scene.meshes.begin() + 1);  // no ceiling
  const World world = worldOf(scene);
  const Surfaces surfaces = rowOf({{{0.3f, 0.2f, -2.0f}, kUp, tilted(20.0)}}, *world.geometry->scene);
  const std::vector<sky::Daylight> days = {uniformDay(100.0f), onlySun(100.0, 70.0), uniformDay(3.0f)};
  const std::vector<Traced> together = traceReference(surfaces, world, days, {});
  for (std::size_t i = 0; i < days.size(); ++i) {
    EXPECT_EQ(traceReference(surfaces, world, {days[i]}, {})[0].luminance.data, together[i].luminance.data);
  }
}

TEST(Reference, KnowsItsOwnNoise) {
  // Many equal points: the spread of their values is what each reports.
  scene::Scene scene = room(paint(0.5f));
  scene.meshes.erase(scene.meshes.begin() + 1);
  const World world = worldOf(scene);
  const std::vector<Looked> points(400, {{0.3f, 0.2f, -2.0f}, kUp, tilted(20.0)});
  ReferenceOptions options;
  options.samples_per_pixel = 32;
  const Traced result =
      traceReference(rowOf(points, *world.geometry->scene), world, {uniformDay(100.0f)}, options)[0];
  double mean = 0.0, square = 0.0, reported = 0.0;
  for (int x = 0; x < 400; ++x) {
    const auto value = static_cast<double>(result.luminance.at(x, 0)[1]);
    mean += value / 400.0;
    square += value * value / 400.0;
    reported += static_cast<double>(*result.noise.at(x, 0)) / 400.0;
  }
  const double spread = std::sqrt(square - mean * mean);
  // The mean of |x| is √(2/π) of a normal distribution's deviation; 400 values know it within a tenth.
  EXPECT_NEAR(reported, std::sqrt(2.0 / kPi) * spread, 0.15 * spread);
  EXPECT_GT(spread, 0.0);
}

TEST(ReferenceOptions, OutOfRangeAreNamed) {
  ReferenceOptions options;
  options.samples_per_pixel = 1;
  EXPECT_THROW(validate(options), std::invalid_argument);
  options = {};
  options.bounces = 65;
  EXPECT_THROW(validate(options), std::invalid_argument);
}

}  // namespace
}  // namespace sunlit::light
