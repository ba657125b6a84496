// Pictures under a closed sky and in fog, by numbers on paper.
#include <gtest/gtest.h>

#include <cmath>

#include "sunlit/light/transport.h"
#include "support/usual_air.h"
#include "test_scenes.h"

namespace sunlit::test {
namespace {

/// Under a sun at 30° in the east.
sky::Daylight under(const sky::Weather& weather) {
  return sky::usualAir().daylight({Direction(Azimuth::degrees(90.0), Angle::degrees(30.0)), 1.0}, {},
                                  weather);
}

/// A camera that looks from `eye` to `target`, and what it sees where a place lies.
class View {
 public:
  View(const light::World& world, const Eigen::Vector3d& eye, const Eigen::Vector3d& target,
       const render::RenderOptions& camera)
      : camera_(camera), map_from_optical_(lookingAt(eye, target)), renderer_(world, camera_) {
    renderer_.look(map_from_optical_);
  }
  image::LinearImage picture(const light::Illumination& light) const { return renderer_.light(light); }
  double at(const image::LinearImage& picture, const Eigen::Vector3d& place) const {
    const Eigen::Vector3d seen = map_from_optical_.inverse() * place;
    const image::PinholeCamera& camera = camera_.camera;
    const int x = static_cast<int>(std::lround(camera.fx * seen.x() / seen.z() + camera.cx));
    const int y = static_cast<int>(std::lround(camera.fy * seen.y() / seen.z() + camera.cy));
    return static_cast<double>(LinearRgb(test::at(picture, x, y)).luminance());
  }

