// A robot is seen and casts its shadow where its links stand, pose by pose.
#include <gtest/gtest.h>

#include <cstring>

#include "sunlit/scene/robot.h"
#include "test_scenes.h"

namespace sunlit::test {
namespace {

/// A box of 1 m on a mast of 2 m, 3 m above the base, whose arm can be elsewhere.
constexpr const char* kRobot = R"(<?xml version="1.0"?>
<robot name="crane">
  <material name="orange"><color rgba="0.9 0.4 0.1 1"/></material>
  <link name="base_link"><visual><origin xyz="0 0 1.5"/><geometry><box size="0.2 0.2 3"/></geometry>
    <material name="orange"/></visual></link>
  <link name="arm"><visual><geometry><box size="1 1 1"/></geometry><material name="orange"/></visual></link>
  <joint name="j" type="prismatic"><parent link="base_link"/><child link="arm"/><origin xyz="0 0 3"/>
    <axis xyz="1 0 0"/><limit lower="-1" upper="1" effort="1" velocity="1"/></joint>
</robot>)";

const render::BodyPlaces kNobody;

struct Stage {
  scene::Robot robot = scene::parseUrdf(kRobot, "crane.urdf", {});
  light::World world = makeWorld();

  light::World makeWorld() const {
    scene::Scene scene;
    addGround(&scene, addMaterial(&scene, {0.5f, 0.5f, 0.5f}), 50.0f);
    const auto meshes = scene::addLooks(robot, &scene);
    return light::World(shared(std::move(scene)), meshes);
  }
  render::BodyPlaces at(const Eigen::Isometry3d& map_from_base) const {
    render::BodyPlaces places = robot.baseFromLinks(0);
    for (Eigen::Isometry3d& place : places) place = map_from_base * place;
    return places;
  }
  render::BodyPlaces at(double east, double north) const {
    return at(Eigen::Isometry3d(Eigen::Translation3d(east, north, 0.0)));
  }
};

/// Straight down from 100 m, 10 px a metre, north up.
struct MapView {
  render::RenderOptions options;
  MapView() { options.camera = image::PinholeCamera{400, 400, 1000.0, 1000.0, 199.5, 199.5}; }
  Eigen::Isometry3d pose() const { return lookingAt({0.0, 0.0, 100.0}, {0.0, 0.0, 0.0}); }
  static int column(double east_m) { return static_cast<int>(std::lround(199.5 + 10.0 * east_m)); }
  static int row(double north_m) { return static_cast<int>(std::lround(199.5 - 10.0 * north_m)); }
};

float ground(const image::LinearImage& image, double east, double north) {
  return at(image, MapView::column(east), MapView::row(north))[1];
}

TEST(Robot, CastsItsShadowWhereItStands) {
  const Stage stage;
  MapView view;
  render::Renderer renderer(stage.world, view.options);
  // Sun in the east at 45°: the box, 3 m up, shades what is 3 m to its west.
  const sky::Daylight day = daylightAt(90.0, 45.0);
  for (const double north : {-8.0, 0.0, 7.0}) {
    renderer.look(view.pose(), stage.at(5.0, north));
    const image::LinearImage image = renderer.light(day);
    const float lit = ground(image, -10.0, 12.0);
    EXPECT_LT(ground(image, 2.0, north), 0.5f * lit);
    EXPECT_LT(ground(image, 4.0, north), 0.5f * lit) << "of the mast";
    EXPECT_NEAR(ground(image, 2.0, north + 1.0), lit, 0.01f * lit);
    EXPECT_NEAR(ground(image, 0.8, north), lit, 0.01f * lit) << "beyond its end";
    EXPECT_GT(at(image, MapView::column(5.0), MapView::row(north))[0], 1.2f * lit)
        << "orange is brighter in red";
  }
}

/// Compares representations, so that NaN equals NaN.
bool sameBits(const std::vector<float>& a, const std::vector<float>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(float)) == 0;
}

