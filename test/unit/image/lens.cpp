// Lenses as they were published, against OpenCV's own formulas and on paper.
#include "sunlit/image/lens.h"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/calib3d.hpp>
#ifdef SUNLIT_HAS_OMNIDIR
#include <opencv2/ccalib/omnidir.hpp>
#endif

#include "support/message_of.h"
#include "support/published_lenses.h"

namespace sunlit::image {
namespace {

void expectWords(const std::string& message, const std::vector<std::string>& words) {
  for (const std::string& word : words) EXPECT_NE(message.find(word), std::string::npos) << message;
}

cv::Vec2d byOpenCv(const PublishedLens& lens, const Eigen::Vector3d& point) {
  const PinholeCamera& c = lens.camera;
  const cv::Matx33d k(c.fx, 0, c.cx, 0, c.fy, c.cy, 0, 0, 1);
  const std::vector<cv::Vec3d> points = {{point.x(), point.y(), point.z()}};
  std::vector<cv::Vec2d> pixels;
  const cv::Vec3d none(0, 0, 0);
  std::vector<double> d = lens.distortion.coefficients;
  switch (lens.distortion.model) {
    case LensModel::kEquidistant:
      cv::fisheye::projectPoints(points, pixels, none, none, k, d);
      break;
    case LensModel::kOmni:
#ifdef SUNLIT_HAS_OMNIDIR
      cv::omnidir::projectPoints(points, pixels, none, none, k, d[0],
                                 std::vector<double>(d.begin() + 1, d.end()));
#endif
      break;
    default:
      cv::projectPoints(points, none, none, k, d, pixels);
  }
  return pixels[0];
}

/// Calls `look` for pixels all over the picture and on its very edge.
template <typename Look>
void overThePicture(const PinholeCamera& camera, const Look& look) {
  constexpr int kSteps = 60;
  for (int j = 0; j <= kSteps; ++j) {
    for (int i = 0; i <= kSteps; ++i)
      look(Eigen::Vector2d(-0.5 + i * camera.width / double(kSteps),
                           -0.5 + j * camera.height / double(kSteps)));
  }
}

TEST(Lens, EveryPixelOfPublishedCamerasIsWhereItsOwnRayLies) {
  for (const PublishedLens& published : publishedLenses()) {
    const Lens lens = published.lens();
    overThePicture(published.camera, [&](const Eigen::Vector2d& pixel) {
      const auto ray = lens.unproject(pixel);
      ASSERT_TRUE(ray) << published.name << " at " << pixel.transpose();
      EXPECT_NEAR(lens.wide() ? ray->norm() : ray->z(), 1.0, 1e-12);  // rounding
      const auto back = lens.project(*ray * 3.7);
      ASSERT_TRUE(back) << published.name << " at " << pixel.transpose();
      EXPECT_LT((*back - pixel).norm(), 1e-9) << published.name << " at " << pixel.transpose();
    });
  }
}

TEST(Lens, PointsLieWhereOpenCvHasThem) {
  for (const PublishedLens& published : publishedLenses()) {
    const Lens lens = published.lens();
    overThePicture(published.camera, [&](const Eigen::Vector2d& pixel) {
      const Eigen::Vector3d ray = lens.unproject(pixel).value();
      // OpenCV's fisheye takes x / z and atan of it, which is right before the camera alone.
      if (published.distortion.model == LensModel::kEquidistant && ray.z() < 0.02) return;
#ifndef SUNLIT_HAS_OMNIDIR
      if (published.distortion.model == LensModel::kOmni) return;
#endif
      const cv::Vec2d theirs = byOpenCv(published, ray * 2.0);
      // The same formula in double precision; it loses digits where x / z is large.
      EXPECT_NEAR(theirs[0], pixel.x(), 1e-7) << published.name << " at " << pixel.transpose();
      EXPECT_NEAR(theirs[1], pixel.y(), 1e-7) << published.name << " at " << pixel.transpose();
    });
  }
}

TEST(Lens, WithoutCoefficientsIsThePinhole) {
  const PinholeCamera camera = eurocLens().camera;
  for (const Distortion& none : {Distortion{}, Distortion{LensModel::kPlumbBob, {0, 0, 0, 0}},
                                 Distortion{LensModel::kRationalPolynomial, std::vector<double>(8, 0.0)}}) {
    EXPECT_TRUE(none.none());
    const Lens lens(camera, none);
    EXPECT_FALSE(lens.wide());
    EXPECT_EQ(lens.unproject({10.0, 20.0}).value(), camera.unproject({10.0, 20.0}));
    EXPECT_EQ(lens.project({1.0, 2.0, 4.0}).value(), camera.project({1.0, 2.0, 4.0}));
    EXPECT_DOUBLE_EQ(lens.fold().deg(), 90.0);
  }
  EXPECT_FALSE((Distortion{LensModel::kEquidistant, {0, 0, 0, 0}}.none()));
}

// On paper: r = f θ, so 90° lie at f π / 2 whatever is there.
TEST(Lens, EquidistantWithoutCoefficientsIsTheArc) {
  const Lens lens({1000, 1000, 200.0, 200.0, 500.0, 500.0}, {LensModel::kEquidistant, {0, 0, 0, 0}});
  EXPECT_NEAR(lens.project({1.0, 0.0, 0.0})->x(), 500.0 + 100.0 * kPi, 1e-9);
  EXPECT_NEAR(lens.project({0.0, -5.0, -5.0})->y(), 500.0 - 150.0 * kPi, 1e-9);
  const Eigen::Vector3d back = lens.unproject({500.0 + 200.0, 500.0}).value();
  EXPECT_NEAR(std::atan2(back.x(), back.z()), 1.0, 1e-12);
}

// xi = 1 is the stereographic projection: 2 tan(θ / 2) over 1 + 1.
TEST(Lens, OmniOfXiOneIsStereographic) {
  const Lens lens({1000, 1000, 200.0, 200.0, 500.0, 500.0}, {LensModel::kOmni, {1, 0, 0, 0, 0}});
  for (const double deg : {10.0, 60.0, 90.0, 115.0}) {
    const double theta = deg * kRadPerDeg;
    EXPECT_NEAR(lens.project({std::sin(theta), 0.0, std::cos(theta)})->x(),
                500.0 + 200.0 * std::tan(theta / 2), 1e-9);
  }
}

// The derivative 1 + 3 k1 r² + 5 k2 r⁴ + 7 k3 r⁶ of KITTI's polynomial has its first root at r
// = 1.196, 50.1°.
TEST(Lens, KittisPolynomialFoldsAtFiftyDegreesAndItsPictureEndsBefore) {
  PublishedLens kitti = kittiLens();
  EXPECT_NEAR(kitti.lens().fold().deg(), 50.1, 0.05);
  EXPECT_NEAR(kitti.lens().widest().deg(), 45.1, 0.2);
  // The same lens before a wider sensor shows what does not exist.
  kitti.camera.width = 1900;
  kitti.camera.cx = 950.0;
  expectWords(messageOf([&] { static_cast<void>(kitti.lens().widest()); }),
              {"1900 x 512", "50.1 degrees", "plumb_bob"});
}

TEST(Lens, PublishedPicturesAreAsWideAsTheirAuthorsSay) {
  EXPECT_NEAR(eurocLens().lens().widest().deg(), 53.9, 0.2);
  EXPECT_NEAR(tumViLens().lens().widest().deg(), 115.0, 1.0);
  EXPECT_NEAR(t265Lens().lens().widest().deg(), 120.0, 1.0);
}

// A part of a picture, whose axis passes beside it: both edges lie to the right of it.
TEST(Lens, IsAsWideAsFromEdgeToEdgeWhereverItsAxisIs) {
  const double expected_deg = (std::atan(739.5 / 500.0) - std::atan(99.5 / 500.0)) / kRadPerDeg;  // 44.6
  const PinholeCamera right{640, 480, 500.0, 500.0, -100.0, 239.5},
      left{640, 480, 500.0, 500.0, 739.0, 239.5};
  for (const PinholeCamera& camera : {right, left})
    EXPECT_NEAR(Lens(camera, {}).acrossWidth().deg(), expected_deg, 1e-9);
}

TEST(Lens, RefusesWhatNoModelHas) {
  const PinholeCamera camera = eurocLens().camera;
  const auto refused = [&](LensModel model, std::vector<double> k, const std::vector<std::string>& words) {
    expectWords(messageOf([&] { Lens(camera, {model, std::move(k)}); }), words);
  };
  refused(LensModel::kPlumbBob, {0, 0, 0}, {"3 numbers", "4 or 5", "plumb_bob"});
  refused(LensModel::kRationalPolynomial, {0, 0, 0, 0, 0}, {"5 numbers", "8", "rational_polynomial"});
  refused(LensModel::kEquidistant, {0, 0, 0, 0, 0}, {"5 numbers", "4", "equidistant"});
  refused(LensModel::kOmni, {0, 0, 0, 0}, {"4 numbers", "5, xi", "omni"});
  refused(LensModel::kOmni, {-1, 0, 0, 0, 0}, {"xi", "-1", "at least 0"});
  refused(LensModel::kPlumbBob, {0, 0, std::nan(""), 0}, {"distortion_coefficients", "nan"});
}

}  // namespace
}  // namespace sunlit::image
