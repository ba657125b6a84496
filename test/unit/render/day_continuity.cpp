// Pictures of one place from one moment to the next, over a day and a night.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "sunlit/astronomy/civil_time.h"
#include "sunlit/image/exposure.h"
#include "sunlit/light/transport.h"
#include "sunlit/studio/sky.h"
#include "test_scenes.h"

namespace sunlit::test {
namespace {

constexpr double kStep_s = 10.0;

/// At the equator sun and moon rise and set fastest, 15° an hour. A full moon rises as this day ends.
const Site kSite{Angle::degrees(0.0), Angle::degrees(0.0), 0.0};
const astronomy::CivilDate kDay{2024, 3, 25, 0.0};

class Day {
 public:
  sky::Daylight at(double time_s, const sky::Weather& weather = {}) {
    const studio::SkyBodies bodies = studio::bodiesAt(midnight_.plusSeconds(time_s), kSite);
    return sky::usualAir().daylight(bodies.sun, {bodies.moon, bodies.map_from_celestial, stars_}, weather);
  }

 private:
  Instant midnight_ = astronomy::midnightOf(kDay);
  std::shared_ptr<const std::vector<sky::Star>> stars_ = studio::loadStars({});
};

/// Striped ground, walls to all sides, a gap under a roof, a slender post: light from everywhere and shadows
/// that sweep.
scene::Scene yard() {
  scene::Scene scene;
  // Stripes of all shades: where many values lie around the median, it does not leap across a gap between
  // two.
  constexpr int kStripes = 60;
  for (int i = 0; i < kStripes; ++i) {
    const float shade = 0.3f + 1.4f * static_cast<float>(i * 23 % kStripes) / kStripes;
    const int stripe = addMaterial(&scene, shade * Eigen::Array3f(0.2f, 0.22f, 0.12f));
    addPatch(&scene, stripe, {-15.0f + 0.5f * static_cast<float>(i), -5.0f, 0.0f}, {0.5f, 0.0f, 0.0f},
             {0.0f, 35.0f, 0.0f});
  }
  const int wall = addMaterial(&scene, {0.55f, 0.5f, 0.42f});
  addBlock(&scene, wall, {-2.0f, 6.0f, 0.0f}, {3.0f, 3.0f, 2.5f});
  addBlock(&scene, wall, {3.0f, 5.0f, 2.0f}, {3.0f, 4.0f, 0.3f});
  addBlock(&scene, addMaterial(&scene, {0.1f, 0.12f, 0.3f}), {-5.0f, 4.0f, 0.0f}, {1.0f, 1.0f, 1.0f});
  addBlock(&scene, addMaterial(&scene, {0.4f, 0.1f, 0.08f}), {1.9f, 4.0f, 0.0f}, {0.2f, 0.2f, 3.0f});
  return scene;
}

struct Statistic {
  std::string name;
  double value = 0.0;
};

/// Natural logarithms of mean, median and standard deviation of each channel of the light, of the exposure,
/// and means of the 8-bit picture in levels.
struct Statistics {
  std::vector<Statistic> logarithms;
  std::array<double, 3> levels{};
};

Statistics statisticsOf(const image::LinearImage& picture) {
  Statistics result;
  const std::size_t pixels = picture.data.size() / 3;
  const double ev100 = image::chooseEv100(picture, image::ExposureOptions{});
  const image::Rgb8Image developed = image::develop(picture, ev100);
  for (std::size_t c = 0; c < 3; ++c) {
    std::vector<double> values(pixels);
    double sum = 0.0, squares = 0.0, levels = 0.0;
    for (std::size_t i = 0; i < pixels; ++i) {
      values[i] = static_cast<double>(picture.data[3 * i + c]);
      sum += values[i];
      squares += values[i] * values[i];
      levels += developed.data[3 * i + c];
    }
    const double n = static_cast<double>(pixels), mean = sum / n;
    std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(pixels / 2), values.end());
    const std::string channel = std::string(" of channel ") + "rgb"[c];
    result.logarithms.push_back({"mean" + channel, std::log(mean)});
    result.logarithms.push_back({"median" + channel, std::log(values[pixels / 2])});
    result.logarithms.push_back({"deviation" + channel, 0.5 * std::log(squares / n - mean * mean)});
    result.levels[c] = levels / n;
  }
  result.logarithms.push_back({"exposure", ev100 * std::log(2.0)});
  return result;
}

constexpr double kHour_s = 3600.0;

/// Moments one after another, kStep_s apart.
std::vector<double> stretch(double from_s, double to_s) {
  std::vector<double> times_s;
  for (double time_s = from_s; time_s < to_s; time_s += kStep_s) times_s.push_back(time_s);
  return times_s;
}

class DayOfPictures : public testing::Test {
 protected:
  /// What all cases look at, which takes seconds to prepare.
  struct View {
    View() : world(baked()), renderer(world, smallCamera(64, 48, 70.0)) {
      // To the north: sun and moon stay out of view here, and what they light is in it. Most of it is ground,
      // so that the median is one of its many shades at any hour.
      renderer.look(lookingAt({0.0, 0.0, 2.0}, {0.3, 10.0, -1.0}));
    }
    static light::World baked() {
      light::World world(shared(yard()));
      light::TransportOptions options;
      options.samples = 4000;
      world.transport = light::Transport::bake(world.geometry, options);
      return world;
    }

