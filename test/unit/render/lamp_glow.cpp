// How lamps glow in fog: beside light that is followed from droplet to droplet, any number of times.
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <random>

#include "sunlit/light/illumination.h"
#include "support/usual_air.h"
#include "test_scenes.h"

namespace sunlit::test {
namespace {

constexpr double kG = sky::kDropletAsymmetry;
constexpr double kFocal_px = 320.0;  // 640 px across 90 degrees

/// Hardly anything: a ground far below.
scene::Scene emptiness() {
  scene::Scene scene;
  addGround(&scene, addMaterial(&scene, Eigen::Array3f::Constant(0.0f)), 1.0f);
  for (Eigen::Vector3f& position : scene.meshes.back().positions) position.z() = -5000.0f;
  return scene;
}

sky::Daylight foggyNight(double visibility_m) {
  sky::Weather weather;
  weather.visibility_m = visibility_m;
  weather.fog_top_m = 3000.0;
  return sky::usualAir().daylight({Direction(Azimuth::degrees(0.0), Angle::degrees(-40.0)), 1.0}, {},
                                  weather);
}

scene::Lamp lampAt(const Eigen::Vector3f& position, float candela) {
  scene::Lamp lamp;
  lamp.position = position;
  lamp.intensity = LinearRgb(Eigen::Array3f::Constant(candela));
  return lamp;
}

scene::Lamp headlight() {
  scene::Lamp lamp = lampAt({0.0f, -1.0f, 0.0f}, 1000.0f);
  lamp.direction = {1.0f, 0.0f, 0.0f};
  lamp.inner_rad = lamp.outer_rad = static_cast<float>(20.0 * kRadPerDeg);
  return lamp;
}

/// At the origin, looking along x.
class LampGlow : public testing::Test {
 protected:
  LampGlow() : renderer_(shared(emptiness()), cameraOptions()) {
    renderer_.look(lookingAt(Eigen::Vector3d::Zero(), Eigen::Vector3d::UnitX()));
  }
  static render::RenderOptions cameraOptions() {
    render::RenderOptions options = smallCamera(640, 480, 90.0);
    options.supersampling = 1;
    return options;
  }
  /// What the lamp adds to the picture.
  static image::LinearImage glow(const render::Renderer& renderer, const scene::Lamp& lamp,
                                 double visibility_m) {
    light::Illumination light(foggyNight(visibility_m));
    image::LinearImage dark = renderer.light(light);
    light.lamps = std::make_shared<const std::vector<scene::Lamp>>(1, lamp);
    image::LinearImage lit = renderer.light(light);
    for (std::size_t i = 0; i < lit.data.size(); ++i) lit.data[i] -= dark.data[i];
    return lit;
  }
  /// Pixel that looks so far to the left.
  static int columnAt(double left_deg) {
    return static_cast<int>(std::lround(319.5 - kFocal_px * std::tan(left_deg * kRadPerDeg)));
  }
  static Eigen::Vector3d rayOf(int x, int y) {
    return Eigen::Vector3d(kFocal_px, 319.5 - x, 239.5 - y).normalized();
  }
  render::Renderer renderer_;
};

/// Light followed backwards from the eye; each droplet is asked what the lamp sends it.
class Walks {
 public:
  Walks(const scene::Lamp& lamp, double visibility_m) : lamp_(lamp), per_m_(2.996 / visibility_m) {}

  double luminance(const Eigen::Vector3d& towards, int count) {
    double sum = 0.0;
    for (int i = 0; i < count; ++i) {
      sum += first(towards);
      sum += later(towards);
    }
    return sum / count;
  }

 private:
  static double phase(double c) {
    return (1.0 - kG * kG) / (4.0 * kPi * std::pow(1.0 + kG * kG - 2.0 * kG * c, 1.5));
  }
  double uniform() { return std::generate_canonical<double, 53>(random_); }

