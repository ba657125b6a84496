// What a camera sees that moves while its rows see, one after another, and for some time.
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>
#include <vector>

#include "render/image_motion.h"
#include "test_scenes.h"

namespace sunlit::test {
namespace {

using render::Renderer;
using render::UnderWay;

constexpr double kWall_m = 5.0;

/// A wall before the camera at the origin that looks east, dark on its left and bright on its right.
scene::Scene halves() {
  scene::Scene scene;
  for (const float side : {1.0f, -1.0f}) {
    scene::Material glows;
    glows.name = side > 0.0f ? "dark" : "bright";
    glows.base_color = LinearRgb(Eigen::Array3f::Constant(0.0f));
    glows.emission = LinearRgb(Eigen::Array3f::Constant(side > 0.0f ? 1.0f : 1000.0f));
    scene.materials.push_back(glows);
    scene::Mesh mesh;
    mesh.name = glows.name;
    mesh.material = static_cast<int>(scene.materials.size()) - 1;
    const auto x = static_cast<float>(kWall_m);
    mesh.positions = {
        {x, 0.0f, -20.0f}, {x, 20.0f * side, -20.0f}, {x, 20.0f * side, 20.0f}, {x, 0.0f, 20.0f}};
    mesh.normals.assign(4, Eigen::Vector3f(-1.0f, 0.0f, 0.0f));
    if (side > 0.0f)
      mesh.triangles = {{0, 2, 1}, {0, 3, 2}};
    else
      mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
    scene.meshes.push_back(mesh);
  }
  return scene;
}

Eigen::Isometry3d eastward() {
  return lookingAt(Eigen::Vector3d::Zero(), Eigen::Vector3d::UnitX());
}

render::RenderOptions camera(int supersampling = 4) {
  render::RenderOptions options = smallCamera(320, 240);
  options.supersampling = supersampling;
  return options;
}

/// Where in a row dark becomes bright, px: what is missing of the brightness all through the row.
double edgeOf(const image::LinearImage& picture, int row) {
  const double dark = *picture.at(0, row), bright = *picture.at(picture.width - 1, row);
  double light = 0.0;
  for (int x = 0; x < picture.width; ++x) light += *picture.at(x, row);
  return picture.width - 0.5 - (light - dark * picture.width) / (bright - dark);
}

UnderWay turning(double deg_s, double line_delay_s) {
  UnderWay way;
  way.motion.turning_rad_s = {0.0, 0.0, deg_s * kRadPerDeg};
  way.line_delay_s = line_delay_s;
  return way;
}

UnderWay driving(const Eigen::Vector3d& velocity_m_s, double line_delay_s, double exposure_s = 0.0) {
  UnderWay way;
  way.motion.velocity_m_s = velocity_m_s;
  way.line_delay_s = line_delay_s;
  way.exposure_s = exposure_s;
  return way;
}

/// All that lights is what glows.
sky::Daylight nightfall() {
  return daylightAt(180.0, -18.0);
}

TEST(UnderWay, WithoutMotionOrWithoutTimeItIsTheSamePictureToTheBit) {
  Renderer renderer(shared(halves()), camera());
  renderer.look(eastward());
  const light::Illumination light(nightfall());
  const image::LinearImage still = renderer.light(light);
  EXPECT_EQ(renderer.light(light, 0, UnderWay()).data, still.data);
  EXPECT_EQ(renderer.light(light, 0, driving({5.0, 0.0, 0.0}, 0.0)).data, still.data);
  EXPECT_EQ(renderer.light(light, 0, driving(Eigen::Vector3d::Zero(), 5e-5, 0.03)).data, still.data);
}

TEST(UnderWay, ACameraThatTurnsSeesRowsTurnedByTheTimeBetweenThem) {
  // 60°/s over a readout of 30 ms, as in a telephone: 1.8° from the first row to the last. To the left the
  // camera turns, to the right go the edges: f tan(ω δ r).
  const double line_delay_s = 0.03 / 240;
  Renderer renderer(shared(halves()), camera());
  renderer.look(eastward());
  const light::Illumination light(nightfall());
  const image::LinearImage still = renderer.light(light);
  const image::LinearImage rolled = renderer.light(light, 0, turning(60.0, line_delay_s));
  const double f = camera().camera.fx;
  for (int row = 0; row < 240; row += 13) {
    const double skew = f * std::tan(60.0 * kRadPerDeg * line_delay_s * row);
    // Rows of a band see at one moment: an eighth of a pixel; and samples lie a quarter of one apart.
    EXPECT_NEAR(edgeOf(rolled, row) - edgeOf(still, row), skew, 0.125 + 0.125) << row;
  }
}

TEST(UnderWay, ACameraThatDrivesSeesWhatIsNearSkewed) {
  // f v δ r / Z, to the left of where it goes: 10 m/s to the north, 5 m before the wall.
  const double line_delay_s = 4e-5;
  Renderer renderer(shared(halves()), camera());
  renderer.look(eastward());
  const light::Illumination light(nightfall());
  const image::LinearImage still = renderer.light(light);
  const image::LinearImage rolled = renderer.light(light, 0, driving({0.0, 10.0, 0.0}, line_delay_s));
  for (int row = 0; row < 240; row += 13) {
    const double skew = camera().camera.fx * 10.0 * line_delay_s * row / kWall_m;
    EXPECT_NEAR(edgeOf(rolled, row) - edgeOf(still, row), skew, 0.125 + 0.125) << row;
  }
}

/// All that is there but the sky: 1.7 px of the 320 of `camera()`, from top to bottom.
scene::Scene post() {
  scene::Scene scene = halves();
  scene.meshes.erase(scene.meshes.begin());
  for (Eigen::Vector3f& position : scene.meshes.front().positions)
    position.y() = std::max(position.y(), -0.03f);
  return scene;
}

/// Where a row's light is in the mean, px.
double middleOf(const image::LinearImage& picture, int row) {
  double light = 0.0, moment = 0.0;
  for (int x = 0; x < picture.width; ++x) light += *picture.at(x, row), moment += *picture.at(x, row) * x;
  return moment / light;
}

TEST(UnderWay, APostBeforeTheSkyIsSkewedAndSmearedThoughMostOfThePictureStands) {
  const double line_delay_s = 4e-5, exposure_s = 0.02;
  Renderer renderer(shared(post()), camera());
  renderer.look(eastward());
  const light::Illumination light(nightfall());
  const Eigen::Vector3d northward(0.0, 10.0, 0.0);
  const image::LinearImage still = renderer.light(light);
  const image::LinearImage rolled = renderer.light(light, 0, driving(northward, line_delay_s));
  for (int row = 0; row < 240; row += 13) {
    const double skew = camera().camera.fx * 10.0 * line_delay_s * row / kWall_m;
    EXPECT_NEAR(middleOf(rolled, row) - middleOf(still, row), skew, 0.125 + 0.125) << row;
  }
  const UnderWay smeared = driving(northward, 0.0, exposure_s);
  EXPECT_EQ(renderer.exposures(smeared), 12);
  const auto lit = [](const image::LinearImage& picture) {
    int count = 0;
    for (int x = 0; x < picture.width; ++x) count += *picture.at(x, 120) > 1.0f ? 1 : 0;
    return count;
  };
  // 11.1 px of smear, of which half a twelfth is before the first picture's moment and behind the last one's.
  EXPECT_NEAR(lit(renderer.light(light, 0, smeared)) - lit(still), 11.1 * 11 / 12, 1.0);
}

TEST(UnderWay, WhatMovesIsSmearedEvenlyOverTheExposure) {
  // f v T / Z = 277 · 10 · 0.02 / 5 = 11.1 px: a ramp of that length about where the edge is sharp.
  Renderer renderer(shared(halves()), camera());
  renderer.look(eastward());
  const light::Illumination light(nightfall());
  const image::LinearImage still = renderer.light(light);
  const UnderWay way = driving({0.0, 10.0, 0.0}, 0.0, 0.02);
  EXPECT_EQ(renderer.exposures(way), 12);
  const image::LinearImage smeared = renderer.light(light, 0, way);
  const double length = camera().camera.fx * 10.0 * 0.02 / kWall_m;
  constexpr int kRow = 120;
  // No light is lost: the middle of the ramp stays where the edge was.
  EXPECT_NEAR(edgeOf(smeared, kRow), edgeOf(still, kRow), 0.05);
  const double dark = *still.at(0, kRow), bright = *still.at(319, kRow);
  for (int x = 140; x < 180; ++x) {
    const double along = std::clamp((x - edgeOf(still, kRow)) / length + 0.5, 0.0, 1.0);
    // Twelve steps, each of a pixel, where the ramp has none.
    EXPECT_NEAR((*smeared.at(x, kRow) - dark) / (bright - dark), along, 0.6 / 12) << x;
  }
}

TEST(UnderWay, EachBandIsWhatACameraSeesThatStandsThere) {
  // Also of what penumbras, mirrors and edges make: a band is not a picture of its own.
  const scene::Scene scene = yard();
  const Eigen::Isometry3d pose = lookingAt({-4.0, -6.0, 1.5}, {4.0, 2.0, 1.0});
  const light::Illumination light(daylightAt(140.0, 35.0));
  const std::vector<render::RenderOptions> cameras = [] {
    std::vector<render::RenderOptions> all = {camera(2)};
    all.push_back(all.front());
    all.back().distortion.coefficients = {-0.28, 0.07, 2e-4, 2e-5, 0.0};
    return all;
  }();
  for (const render::RenderOptions& options : cameras) {
    Renderer renderer(shared(yard()), options);
    renderer.look(pose);
    const UnderWay way = turning(60.0, 0.03 / 240);  // 8 px of skew: 64 bands of 4 rows
    const image::LinearImage rolled = renderer.light(light, 0, way);
    Renderer standing(shared(scene), options);
    for (const int first : {0, 4, 120, 236}) {
      const double moment_s = (first + 1.5) * way.line_delay_s;
      standing.look(way.motion.after(moment_s, pose.translation()) * pose);
      const image::LinearImage still = standing.light(light);
      double worst = 0.0, mean = 0.0;
      for (int row = first; row < first + 4; ++row) {
        for (int x = 0; x < still.width; ++x) {
          const double off =
              std::abs(*rolled.at(x, row) - *still.at(x, row)) / static_cast<double>(*still.at(x, row));
          worst = std::max(worst, off);
          mean += off / (4.0 * still.width);
        }
      }
      // Samples at the very edge of a triangle may fall to either side by rounding, and rows of points on the
      // sun's disc begin anew in each band.
      EXPECT_LT(mean, 2e-3) << first << " " << options.distortion.none() << " worst " << worst;
    }
  }
}

TEST(UnderWay, BandsBeforeALensAreAlikeWhateverTheHeight) {
  // 126 rows in 31 bands: not one of them of a single row, which has no next one to tell directions by.
  render::RenderOptions options = smallCamera(160, 126);
  options.distortion.coefficients = {-0.28, 0.07, 2e-4, 2e-5, 0.0};
  const Eigen::Isometry3d pose = lookingAt({-4.0, -6.0, 1.5}, {4.0, 2.0, 1.0});
  const light::Illumination light(daylightAt(140.0, 35.0));
  Renderer renderer(shared(yard()), options), standing(shared(yard()), options);
  renderer.look(pose);
  const UnderWay way = turning(120.0, 0.03 / 126);
  const image::LinearImage rolled = renderer.light(light, 0, way);
  constexpr int kFirst = 30 * 126 / 31;
  standing.look(way.motion.after((kFirst + 2) * way.line_delay_s, pose.translation()) * pose);
  const image::LinearImage still = standing.light(light);
  double off = 0.0;
  for (int row = kFirst; row < 126; ++row)
    for (int x = 0; x < still.width; ++x)
      off += std::abs(*rolled.at(x, row) / *still.at(x, row) - 1.0f) / (5.0 * still.width);
  EXPECT_LT(off, 4e-3);
}

TEST(UnderWay, ExposuresLookAroundTheirPixelsEvenly) {
  const image::PinholeCamera camera = smallCamera(64, 48).camera;
  for (int exposures = 1; exposures <= 40; ++exposures) {
    double x = 0.0, y = 0.0;
    std::set<double> different;
    for (int i = 0; i < exposures; ++i) {
      const image::PinholeCamera aside = render::shifted(camera, render::patternOf(i, exposures));
      x += aside.cx - camera.cx;
      y += aside.cy - camera.cy;
      EXPECT_LT(std::max(std::abs(aside.cx - camera.cx), std::abs(aside.cy - camera.cy)), 0.5);
      different.insert(aside.cx);
    }
    EXPECT_LT(std::max(std::abs(x), std::abs(y)), 1e-9) << exposures;  // whole pairs, whatever their number
    EXPECT_EQ(different.size(), static_cast<std::size_t>(std::min(exposures, 16 + exposures % 2)));
  }
}

TEST(UnderWay, AManyTimesExposedPictureIsTheMeanOfWhatStandingCamerasSee) {
  const Eigen::Isometry3d pose = lookingAt({-4.0, -6.0, 1.5}, {4.0, 2.0, 1.0});
  const light::Illumination light(daylightAt(140.0, 35.0));
  Renderer renderer(shared(yard()), camera(2));
  renderer.look(pose);
  const UnderWay way = driving({0.0, 6.0, 0.0}, 0.0, 0.05);
  const int exposures = renderer.exposures(way);
  EXPECT_EQ(exposures, 16);
  const image::LinearImage smeared = renderer.light(light, 0, way);
  Renderer standing(shared(yard()), camera(4));
  std::vector<double> mean(smeared.data.size(), 0.0);
  for (int i = 0; i < exposures; ++i) {
    const double moment_s = ((i + 0.5) / exposures - 0.5) * way.exposure_s;
    standing.look(way.motion.after(moment_s, pose.translation()) * pose);
    const image::LinearImage still = standing.light(light);
    for (std::size_t k = 0; k < mean.size(); ++k) mean[k] += static_cast<double>(still.data[k]) / exposures;
  }
  double off = 0.0, sum = 0.0, light_sum = 0.0;
  for (std::size_t k = 0; k < mean.size(); ++k) {
    off += std::abs(static_cast<double>(smeared.data[k]) / mean[k] - 1.0) / static_cast<double>(mean.size());
    sum += smeared.data[k];
    light_sum += mean[k];
  }
  // One sample a pixel each time, where the others have sixteen: what differs is at edges, and even about it.
  EXPECT_LT(off, 0.01);
  EXPECT_NEAR(sum / light_sum, 1.0, 0.001);
}

TEST(UnderWay, HasTheSameBitsWhateverWasSeenBeforeAndForAnyThreads) {
  const Eigen::Isometry3d pose = lookingAt({-4.0, -6.0, 1.5}, {4.0, 2.0, 1.0});
  const light::Illumination light(daylightAt(140.0, 35.0));
  UnderWay way = driving({3.0, 2.0, 0.0}, 5e-5, 0.01);
  way.motion.turning_rad_s = {0.1, 0.0, 0.5};
  const auto taken = [&](int threads, bool has_looked_around) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                    static_cast<std::size_t>(threads));
    Renderer renderer(shared(yard()), camera(2));
    if (has_looked_around) {
      renderer.look(eastward());
      static_cast<void>(renderer.light(light, 0, turning(90.0, 1e-4)));
    }
    renderer.look(pose);
    if (has_looked_around) renderer.lookAhead(eastward());
    return renderer.light(light, 0, way).data;
  };
  const std::vector<float> first = taken(1, false);
  EXPECT_EQ(taken(4, true), first);
}