TEST(Robot, CastsTheShadowAndHasTheDepthOfTheSameTrianglesInTheScene) {
  const Stage stage;
  // Another rotation than a whole turn would round differently.
  Eigen::Isometry3d map_from_base(Eigen::Translation3d(3.0, -2.0, 0.0));
  map_from_base.linear() << 0, -1, 0, 1, 0, 0, 0, 0, 1;
  const render::BodyPlaces places = stage.at(map_from_base);
  scene::Scene built_in;
  addGround(&built_in, addMaterial(&built_in, {0.5f, 0.5f, 0.5f}), 50.0f);
  const auto meshes = scene::addLooks(stage.robot, &built_in);
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    for (scene::Mesh mesh : meshes[i]) {
      for (auto& position : mesh.positions) position = (places[i] * position.cast<double>()).cast<float>();
      for (auto& normal : mesh.normals) normal = (places[i].linear() * normal.cast<double>()).cast<float>();
      built_in.meshes.push_back(mesh);
    }
  }
  const Eigen::Isometry3d pose = lookingAt({-9.0, -8.0, 4.0}, {1.0, -1.0, 1.0});
  render::Renderer moving(stage.world, smallCamera());
  render::Renderer fixed(shared(std::move(built_in)), smallCamera());
  moving.look(pose, places);
  fixed.look(pose);
  EXPECT_TRUE(sameBits(moving.depth().data, fixed.depth().data));
  // Of the light only the sun's is the same to the bit: all around, bodies are told apart.
  const sky::Daylight day = daylightAt(90.0, 30.0);
  const image::LinearImage with = moving.light(day), as_scene = fixed.light(day);
  // The sun gives two thirds of the light on the ground: where its shadow lay elsewhere, as much would
  // differ.
  const float lit = at(as_scene, 20, 110)[1];
  int shadow_differs = 0;
  for (std::size_t i = 1; i < with.data.size(); i += 3) {
    if (std::abs(with.data[i] - as_scene.data[i]) > 0.4f * lit) ++shadow_differs;
  }
  EXPECT_EQ(shadow_differs, 0);
}

TEST(Robot, LooksTheSameWhenItsPoseWasDrawnAheadAndLeavesWhenNotGiven) {
  const Stage stage;
  MapView view;
  const sky::Daylight day = daylightAt(90.0, 45.0);
  render::Renderer plain(stage.world, view.options), ahead(stage.world, view.options);
  plain.look(view.pose(), stage.at(0.0, 0.0));
  const std::vector<float> first = plain.light(day).data;
  plain.look(view.pose(), stage.at(4.0, 2.0));
  const std::vector<float> second = plain.light(day).data;
  plain.look(view.pose());
  const image::LinearImage nobody = plain.light(day);

  ahead.look(view.pose(), stage.at(0.0, 0.0));
  ahead.lookAhead(view.pose(), stage.at(4.0, 2.0));
  EXPECT_TRUE(sameBits(ahead.light(day).data, first)) << "while another place was drawn";
  ahead.look(view.pose(), stage.at(4.0, 2.0));
  EXPECT_TRUE(sameBits(ahead.light(day).data, second));
  ahead.lookAhead(view.pose(), stage.at(0.0, 0.0));
  ahead.look(view.pose());  // another one than was drawn ahead
  EXPECT_TRUE(sameBits(ahead.light(day).data, nobody.data));
  EXPECT_FALSE(sameBits(first, second));
  const float lit = ground(nobody, -10.0, 12.0);
  EXPECT_NEAR(ground(nobody, 0.0, 0.0), lit, 0.01f * lit);
}

TEST(Robot, IsRefusedWhereItDoesNotFit) {
  const Stage stage;
  render::Renderer renderer(stage.world, smallCamera());
  render::BodyPlaces places = stage.at(0.0, 0.0);
  places.pop_back();
  EXPECT_THROW(renderer.look(MapView().pose(), places), std::invalid_argument);
  EXPECT_THROW(renderer.light(daylightAt(90.0, 45.0)), std::logic_error) << "of a pose that failed";
  places.push_back(Eigen::Isometry3d(Eigen::Translation3d(std::nan(""), 0.0, 0.0)));
  EXPECT_THROW(renderer.look(MapView().pose(), places), std::invalid_argument);
}

/// Under a wide plate, 1 m above the ground.
TEST(Robot, KeepsTheSkyFromTheGroundBeneathIt) {
  const scene::Robot robot = scene::parseUrdf(
      "<robot name='plate'><link name='base'><visual><origin xyz='0 0 1'/><geometry><box size='4 4 0.02'/>"
      "</geometry></visual></link></robot>",
      "plate.urdf", {});
  scene::Scene scene;
  addGround(&scene, addMaterial(&scene, {0.5f, 0.5f, 0.5f}), 50.0f);
  const auto meshes = scene::addLooks(robot, &scene);
  const light::World world(shared(std::move(scene)), meshes);
  render::Renderer renderer(world, smallCamera(160, 120, 40.0));
  const Eigen::Vector3d eye(0.0, -6.0, 0.5);
  const sky::Daylight day = daylightAt(0.0, -3.0);  // no sun
  renderer.look(lookingAt(eye, {0.0, 0.0, 0.0}));
  const float open = at(renderer.light(day), 80, 60)[1];
  renderer.look(lookingAt(eye, {0.0, 0.0, 0.0}), robot.baseFromLinks(0));
  const float beneath = at(renderer.light(day), 80, 60)[1];
  // The form factor of a square of half side a from the ground at height h below its middle:
  // 4 · 2/(2π) · x/√(1+x²) · atan(x/√(1+x²)) with x = a / h = 2 (Howell's catalogue, configuration C-11):
  // 0.831. 32 rays tell it to 1 in 32; the luminance of the sky differs by direction, some tenths of the
  // rest.
  const float expected = 1.0f - 0.831f;
  EXPECT_NEAR(beneath / open, expected, 1.0f / 32.0f + 0.02f);
}