  /// Luminance that leaves `point` back along `way`, for each droplet there.
  double lampLight(const Eigen::Vector3d& point, const Eigen::Vector3d& way) const {
    const Eigen::Vector3d from_lamp = point - lamp_.position.cast<double>();
    // Droplets closer than this are left to the first order: their 1 / r² makes noise alone.
    const double r = std::max(from_lamp.norm(), 0.3);
    const Eigen::Vector3d out = from_lamp.normalized();
    if (lamp_.isSpot() && out.dot(lamp_.direction.cast<double>()) < std::cos(lamp_.outer_rad)) return 0.0;
    return lamp_.intensity.value[1] * phase(-out.dot(way)) * std::exp(-per_m_ * r) / (r * r);
  }
  /// Scattered once, by points at even angles from the lamp.
  double first(const Eigen::Vector3d& way) {
    const double nearest = way.dot(lamp_.position.cast<double>());
    const double beside = (lamp_.position.cast<double>() - nearest * way).norm();
    const double from = std::atan(-nearest / beside), to = 0.5 * kPi - 1e-4;
    const double angle = from + uniform() * (to - from);
    const double s = nearest + beside * std::tan(angle);
    const Eigen::Vector3d point = s * way, from_lamp = point - lamp_.position.cast<double>();
    const Eigen::Vector3d out = from_lamp.normalized();
    if (lamp_.isSpot() && out.dot(lamp_.direction.cast<double>()) < std::cos(lamp_.outer_rad)) return 0.0;
    return lamp_.intensity.value[1] * phase(-out.dot(way)) * per_m_ *
           std::exp(-per_m_ * (s + from_lamp.norm())) * (to - from) / beside;
  }
  double later(Eigen::Vector3d way) {
    constexpr int kOrders = 30;
    Eigen::Vector3d point = Eigen::Vector3d::Zero();
    double sum = 0.0;
    for (int order = 1; order <= kOrders; ++order) {
      point += way * (-std::log(1.0 - uniform()) / per_m_);
      if (order > 1) sum += lampLight(point, way);
      const double u = uniform(), part = (1.0 - kG * kG) / (1.0 - kG + 2.0 * kG * u);
      const double c = (1.0 + kG * kG - part * part) / (2.0 * kG), turn = 2.0 * kPi * uniform();
      const Eigen::Vector3d across = way.unitOrthogonal(), up = way.cross(across);
      way =
          (c * way + std::sqrt(std::max(0.0, 1.0 - c * c)) * (std::cos(turn) * across + std::sin(turn) * up))
              .normalized();
    }
    return sum;
  }

