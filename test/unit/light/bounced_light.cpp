// What surfaces pass on of the light of lamps that move, by pencil and paper and against traced paths.
#include "light/picture/lamps/bounced_light.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <numeric>

#include "baked_scene.h"
#include "lamp_scene.h"
#include "light/lamps/lamp_beam.h"
#include "light/picture/lamps/power_rays.h"

namespace sunlit::light {
namespace {

const Eigen::Vector3f kUp = Eigen::Vector3f::UnitZ();

/// Of bodies that stand where `map`'s origin is but for `moved`.
std::vector<BouncedLight> bouncedBy(const World& world, const std::vector<scene::Lamp>& lamps,
                                    const Eigen::Vector3d& moved = Eigen::Vector3d::Zero()) {
  std::vector<BodyLamp> of_body;
  for (const scene::Lamp& lamp : lamps) of_body.push_back({0, lamp});
  return bouncedLight(of_body, {Eigen::Isometry3d(Eigen::Translation3d(moved))}, *world.visibility);
}

/// A picture of one tile, all of whose pixels show `point`: as pixels of a picture they share the rays that
/// find what hides weak light.
Surfaces tileOf(const Looked& point, const scene::Scene& scene) {
  constexpr int kSize = Surfaces::kTileSize;
  Surfaces picture = rowOf(std::vector<Looked>(kSize * kSize, point), scene);
  picture.width = picture.height = kSize;
  Tile all = picture.tiles[0];
  all.height = kSize;
  all.sky.assign(kSize * kSize, 0);
  for (std::size_t i = 1; i < picture.tiles.size(); ++i) {
    const Tile& row = picture.tiles[i];
    for (Surface surface : row.surfaces) {
      surface.first_sample += static_cast<std::uint32_t>(all.origin_x.size());
      all.surfaces.push_back(surface);
    }
    all.origin_x.insert(all.origin_x.end(), row.origin_x.begin(), row.origin_x.end());
    all.origin_y.insert(all.origin_y.end(), row.origin_y.begin(), row.origin_y.end());
    all.origin_z.insert(all.origin_z.end(), row.origin_z.begin(), row.origin_z.end());
  }
  picture.tiles = {all};
  return picture;
}

/// Luminances of points by nothing else, each the mean of a tile of it.
std::vector<double> litBy(const World& world, const std::vector<BouncedLight>& bounced,
                          const std::vector<Looked>& points) {
  Illumination light(uniformDay(0.0f));
  light.bounced = std::make_shared<const std::vector<BouncedLight>>(bounced);
  const scene::Scene& scene = *world.geometry->scene;
  std::vector<double> values;
  for (const Looked& point : points) {
    const Surfaces surfaces = tileOf(point, scene);
    const image::LinearImage seen = pictureOf(surfaces, outlooksOf(surfaces, world), world, light);
    double sum = 0.0;
    for (std::size_t i = 1; i < seen.data.size(); i += 3) sum += static_cast<double>(seen.data[i]);
    values.push_back(3.0 * sum / static_cast<double>(seen.data.size()));
  }
  return values;
}

/// Of points that the lamps do not reach themselves.
std::vector<double> tracedOnce(const World& world, const std::vector<scene::Lamp>& lamps,
                               const std::vector<Looked>& points, int samples = 20000) {
  ReferenceOptions options;
  options.samples_per_pixel = samples;
  options.bounces = 1;
  options.lamps = lamps;
  const Surfaces surfaces = rowOf(points, *world.geometry->scene);
  return rowValues(traceReference(surfaces, world, {uniformDay(0.0f)}, options)[0].luminance);
}

scene::Lamp spotAt(const Eigen::Vector3f& position, const Eigen::Vector3f& direction, float inner_rad,
                   float outer_rad) {
  scene::Lamp lamp = lampAt(position, 300.0f);
  lamp.direction = direction.normalized();
  lamp.inner_rad = inner_rad;
  lamp.outer_rad = outer_rad;
  return lamp;
}

TEST(PowerRays, CarryEqualPartsOfTheConesPower) {
  for (const auto& [inner, outer, exponent] : {std::array{0.175f, 0.45f, 2.0f}, std::array{0.0f, 1.2f, 1.0f},
                                               std::array{0.3f, 0.3f, 2.0f}, std::array{3.2f, 3.2f, 2.0f}}) {
    scene::Lamp lamp = spotAt({0.0f, 0.0f, 0.0f}, kUp, inner, outer);
    lamp.exponent = exponent;
    const LampBeam beam(lamp);
    double all = 0.0, cosines = 0.0;  // over rings of the sphere, by what the beam gives at 1 m
    constexpr int kRings = 20000;
    for (int i = 0; i < kRings; ++i) {
      const double z = 1.0 - (2.0 * i + 1.0) / kRings;
      const Eigen::Vector3d towards(std::sqrt(1.0 - z * z), 0.0, z);
      const double power = static_cast<double>(beam.share(towards.cast<float>())) * 4.0 * kPi / kRings;
      all += power;
      cosines += power * z;
    }
    const PowerRays rays = powerRays(lamp, 256, 12);
    EXPECT_NEAR(256.0 * static_cast<double>(rays.each_sr), all, 0.003 * all);
    Eigen::Vector3d mean = Eigen::Vector3d::Zero();
    for (const Eigen::Vector3f& direction : rays.directions) mean += direction.cast<double>() / 256.0;
    EXPECT_NEAR(mean.z(), cosines / all, 2e-3);
    EXPECT_NEAR(mean.head<2>().norm(), 0.0, 5e-3) << "evenly around the axis";
    // Neighbours: about as many rays in each group.
    std::array<int, 12> in_group{};
    for (const std::uint32_t group : rays.groups) ++in_group[group];
    EXPECT_GE(*std::min_element(in_group.begin(), in_group.end()), 7);
    EXPECT_LE(*std::max_element(in_group.begin(), in_group.end()), 42);
  }
}

TEST(BouncedLight, OfANarrowSpotFallsByCosinesAndTheSquareOfTheDistance) {
  scene::Scene scene;
  scene.materials = {paint(0.5f), paint(0.8f), paint(0.0f)};
  addPatch(&scene, 1, {0.0f, -5.0f, -5.0f}, {0.0f, 10.0f, 0.0f}, {0.0f, 0.0f, 10.0f});  // faces east
  const World world = worldOf(std::move(scene));
  const scene::Lamp lamp = spotAt({3.0f, 0.0f, 0.0f}, {-1.0f, 0.0f, 0.0f}, 0.05f, 0.05f);
  const Reflection wall{Eigen::Vector3f::UnitX(), Eigen::Vector3f::UnitX(), Eigen::Array3f::Constant(0.8f),
                        1.0f, 0.0f};
  const AmbientReflectance by = ambientReflectance(wall);
  const double albedo = static_cast<double>(by.diffuse[1] * kPiFloat + by.specular[1]);
  const double cd = albedo / kPi * 300.0 * 2.0 * kPi * (1.0 - std::cos(0.05));
  for (const Eigen::Vector3f& position :
       {Eigen::Vector3f(3.0f, 3.0f, 0.0f), Eigen::Vector3f(1.0f, 0.0f, 2.0f),
        Eigen::Vector3f(20.0f, -5.0f, 1.0f)}) {
    const Looked point{position, -Eigen::Vector3f::UnitX(), -Eigen::Vector3f::UnitX()};
    const Eigen::Vector3f towards = -position.normalized();
    const Reflection reflection{point.normal, point.to_eye, Eigen::Array3f::Constant(0.5f), 1.0f, 0.0f};
    const double cosine = static_cast<double>(-towards.x());
    const double expected = static_cast<double>(directReflectance(reflection, towards, 0.0f)[1]) * cd *
                            cosine / static_cast<double>(position.squaredNorm());
    // The spot is 0.3 m wide, so that nearest by its parts are up to 7 % nearer and further.
    EXPECT_NEAR(litBy(world, bouncedBy(world, {lamp}), {point})[0], expected, 0.02 * expected)
        << position.transpose();
  }
}

TEST(BouncedLight, OfALampAmidARoomIsAllThatItsWallsSendBack) {
  scene::Scene scene;
  scene.materials = {paint(0.5f)};
  addRoom(&scene, 0, {-2.0f, -2.0f, 0.0f}, {4.0f, 4.0f, 4.0f});
  const World world = worldOf(std::move(scene));
  const std::vector<BouncedLight> bounced = bouncedBy(world, {lampAt({0.0f, 0.0f, 2.0f}, 100.0f)});
  std::vector<Looked> floor;
  for (int i = 0; i < 16; ++i)
    for (int k = 0; k < 16; ++k)
      floor.push_back(
          {{-1.875f + 0.25f * static_cast<float>(i), -1.875f + 0.25f * static_cast<float>(k), 0.0f},
           kUp,
           kUp});
  const std::vector<double> values = litBy(world, bounced, floor);
  const double mean = std::accumulate(values.begin(), values.end(), 0.0) / 256.0;
  const std::vector<double> truth = tracedOnce(world, {lampAt({0.0f, 0.0f, 2.0f}, 100.0f)}, floor, 4096);
  const std::vector<double> direct = lit(world, {lampAt({0.0f, 0.0f, 2.0f}, 100.0f)}, floor);
  double once = 0.0;
  for (std::size_t i = 0; i < floor.size(); ++i) once += (truth[i] - direct[i]) / 256.0;
  // Whole walls by a few discs each, of which half of one lies next to the floor.
  EXPECT_NEAR(mean, once, 0.1 * once);
}

/// A white wall at x = 0 that a spot shines at, a floor, and a wall beside it at y = −3; all else is black.
World cornerWorld() {
  scene::Scene scene;
  scene.materials = {paint(0.5f), paint(0.8f), paint(0.0f)};
  addGround(&scene, 2, 40.0f);
  addPatch(&scene, 1, {0.0f, -3.0f, 0.0f}, {0.0f, 8.0f, 0.0f}, {0.0f, 0.0f, 4.0f});
  addPatch(&scene, 2, {0.0f, -3.0f, 0.0f}, {0.0f, 0.0f, 4.0f}, {8.0f, 0.0f, 0.0f});
  addBlock(&scene, 2, {1.0f, 1.5f, 0.0f}, {0.3f, 0.5f, 2.0f});
  return worldOf(std::move(scene));
}

std::vector<Looked> besideTheSpot() {
  std::vector<Looked> points;
  for (const float x : {0.05f, 0.2f, 0.5f, 1.0f, 2.0f, 4.0f})
    for (const float y : {-2.5f, -1.0f, 0.0f, 1.0f, 3.0f})
      if (x != 2.0f || y != 3.0f) points.push_back({{x, y, 0.0f}, kUp, {0.6f, 0.0f, 0.8f}});
  for (const float x : {0.1f, 0.4f, 1.5f, 3.0f})
    for (const float z : {0.3f, 1.0f, 2.5f})
      points.push_back({{x, -3.0f, z}, Eigen::Vector3f::UnitY(), {0.0f, 0.8f, 0.6f}});
  return points;
}

TEST(BouncedLight, IsHiddenFromWhatDoesNotSeeWhereItComesFrom) {
  const scene::Lamp lamp = spotAt({4.0f, 0.0f, 1.2f}, {-1.0f, 0.0f, 0.0f}, 0.08f, 0.175f);
  const World world = cornerWorld();
  EXPECT_EQ(litBy(world, bouncedBy(world, {lamp}), {floorAt(2.0f, 3.0f)})[0], 0.0) << "behind the block";
}

TEST(BouncedLight, OfASpotAtAWallLightsFloorAndWallAsTracedPathsDo) {
  const World world = cornerWorld();
  const std::vector<Looked> points = besideTheSpot();
  // A circle of 0.7 m about a point 1.2 m up.
  const scene::Lamp lamp = spotAt({4.0f, 0.0f, 1.2f}, {-1.0f, 0.0f, 0.0f}, 0.08f, 0.175f);
  const std::vector<double> fast = litBy(world, bouncedBy(world, {lamp}), points),
                            slow = tracedOnce(world, {lamp}, points);
  const Errors found = errors(fast, slow);
  // Worst 10 cm beside the lit wall and 3 m from its spot, where all light comes at 2°.
  EXPECT_LT(found.mean, 0.05);
  EXPECT_LT(std::abs(found.bias), 0.03);
  EXPECT_LT(found.worst, 0.25);
}

/// A lamp low above a white floor, as a rover's: its light reaches from half a metre to the horizon.
TEST(BouncedLight, OfAHeadlightOverTheFloorLightsWhatStandsThereAsTracedPathsDo) {
  scene::Scene scene;
  scene.materials = {paint(0.5f), paint(0.6f), paint(0.0f)};
  addGround(&scene, 1, 60.0f);
  const World world = worldOf(std::move(scene));
  const scene::Lamp lamp = spotAt({0.0f, 0.0f, 0.35f}, {1.0f, 0.0f, -0.05f}, 0.175f, 0.45f);
  std::vector<Looked> points;
  for (const float x : {0.7f, 1.5f, 3.0f, 6.0f, 12.0f})
    for (const float y : {0.0f, 3.0f})
      for (const float z : {1.0f, 2.0f}) {
        const Eigen::Vector3f from_lamp = Eigen::Vector3f(x, y, z) - lamp.position;
        if (from_lamp.normalized().dot(lamp.direction) > std::cos(lamp.outer_rad + 0.02f)) continue;
        points.push_back({{x, y, z}, -kUp, -kUp});
        points.push_back({{x, y, z}, -Eigen::Vector3f::UnitY(), -Eigen::Vector3f::UnitY()});
      }
  for (const float z : {0.2f, 0.4f, 0.8f})
    points.push_back({{-0.1f, 0.0f, z}, Eigen::Vector3f::UnitX(), Eigen::Vector3f::UnitX()});
  const std::vector<double> fast = litBy(world, bouncedBy(world, {lamp}), points),
                            slow = tracedOnce(world, {lamp}, points, 60000);
  const Errors found = errors(fast, slow);
  // Too little where discs as wide as they are far stand for a floor that begins near by.
  EXPECT_LT(found.mean, 0.06);
  EXPECT_LT(std::abs(found.bias), 0.06);
  EXPECT_LT(found.worst, 0.25);
}

/// A floor, a table on it whose edge cuts the light in two, and a wall behind.
World tableWorld() {
  scene::Scene scene;
  scene.materials = {paint(0.5f), paint(0.7f)};
  addGround(&scene, 1, 40.0f);
  addBlock(&scene, 1, {2.0f, -1.0f, 0.65f}, {1.0f, 2.0f, 0.05f});
  addPatch(&scene, 1, {6.0f, -5.0f, 0.0f}, {0.0f, 0.0f, 4.0f}, {0.0f, 10.0f, 0.0f});
  return worldOf(std::move(scene));
}

TEST(BouncedLight, ComesFromSurfacesAndNotFromMidAir) {
  const World world = tableWorld();
  const scene::Lamp lamp = spotAt({0.0f, 0.0f, 1.5f}, {1.0f, 0.0f, -0.35f}, 0.3f, 0.6f);
  const std::vector<BouncedLight> bounced = bouncedBy(world, {lamp});
  EXPECT_GT(bounced.size(), 12u);
  EXPECT_LT(bounced.size(), 40u);
  float on = 0.0f, all = 0.0f;
  for (const BouncedLight& light : bounced) {
    const float z = light.position.z();
    const bool level = light.normal.z() > 0.99f && (std::abs(z) < 0.01f || std::abs(z - 0.7f) < 0.01f);
    const bool upright = std::abs(light.normal.x()) > 0.99f && (std::abs(light.position.x() - 6.0f) < 0.01f ||
                                                                std::abs(light.position.x() - 2.0f) < 0.01f);
    all += light.intensity[1];
    if (level || upright) on += light.intensity[1];
  }
  // Faint ones, of few rays, are taken together.
  EXPECT_GT(on, 0.97f * all);
}

TEST(BouncedLight, ChangesLittleWhenTheLampMovesByACentimetre) {
  const World world = tableWorld();
  const scene::Lamp lamp = spotAt({0.0f, 0.0f, 1.5f}, {1.0f, 0.0f, -0.35f}, 0.3f, 0.6f);
  std::vector<Looked> points;
  for (const float x : {0.5f, 1.5f, 3.5f, 5.0f})
    for (const float z : {0.3f, 1.0f, 2.0f})
      points.push_back({{x, 2.5f, z}, -Eigen::Vector3f::UnitY(), -Eigen::Vector3f::UnitY()});
  std::vector<double> before;
  double worst = 0.0, mean = 0.0;
  constexpr int kSteps = 100;
  for (int i = 0; i <= kSteps; ++i) {
    const std::vector<double> now = litBy(world, bouncedBy(world, {lamp}, {0.01 * i, 0.0, 0.0}), points);
    for (std::size_t k = 0; k < before.size(); ++k) {
      const double change = std::abs(now[k] / before[k] - 1.0);
      worst = std::max(worst, change);
      mean += change / static_cast<double>(kSteps * points.size());
    }
    before = now;
  }
  // The light itself changes by some 1 %: 1 cm of 2 m, squared. The rest are rays that meet the table's edge
  // or pass it, 5 cm thick and near some of the points.
  EXPECT_LT(worst, 0.06);
  EXPECT_LT(mean, 0.01);
}

TEST(BouncedLight, OfAPairOfHeadlightsIsTakenTogether) {
  const World world = tableWorld();
  const scene::Lamp left = spotAt({0.0f, 0.1f, 1.0f}, {1.0f, 0.0f, -0.2f}, 0.3f, 0.6f);
  scene::Lamp right = left;
  right.position.y() = -0.1f;
  const auto cd = [](const std::vector<BouncedLight>& all) {
    float sum = 0.0f;
    for (const BouncedLight& light : all) sum += light.intensity[1];
    return sum;
  };
  const std::vector<BouncedLight> pair = bouncedBy(world, {left, right}), one = bouncedBy(world, {left});
  EXPECT_NEAR(cd(pair), 2.0f * cd(one), 0.02f * cd(pair));
  EXPECT_LT(pair.size(), one.size() + 10);
}

/// Rays show polished surfaces what lies around them: another glint of it were too much.
TEST(BouncedLight, IsNoLampInPolishedSurfaces) {
  const World plain = cornerWorld();
  const BouncedLight wall{
      {0.0f, 0.0f, 1.0f}, Eigen::Vector3f::UnitX(), 0.2f, Eigen::Array3f::Constant(10.0f)};
  const auto seen = [&](float roughness) {
    scene::Scene scene = *plain.geometry->scene;
    scene.materials[0].roughness = roughness;
    const World world = worldOf(scene);
    Illumination light(uniformDay(0.0f));
    light.bounced = std::make_shared<const std::vector<BouncedLight>>(1, wall);
    const Looked glint{{1.0f, 0.0f, 0.0f}, kUp, {1.0f, 0.0f, 1.0f}};
    const Surfaces surfaces = rowOf({glint}, scene);
    return rowValues(pictureOf(surfaces, outlooksOf(surfaces, world), world, light))[0];
  };
  // The matt part alone: albedo / π less what Fresnel takes at 45°, I cos 45° / (r² / 4 + 2), again cos 45°.
  const double matt = 0.5 / kPi * (1.0 - 0.042) * 10.0 * 0.5 / 2.01;
  EXPECT_NEAR(seen(0.1f), matt, 0.01 * matt);
  EXPECT_NEAR(seen(0.42f), matt, 0.01 * matt);
  EXPECT_GT(seen(0.48f), 1.2 * matt);
}

TEST(BouncedLight, IsNoneWhereRaysMeetNothingAndWhereNoLampBurns) {
  const World world = floorWorld();
  EXPECT_TRUE(bouncedBy(world, {}).empty());
  EXPECT_TRUE(bouncedBy(world, {spotAt({0.0f, 0.0f, 1.0f}, kUp, 0.2f, 0.4f)}).empty());
  scene::Lamp near = spotAt({0.0f, 0.0f, 1.0f}, -kUp, 0.2f, 0.4f);
  near.range_m = 0.9f;
  EXPECT_TRUE(bouncedBy(world, {near}).empty());
}

TEST(BouncedLight, HasTheSameBitsOnAnyNumberOfThreads) {
  const World world = cornerWorld();
  const scene::Lamp lamp = spotAt({4.0f, 0.0f, 1.2f}, {-1.0f, 0.0f, 0.0f}, 0.08f, 0.175f);
  const std::vector<double> many = litBy(world, bouncedBy(world, {lamp}), besideTheSpot());
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  EXPECT_EQ(litBy(world, bouncedBy(world, {lamp}), besideTheSpot()), many);
}

}  // namespace
}  // namespace sunlit::light