/// A spot on the ground, from which light comes back to the robot's own arm.
TEST(Robot, ItsHeadlightsLightWhatTheyDoNotReachByWayOfTheGround) {
  Stage stage;
  scene::Lamp headlight;
  headlight.position = {1.5f, 0.0f, 2.0f};
  headlight.direction = {0.0f, 0.0f, -1.0f};
  headlight.inner_rad = headlight.outer_rad = 0.1f;
  headlight.intensity = LinearRgb(1000.0f, 1000.0f, 1000.0f);
  stage.world.lamps_of_bodies = {{headlight}, {}};
  render::Renderer renderer(stage.world, smallCamera());
  const sky::Daylight night = daylightAt(90.0, -30.0);
  light::LampOptions off;
  off.mode = light::LampMode::kOff;
  // The underside of the arm's box, 2.5 m up.
  const Eigen::Vector3d seen(5.2, 3.0, 2.5);
  renderer.look(lookingAt({5.6, 1.0, 0.5}, seen), stage.at(5.0, 3.0));
  const float by_lamp = at(renderer.light(light::illumination(stage.world, night)), 80, 60)[1] -
                        at(renderer.light(light::illumination(stage.world, night, off)), 80, 60)[1];
  // I 2π (1 − cos 0.1) lm times the ground's albedo of 0.5, over π; cosines of 2.5 m and 1.3 m aside. 15 %:
  // the mirror-like parts of both surfaces.
  const float cd = 1000.0f * 2.0f * (1.0f - std::cos(0.1f)) * 0.5f, square = 2.5f * 2.5f + 1.3f * 1.3f;
  const float arm = stage.world.geometry->scene->materials.back().base_color.value[1];
  const float expected = arm / kPiFloat * cd * 2.5f * 2.5f / (square * square);
  EXPECT_NEAR(by_lamp, expected, 0.15f * expected);
}

TEST(Robot, ItsHeadlightsMoveWithIt) {
  Stage stage;
  scene::Lamp headlight;
  headlight.name = "headlight";
  headlight.position = {0.2f, 0.0f, 1.0f};  // of the base link, ahead of its mast
  headlight.direction = Eigen::Vector3f(1.0f, 0.0f, -0.5f).normalized();
  headlight.inner_rad = 0.2f;
  headlight.outer_rad = 0.3f;
  headlight.intensity = LinearRgb(100.0f, 100.0f, 100.0f);
  stage.world.lamps_of_bodies = {{headlight}, {}};
  MapView view;
  render::Renderer renderer(stage.world, view.options);
  const sky::Daylight night = daylightAt(90.0, -30.0);
  light::LampOptions off;
  off.mode = light::LampMode::kOff;
  const light::Illumination lit = light::illumination(stage.world, night),
                            dark = light::illumination(stage.world, night, off);
  const auto byLamp = [&](double east, double north) {
    return ground(renderer.light(lit), east, north) - ground(renderer.light(dark), east, north);
  };
  // Its axis meets the ground 2 m ahead of it: 100 cd, √5 m, cosine 1/√5, 3 % by Fresnel at that angle and
  // more.
  const float expected = 0.5f / kPiFloat * 100.0f / (5.0f * std::sqrt(5.0f));
  renderer.look(view.pose(), stage.at(5.0, 3.0));
  EXPECT_NEAR(byLamp(7.2, 3.0), expected, 0.15f * expected);
  EXPECT_EQ(byLamp(2.8, 3.0), 0.0f);
  Eigen::Isometry3d turned = Eigen::Isometry3d::Identity();
  turned.translation() = Eigen::Vector3d(-4.0, 0.0, 0.0);
  turned.rotate(Eigen::AngleAxisd(0.5 * kPi, Eigen::Vector3d::UnitZ()));
  renderer.look(view.pose(), stage.at(turned));
  EXPECT_NEAR(byLamp(-4.0, 2.2), expected, 0.15f * expected);
  EXPECT_EQ(byLamp(7.2, 3.0), 0.0f);
  renderer.look(view.pose(), kNobody);
  EXPECT_EQ(byLamp(-4.0, 2.2), 0.0f);
}

}  // namespace
}  // namespace sunlit::test