  scene::Lamp lamp_;
  double per_m_;
  std::mt19937_64 random_{7};
};

TEST_F(LampGlow, IsThatOfLightThatIsScatteredAnyNumberOfTimes) {
  struct Case {
    double visibility_m;
    float away_m;
    double tolerance;
  };
  // Single scattering with less extinction is a model: within a sixth at 0.4 optical depths, within two
  // fifths at 1.2; and 40,000 walks are within 3 %.
  for (const Case& row : {Case{150.0, 20.0f, 0.17}, Case{150.0, 60.0f, 0.4}}) {
    const scene::Lamp lamp = lampAt({row.away_m, 0.0f, 0.0f}, 1000.0f);
    const image::LinearImage picture = glow(renderer_, lamp, row.visibility_m);
    Walks walks(lamp, row.visibility_m);
    for (const double left_deg : {1.0, 2.0, 5.0, 15.0}) {
      const int x = columnAt(left_deg);
      const double traced = walks.luminance(rayOf(x, 240), 40000);
      EXPECT_NEAR(*picture.at(x, 240) / traced, 1.0, row.tolerance + 0.03) << row.away_m << " " << left_deg;
    }
  }
}

TEST_F(LampGlow, OfHeadlightsIsWhatComesBackFromTheFogBeforeThem) {
  for (const double visibility_m : {50.0, 150.0}) {
    const image::LinearImage picture = glow(renderer_, headlight(), visibility_m);
    Walks walks(headlight(), visibility_m);
    // Light that leaves the beam and comes back to the eye is not in the model: little, but in thick fog.
    const double tolerance = visibility_m < 100.0 ? 0.25 : 0.15;
    for (const double left_deg : {-10.0, 10.0}) {
      const int x = columnAt(left_deg);
      EXPECT_NEAR(*picture.at(x, 240) / walks.luminance(rayOf(x, 240), 200000), 1.0, tolerance + 0.03)
          << visibility_m << " " << left_deg;
    }
  }
}

/// The model itself, in many small steps.
double modelled(const scene::Lamp& lamp, const Eigen::Vector3d& way, double visibility_m, double end_m) {
  const double per_m = 2.996 / visibility_m;
  const Eigen::Vector3d at = lamp.position.cast<double>();
  const double nearest = way.dot(at), beside = (at - nearest * way).norm();
  const double angle_deg = std::atan2(beside, nearest) / kRadPerDeg;
  const double k = per_m * std::max(1.0 - kG * kG, 1.0 / (1.0 + angle_deg / 5.0));
  constexpr int kSteps = 2000;
  const double from = std::atan(-nearest / beside), to = std::atan((end_m - nearest) / beside);
  double sum = 0.0;
  for (int i = 0; i < kSteps; ++i) {
    const double s = nearest + beside * std::tan(from + (to - from) * (i + 0.5) / kSteps);
    const Eigen::Vector3d away = s * way - at;
    if (lamp.isSpot() && away.normalized().dot(lamp.direction.cast<double>()) < std::cos(lamp.outer_rad))
      continue;
    const double c = -away.normalized().dot(way);
    sum += std::exp(-k * (s + away.norm())) / std::pow(1.0 + kG * kG - 2.0 * kG * c, 1.5);
  }
  return lamp.intensity.value[1] * per_m * (1.0 - kG * kG) / (4.0 * kPi) * sum * (to - from) / kSteps /
         beside;
}

TEST_F(LampGlow, IsEvenWhereCellsAndTilesMeet) {
  const scene::Lamp lamp = lampAt({30.0f, 4.0f, 3.0f}, 1000.0f);
  const image::LinearImage picture = glow(renderer_, lamp, 150.0);
  double worst = 0.0;
  for (int y = 100; y < 480; y += 7) {
    for (int x = 100; x < 640; x += 5) {
      const double exact = modelled(lamp, rayOf(x, y), 150.0, 400.0);
      worst = std::max(worst, std::abs(*picture.at(x, y) / exact - 1.0));
    }
  }
  // 3 % between corners, and steps of 0.2 rad.
  EXPECT_LT(worst, 0.04);
}

TEST_F(LampGlow, OfAConeEndsSharplyAtItsEdge) {
  // A street lamp's sharp cone, seen from beside it: straight edges down both of its flanks.
  scene::Lamp lamp = lampAt({30.0f, 4.0f, 8.0f}, 1000.0f);
  lamp.direction = Eigen::Vector3f(0.1f, -0.2f, -1.0f).normalized();
  lamp.inner_rad = lamp.outer_rad = static_cast<float>(35.0 * kRadPerDeg);
  const image::LinearImage picture = glow(renderer_, lamp, 150.0);
  double most = 0.0, worst = 0.0;
  for (int y = 100; y < 480; y += 3) {
    for (int x = 100; x < 640; x += 3) {
      const double exact = modelled(lamp, rayOf(x, y), 150.0, 400.0);
      most = std::max(most, exact);
      worst = std::max(worst, std::abs(*picture.at(x, y) - exact) / std::max(exact, 0.05 * most));
    }
  }
  // As of lamps without one.
  EXPECT_LT(worst, 0.04);
}

TEST_F(LampGlow, IsSeenFromAboveAsFromWhereOneLooksIntoTheFog) {
  sky::Weather weather;
  weather.visibility_m = 50.0;
  weather.fog_top_m = 30.0;
  const sky::Daylight night =
      sky::usualAir().daylight({Direction(Azimuth::degrees(0.0), Angle::degrees(-40.0)), 1.0}, {}, weather);
  const auto glowFrom = [&](const Eigen::Isometry3d& map_from_optical) {
    renderer_.look(map_from_optical);
    light::Illumination light(night);
    const image::LinearImage dark = renderer_.light(light);
    light.lamps = std::make_shared<const std::vector<scene::Lamp>>(1, lampAt({0.0f, 0.0f, 15.0f}, 1000.0f));
    const image::LinearImage lit = renderer_.light(light);
    return static_cast<double>(*lit.at(330, 240) - *dark.at(330, 240));
  };
  // Straight down beside a lamp; the same ray begins for the one eye where it enters the fog for the other.
  Eigen::Isometry3d from_above = lookingAt({1.0, 0.0, 130.0}, {1.0, 0.0, 0.0}), from_top = from_above;
  const Eigen::Vector3d ray = from_above.linear() * Eigen::Vector3d(10.5, 0.5, kFocal_px);
  from_top.translation() += 100.0 / -ray.z() * ray;
  const double there = glowFrom(from_top);
  EXPECT_GT(there, 0.0);
  EXPECT_NEAR(glowFrom(from_above) / there, 1.0, 0.04);  // what cells and tiles differ by
}

TEST_F(LampGlow, EndsAtWhatIsInTheWayAndCastsShadowsIntoTheFog) {
  // A wall at 10 m across the whole picture, a lamp 10 m behind it, and one before it.
  scene::Scene scene = emptiness();
  addBlock(&scene, 0, {10.0f, -60.0f, -60.0f}, {0.5f, 120.0f, 120.0f});
  render::Renderer renderer(shared(scene), cameraOptions());
  renderer.look(lookingAt(Eigen::Vector3d::Zero(), Eigen::Vector3d::UnitX()));
  scene::Lamp behind = lampAt({20.0f, 0.0f, 0.0f}, 1000.0f);
  const float shaded = *glow(renderer, behind, 150.0).at(200, 240);
  behind.casts_shadows = false;
  const float open = *glow(renderer, behind, 150.0).at(200, 240);
  EXPECT_LT(shaded, 0.02f * open);
  const Eigen::Vector3d way = rayOf(200, 240);
  EXPECT_NEAR(open / modelled(behind, way, 150.0, 10.0 / way.x()), 1.0, 0.06);
  const scene::Lamp before = lampAt({7.0f, 1.0f, 0.0f}, 1000.0f);
  const Eigen::Vector3d down = rayOf(330, 400);
  // The wall is black, but not without gloss: what it sends without fog comes through that.
  const double wall_m = 10.0 / down.x();
  light::Illumination clear(daylightAt(0.0, -40.0));
  const double unlit = *renderer.light(clear).at(330, 400);
  clear.lamps = std::make_shared<const std::vector<scene::Lamp>>(1, before);
  const double through = (*renderer.light(clear).at(330, 400) - unlit) * std::exp(-2.996 / 150.0 * wall_m);
  EXPECT_NEAR((*glow(renderer, before, 150.0).at(330, 400) - through) / modelled(before, down, 150.0, wall_m),
              1.0, 0.04);
}

TEST_F(LampGlow, OfLampsCloseBehindWhatHidesThemEndsAtItsEdgeFromWhereverOneLooks) {
  // A board that reaches 1.5 m above the eye, its lamp 1 m behind it: somewhere in the one slice of the fog
  // that both lie in.
  scene::Scene scene = emptiness();
  addBlock(&scene, 0, {15.0f, -6.0f, -6.0f}, {0.2f, 12.0f, 7.5f});
  render::Renderer renderer(shared(scene), cameraOptions());
  scene::Lamp lamp = lampAt({16.0f, 0.0f, 0.0f}, 1000.0f);
  for (const double x : {0.0, 0.5, 1.0, 1.5, 2.0, 3.0}) {
    renderer.look(lookingAt({x, 0.0, 0.0}, {x + 1.0, 0.0, 0.0}));
    const image::LinearImage picture = glow(renderer, lamp, 100.0);
    const int edge = static_cast<int>(239.5 - kFocal_px * 1.5 / (15.0 - x));
    const float beside = *picture.at(320, edge - 4);
    EXPECT_GT(beside, 0.0f);
    // The board's front is black and unlit, and the fog before it sees no more than what shines over it.
    for (int y = edge + 3; y < 300; ++y) EXPECT_LT(*picture.at(320, y), 0.1f * beside) << x << " " << y;
    EXPECT_LT(*picture.at(320, 240), 0.01f * beside) << x;
  }
}

TEST_F(LampGlow, IsNotThereWithoutFogAndTheSameForAnyThreads) {
  light::Illumination clear(daylightAt(0.0, -40.0));
  const image::LinearImage dark = renderer_.light(clear);
  clear.lamps = std::make_shared<const std::vector<scene::Lamp>>(1, lampAt({20.0f, 0.0f, 0.0f}, 1000.0f));
  EXPECT_EQ(renderer_.light(clear).data, dark.data);
  const image::LinearImage many = glow(renderer_, lampAt({20.0f, 3.0f, 0.0f}, 1000.0f), 150.0);
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, 1);
  EXPECT_EQ(glow(renderer_, lampAt({20.0f, 3.0f, 0.0f}, 1000.0f), 150.0).data, many.data);
}

}  // namespace
}  // namespace sunlit::test
