// Baked sky light and bounced light by scenes with pencil-and-paper answers.
#include "sunlit/light/transport.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "light/bake/samples/transport_data.h"
#include "light/patches/sky_patches.h"
#include "paper_scene.h"
#include "sunlit/light/illumination.h"
#include "sunlit/quantity/angle.h"
#include "support/message_of.h"
#include "support/usual_air.h"

namespace sunlit::light {
namespace {

const Eigen::Vector3f kUp = Eigen::Vector3f::UnitZ();

World baked(scene::Scene scene, const TransportOptions& options = {}) {
  World world = worldOf(std::move(scene));
  world.transport = Transport::bake(world.geometry, options);
  return world;
}

bool same(const NodeLight& a, const NodeLight& b) {
  return (a.irradiance == b.irradiance).all() && (a.around.above == b.around.above).all() &&
         (a.around.below == b.around.below).all();
}

/// Illuminance of the sky light and bounced light at points, lx.
std::vector<Eigen::Array3f> illuminances(const World& world, const sky::Daylight& day,
                                         const std::vector<Looked>& points) {
  Surfaces surfaces = rowOf(points, *world.geometry->scene);
  for (Tile& tile : surfaces.tiles) {
    for (Surface& surface : tile.surfaces)
      surface.triangle = triangleAt(*world.geometry, surface.position, surface.geometric_normal);
  }
  const Illumination light = illumination(world, day);
  std::vector<Eigen::Array3f> values;
  for (const TileOutlooks& tile : outlooksOf(surfaces, world)) {
    for (const Outlook& outlook : tile.surfaces) {
      EXPECT_TRUE(outlook.light.known());
      values.push_back(irradianceAt(outlook.light, *light.nodes));
    }
  }
  return values;
}

double illuminance(const World& world, const sky::Daylight& day, const Eigen::Vector3f& position,
                   const Eigen::Vector3f& normal = kUp) {
  return static_cast<double>(illuminances(world, day, {{position, normal, normal}})[0][1]);
}

TEST(SkyPatches, FillTheSphere) {
  const SkyPatches patches(3);
  double fine = 0.0, coarse = 0.0, above = 0.0, level = 0.0;
  for (const SkyPatches::Ray& ray : patches.rays()) {
    fine += static_cast<double>(ray.solid_angle);
    level += static_cast<double>(ray.solid_angle * std::max(ray.towards.z(), 0.0f));
  }
  for (const SkyPatches::Ray& ray : patches.coarseRays()) coarse += static_cast<double>(ray.solid_angle);
  for (int patch = 0; patch < SkyPatches::kAbove; ++patch)
    above += static_cast<double>(SkyPatches::solidAngle(patch));
  EXPECT_NEAR(fine, 4.0 * kPi, 1e-4);
  EXPECT_NEAR(coarse, 4.0 * kPi, 1e-4);
  EXPECT_NEAR(above, 2.0 * kPi, 1e-4);
  EXPECT_NEAR(level, kPi, 1e-4);  // equal areas are equally spaced in z, so this sum is exact
}

TEST(SkyPatches, DivideASmallLightWithoutJumps) {
  std::array<float, SkyPatches::kCount> before{};
  for (int i = 0; i <= 20000; ++i) {
    const double elevation = 89.0 * std::sin(i * 0.0003), azimuth = i * 0.001;
    const Eigen::Vector3f towards = Eigen::Vector3d(std::cos(azimuth) * std::cos(elevation * kRadPerDeg),
                                                    std::sin(azimuth) * std::cos(elevation * kRadPerDeg),
                                                    std::sin(elevation * kRadPerDeg))
                                        .cast<float>();
    std::array<float, SkyPatches::kCount> now{};
    float sum = 0.0f;
    for (const PatchShare& share : SkyPatches::around(towards)) {
      ASSERT_GE(share.share, 0.0f);
      now[static_cast<std::size_t>(share.patch)] += share.share;
      sum += share.share;
    }
    ASSERT_NEAR(sum, 1.0f, 1e-5f);
    // Steps of 0.06° in azimuth and up to 0.03° in elevation, patches at least 6° apart: 0.01 + 0.005.
    for (std::size_t p = 0; i > 0 && p < now.size(); ++p) ASSERT_NEAR(now[p], before[p], 0.02f) << i;
    before = now;
  }
}

TEST(BakedLight, APlaneUnderAnEvenSkyGetsPiTimesItsLuminance) {
  scene::Scene scene;
  scene.materials = {paint(0.5f)};
  addGround(&scene, 0, 30.0f);
  const World world = baked(std::move(scene));
  // Coefficients are bytes, but so rounded that sums over patches are right; measured 0.0003, of the rays.
  EXPECT_NEAR(illuminance(world, uniformDay(100.0f), {3.3f, 1.7f, 0.0f}), kPi * 100.0, 0.0005 * kPi * 100.0);
}

TEST(Coefficients, KeepTheSumOfManyPatchesThatEachCountLittle) {
  std::array<float, SkyPatches::kCount> row;
  row.fill(0.3f / 255.0f);
  row[20] = 1.0f;
  row[90] = row[91] = 0.0f;
  Coefficients coefficients;
  coefficients.resize(1);
  coefficients.set(0, row.data());
  const float sum = std::accumulate(row.begin(), row.end(), 0.0f);
  EXPECT_NEAR(coefficients.sum(0), sum, 1.0f / 255.0f);  // each rounded by itself leaves 1 of it
  EXPECT_EQ(coefficients.row(0)[20], 255);
  EXPECT_EQ(coefficients.row(0)[90] + coefficients.row(0)[91], 0);
  float of_first = 0.0f;
  for (std::size_t p = 0; p < row.size(); ++p) {
    of_first += row[p] - static_cast<float>(coefficients.row(0)[p]) * coefficients.scales[0];
    EXPECT_LE(std::abs(of_first), 0.51f / 255.0f) << p;
  }
}

TEST(BakedLight, BesideALongHighWallHalfTheSkyIsLeft) {
  scene::Scene scene;
  scene.materials = {paint(0.0f)};
  addGround(&scene, 0, 40.0f);
  addPatch(&scene, 0, {0.0f, -4000.0f, 0.0f}, {0.0f, 8000.0f, 0.0f}, {0.0f, 0.0f, 2000.0f});
  TransportOptions options;
  options.rays_per_patch = 8;
  const World world = baked(std::move(scene), options);
  // From the foot of an endless wall of height h, at distance d: E = πL (1 + sin(elevation)) / 2 seen from
  // the open side, of which the wall takes (1 − cos) / 2 … here h ≫ d, so half is left.
  for (const float d : {0.3f, 1.0f, 5.0f, 20.0f}) {
    // The paint mirrors a few percent; 2 % is the quadrature over patches that the wall's plane cuts.
    const double expected = 0.5 * kPi * 100.0;
    EXPECT_NEAR(illuminance(world, uniformDay(100.0f), {d, 2.2f, 0.0f}), expected, 0.06 * expected) << d;
  }
}

/// Share of an endless wall of height `h` in what level ground at distance `d` from it sees: (1 − cos γ) / 2
/// with γ the angle at which its top stands (Howell, configuration factor B-5, both sides endless).
double wallShare(double h, double d) {
  return 0.5 * (1.0 - d / std::hypot(h, d));
}

TEST(BakedLight, GroundBeforeABlackWallLosesTheWallsShareOfTheSky) {
  scene::Scene scene;
  scene.materials = {paint(0.0f)};
  scene.materials[0].roughness = 1.0f;
  addGround(&scene, 0, 30.0f);
  addPatch(&scene, 0, {0.0f, -400.0f, 0.0f}, {0.0f, 800.0f, 0.0f}, {0.0f, 0.0f, 3.0f});
  TransportOptions options;
  options.bounces = 0;  // black paint still mirrors 4 %
  const World world = baked(std::move(scene), options);
  for (const float d : {0.2f, 0.5f, 1.0f, 2.0f, 4.0f, 8.0f}) {
    const double expected = (1.0 - wallShare(3.0, static_cast<double>(d))) * kPi * 100.0;
    // Interpolation between samples 0.25 m apart at the wall, and a sky cut into 700 parts.
    EXPECT_NEAR(illuminance(world, uniformDay(100.0f), {d, 2.2f, 0.0f}), expected, 0.02 * kPi * 100.0) << d;
  }
}

TEST(BakedLight, TakesNoMoreSamplesThanAllowed) {
  // Slabs on the ground, which could do with more than allowed.
  const auto samplesOf = [](int allowed) {
    scene::Scene scene;
    scene.materials = {paint(0.5f)};
    addGround(&scene, 0, 60.0f);
    for (int i = 0; i < 64; ++i) {
      const Eigen::Vector3f corner(-24.0f + 6.0f * static_cast<float>(i % 8),
                                   -24.0f + 6.0f * static_cast<float>(i / 8), 0.0f);
      addBlock(&scene, 0, corner, {2.5f, 2.5f, 0.4f});
    }
    TransportOptions options;
    options.bounces = 0;
    options.samples = allowed;
    return baked(std::move(scene), options).transport->sampleCount();
  };
  // Some nodes are no samples: amid an undivided edge, or hidden.
  for (const std::size_t allowed : {10000u, 20000u}) {
    const std::size_t taken = samplesOf(static_cast<int>(allowed));
    EXPECT_LE(taken, allowed);
    EXPECT_GT(taken, allowed / 2);
  }
}

TEST(BakedLight, ARoomThatGlowsFillsUp) {
  for (const float base : {0.5f, 0.9f}) {
    scene::Scene scene;
    scene.materials = {paint(base, 100.0f)};
    addRoom(&scene, 0, {-2.0f, -2.0f, 0.0f}, {4.0f, 4.0f, 4.0f});
    const World world = baked(std::move(scene));
    // E = π e / (1 − ρ), of which three bounces would leave 12 and 69 % out. 2 % as of ambientReflectance(),
    // twice that where 0.9 comes back each time.
    const double expected = kPi * 100.0 / (1.0 - albedoOf(base));
    const double tolerance = base < 0.8f ? 0.02 : 0.04;
    for (const Eigen::Vector3f& place :
         {Eigen::Vector3f(0.1f, 0.2f, 0.0f), Eigen::Vector3f(1.9f, -1.9f, 0.0f)})
      EXPECT_NEAR(illuminance(world, uniformDay(0.0f), place), expected, tolerance * expected) << base;
  }
}

TEST(BakedLight, BetweenTwoPlatesLightGoesBackAndForth) {
  // A wide plate above the ground, lit only from the sides, is hard on paper; a grey ground under a grey
  // canopy that leaves a known share open is not: two endless plates, of which the lower glows.
  scene::Scene scene;
  scene.materials = {paint(0.6f, 10.0f), paint(0.3f)};
  addGround(&scene, 0, 200.0f);
  addPatch(&scene, 1, {-200.0f, -200.0f, 2.0f}, {0.0f, 400.0f, 0.0f}, {400.0f, 0.0f, 0.0f});
  TransportOptions options;
  options.samples = 20000;
  const World world = baked(std::move(scene), options);
  const double low = albedoOf(0.6f), high = albedoOf(0.3f);
  // E of the upper plate: π e + ρ_low E_low, with E_low = ρ_high E_high.
  const double up = kPi * 10.0 / (1.0 - low * high);
  // 1 %: the plates end 100 heights away.
  EXPECT_NEAR(illuminance(world, uniformDay(0.0f), {3.1f, 2.3f, 2.0f}, -kUp), up, 0.015 * up);
  EXPECT_NEAR(illuminance(world, uniformDay(0.0f), {3.1f, 2.3f, 0.0f}), high * up, 0.015 * up);
}

/// A closed shed of 4 m on the ground, walls 5 cm thick.
scene::Scene shed() {
  scene::Scene scene;
  scene.materials = {paint(0.5f)};
  addGround(&scene, 0, 20.0f);
  const auto block = [&](const Eigen::Vector3f& low, const Eigen::Vector3f& size) {
    addBlock(&scene, 0, low, size);
  };
  block({-2, -2, 0}, {0.05f, 4, 2.5f});
  block({1.95f, -2, 0}, {0.05f, 4, 2.5f});
  block({-2, -2, 0}, {4, 0.05f, 2.5f});
  block({-2, 1.95f, 0}, {4, 0.05f, 2.5f});
  block({-2, -2, 2.5f}, {4, 4, 0.05f});
  return scene;
}

TEST(BakedLight, DoesNotLeakIntoAShed) {
  const World world = baked(shed());
  const sky::Daylight day = uniformDay(100.0f);
  const double open = illuminance(world, day, {12.0f, 0.4f, 0.0f});
  for (const float x : {0.0f, 1.0f, 1.5f}) {
    // 0.25 m is the finest distance of samples: the strip nearer to the wall shares one with the outside.
    EXPECT_LT(illuminance(world, day, {x, 0.3f, 0.0f}), 0.002 * open) << x;
  }
  EXPECT_LT(illuminance(world, day, {1.95f, 0.3f, 0.6f}, -Eigen::Vector3f::UnitX()), 0.002 * open);
}

TEST(BakedLight, IsNotDarkenedFromInsideWalls) {
  const World world = baked(shed());
  const sky::Daylight day = uniformDay(100.0f);
  // The wall takes 48 % of the sky at its very foot and gives back less than half of what it gets.
  for (const float x : {2.02f, 2.05f, 2.1f, 2.2f})
    EXPECT_GT(illuminance(world, day, {x, 0.3f, 0.0f}), 0.5 * kPi * 100.0) << x;
}

TEST(BakedLight, IsContinuousOverCellsOfUnequalSize) {
  scene::Scene scene;
  scene.materials = {paint(0.3f)};
  addGround(&scene, 0, 25.0f);
  addPatch(&scene, 0, {0.0f, -1.0f, 0.0f}, {0.0f, 2.0f, 0.0f}, {0.0f, 0.0f, 2.0f});
  const World world = baked(std::move(scene));
  std::vector<Looked> points;
  constexpr int kSteps = 4000;
  for (int i = 0; i <= kSteps; ++i) {
    const float t = static_cast<float>(i) / kSteps;
    points.push_back({{0.3f + 7.0f * t, -3.0f + 6.1f * t, 0.0f}, kUp, kUp});
  }
  const auto values = illuminances(world, uniformDay(100.0f), points);
  // Steps of 2.3 mm. The steepest true gradient, right behind the wall, is below π L / 0.3 m.
  for (std::size_t i = 1; i < values.size(); ++i) ASSERT_NEAR(values[i][1], values[i - 1][1], 2.5f) << i;
}

TEST(BakedLight, BendsSmoothlyWithTheSun) {
  const World world = baked(shed());
  const std::vector<Looked> points = {{{2.3f, 0.3f, 0.0f}, kUp, kUp}, {{-2.5f, 0.1f, 0.0f}, kUp, kUp}};
  std::vector<Eigen::Array3f> before;
  for (int i = 0; i < 60; ++i) {
    // 10 s of the sun's way: 0.04°, across the border of two rings of patches at 18° of elevation.
    const double angle = 17.4 + i * 0.0417 / 2;
    const auto now =
        illuminances(world,
                     sky::usualAir().daylight(
                         {Direction(Azimuth::degrees(120.0 + i * 0.0417), Angle::degrees(angle)), 1.0}),
                     points);
    for (std::size_t k = 0; i > 0 && k < now.size(); ++k) {
      // The light of day itself grows by 0.15 % a step here.
      ASSERT_NEAR(now[k][1] / before[k][1], 1.0f, 0.006f) << i;
    }
    before = now;
  }
}

/// What a wall along x, `height` above ground that shines with 1 cd/m² where x > 0, gets of it at `x`, lx: a
/// sum over a quarter of a million directions.
double fromHalfOfTheGround(double x, double height) {
  constexpr int kAcross = 500;
  double sum = 0.0;
  for (int i = 0; i < kAcross; ++i) {
    const double down = (i + 0.5) / kAcross, level = std::sqrt(1.0 - down * down);
    for (int k = 0; k < kAcross; ++k) {
      const double azimuth = kPi * (k + 0.5) / kAcross;  // the half sphere before the wall
      const bool bright = x + height * level * std::cos(azimuth) / down > 0.0;
      if (bright) sum += level * std::sin(azimuth);
    }
  }
  return sum * kPi / (kAcross * kAcross);
}

TEST(BakedLight, OfGroundThatShinesInPartFallsEvenlyOnAWall) {
  scene::Scene scene;
  scene.materials = {paint(0.0f), paint(0.0f, 100.0f)};
  addPatch(&scene, 0, {-900.0f, 0.0f, 0.0f}, {900.0f, 0.0f, 0.0f}, {0.0f, 900.0f, 0.0f});
  addPatch(&scene, 1, {0.0f, 0.0f, 0.0f}, {900.0f, 0.0f, 0.0f}, {0.0f, 900.0f, 0.0f});
  addPatch(&scene, 0, {-6.0f, 0.0f, 0.0f}, {0.0f, 0.0f, 3.0f}, {12.0f, 0.0f, 0.0f});
  const World world = baked(std::move(scene));
  std::vector<Looked> points;
  const Eigen::Vector3f across = Eigen::Vector3f::UnitY();
  for (float x = -4.0f; x <= 4.0f; x += 0.25f) points.push_back({{x, 0.0f, 1.5f}, across, across});
  const std::vector<Eigen::Array3f> values = illuminances(world, uniformDay(0.0f), points);
  const double whole = 0.5 * kPi * 100.0;
  double squares = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double expected = 100.0 * fromHalfOfTheGround(static_cast<double>(points[i].position.x()), 1.5);
    const double off = (static_cast<double>(values[i][1]) - expected) / whole;
    squares += off * off;
    EXPECT_NEAR(off, 0.0, 0.04) << points[i].position.x();
  }
  // A direction is an 80th of what comes from below, the wall's nodes are 1 to 2 m apart. With half as many
  // directions it is 5 % at worst and 2.3 % rms: blotches on plain walls.
  EXPECT_LT(std::sqrt(squares / static_cast<double>(points.size())), 0.018);
}

TEST(BakedLight, OfGroundThatShinesIsTheSameInAllDirections) {
  scene::Scene scene;
  scene.materials = {paint(0.0f, 100.0f), paint(0.0f)};
  addGround(&scene, 0, 900.0f);
  addPatch(&scene, 1, {-6.0f, 0.0f, 0.0f}, {0.0f, 0.0f, 3.0f}, {12.0f, 0.0f, 0.0f});
  const World world = baked(std::move(scene));
  const double found = illuminance(world, uniformDay(0.0f), {0.3f, 0.0f, 1.5f}, Eigen::Vector3f::UnitY());
  // The ground ends 600 heights away: 0.1 %. The rest is what directions round. Dimmed by what a shiny ground
  // scatters less at a glancing angle it was 0.7 % less.
  EXPECT_NEAR(found, 0.5 * kPi * 100.0, 0.003 * 0.5 * kPi * 100.0);
}

TEST(BakedLight, WhereEdgesAreAsShortAsSinglePrecisionKnows) {
  // Coordinates are 8 mm apart there; cells that a wall cuts are to be halved below that.
  scene::Scene scene;
  scene.materials = {paint(0.5f)};
  const Eigen::Vector3f far(0.0f, 99990.0f, 0.0f);
  addPatch(&scene, 0, far + Eigen::Vector3f(-20.0f, -20.0f, 0.0f), {40.0f, 0.0f, 0.0f}, {0.0f, 40.0f, 0.0f});
  addBlock(&scene, 0, far, {2.0f, 2.0f, 3.0f});
  TransportOptions options;
  options.finest_m = 0.02;
  options.samples = 20000;
  const World world = baked(std::move(scene), options);
  EXPECT_GT(world.transport->sampleCount(), 0u);
}

TEST(BakedLight, OfSheetsThatOverlapByHalfTheirCells) {
  // Nodes that lie in the same place are one: that of the first sheet hangs between nodes of the second, and
  // these between nodes of the first.
  scene::Scene scene;
  scene.materials = {paint(0.5f)};
  for (int sheet = 0; sheet < 8; ++sheet) {
    const float x = 1.0f * static_cast<float>(sheet);
    addPatch(&scene, 0, {x, 0.0f, 0.0f}, {2.0f, 0.0f, 0.0f}, {0.0f, 2.0f, 0.0f});
    addPatch(&scene, 0, {x, -2.0f, 0.0f}, {2.0f, 0.0f, 0.0f}, {0.0f, 2.0f, 0.0f});
  }
  addBlock(&scene, 0, {0.3f, -1.3f, 0.0f}, {7.0f, 0.4f, 2.0f});
  TransportOptions options;
  options.finest_m = 0.5;
  const World world = baked(std::move(scene), options);
  EXPECT_GT(world.transport->sampleCount(), 0u);
}

TEST(BakedLight, HasTheSameBitsOnAnyNumberOfThreads) {
  TransportOptions options;
  options.rays_per_patch = 2;
  std::vector<std::vector<NodeLight>> results;
  for (const std::size_t threads : {1u, 4u}) {
    const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
    const World world = baked(shed(), options);
    results.push_back(world.transport->relight(uniformDay(77.0f)));
  }
  ASSERT_EQ(results[0].size(), results[1].size());
  for (std::size_t i = 0; i < results[0].size(); ++i) ASSERT_TRUE(same(results[0][i], results[1][i])) << i;
}

TEST(BakedLight, IsTheSameOfANodeThatIsAskedForByItself) {
  TransportOptions options;
  options.rays_per_patch = 2;
  const World world = baked(shed(), options);
  const sky::Daylight day = onlySun(150.0, 35.0);
  const std::vector<NodeLight> all = world.transport->relight(day, {}, world.visibility.get());
  const Illumination light = world.transport->illumination(day, {}, world.visibility.get());
  ASSERT_EQ(light.nodes->size(), all.size());
  float brightest = 0.0f;
  for (std::size_t n = all.size(); n-- > 0; n -= std::min(n, std::size_t{7})) {
    for (Eigen::Index c = 0; c < 3; ++c) {
      EXPECT_EQ(light.nodes->irradiance(n)[c], PackedLight(all[n].irradiance[c]).value());
      EXPECT_EQ(light.nodes->below(n)[c], PackedLight(all[n].around.below[c]).value());
    }
    brightest = std::max(brightest, all[n].irradiance[1]);
  }
  EXPECT_GT(brightest, 0.0f);
}

// So that what a picture looks at lies together in memory.
TEST(BakedLight, OfNodesSideBySideIsOfSamplesSideBySide) {
  const World world = baked(shed());
  const LightMesh& mesh = world.transport->data().mesh;
  std::size_t falls = 0;
  for (std::size_t n = 1; n < mesh.nodeCount(); ++n)
    falls += mesh.shares[mesh.first_share[n]].sample < mesh.shares[mesh.first_share[n - 1]].sample ? 1 : 0;
  // Where samples were of no use, nodes have those of others.
  EXPECT_LT(falls, mesh.nodeCount() / 10);
}

TEST(BakedLight, TellsTheTimeLeftOnceItCan) {
  TransportOptions options;
  options.samples = 2000;
  double latest = 0.0;
  int reports = 0;
  Transport::bake(worldOf(shed()).geometry, options, [&](double share, double seconds_left) {
    ++reports;
    EXPECT_EQ(std::isnan(seconds_left), share < 0.05) << share;
    EXPECT_FALSE(seconds_left < 0.0);
    EXPECT_LE(share, 1.0);
    latest = std::max(latest, share);
  });
  EXPECT_GT(reports, 1);
  EXPECT_GT(latest, 0.9);
}

TEST(BakedLight, OfSmallWorldsHasFinerSamples) {
  const auto finest = [](float side) {
    scene::Scene scene;
    scene.materials = {paint(0.5f)};
    addPatch(&scene, 0, {0.0f, 0.0f, 0.0f}, {side, 0.0f, 0.0f}, {0.0f, side, 0.0f});
    return finestOf({}, *worldOf(std::move(scene)).geometry);
  };
  EXPECT_NEAR(finest(3.0f), 3.0 * std::sqrt(2.0) / 64.0, 1e-6);
  EXPECT_EQ(finest(0.3f), 0.02);
  EXPECT_EQ(finest(12.0f), 0.25);
  TransportOptions options;
  options.finest_m = 0.1;
  EXPECT_EQ(finestOf(options, *worldOf(shed()).geometry), 0.1);
}

TEST(BakedLight, RefusesOptionsOutOfRange) {
  const World world = worldOf(shed());
  TransportOptions options;
  options.finest_m = 0.0;
  const std::string error = messageOf([&] { Transport::bake(world.geometry, options); });
  EXPECT_NE(error.find("finest is 0, but must be from 0.02 to 10 m"), std::string::npos) << error;
}

}  // namespace
}  // namespace sunlit::light