TEST(UnderWay, LeavesAloneWhatLookLooksAt) {
  Renderer renderer(shared(yard()), camera(2));
  renderer.look(lookingAt({-4.0, -6.0, 1.5}, {4.0, 2.0, 1.0}));
  const light::Illumination light(daylightAt(140.0, 35.0));
  const image::LinearImage still = renderer.light(light);
  const image::DepthImage depth = renderer.depth();
  static_cast<void>(renderer.light(light, 0, driving({5.0, 0.0, 0.0}, 5e-5, 0.02)));
  EXPECT_EQ(renderer.light(light).data, still.data);
  const image::DepthImage after = renderer.depth();
  EXPECT_TRUE(std::equal(depth.data.begin(), depth.data.end(), after.data.begin(),
                         [](float a, float b) { return a == b || (std::isnan(a) && std::isnan(b)); }));
}

// Exposures look up to half a pixel aside: of a picture that reaches as far as a camera may see, beyond that.
TEST(UnderWay, SmearsPicturesThatReachTheirLensesEnd) {
  render::RenderOptions options;
  options.camera = {306, 306, 100.0, 100.0, 152.5, 152.5};  // 153 √2 / 100 rad are 123.97°, of 124
  options.distortion = {image::LensModel::kEquidistant, {0.0, 0.0, 0.0, 0.0}};
  options.supersampling = 1;
  Renderer renderer(shared(halves()), options);
  renderer.look(eastward());
  const light::Illumination light(nightfall());
  const UnderWay way = driving({0.0, 10.0, 0.0}, 0.0, 0.02);
  EXPECT_GT(renderer.exposures(way), 1);
  const image::LinearImage smeared = renderer.light(light, 0, way);
  EXPECT_GT(*smeared.at(300, 153), *smeared.at(5, 153));
}

}  // namespace
}  // namespace sunlit::test