    Day day;
    light::World world;
    render::Renderer renderer;
  };
  static void SetUpTestSuite() { view_ = std::make_unique<View>(); }
  static void TearDownTestSuite() { view_.reset(); }

  static Day& day() { return view_->day; }
  static Statistics at(double time_s) { return of(day().at(time_s)); }
  static Statistics of(const sky::Daylight& light) {
    return statisticsOf(view_->renderer.light(light::illumination(view_->world, light)));
  }

  // In twilight a step's change itself goes from 3 to 5.6 % over 70 steps, less than a thousandth each; the
  // rest is how the sky's tables are interpolated. A jump, of whatever cause, would bend each statistic by
  // its size.
  static constexpr double kMostBend = 0.01;

  /// No statistic of three pictures in a row changes faster than light does.
  void expectSteady(const std::array<Statistics, 3>& seen, double time_s,
                    double most_bend = kMostBend) const {
    // At most the whole twilight falls by a factor of 3.5 a degree (it is 3.3 from -4° to -6° in the tables
    // of Janiczek & DeYoung 1987), and a red or blue channel a tenth faster: 5.7 % in the 0.042° of 10 s.
    constexpr double kFastest = 0.065;
    // Auto exposure takes most of each change: what is left to the picture is less than a level.
    constexpr double kMostLevels = 1.0;
    for (std::size_t i = 0; i < seen[0].logarithms.size(); ++i) {
      const auto value = [&](std::size_t k) { return seen[k].logarithms[i].value; };
      EXPECT_LT(std::abs(value(2) - value(1)), kFastest)
          << seen[0].logarithms[i].name << " at " << time_s << " s";
      EXPECT_LT(std::abs(value(2) - 2.0 * value(1) + value(0)), most_bend)
          << seen[0].logarithms[i].name << " at " << time_s << " s";
    }
    for (std::size_t c = 0; c < 3; ++c)
      EXPECT_LT(std::abs(seen[2].levels[c] - seen[1].levels[c]), kMostLevels)
          << "channel " << c << " at " << time_s;
  }
  void expectSteady(const std::vector<double>& times_s) {
    std::array<Statistics, 3> seen;
    for (std::size_t k = 0; k < times_s.size(); ++k) {
      seen = {seen[1], seen[2], at(times_s[k])};
      if (k >= 2) expectSteady(seen, times_s[k]);
    }
  }

