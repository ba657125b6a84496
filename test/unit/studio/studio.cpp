#include "sunlit/studio/studio.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "sunlit/image/mean_luminance.h"
#include "sunlit/image/rain_streaks.h"
#include "sunlit/quantity/angle.h"
#include "sunlit/quantity/frames.h"
#include "sunlit/scene/shelter.h"
#include "support/message_of.h"
#include "support/temporary_folder.h"
#include "support/usual_air.h"

namespace sunlit::studio {
namespace {

constexpr const char* kBoxes = SUNLIT_SOURCE_DIR "/test/support/worlds/two_boxes.urdf";

/// Two boxes on a plain under an open sky, by a small camera.
StudioOptions boxes() {
  StudioOptions options;
  options.world.name = kBoxes;
  options.bake.enabled = false;
  options.render.camera = image::PinholeCamera::fromFieldOfView(48, 32, Angle::degrees(90.0));
  return options;
}

const sky::SunInSky kHighSun{Direction(Azimuth::degrees(160.0), Angle::degrees(55.0)), 1.0};

// It has no depth.
TEST(Studio, SeesWhatBlendsToo) {
  const TemporaryFolder folder;
  setContent(
      folder.file("pane.urdf"),
      "<robot name='pane'><link name='base'><visual><origin xyz='5 0 0'/><geometry>"
      "<box size='0.1 90 90'/></geometry><material name='veil'><color rgba='0.6 1 0.2 0.5'/></material>"
      "</visual></link></robot>");
  StudioOptions options = boxes();
  options.world.name = folder.file("pane.urdf");
  Studio studio(options);
  studio.look(Eigen::Isometry3d::Identity());
  EXPECT_TRUE(std::isnan(*studio.depth().at(24, 16)));
  EXPECT_FALSE(studio.viewFault());
  studio.look(Eigen::Isometry3d(Eigen::Translation3d(9, 0, 0)));
  EXPECT_TRUE(studio.viewFault());
}

TEST(Studio, SaysWhereTheWorldIsThatIsNotInView) {
  Studio studio(boxes());
  const Eigen::AlignedBox3d bounds = boundsOf(studio.world());
  studio.look(Eigen::Isometry3d(Eigen::Translation3d(5000, 0, 1)));
  ASSERT_TRUE(studio.viewFault());
  EXPECT_EQ(studio.viewFault()->poses, std::string("see nothing of the world"));
  EXPECT_EQ(studio.viewFault()->reason,
            "nothing of the world is in view, " + reachOf(bounds) +
                "; surfaces with one side do not show the other, and nothing nearer "
                "than 5 cm is drawn");
  EXPECT_EQ(reachOf({Eigen::Vector3d(-1.25, 592000.4, 0.0), Eigen::Vector3d(99.96, 592003.0, 2.0)}),
            "which reaches from -1.25,592000,0 to 100,592003,2 m");
}

// The boxes stand on a slab of ground between z = -1 m and 0.
TEST(Studio, TellsACameraThatIsUnderTheGround) {
  Studio studio(boxes());
  const auto faultAt = [&](double x, double z) -> std::string {
    studio.look(Eigen::Isometry3d(Eigen::Translation3d(x, 0.0, z)));
    const std::optional<ViewFault> fault = studio.viewFault();
    return fault ? fault->poses : "";
  };
  EXPECT_EQ(faultAt(0.0, 1.0), "");
  EXPECT_EQ(faultAt(0.0, 0.0), "") << "on the ground";
  EXPECT_EQ(faultAt(13.0, 5.0), "") << "above a box";
  EXPECT_EQ(faultAt(0.0, -3.0), "are under the ground, or where there is none");
  EXPECT_NE(studio.viewFault()->reason.find("is seen beneath the camera, but something is above"),
            std::string::npos);
  EXPECT_EQ(faultAt(5000.0, -3.0), "see nothing of the world");
}

TEST(Studio, TellsWhatIsFarFromAWorld) {
  const Eigen::AlignedBox3d cube(Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(4, 3, 0));  // 5 m wide
  EXPECT_FALSE(isFarFrom(cube, {2, 1, 0}, 20000.0));
  EXPECT_FALSE(isFarFrom(cube, {53.9, 1, 0}, 20000.0));
  EXPECT_TRUE(isFarFrom(cube, {54.1, 1, 0}, 20000.0));
  EXPECT_TRUE(isFarFrom(cube, {592000, 5760000, 0}, 20000.0));
  EXPECT_TRUE(isFarFrom(cube, {2, 1, -20}, 10.0)) << "nothing is seen so far away";
  EXPECT_FALSE(isFarFrom({}, {592000, 5760000, 0}, 20000.0)) << "there is nothing to be near to";
}

TEST(Studio, RefusesBadOptionsBeforeItLoadsTheWorld) {
  StudioOptions options = boxes();
  options.world.name = "no_such.world";
  const auto refusal = [&] { return messageOf<std::exception>([&] { Studio studio(options); }); };
  EXPECT_NE(refusal().find("no_such.world"), std::string::npos);
  options.chains[0].noise.read_e = -1.0;
  EXPECT_NE(refusal().find("read_e"), std::string::npos) << refusal();
  options.chains[0].noise.read_e = 3.0;
  options.chains[0].exposure.max_ev100 = options.chains[0].exposure.min_ev100 - 1.0;
  EXPECT_NE(refusal().find("ev100"), std::string::npos) << refusal();
  options.chains[0].exposure = {};
  options.bake.transport.bounces = -1;
  EXPECT_NE(refusal().find("bounces"), std::string::npos) << refusal();
  options.bake.transport.bounces = 3;
  options.render.supersampling = 9;
  EXPECT_NE(refusal().find("supersampling"), std::string::npos) << refusal();
  options.render.supersampling = 2;
  options.chains[0].glare.share = 0.5;
  EXPECT_NE(refusal().find("share"), std::string::npos) << refusal();
  options.chains[0].glare.share = 0.0;
  options.chains[0].blur.sigma_px = 11.0;
  EXPECT_NE(refusal().find("sigma"), std::string::npos) << refusal();
  options.chains[0].blur.sigma_px = 0.0;
  options.chains[0].vignetting.a1 = -2.0;
  EXPECT_NE(refusal().find("a1"), std::string::npos) << refusal();
  options.chains[0].vignetting.a1 = 0.0;
  options.chains.emplace_back().shutter.line_delay_us = -1.0;
  EXPECT_NE(refusal().find("line_delay"), std::string::npos) << refusal();
}

/// All that a lens and a sensor can do, while it turns in the rain.
StudioOptions everythingOn() {
  StudioOptions options = boxes();
  ChainOptions& chain = options.chains[0];
  chain.shutter.line_delay_us = 1000.0;
  chain.shutter.exposure_ms = 60.0;
  chain.vignetting.cos4 = true;
  chain.vignetting.a1 = -0.1;
  chain.glare.share = 0.05;
  chain.blur.sigma_px = 0.5;
  chain.exposure.compensation_ev = 0.5;
  chain.noise.enabled = true;
  chain.mosaic.pattern = image::MosaicPattern::kRggb;
  return options;
}

/// What is photographed, and how the camera moves meanwhile.
struct Taken {
  image::PictureName name;
  Eigen::Isometry3d map_from_camera;
  Motion motion;
  sky::Daylight day;
};

Taken inRain() {
  sky::Weather rainy;
  rainy.rain_mm_per_h = 100.0;
  rainy.wind_m_per_s = 10.0;
  return {{7, "noon"},
          Eigen::Isometry3d(Eigen::Translation3d(0.0, 0.0, 1.0)),
          {{0.0, 2.0, 0.0}, {0.0, 0.0, 2.0}},
          sky::usualAir().daylight(kHighSun, {}, rainy)};
}

/// The steps of the first chain one by one; `glare_first`: before the vignetting.
Developed byHand(const StudioOptions& options, const Taken& taken, bool glare_first) {
  const ChainOptions& chain = options.chains[0];
  const light::World world = loadWorld(options.world, "", std::nullopt, {});
  render::Renderer renderer(world, options.render);
  renderer.look(taken.map_from_camera * linkFromOptical());
  const light::Illumination light = light::illumination(world, taken.day, options.lamps);
  const render::UnderWay way{taken.motion, 1e-6 * chain.shutter.line_delay_us,
                             1e-3 * chain.shutter.exposure_ms.value(), chain.shutter.exposures};
  image::LinearImage luminance = renderer.light(light, 0, way);
  const image::Lens lens(options.render.camera, {});
  const image::Vignetting vignetting(lens, chain.vignetting);
  const std::vector<image::LightOutside> outside = renderer.lightsOutside(light);
  EXPECT_EQ(outside.size(), 1u);  // the sun, high above what the camera sees
  const auto passLens = [&](image::LinearImage* passing) {
    if (!glare_first) vignetting.apply(passing);
    image::VeilingGlare(vignetting, chain.glare).apply(outside, passing);
    if (glare_first) vignetting.apply(passing);
    image::blur(chain.blur, passing);
  };
  image::LinearImage dry = luminance;
  passLens(&dry);
  const double ev100 = image::chooseEv100(dry, chain.exposure);
  const Eigen::Array3f drops = image::dropLuminance(luminance, taken.day.groundIlluminance().value);
  const sky::Rain rain = taken.day.rain();
  const image::RainStreaks streaks{
      rain.mm_per_h, rain.seed,    taken.name.index, image::streakTime_s(chain.shutter, ev100),
      drops,         rain.wind_m_s};
  const scene::Shelter shelter(*world.geometry->shape, world.geometry->scene->materials);
  image::addRain(streaks,
                 {lens, taken.map_from_camera * linkFromOptical(), taken.motion, renderer.depth(),
                  [&](const Eigen::Vector3d& place) { return shelter.open(place); }},
                 &luminance);
  passLens(&luminance);
  image::addSensorNoise(ev100, chain.noise, taken.name, &luminance);
  return {image::throughMosaic(image::develop(luminance, ev100), chain.mosaic), ev100};
}

TEST(Studio, TakesThePictureThatItsPartsMakeInTheirOrder) {
  const StudioOptions options = everythingOn();
  const Taken taken = inRain();
  const auto photographed = [&](const StudioOptions& with) {
    Studio studio(with);
    studio.look(taken.map_from_camera, {}, taken.motion);
    return studio.photograph(studio.illumination(taken.day), taken.name);
  };
  const Developed developed = photographed(options);
  const Developed expected = byHand(options, taken, false);
  EXPECT_EQ(developed.ev100, expected.ev100);
  EXPECT_EQ(developed.picture.data, expected.picture.data);
  // It would show if glare came first.
  EXPECT_NE(byHand(options, taken, true).picture.data, expected.picture.data);
}

TEST(Studio, TheSameDropsFallInEveryConditionOfOneMoment) {
  Studio studio(boxes());  // without grain, which is each picture's own
  const Taken taken = inRain();
  studio.look(taken.map_from_camera, {}, taken.motion);
  const light::Illumination light = studio.illumination(taken.day);
  const auto pictureOf = [&](const image::PictureName& name) {
    return studio.photograph(light, name).picture.data;
  };
  EXPECT_EQ(pictureOf({7, "noon"}), pictureOf({7, "dusk"}));
  EXPECT_NE(pictureOf({7, "noon"}), pictureOf({8, "noon"}));
  // A second drive, past the same place at another time.
  EXPECT_NE(pictureOf({7, "noon"}), pictureOf({7, "noon", "beside"}));
}

TEST(Studio, TakesPicturesWithAsManyChainsAsItHas) {
  StudioOptions options = boxes();
  ChainOptions soft, rolling, long_exposed;
  soft.blur.sigma_px = 2.0;
  rolling.shutter.line_delay_us = 1000.0;
  long_exposed.shutter.exposure_ms = std::nullopt;
  options.chains = {{}, soft, rolling, long_exposed};
  Studio studio(options);
  Eigen::Isometry3d map_from_camera = Eigen::Isometry3d::Identity();
  map_from_camera.translation().z() = 1.0;
  const light::Illumination light = studio.illumination(sky::usualAir().daylight(kHighSun));
  const auto taken = [&](std::size_t chain, const Motion& motion) {
    studio.look(map_from_camera, {}, motion);
    return studio.photograph(light, {}, {0, chain}).picture.data;
  };
  Motion fast;
  fast.velocity_m_s = {0.0, 20.0, 0.0};
  fast.turning_rad_s = {0.0, 0.0, 20.0};
  const auto sharp = taken(0, {});
  EXPECT_NE(taken(1, {}), sharp);
  EXPECT_EQ(taken(2, {}), sharp);
  EXPECT_NE(taken(2, fast), sharp);
  // By its own exposure it sees for less than it takes to run a pixel; two stops darker not.
  EXPECT_EQ(taken(3, fast), sharp);
  studio.look(map_from_camera, {}, fast);
  const auto dark = [&](std::size_t chain) {
    Setting setting{0, chain};
    setting.adapted = [](double) { return 11.0; };
    return studio.photograph(light, {}, setting);
  };
  EXPECT_EQ(dark(3).ev100, 11.0);
  EXPECT_NE(dark(3).picture.data, dark(0).picture.data);
  EXPECT_EQ(studio.meter(light, {}), studio.photograph(light, {}).ev100);
}

TEST(Studio, AFixedExposureIsLitOnceAlsoWhereItsTimeIsItsOwn) {
  StudioOptions options = boxes();
  ChainOptions fixed;
  fixed.shutter.exposure_ms = std::nullopt;
  ChainOptions metered = fixed;
  fixed.exposure.mode = image::ExposureMode::kFixed;
  fixed.exposure.ev100 = 10.0;  // 8 ms
  options.chains = {fixed, metered};
  Studio studio(options);
  Eigen::Isometry3d map_from_camera = Eigen::Isometry3d::Identity();
  map_from_camera.translation().z() = 1.0;
  Motion fast;
  fast.turning_rad_s = {0.0, 0.0, 20.0};
  studio.look(map_from_camera, {}, fast);
  const light::Illumination light = studio.illumination(sky::usualAir().daylight(kHighSun));
  const Developed once = studio.photograph(light, {0, "fixed"}, {0, 0});
  Setting same_exposure{0, 1};
  same_exposure.adapted = [](double) { return 10.0; };
  const Developed twice = studio.photograph(light, {0, "metered"}, same_exposure);
  EXPECT_EQ(once.ev100, 10.0);
  EXPECT_EQ(once.picture.data, twice.picture.data);
  EXPECT_EQ(studio.meter(light, {0, "fixed"}, {0, 0}), 10.0);
  const auto litOf = [&](const std::string& series) {
    int count = 0;
    for (const Stopwatch::Entry& entry : studio.stopwatch().entries())
      if (entry.stage == "light" && entry.what == series) count += entry.count;
    return count;
  };
  EXPECT_EQ(litOf("fixed"), 1);
  EXPECT_EQ(litOf("metered"), 2);  // of a smear that only its exposure tells
}

TEST(Studio, TheRightCameraOfOneThatTurnsIsCarriedAlong) {
  StudioOptions options = boxes();
  options.chains[0].shutter.line_delay_us = 1000.0;
  constexpr double kBaseline_m = 2.0;
  options.right = image::idealRight(image::calibrationOf(options.render.camera), kBaseline_m, "");
  Studio studio(options);
  Eigen::Isometry3d map_from_camera = Eigen::Isometry3d::Identity();
  map_from_camera.translation().z() = 1.0;
  Motion motion;
  motion.velocity_m_s = {1.0, 0.0, 0.0};
  motion.turning_rad_s = {0.0, 0.0, 2.0};
  studio.look(map_from_camera, {}, motion);
  const light::Illumination light = studio.illumination(sky::usualAir().daylight(kHighSun));
  const Developed left = studio.photograph(light, {});

  // Alone in the right one's place, which lies at y = −2 m and so goes forward by 4 m/s more.
  StudioOptions in_its_place = boxes();
  in_its_place.chains = options.chains;
  in_its_place.chains[0].exposure.mode = image::ExposureMode::kFixed;
  in_its_place.chains[0].exposure.ev100 = left.ev100;
  Studio alone(in_its_place);
  motion.velocity_m_s.x() += 2.0 * kBaseline_m;
  alone.look(map_from_camera * Eigen::Translation3d(0.0, -kBaseline_m, 0.0), {}, motion);
  EXPECT_EQ(studio.photographRight(light, {}, left.ev100).data, alone.photograph(light, {}).picture.data);
}

TEST(Studio, TheRightCameraSeesWhatOneInItsPlaceWouldAtTheLeftsExposureWithGrainOfItsOwn) {
  StudioOptions options = boxes();
  options.chains[0].noise.enabled = true;
  Eigen::Isometry3d map_from_camera = Eigen::Isometry3d::Identity();
  map_from_camera.translation().z() = 1.0;
  const sky::Daylight day = sky::usualAir().daylight(kHighSun);
  const image::PictureName name{7, "noon"};
  Studio alone(options);
  alone.look(map_from_camera);
  const Developed without = alone.photograph(alone.illumination(day), name);

  options.right = image::idealRight(image::calibrationOf(options.render.camera), 0.3, "");
  Studio studio(options);
  studio.look(map_from_camera);
  const light::Illumination light = studio.illumination(day);
  const Developed left = studio.photograph(light, name);
  const image::Rgb8Image right = studio.photographRight(light, name, left.ev100);
  EXPECT_EQ(left.picture.data, without.picture.data);

  const light::World world = loadWorld(options.world, "", std::nullopt, {});
  render::Renderer renderer(world, options.render);
  // y is to the left.
  renderer.look(map_from_camera * Eigen::Translation3d(0.0, -0.3, 0.0) * linkFromOptical());
  image::LinearImage luminance = renderer.light(day);
  image::LinearImage same_grain = luminance;
  image::addSensorNoise(left.ev100, options.chains[0].noise, {7, "noon right"}, &luminance);
  EXPECT_EQ(right.data, image::develop(luminance, left.ev100).data);
  image::addSensorNoise(left.ev100, options.chains[0].noise, name, &same_grain);
  EXPECT_NE(right.data, image::develop(same_grain, left.ev100).data);

  // Drawn ahead is the same.
  map_from_camera.translation().x() = 1.0;
  studio.lookAhead(map_from_camera);
  EXPECT_EQ(studio.photographRight(light, name, left.ev100).data, right.data);
  studio.look(map_from_camera);
  const image::Rgb8Image ahead = studio.photographRight(light, name, left.ev100);
  Studio other(options);
  other.look(map_from_camera);
  EXPECT_EQ(ahead.data, other.photographRight(light, name, left.ev100).data);
}

TEST(Studio, AMapLeavesWhatTheCameraLooksAt) {
  Studio studio(boxes());
  Eigen::Isometry3d map_from_camera = Eigen::Isometry3d::Identity();
  map_from_camera.translation().z() = 1.0;
  studio.look(map_from_camera);
  const sky::Daylight day = sky::usualAir().daylight(kHighSun);
  const light::Illumination light = studio.illumination(day);
  const Developed before = studio.photograph(light, {});
  const image::Rgb8Image map = studio.mapFromAbove({-20.0, 20.0, -10.0, 10.0}, day);
  EXPECT_EQ(map.width, 1600);
  EXPECT_EQ(map.height, 800);
  EXPECT_EQ(studio.photograph(light, {}).picture.data, before.picture.data);
}

/// Dark land at 300 m with a white square of 25 m in its middle, and a post that rises so far above it.
std::string highLand(const TemporaryFolder& folder, const std::string& post_top) {
  setContent(folder.file("land.mtl"), "newmtl dark\nKd 0.05 0.05 0.05\nnewmtl white\nKd 0.9 0.9 0.9\n");
  const std::string file = folder.file("land_" + post_top + ".obj");
  setContent(file,
             "mtllib land.mtl\nv -200 -200 300\nv 200 -200 300\nv 200 200 300\nv -200 200 300\n"
             "v -12.5 -12.5 300.01\nv 12.5 -12.5 300.01\nv 12.5 12.5 300.01\nv -12.5 12.5 300.01\n"
             "v 150 150 300\nv 151 150 300\nv 150 150 " +
                 post_top + "\nusemtl dark\nf 1 2 3 4\nf 9 10 11\nusemtl white\nf 5 6 7 8\n");
  return file;
}

/// Of 50 m of that land from straight above, in haze.
image::Rgb8Image seenFromAbove(const std::string& world) {
  StudioOptions options = boxes();
  options.world.name = world;
  options.top_down = TopDown{0.0, 0.0, 50.0};
  options.render.camera = image::PinholeCamera::fromFieldOfView(80, 60, Angle::degrees(90.0));
  options.chains[0].exposure.mode = image::ExposureMode::kFixed;
  options.chains[0].exposure.ev100 = 14.0;
  Studio studio(options);
  studio.look(studio.mapFromTopDown().value());
  sky::Weather hazy;
  hazy.visibility_m = 2000.0;
  const image::DepthImage depth = studio.depth();
  EXPECT_TRUE(std::isfinite(depth.data.front()) && std::isfinite(depth.data.back()));
  return studio.photograph(studio.illumination(sky::usualAir().daylight(kHighSun, {}, hazy)), {}).picture;
}

TEST(Studio, SeesAsMuchGroundFromAboveAsAskedForWhateverItsHeightAndWithoutHaze) {
  const TemporaryFolder folder;
  const image::Rgb8Image low = seenFromAbove(highLand(folder, "310"));
  const auto isWhite = [&](int x, int y) { return *low.at(x, y) > 150; };
  // 80 px are 50 m, so the square is 40 px wide, from 20 to 60; up to the pixels that its edges lie in.
  for (const int side : {0, 1}) {
    EXPECT_FALSE(isWhite(side ? 61 : 18, 30));
    EXPECT_TRUE(isWhite(side ? 58 : 21, 30));
    EXPECT_FALSE(isWhite(40, side ? 51 : 8));
    EXPECT_TRUE(isWhite(40, side ? 48 : 11));
  }
  // From 3.5 km above, where the haze of 2 km would hide all.
  const image::Rgb8Image high = seenFromAbove(highLand(folder, "3300"));
  EXPECT_NEAR(*high.at(40, 30), *low.at(40, 30), 1);
  EXPECT_NEAR(*high.at(5, 5), *low.at(5, 5), 1);
}

/// Columns of a map's row that are white, as of that square: the first, and how many from it to the last.
std::pair<int, int> whiteColumns(const image::Rgb8Image& map, int row) {
  int first = -1, count = 0;
  for (int x = 0; x < map.width; ++x) {
    if (*map.at(x, row) < 128) continue;
    if (first < 0) first = x;
    count = x + 1 - first;
  }
  return {first, count};
}

TEST(Studio, MapsShowTheirExtentAtTheGroundWhateverTheWorldsHeight) {
  const TemporaryFolder folder;
  // 100 km: more than a camera's focal length allows for 80 m.
  for (const std::string top : {"340", "3300", "100000"}) {
    StudioOptions options = boxes();
    options.world.name = highLand(folder, top);
    const Studio studio(options);
    // 20 px/m, the northern edge of the square 10 m and 200 px below that of the map.
    const image::Rgb8Image map =
        studio.mapFromAbove({-40.0, 40.0, -17.5, 22.5}, sky::usualAir().daylight(kHighSun));
    ASSERT_EQ(map.height, 800);
    for (const int row : {202, 255, 256, 450, 697}) {
      const auto [first, count] = whiteColumns(map, row);
      EXPECT_NEAR(first, 550, 1) << "a top of " << top << ", row " << row;
      EXPECT_NEAR(count, 500, 1) << "a top of " << top << ", row " << row;
    }
    for (const int row : {0, 197, 702, 799}) EXPECT_EQ(whiteColumns(map, row).second, 0) << row;
  }
}

TEST(Studio, MapsPathsOfAnyLength) {
  // A camera may look 1e7 m far and see nothing within 1e6: a path of 200 km is not seen from 20 times that.
  Studio studio(boxes());
  const MapExtent extent = widened({0.0, 2e5, -40.0, 40.0});
  const image::Rgb8Image map = studio.mapFromAbove(extent, sky::usualAir().daylight(kHighSun));
  EXPECT_EQ(map.width, 1600);
  EXPECT_EQ(map.height, 16);
}

TEST(MapExtents, AreAsWideAsTheirMapsShow) {
  const MapExtent straight = widened({0.0, 16000.0, -40.0, 40.0});
  EXPECT_EQ(straight.x_min, 0.0);
  EXPECT_EQ(straight.x_max, 16000.0);
  EXPECT_DOUBLE_EQ(straight.y_min, -80.0);
  EXPECT_DOUBLE_EQ(straight.y_max, 80.0);
  const MapExtent usual = widened({-30.0, 50.0, -40.0, 400.0});
  EXPECT_EQ(usual.x_min, -30.0);
  EXPECT_EQ(usual.x_max, 50.0);
  EXPECT_EQ(usual.y_max, 400.0);
}

TEST(Studio, TellsWhatItLoadsToWhoListens) {
  std::vector<std::string> notes;
  Reports reports;
  reports.note = [&](const std::string& line) { notes.push_back(line); };
  const scene::Scene scene = loadScene(boxes().world, reports);
  ASSERT_EQ(notes.size(), 1u);
  EXPECT_NE(notes[0].find(std::to_string(scene.triangleCount()) + " triangles"), std::string::npos)
      << notes[0];
}

/// Prints that are told of before anything is baked, and then what the Studio itself has.
std::vector<std::string> printsOf(StudioOptions options) {
  std::vector<std::string> prints;
  Reports reports;
  reports.loaded = [&](const light::World&, const std::string& print) { prints.push_back(print); };
  reports.baking = [&](double, double) { EXPECT_EQ(prints.size(), 1u); };
  const Studio studio(options, std::nullopt, reports);
  prints.push_back(light::fingerprint(studio.world()));
  return prints;
}

TEST(Studio, TellsWhatItIsAboutToBake) {
  const TemporaryFolder folder;
  StudioOptions options = boxes();
  const std::vector<std::string> open = printsOf(options);
  ASSERT_EQ(open.size(), 2u);
  EXPECT_EQ(open[0], open[1]);
  options.bake.enabled = true;
  options.bake.transport.samples = 1000;
  options.bake.cache_dir = folder.file("cache");
  options.surfaces = {{}, {}};
  options.surfaces[0].wet = 1.0;
  const std::vector<std::string> wet = printsOf(options);
  ASSERT_EQ(wet.size(), 2u);
  EXPECT_EQ(wet[0], wet[1]);
}

TEST(Studio, BakesNothingForWhoRefusesWhatIsLoaded) {
  const TemporaryFolder folder;
  StudioOptions options = boxes();
  options.bake.enabled = true;
  options.bake.cache_dir = folder.file("cache");
  Reports reports;
  reports.loaded = [](const light::World&, const std::string&) { throw std::runtime_error("another world"); };
  reports.baking = [](double, double) { ADD_FAILURE(); };
  EXPECT_EQ(messageOf<std::runtime_error>([&] { Studio studio(options, std::nullopt, reports); }),
            "another world");
}

/// A triangle, and a lamp of each of these groups.
light::World lampsOf(const std::vector<std::string>& groups) {
  auto scene = std::make_shared<scene::Scene>();
  scene->materials.emplace_back();
  scene::Mesh triangle;
  triangle.positions = {{0.0f, 0.0f, 0.0f}, {1.0f, 0.0f, 0.0f}, {0.0f, 1.0f, 0.0f}};
  triangle.normals.assign(3, Eigen::Vector3f::UnitZ());
  triangle.triangles = {{0, 1, 2}};
  scene->meshes.push_back(triangle);
  for (const std::string& group : groups) scene->lamps.emplace_back().group = group;
  return light::World(std::move(scene));
}

/// What a person is told of these groups that are to stay dark: the refusal, or else the warnings.
std::string toldOf(const light::World& world, const std::vector<std::string>& off) {
  light::LampOptions lamps;
  lamps.off = off;
  std::string warnings;
  Reports reports;
  reports.warning = [&](const std::string& line) { warnings += line; };
  const std::string refusal = messageOf([&] { requireGroups(world, lamps, reports); });
  return refusal.empty() ? warnings : refusal;
}

TEST(LampGroups, ThatAreToStayDarkMustBeThere) {
  const light::World street = lampsOf({"post", "sign", "post"});
  EXPECT_EQ(toldOf(street, {}), "");
  EXPECT_EQ(toldOf(street, {"sign", "post"}), "");
  EXPECT_EQ(toldOf(street, {"sign", "poles"}), "lamps_off is poles, but must be one of post, sign");
  EXPECT_EQ(toldOf(lampsOf({}), {"post"}), "lamps_off is post, but must be left out: there are no lamps");
}

TEST(LampGroups, OfABodyCountToo) {
  light::World street = lampsOf({"post"});
  street.lamps_of_bodies = {{}, {scene::Lamp()}};
  street.lamps_of_bodies[1][0].group = "headlight";
  EXPECT_EQ(toldOf(street, {"headlight"}), "");
  EXPECT_EQ(toldOf(street, {"rear"}), "lamps_off is rear, but must be one of headlight, post");
}

TEST(LampGroups, BeyondThoseThatTheBakeTellsApartAreWarnedOfWhereOneIsSwitched) {
  std::vector<std::string> groups;
  for (std::size_t i = 0; i < light::kMostLampSets; ++i) groups.push_back("lamp" + std::to_string(i));
  EXPECT_EQ(toldOf(lampsOf(groups), {"lamp0"}), "");
  groups.push_back("one too many");
  EXPECT_EQ(toldOf(lampsOf(groups), {}), "");
  EXPECT_EQ(
      toldOf(lampsOf(groups), {"lamp0"}),
      "there are 33 groups of lamps: lamps_off switches what surfaces pass on of the light of all but the "
      "first 31 as one, by the share that burns");
}

}  // namespace
}  // namespace sunlit::studio
