// Light from all around a body, in surroundings whose light can be worked out on paper.
#include "light/picture/bodies/body_light.h"

#include <gtest/gtest.h>

#include <cmath>

#include "sunlit/quantity/angle.h"
#include "sunlit/sky/uniform_sky.h"
#include "support/usual_air.h"

namespace sunlit::light {
namespace {

/// `luminance(direction)` from all around, in small parts.
template <typename Luminance>
AroundLight surroundings(const Luminance& luminance) {
  AroundLight light;
  constexpr int kParts = 20000;
  for (int i = 0; i < kParts; ++i) {
    const float z = 1.0f - (2.0f * static_cast<float>(i) + 1.0f) / kParts;
    const float r = std::sqrt(1.0f - z * z), turn = 2.39996323f * static_cast<float>(i);
    const Eigen::Vector3f towards(r * std::cos(turn), r * std::sin(turn), z);
    light.add(towards, 4.0f * kPiFloat / kParts, luminance(towards));
  }
  return light;
}

TEST(AroundLight, OfUniformLuminanceIsPiTimesThatOnEverySide) {
  const AroundLight light =
      surroundings([](const Eigen::Vector3f&) { return Eigen::Array3f(1.0f, 2.0f, 3.0f); });
  for (const Eigen::Vector3f& normal : {Eigen::Vector3f(0, 0, 1), Eigen::Vector3f(0.6f, 0, -0.8f)}) {
    // Rounding of a sum of 20,000 parts.
    EXPECT_LT((light.illuminance(normal) / Eigen::Array3f(1, 2, 3) - kPiFloat).abs().maxCoeff(), 2e-3f);
  }
}

TEST(AroundLight, OfAHalfLitSphereIsHalfOnTheEdge) {
  const AroundLight light = surroundings([](const Eigen::Vector3f& towards) {
    return Eigen::Array3f::Constant(towards.z() > 0.0f ? 1.0f : 0.0f);
  });
  // (1 + cos) / 2 of π: on paper for a surface tilted from the lit side; the second order is within 3 % of π
  // of it.
  for (const float cosine : {1.0f, 0.5f, 0.0f, -0.5f, -1.0f}) {
    const Eigen::Vector3f normal(std::sqrt(1.0f - cosine * cosine), 0.0f, cosine);
    EXPECT_NEAR(light.illuminance(normal)[0], 0.5f * kPiFloat * (1.0f + cosine), 0.03f * kPiFloat) << cosine;
  }
}

scene::Mesh square(const Eigen::Vector3f& centre, float half) {
  scene::Mesh mesh;
  for (const auto& [x, y] : {std::pair{-1.0f, -1.0f}, {1.0f, -1.0f}, {1.0f, 1.0f}, {-1.0f, 1.0f}})
    mesh.positions.push_back(centre + Eigen::Vector3f(half * x, half * y, 0.0f));
  mesh.normals.assign(4, Eigen::Vector3f::UnitZ());
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  return mesh;
}

TEST(BodyLight, BelowABodyIsTheLightThatTheGroundSendsBack) {
  auto scene = std::make_shared<scene::Scene>();
  scene->materials.resize(1);
  const Eigen::Array3f albedo(0.5f, 0.4f, 0.3f);
  scene->materials[0].base_color = LinearRgb(albedo);
  scene->materials[0].roughness = 1.0f;
  scene->meshes = {square(Eigen::Vector3f::Zero(), 500.0f)};
  const World world(scene, {{square(Eigen::Vector3f::Zero(), 0.1f)}});
  const BodyLight body_light(world);
  // So high that its own shadow is small; sun at 60°.
  const auto placed = world.bodies->placed({Eigen::Isometry3d(Eigen::Translation3d(0.0, 0.0, 5.0))});
  const auto views = body_light.look(*placed, std::make_shared<Visibility>(world.visibility, placed));
  const sky::Daylight day =
      sky::usualAir().daylight({Direction(Azimuth::degrees(100.0), Angle::degrees(60.0)), 1.0});
  const std::vector<AroundLight> around = body_light.around(*views, day);
  ASSERT_EQ(around.size(), 1u);
  const Eigen::Array3f below = around[0].illuminance(-Eigen::Vector3f::UnitZ());
  // Over boundless ground it is the ground's own illuminance times its albedo. 8 %: that of the second order,
  // 3 % of what comes from above too, and what the fitted mirror part of the reflectance adds.
  const Eigen::Array3f expected = albedo * day.groundIlluminance().value;
  EXPECT_LT((below / expected - 1.0f).abs().maxCoeff(), 0.08f) << below.transpose() << "\n"
                                                               << expected.transpose();
  // From above the open sky.
  const Eigen::Array3f above = around[0].illuminance(Eigen::Vector3f::UnitZ());
  const Eigen::Array3f sky = day.skyIlluminance(Eigen::Vector3f::UnitZ()).value;
  EXPECT_LT((above / sky - 1.0f).abs().maxCoeff(), 0.12f) << above.transpose() << "\n" << sky.transpose();
}

TEST(BodyLight, BelowABodyIsWhatTheGroundHasUnderTheCloudThatStandsThere) {
  auto scene = std::make_shared<scene::Scene>();
  scene->materials.resize(1);
  scene->materials[0].base_color = LinearRgb(0.5f, 0.5f, 0.5f);
  scene->materials[0].roughness = 1.0f;
  scene->meshes = {square(Eigen::Vector3f::Zero(), 20000.0f)};
  const World world(scene, {{square(Eigen::Vector3f::Zero(), 0.1f)}});
  const BodyLight body_light(world);
  sky::Weather weather;
  weather.cover_oktas = 4.0;
  const sky::Daylight day =
      sky::usualAir().daylight({Direction(Azimuth::degrees(100.0), Angle::degrees(60.0)), 1.0}, {}, weather);
  ASSERT_TRUE(day.hasBrokenCloud());
  const auto below = [&](float x) {
    const auto placed = world.bodies->placed({Eigen::Isometry3d(Eigen::Translation3d(x, 0.0, 5.0))});
    const auto views = body_light.look(*placed, std::make_shared<Visibility>(world.visibility, placed));
    return body_light.around(*views, day)[0].illuminance(-Eigen::Vector3f::UnitZ())[1];
  };
  // Where it shines most and least along a line, every 100 m.
  float sunny = 0.0f, shady = 0.0f;
  const auto through = [&](float x) { return day.throughCloud(day.sun(), {x, 0.0f, 0.0f}); };
  for (float x = 0.0f; x < 8000.0f; x += 100.0f) {
    if (through(x) > through(sunny)) sunny = x;
    if (through(x) < through(shady)) shady = x;
  }
  ASSERT_GT(through(sunny), 1.5f);
  ASSERT_LT(through(shady), 0.3f);
  const float sun = day.sun().illuminance.value[1] * day.sun().towards.vector().cast<float>().z();
  const float difference = 0.5f * sun * (through(sunny) - through(shady));
  // The sky's light is alike. 15 %: places some metres aside have other clouds.
  EXPECT_NEAR(below(sunny) - below(shady), difference, 0.15f * difference);
}

/// A matt floor without edges, a plate of 0.2 m above it, and darkness.
struct PlateAboveFloor {
  std::shared_ptr<scene::Scene> scene = std::make_shared<scene::Scene>();
  std::unique_ptr<const World> world;
  std::unique_ptr<const BodyLight> body_light;
  PlateAboveFloor() {
    scene->materials.resize(1);
    scene->materials[0].base_color = LinearRgb(0.5f, 0.4f, 0.3f);
    scene->materials[0].roughness = 1.0f;
    add(square(Eigen::Vector3f::Zero(), 500.0f));
  }
  /// Adds `mesh` to the scene.
  void add(const scene::Mesh& mesh) {
    scene->meshes.push_back(mesh);
    const std::vector<std::vector<scene::Mesh>> plate = {{square(Eigen::Vector3f::Zero(), 0.1f)}};
    world = std::make_unique<const World>(scene, plate);
    body_light = std::make_unique<const BodyLight>(*world);
  }
  AroundLight around(double height_m, const Illumination& light) const {
    const auto placed = world->bodies->placed({Eigen::Isometry3d(Eigen::Translation3d(0.0, 0.0, height_m))});
    const auto views = body_light->look(*placed, std::make_shared<Visibility>(world->visibility, placed));
    return body_light->around(*views, light)[0];
  }
};

TEST(BodyLight, BelowABodyIsTheLightOfLampsThatTheFloorSendsBack) {
  const PlateAboveFloor stage;
  constexpr double kHeight_m = 1.5, kCd = 400.0;
  scene::Lamp lamp;
  lamp.position = {3.0f, 0.0f, 4.0f};
  lamp.intensity = LinearRgb(400.0f, 400.0f, 400.0f);
  Illumination light(sky::uniformDaylight({}));
  light.lamps = std::make_shared<const std::vector<scene::Lamp>>(1, lamp);
  const Eigen::Array3f below = stage.around(kHeight_m, light).illuminance(-Eigen::Vector3f::UnitZ());
  // The floor's luminance, albedo E / π with E = I h / d³, by the cosines at both ends over π distance².
  double expected = 0.0;
  constexpr double kStep_m = 0.05;
  for (double x = -40.0; x < 40.0; x += kStep_m) {
    for (double y = -40.0; y < 40.0; y += kStep_m) {
      const double to_lamp = std::sqrt((x - 3.0) * (x - 3.0) + y * y + 16.0);
      const double floor_lx = kCd * 4.0 / (to_lamp * to_lamp * to_lamp);
      const double square = x * x + y * y + kHeight_m * kHeight_m;
      expected += floor_lx * kHeight_m * kHeight_m / (square * square) * kStep_m * kStep_m / kPi;
    }
  }
  // 10 %: of the second order and 256 rays, and what the fitted mirror part of the reflectance adds.
  for (Eigen::Index c = 0; c < 3; ++c) {
    const double albedo = 0.5 - 0.1 * static_cast<double>(c);
    EXPECT_NEAR(static_cast<double>(below[c]), albedo * expected, 0.1 * albedo * expected) << c;
  }
  light.lamps = nullptr;
  EXPECT_EQ(stage.around(kHeight_m, light).illuminance(-Eigen::Vector3f::UnitZ()).maxCoeff(), 0.0f);
}

TEST(BodyLight, HoldsLampsUnderARoofByDayAsByNight) {
  PlateAboveFloor stage;
  const auto below = [&](bool by_day) {
    sky::UniformSky sky;
    sky.sun.towards = Direction(Azimuth::degrees(180.0), Angle::degrees(60.0));
    if (by_day) sky.sun.illuminance = LinearRgb(1e5f, 1e5f, 1e5f);
    scene::Lamp lamp;
    lamp.position = {3.0f, 0.0f, 4.0f};
    lamp.intensity = LinearRgb(400.0f, 400.0f, 400.0f);
    Illumination light(sky::uniformDaylight(sky));
    light.lamps = std::make_shared<const std::vector<scene::Lamp>>(1, lamp);
    return stage.around(1.5, light).illuminance(-Eigen::Vector3f::UnitZ())[1];
  };
  const float open = below(true);
  stage.add(square({0.0f, 0.0f, 10.0f}, 600.0f));  // the sun reaches all of the floor, or nothing
  EXPECT_GT(open, 100.0f * below(true));
  EXPECT_GT(below(false), 0.0f);
  EXPECT_EQ(below(true), below(false));
}

TEST(BodyLight, IsThatOfAScreenWhereItsMapHasItShine) {
  // A floor that shines on its half of positive x alone, and one that is seen from below only.
  const auto below = [](const scene::Material& material) {
    auto scene = std::make_shared<scene::Scene>();
    scene->materials = {material};
    scene->textures = {{"halves", 2, 1, {0, 0, 0, 255, 255, 255, 255, 255}}};
    scene->meshes = {square(Eigen::Vector3f::Zero(), 500.0f)};
    scene->meshes[0].texture_coordinates = {{0.0f, 0.0f}, {1.0f, 0.0f}, {1.0f, 1.0f}, {0.0f, 1.0f}};
    const World world(scene, {{square(Eigen::Vector3f::Zero(), 0.1f)}});
    const auto placed = world.bodies->placed({Eigen::Isometry3d(Eigen::Translation3d(0.0, 0.0, 5.0))});
    const BodyLight body_light(world);
    const auto views = body_light.look(*placed, std::make_shared<Visibility>(world.visibility, placed));
    return body_light.around(*views, sky::uniformDaylight({}))[0].illuminance(-Eigen::Vector3f::UnitZ())[1];
  };
  scene::Material screen;
  screen.base_color = LinearRgb(0.0f, 0.0f, 0.0f);
  screen.emission = LinearRgb(100.0f, 100.0f, 100.0f);
  const float whole = below(screen);
  EXPECT_NEAR(whole, 100.0f * kPiFloat, 3.0f * kPiFloat);  // of the second order
  screen.emission_map.texture = 0;
  // The texels run into each other between their middles, 250 m from the body's: half on average.
  EXPECT_NEAR(below(screen) / whole, 0.5f, 0.02f);
  screen.double_sided = false;
  EXPECT_NEAR(below(screen) / whole, 0.5f, 0.02f);
}

TEST(BodyLight, IsInTheShadeWhereItHidesTheLampFromTheFloor) {
  const PlateAboveFloor stage;
  // A narrow spot straight down at the plate: what passes its edges lights the floor, the rest does not.
  scene::Lamp lamp;
  lamp.position = {0.0f, 0.0f, 4.0f};
  lamp.intensity = LinearRgb(400.0f, 400.0f, 400.0f);
  lamp.inner_rad = lamp.outer_rad = 0.03f;
  Illumination light(sky::uniformDaylight({}));
  light.lamps = std::make_shared<const std::vector<scene::Lamp>>(1, lamp);
  EXPECT_EQ(stage.around(1.5, light).illuminance(-Eigen::Vector3f::UnitZ()).maxCoeff(), 0.0f);
}

TEST(BodyLight, HoldsWhatSurfacesPassOnToOthersAroundABody) {
  const PlateAboveFloor stage;
  Illumination light(sky::uniformDaylight({}));
  // A patch of a wall, 8 m away, that shines at the floor before it.
  light.bounced = std::make_shared<const std::vector<BouncedLight>>(
      1, BouncedLight{{8.0f, 0.0f, 2.0f}, -Eigen::Vector3f::UnitX(), 0.5f, Eigen::Array3f::Constant(100.0f)});
  EXPECT_GT(stage.around(1.5, light).illuminance(-Eigen::Vector3f::UnitZ()).minCoeff(), 0.0f);
}

TEST(Bodies, NumberTheirTrianglesAlikeWhereverTheyStand) {
  auto scene = std::make_shared<scene::Scene>();
  scene->materials.resize(1);
  const Bodies bodies(scene,
                      {{}, {square(Eigen::Vector3f::Zero(), 1.0f)}, {square(Eigen::Vector3f::Zero(), 2.0f)}});
  ASSERT_EQ(bodies.count(), 3u);
  for (const double far_m : {0.0, 5000.0}) {
    std::vector<Eigen::Isometry3d> places(3, Eigen::Isometry3d(Eigen::Translation3d(far_m, -far_m, 7.0)));
    places[2].rotate(Eigen::AngleAxisd(kPi, Eigen::Vector3d::UnitX()));
    const auto placed = bodies.placed(places);
    ASSERT_EQ(placed->triangles.size(), 4u);
    EXPECT_TRUE(bodies.boxOf(0, *placed).isEmpty());
    EXPECT_EQ(bodies.surfaceOf(2), 16.0f);
    for (std::uint32_t t = 0; t < 4; ++t) {
      const bool flat_side_up = bodies.bodyOf(t) == 1;
      EXPECT_NEAR(placed->planes[t].normal.z(), flat_side_up ? 1.0f : -1.0f, 1e-6f);
      EXPECT_NEAR(placed->planes[t].normal.z() * placed->planes[t].offset, 7.0, 1e-5);
    }
  }
}

TEST(Bodies, TurnTheirTangentsWithThem) {
  auto scene = std::make_shared<scene::Scene>();
  scene->materials.resize(1);
  scene::Mesh plate = square(Eigen::Vector3f::Zero(), 1.0f);
  plate.tangents.assign(plate.positions.size(), Eigen::Vector4f(1.0f, 0.0f, 0.0f, -1.0f));
  const Bodies bodies(scene, {{plate}});
  Eigen::Isometry3d place(Eigen::Translation3d(10.0, 20.0, 3.0));
  place.rotate(Eigen::AngleAxisd(0.5 * kPi, Eigen::Vector3d::UnitZ()));
  const auto placed = bodies.placed({place});
  ASSERT_EQ(placed->tangents.size(), placed->positions.size());
  for (const Eigen::Vector4f& tangent : placed->tangents)
    EXPECT_LT((tangent - Eigen::Vector4f(0.0f, 1.0f, 0.0f, -1.0f)).norm(), 1e-6f);
}

}  // namespace
}  // namespace sunlit::light