  inline static std::unique_ptr<View> view_;
};

TEST_F(DayOfPictures, NothingJumpsThroughDawnAndSunrise) {
  // The sun rises from 18.6° below the horizon, where its light is first added to the night's, to 1.5° above,
  // in steps of 10 s; the full moon sets meanwhile.
  expectSteady(stretch(4.85 * kHour_s, 6.2 * kHour_s));
}

TEST_F(DayOfPictures, NothingJumpsThroughSunset) {
  // From 1.5° above to 1.5° below the horizon.
  expectSteady(stretch(18.0 * kHour_s, 18.2 * kHour_s));
}

TEST_F(DayOfPictures, NothingJumpsInBetween) {
  // Three pictures in a row every 40 minutes: the moon goes over, and so do the stars, and shadows turn.
  for (double time_s = 0.0; time_s < 24.0 * kHour_s; time_s += 2.0 / 3.0 * kHour_s)
    expectSteady(stretch(time_s, time_s + 2.5 * kStep_s));
}

/// Four oktas that a west wind of 10 m/s moves, as they are at that time of day.
sky::Weather clouds(double time_s) {
  sky::Weather weather;
  weather.cover_oktas = 4.0;
  weather.wind_m_per_s = 10.0;
  weather.clock_s = time_s;
  return weather;
}

/// Logarithms of the illuminance of open ground, all over what is in view.
std::vector<double> groundLight(const sky::Daylight& day) {
  const double sun = static_cast<double>(day.sun().illuminance.luminance()) * day.sun().towards.vector().z();
  const auto sky = static_cast<double>(day.skyIlluminance(Eigen::Vector3f::UnitZ()).luminance());
  std::vector<double> light;
  for (float y = -5.0f; y <= 40.0f; y += 5.0f) {
    for (float x = -20.0f; x <= 20.0f; x += 5.0f)
      light.push_back(std::log(sun * static_cast<double>(day.throughCloud(day.sun(), {x, y, 0.0f})) + sky));
  }
  return light;
}

/// The largest of the differences between two lists.
double apart(const std::vector<double>& a, const std::vector<double>& b) {
  double most = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) most = std::max(most, std::abs(a[i] - b[i]));
  return most;
}

// In these 80 seconds a gap comes and goes: its edges take 8 s each to cross the yard.
constexpr double kGap_s = 9.0 * kHour_s;

TEST_F(DayOfPictures, FromSecondToSecondNoPictureChangesMoreThanACloudsEdgeSweeps) {
  Statistics before;
  std::vector<double> ground_before;
  double darkest = 1e9, brightest = -1e9;
  for (double time_s = kGap_s; time_s < kGap_s + 80.0; time_s += 1.0) {
    const sky::Daylight now = day().at(time_s, clouds(time_s));
    const Statistics seen = of(now);
    const std::vector<double> ground = groundLight(now);
    const double mean = seen.logarithms[0].value;
    darkest = std::min(darkest, mean);
    brightest = std::max(brightest, mean);
    for (std::size_t i = 0; i < before.logarithms.size(); ++i) {
      // Light of the sky, in which other clouds stand by now, changes by half a percent; and the grid misses
      // what is between its places.
      EXPECT_LT(std::abs(seen.logarithms[i].value - before.logarithms[i].value),
                apart(ground, ground_before) + 0.015)
          << seen.logarithms[i].name << " at " << time_s - kGap_s << " s";
    }
    before = seen;
    ground_before = ground;
  }
  EXPECT_GT(brightest - darkest, 0.4);  // or there was no edge
}

TEST_F(DayOfPictures, NothingJumpsAsTheEdgeOfACloudsShadowGoesOver) {
  // A metre of wind a picture, where the edge is some 20 m wide. The rate changes as its slope does; that of
  // the median most, while half of the picture is lit: measured up to 0.018.
  constexpr double kEdgeBend = 0.025;
  std::array<Statistics, 3> seen;
  double first = 0.0;
  for (int k = 0; k < 40; ++k) {
    const double time_s = kGap_s + 69.5 + 0.1 * k;
    seen = {seen[1], seen[2], of(day().at(time_s, clouds(time_s)))};
    if (k == 0) first = seen[2].logarithms[0].value;
    if (k >= 2) expectSteady(seen, time_s, kEdgeBend);
  }
  EXPECT_LT(seen[2].logarithms[0].value, first - 0.3);  // or there was no edge
}

}  // namespace
}  // namespace sunlit::test