 private:
  render::RenderOptions camera_;
  Eigen::Isometry3d map_from_optical_;
  render::Renderer renderer_;
};

constexpr double kVisibility_m = 200.0;
const Eigen::Vector3d kEye(0.0, 0.0, 1.6);

struct Board {
  double distance_m, left_deg;
  bool black;
  Eigen::Vector3d middle() const {
    const double turn = left_deg * kRadPerDeg;
    return kEye + distance_m * Eigen::Vector3d(std::cos(turn), std::sin(turn), 0.0);
  }
};

const Board kBlackFar{kVisibility_m, 3.0, true}, kBlackNear{0.5 * kVisibility_m, 7.0, true};
const Board kGreyFar{kVisibility_m, -3.0, false}, kGreyNear{0.5 * kVisibility_m, -7.0, false};

/// Boards of 6 m that face the camera, and nothing else.
scene::Scene boards() {
  scene::Scene scene;
  // Black is what mirrors nothing, either: a metal of no colour.
  const int black = addMaterial(&scene, Eigen::Array3f::Zero());
  scene.materials[0].metalness = 1.0f;
  const int grey = addMaterial(&scene, Eigen::Array3f::Constant(0.4f));
  for (const Board& board : {kBlackFar, kBlackNear, kGreyFar, kGreyNear}) {
    const Eigen::Vector3f corner = board.middle().cast<float>() + Eigen::Vector3f(0.0f, 3.0f, -3.0f);
    addPatch(&scene, board.black ? black : grey, corner, {0.0f, -6.0f, 0.0f}, {0.0f, 0.0f, 6.0f});
  }
  return scene;
}

TEST(Fog, TakesFromBoardsTheContrastThatVisibilitySays) {
  sky::Weather weather;
  weather.visibility_m = kVisibility_m;
  weather.cover_oktas = 8.0;  // so that light comes evenly from all round, as Koschmieder has it
  const sky::Daylight day = under(weather);
  const light::World world(shared(boards()));
  // The air is asked for every 16 px, and the sky's brightness has a kink at the horizon: here that is a
  // corner.
  const View view(world, kEye, kEye + Eigen::Vector3d::UnitX(), smallCamera(320, 256, 24.0));
  const image::LinearImage picture = view.picture(day);
  const double horizon = view.at(picture, kEye + Eigen::Vector3d::UnitX());
  const auto contrast = [&](const Board& board) {
    return (horizon - view.at(picture, board.middle())) / horizon;
  };
  // Air is asked for at distances half an octave apart, and the chord between two lies up to 0.6 % of the
  // light above the curve.
  EXPECT_NEAR(contrast(kBlackFar), 0.05, 0.006);
  EXPECT_NEAR(contrast(kBlackNear), 0.2236, 0.007);
  // A grey board's own, from so near that 1.5 % are lost.
  const Eigen::Vector3d before = kGreyNear.middle() - Eigen::Vector3d::UnitX();
  const View near(world, before, kGreyNear.middle(), smallCamera(320, 256, 24.0));
  const double own = (horizon - near.at(near.picture(day), kGreyNear.middle())) / horizon;
  EXPECT_GT(std::abs(own), 0.2);  // or the next would say nothing
  EXPECT_NEAR(contrast(kGreyNear), 0.2236 * own, 0.008 * std::abs(own));
  EXPECT_NEAR(contrast(kGreyFar), 0.05 * own, 0.006 * std::abs(own));
}

TEST(Fog, IsAsBrightBeforeBoardsInAnyRowAsItIsBehindThem) {
  sky::Weather weather;
  weather.visibility_m = kVisibility_m;
  weather.cover_oktas = 8.0;
  const sky::Daylight day = under(weather);
  const light::World world(shared(boards()));
  for (const int height : {240, 248, 256, 264}) {
    const View view(world, kEye, kEye + Eigen::Vector3d::UnitX(), smallCamera(320, height, 24.0));
    const image::LinearImage picture = view.picture(day);
    const double horizon = view.at(picture, kEye + Eigen::Vector3d::UnitX());
    const double found = (horizon - view.at(picture, kBlackFar.middle())) / horizon;
    // Between corners of tiles the kink is cut by up to 2 % of the light, and before a board it is so much
    // brighter than beside it: measured 0.033 to 0.054.
    EXPECT_NEAR(found, 0.05, 0.02) << height;
  }
}

TEST(StandardOvercast, CastsNoShadowOfAPost) {
  scene::Scene scene;
  constexpr float kAlbedo = 0.3f, kHeight_m = 3.0f;
  addGround(&scene, addMaterial(&scene, Eigen::Array3f::Constant(kAlbedo)), 60.0f);
  addBlock(&scene, addMaterial(&scene, Eigen::Array3f::Constant(0.1f)), {-0.1f, -0.1f, 0.0f},
           {0.2f, 0.2f, kHeight_m});
  light::World world(shared(scene));
  light::TransportOptions options;
  options.samples = 8000;
  world.transport = light::Transport::bake(world.geometry, options);
  const View view(world, {0.0, -6.0, 4.0}, Eigen::Vector3d::Zero(), smallCamera(320, 240, 60.0));
  const auto ratio = [&](const image::LinearImage& picture, double away_m) {
    return view.at(picture, {-away_m, 0.0, 0.0}) / view.at(picture, {away_m, 0.0, 0.0});
  };
  sky::Weather cie;
  cie.cover_oktas = 8.0;
  cie.overcast = sky::Overcast::kCie;
  const sky::Daylight grey = under(cie);
  const image::LinearImage without = view.picture(light::illumination(world, grey));
  const image::LinearImage with = view.picture(light::illumination(world, under({})));
  for (const double away_m : {0.5, 1.0, 2.0}) {
    EXPECT_LT(ratio(with, away_m), 0.3) << away_m;  // the sun's shadow is 5.2 m long
    // Light of the sky is baked at nodes that lie otherwise to either side: measured within 2 %.
    EXPECT_NEAR(ratio(without, away_m), 1.0, 0.03) << away_m;
  }
}

TEST(BrokenCloud, IsAsHighOverAWorldThatLiesHigh) {
  sky::Weather weather;
  weather.cover_oktas = 4.0;
  const sky::Daylight day = under(weather);
  constexpr double kSquare_m = 400.0;
  const auto pictureAt = [&](double level_m) {
    scene::Scene scene;
    const int grey = addMaterial(&scene, Eigen::Array3f::Constant(0.3f));
    const auto corner_m = static_cast<float>(0.5 * kSquare_m), side_m = static_cast<float>(kSquare_m);
    addPatch(&scene, grey, {-corner_m, -corner_m, static_cast<float>(level_m)}, {side_m, 0.0f, 0.0f},
             {0.0f, side_m, 0.0f});
    light::World world(shared(scene));
    light::TransportOptions options;
    options.samples = 1000;
    world.transport = light::Transport::bake(world.geometry, options);
    // Sky, the cloud's shadows on the ground, and light of the sky.
    const Eigen::Vector3d eye(0.0, 0.0, level_m + 40.0);
    const View view(world, eye, eye + Eigen::Vector3d(10.0, 3.0, -1.0), smallCamera(64, 48, 60.0));
    return view.picture(light::illumination(world, day));
  };
  const image::LinearImage low = pictureAt(0.0), high = pictureAt(1600.0);  // above the cloud's base
  double least = 1e9, most = 0.0;
  for (int y = 0; y < 48; ++y) {
    for (int x = 0; x < 64; ++x) {
      const float expected = LinearRgb(test::at(low, x, y)).luminance();
      EXPECT_NEAR(LinearRgb(test::at(high, x, y)).luminance(), expected, 0.01f * expected) << x << ' ' << y;
      if (y < 40) continue;
      least = std::min(least, static_cast<double>(expected));
      most = std::max(most, static_cast<double>(expected));
    }
  }
  EXPECT_GT(most, 0.0);
  EXPECT_LT(least, most);
}

TEST(Fog, IsAboveMirrorsOnTheGroundThatAreSeenFromAboveIt) {
  scene::Scene scene;
  const int metal = addMaterial(&scene, {0.9f, 0.9f, 0.9f});
  scene.materials.back().metalness = 1.0f;
  scene.materials.back().roughness = scene::Material::kSmoothest;
  addGround(&scene, metal, 300.0f);
  sky::Weather weather;
  weather.visibility_m = kVisibility_m;
  weather.fog_top_m = 30.0;
  const sky::Daylight day = under(weather);
  const Eigen::Vector3d eye(0.0, 0.0, 100.0), place(0.0, 100.0, 0.0);
  const View view(light::World(shared(scene)), eye, place, smallCamera());
  const double seen = view.at(view.picture(light::Illumination(day)), place);
  const Eigen::Vector3f down = (place - eye).normalized().cast<float>(), up(down.x(), down.y(), -down.z());
  const sky::AirColumn air = day.seenFrom(eye.cast<float>()).airOver(down, 141.421f);
  const Eigen::Array3f foggy = day.skyLuminance(up).value, clear = under({}).skyLuminance(up).value;
  const auto through = [&](const Eigen::Array3f& sky) {
    return static_cast<double>(
        LinearRgb(Eigen::Array3f(0.9f * sky * air.transmittance + air.airlight)).luminance());
  };
  EXPECT_NEAR(seen, through(foggy), 0.03 * through(foggy));  // the lobe's tables: 2 %
  EXPECT_GT(std::abs(through(clear) / through(foggy) - 1.0), 0.1);
}

}  // namespace
}  // namespace sunlit::test
