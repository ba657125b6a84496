// The sun, matches and what the builtin rasterizer sees have the same bits on every machine: these hashes
// were seen on x86-64, by its vector instructions, and on arm64, by plain loops (scripts/build_arm64).
#include <gnu/libc-version.h>
#include <gtest/gtest.h>

#include <opencv2/core.hpp>
#include <random>

#include "rasterizer_scenes.h"
#include "sunlit/astronomy/civil_time.h"
#include "sunlit/astronomy/sun_position.h"
#include "sunlit/evaluate/features/matching.h"
#include "sunlit/image/content_hash.h"

namespace sunlit::test {
namespace {

/// Numbers below `end`; distributions of the standard library may differ between machines.
class Random {
 public:
  int below(int end) { return static_cast<int>(engine_() % static_cast<unsigned>(end)); }

 private:
  std::mt19937 engine_{1};
};

/// 10,000 of them, one in some 2.2 h, over two and a half years.
std::vector<astronomy::SunPosition> suns() {
  std::vector<Instant> instants;
  const Instant first = astronomy::instantOf({2024, 7, 1, 4, 0, 0.0, 3.0});
  for (int i = 0; i < 10000; ++i) instants.push_back(first.plusSeconds(7919.0 * i));
  const Site track{Angle::degrees(55.792115), Angle::degrees(49.122254), 90.0};
  return astronomy::sunPositions(instants, {0.0, 69.184}, track, {});
}

/// Sines and their like differ in their last bit between C libraries, and on x86-64 between processors that
/// fuse multiplication and addition and those that do not.
bool roundsAsWhereSeen() {
#if defined(__x86_64__)
  const bool fuses = __builtin_cpu_supports("fma");
#else
  const bool fuses = true;
#endif
  return fuses && std::string(gnu_get_libc_version()) == "2.36";
}

TEST(AnyMachine, SeesTheSunAtTheSamePlaces) {
  if (!roundsAsWhereSeen()) GTEST_SKIP() << "the C library rounds otherwise, or is not known to round alike";
  image::ContentHash hash;
  for (const astronomy::SunPosition& sun : suns()) {
    hash.add(sun.azimuth.rad());
    hash.add(sun.elevation.rad());
    hash.add(sun.elevation_geometric.rad());
    hash.add(sun.right_ascension.rad());
    hash.add(sun.declination.rad());
  }
  EXPECT_EQ(hash.text(), "b1d3e25ddb8b440fc77d8f975179a99e");
}

/// Of numbers whose product is not one of Scalar. A product that went unrounded into a sum would leave a
/// rest.
template <typename Scalar>
void expectNoRest() {
  const Scalar a = Scalar(1) / Scalar(3), b = Scalar(1) / Scalar(7);
  Eigen::Matrix<Scalar, 4, 4> differences;
  differences << a, -a, 0, 0, 0, a, -a, 0, 0, 0, a, -a, -a, 0, 0, a;
  const Eigen::Matrix<Scalar, 4, 1> even = Eigen::Matrix<Scalar, 4, 1>::Constant(b);
  EXPECT_EQ((differences * even).eval(), (Eigen::Matrix<Scalar, 4, 1>::Zero()));
  const Eigen::Matrix<Scalar, 4, 4> all_even = even.replicate(1, 4);
  EXPECT_EQ((differences * all_even).eval(), (Eigen::Matrix<Scalar, 4, 4>::Zero()));
  Eigen::Transform<Scalar, 3, Eigen::Isometry> pose(differences);
  EXPECT_EQ((pose * even.template head<3>()).eval()[0], Scalar(0));
}

/// The first to the sum of the others.
TEST(AnyMachine, AddsUpThreeFloatsInOneOrder) {
  const Eigen::Vector3f ones = Eigen::Vector3f::Ones();
  EXPECT_EQ(Eigen::Vector3f(1.0f, 1e9f, -1e9f).dot(ones), 1.0f);
  EXPECT_EQ(Eigen::Vector3f(1e9f, 1.0f, -1e9f).dot(ones), 0.0f);
  Eigen::Matrix3f rows;
  rows << 1.0f, 1e9f, -1e9f, 1.0f, 1e9f, -1e9f, 1.0f, 1e9f, -1e9f;
  EXPECT_EQ((rows * ones).eval(), ones);
}

TEST(AnyMachine, RoundsProductsBeforeItAddsThem) {
  expectNoRest<float>();
  expectNoRest<double>();
}

void add(const std::vector<evaluate::Neighbours>& found, bool with_distances, image::ContentHash* hash) {
  for (const evaluate::Neighbours& neighbours : found) {
    hash->add(neighbours.best);
    if (!with_distances) continue;
    hash->add(neighbours.best_distance);
    hash->add(neighbours.second_distance);
  }
}

/// Of two sets of random descriptors, both ways. Values are whole numbers times `step`.
template <typename Value>
std::string hashOfNearest(int width, double step, int norm) {
  Random random;
  cv::Mat sets[2];
  for (int i = 0; i < 2; ++i) {
    sets[i].create(701 - 90 * i, width, cv::DataType<Value>::type);
    for (Value& value : cv::Mat_<Value>(sets[i])) value = static_cast<Value>(step * random.below(256));
  }
  const evaluate::BothWays found = evaluate::twoNearestBothWays(sets[0], sets[1], norm);
  EXPECT_EQ(found.from_a.size(), 701u);
  EXPECT_EQ(found.from_b.size(), 611u);
  image::ContentHash hash;
  // Distances of fractions are summed up by OpenCV, in an order that hangs on the processor.
  add(found.from_a, step == 1.0, &hash);
  add(found.from_b, step == 1.0, &hash);
  return hash.text();
}

TEST(AnyMachine, FindsTheSameNearestNeighbours) {
  const std::string like_sift = hashOfNearest<float>(128, 1.0, cv::NORM_L2);
  EXPECT_EQ(like_sift, "4e2e30e734cfe32f9892063ee61270fe");
  const std::string like_surf = hashOfNearest<float>(64, 0.01 / 3.0, cv::NORM_L2);
  EXPECT_EQ(like_surf, "0ffefa8a731fb95aba06a2841a5287c3");
  const std::string like_orb = hashOfNearest<std::uint8_t>(32, 1.0, cv::NORM_HAMMING);
  EXPECT_EQ(like_orb, "bdf1ef5a3744ee573f3464654b95c2da");
  const std::string like_akaze = hashOfNearest<std::uint8_t>(61, 1.0, cv::NORM_HAMMING);
  EXPECT_EQ(like_akaze, "6cd705c318de48acf1f75020a907ec2e");
}

/// Triangles of all sizes that cut through each other, some with leaves cut out, on ground.
scene::Scene thicket() {
  Random random;
  scene::Scene scene;
  scene::Texture leaves{"leaves", 64, 64, {}};
  for (int i = 0; i < 4 * 64 * 64; ++i)
    leaves.rgba.own().push_back(static_cast<std::uint8_t>(random.below(256)));
  scene.textures.push_back(leaves);
  const int plain = addMaterial(&scene, {0.5f, 0.5f, 0.5f});
  const int cut_out = addMaterial(&scene, {0.5f, 0.5f, 0.5f});
  scene.materials[1].base_texture = 0;
  scene.materials[1].alpha_mode = scene::AlphaMode::kMask;
  addGround(&scene, plain, 100.0f);
  const auto within = [&random](float reach) {
    return reach * (static_cast<float>(random.below(2001)) / 1000.0f - 1.0f);
  };
  for (int i = 0; i < 400; ++i) {
    // In braces: calls among parentheses come in an order that compilers choose.
    const Eigen::Vector3f low{within(30.0f), within(30.0f), 2.0f + within(2.0f)};
    addBlock(&scene, i % 3 == 0 ? cut_out : plain, low,
             {2.1f + within(2.0f), 2.1f + within(2.0f), 3.1f + within(3.0f)});
  }
  return scene;
}

TEST(AnyMachine, SeesTheSameTriangles) {
  const Drawable drawable(thicket());
  const auto rasterizer = drawable.by(render::RasterizerKind::kBuiltin);
  image::ContentHash hash;
  std::vector<render::Sample> samples;
  for (const double x : {-40.0, -7.0, 0.5, 12.0}) {
    render::View view = viewFrom(lookingAt({x, -20.0, 2.5}, {3.0, 4.0, 1.0}), 320, 240);
    view.camera.fx = view.camera.fy = 250.0;
    rasterizer->draw(view, nullptr, &samples);
    EXPECT_EQ(samples.size(), 4u * 320u * 240u);
    for (const render::Sample& sample : samples) {
      hash.add(sample.triangle);
      hash.add(sample.depth);
    }
  }
  EXPECT_EQ(hash.text(), "152cb8a86868aa6f42dfbaeabd984238");
}

}  // namespace
}  // namespace sunlit::test
