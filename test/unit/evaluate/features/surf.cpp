// What must hold of SURF by its definition, without any reference implementation.
#include "sunlit/evaluate/features/surf.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <opencv2/imgproc.hpp>
#include <stdexcept>

#include "support/message_of.h"
#include "unit/evaluate/features/surf_picture.h"

// The same sources without vector clones, under another name for the outer namespace: see surf_tests.cmake.
namespace sunlit_plain::evaluate {
struct SurfOptions : sunlit::evaluate::SurfOptions {};  // the same members in the same order
cv::Ptr<cv::Feature2D> createSurf(const SurfOptions& options);
}  // namespace sunlit_plain::evaluate

namespace sunlit::evaluate {
namespace {

struct Features {
  std::vector<cv::KeyPoint> points;
  cv::Mat descriptors;
};

Features featuresOf(const cv::Mat& image, const SurfOptions& options = {}, const cv::Mat& mask = {}) {
  Features f;
  createSurf(options)->detectAndCompute(image, mask, f.points, f.descriptors);
  return f;
}

cv::Mat1b blob(cv::Size size, cv::Point2d centre, double sigma, double height = 100) {
  cv::Mat1b image(size);
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      const double r2 = std::pow(x - centre.x, 2) + std::pow(y - centre.y, 2);
      image(y, x) = cv::saturate_cast<std::uint8_t>(100 + height * std::exp(-r2 / (2 * sigma * sigma)));
    }
  }
  return image;
}

double angleBetween(double a_deg, double b_deg) {
  return std::abs(std::remainder(a_deg - b_deg, 360));
}

bool sameBits(const Features& a, const Features& b) {
  if (a.points.size() != b.points.size() || a.descriptors.size() != b.descriptors.size()) return false;
  for (std::size_t k = 0; k < a.points.size(); ++k) {
    const cv::KeyPoint &p = a.points[k], &q = b.points[k];
    if (p.pt != q.pt || p.size != q.size || p.angle != q.angle || p.response != q.response ||
        p.octave != q.octave || p.class_id != q.class_id) {
      return false;
    }
  }
  return a.descriptors.empty() || cv::norm(a.descriptors, b.descriptors, cv::NORM_INF) == 0;
}

// Pencil and paper: at the centre of a Gaussian blob Dxy is 0 and Dxx = Dyy, and the mean of the blob over a
// box is a product of error functions. The filter side for which Dxx is greatest follows by trying all.
double bestSideForBlob(double sigma) {
  const auto integral = [&](double a, double b) {
    return std::erf(b / (std::sqrt(2.0) * sigma)) - std::erf(a / (std::sqrt(2.0) * sigma));
  };
  double best_side = 0, best = 0;
  for (double side = 9; side < 400; side += 0.1) {
    const double ninth = side / 9;
    const double lobes = integral(-4.5 * ninth, 4.5 * ninth) - 3 * integral(-1.5 * ninth, 1.5 * ninth);
    const double dxx = std::abs(lobes) * integral(-2.5 * ninth, 2.5 * ninth) / (15 * ninth * ninth);
    if (dxx <= best) continue;
    best = dxx;
    best_side = side;
  }
  return best_side;
}

TEST(Surf, FindsAGaussianBlobAtItsCentreAndScale) {
  for (const double sigma : {2.5, 4.0, 6.0, 9.0, 14.0}) {
    const cv::Point2d centre(150.3, 120.6);
    const auto found = featuresOf(blob({300, 240}, centre, sigma));
    ASSERT_FALSE(found.points.empty()) << sigma;
    const cv::KeyPoint& strongest = found.points.front();
    // One Newton step on samples up to 4 px apart: a tenth of sigma.
    EXPECT_LT(cv::norm(cv::Point2d(strongest.pt) - centre), 0.1 * sigma) << sigma;
    // A quadratic through sizes that are a third apart; ninths and the result are rounded to whole pixels.
    const double expected = bestSideForBlob(sigma);
    EXPECT_NEAR(strongest.size, expected, 0.1 * expected + 1) << sigma;
  }
}

TEST(Surf, TellsBrightBlobsFromDarkOnes) {
  EXPECT_EQ(featuresOf(blob({120, 120}, {60, 60}, 4, 100)).points.at(0).class_id, -1);
  EXPECT_EQ(featuresOf(blob({120, 120}, {60, 60}, 4, -90)).points.at(0).class_id, 1);
}

TEST(Surf, ResponseIsTheSquareOfContrast) {
  const auto weak = featuresOf(blob({120, 120}, {60, 60}, 4, 50)).points.at(0);
  const auto strong = featuresOf(blob({120, 120}, {60, 60}, 4, 150)).points.at(0);
  // Grey levels are whole numbers: up to half a level in fifty at every pixel, which the filter averages.
  EXPECT_NEAR(strong.response / weak.response, 9, 0.2);
}

TEST(Surf, NegativeHasTheSamePointsTurnedAbout) {
  const cv::Mat picture = test::madePicture(320, 240);
  const auto a = featuresOf(picture);
  const auto b = featuresOf(255 - picture);
  ASSERT_EQ(a.points.size(), b.points.size());
  ASSERT_GT(a.points.size(), 100u);
  for (std::size_t k = 0; k < a.points.size(); ++k) {
    // Every box filter changes its sign exactly.
    ASSERT_EQ(a.points[k].pt, b.points[k].pt);
    ASSERT_EQ(a.points[k].size, b.points[k].size);
    ASSERT_EQ(a.points[k].response, b.points[k].response);
    ASSERT_EQ(a.points[k].class_id, -b.points[k].class_id);
  }
}

TEST(Surf, TurnsWithThePicture) {
  const cv::Mat picture = test::madePicture(320, 240);
  cv::Mat turned;
  cv::rotate(picture, turned, cv::ROTATE_90_CLOCKWISE);
  SurfOptions options;
  options.octaves = 1;  // coarser sampling grids do not map onto themselves
  const auto a = featuresOf(picture, options);
  const auto b = featuresOf(turned, options);
  ASSERT_EQ(a.points.size(), b.points.size());
  int same = 0;
  for (std::size_t k = 0; k < a.points.size(); ++k) {
    const cv::Point2f expected(static_cast<float>(picture.rows) - 1 - a.points[k].pt.y, a.points[k].pt.x);
    for (std::size_t m = 0; m < b.points.size(); ++m) {
      // Single precision at 320 px; one degree since angles are binned to whole degrees.
      if (cv::norm(b.points[m].pt - expected) > 1e-3 || b.points[m].size != a.points[k].size) continue;
      if (angleBetween(b.points[m].angle, a.points[k].angle + 90) > 1) continue;
      // Grey levels of the patch are rounded after turning: some differ by one.
      same += cv::norm(a.descriptors.row(static_cast<int>(k)), b.descriptors.row(static_cast<int>(m))) < 0.1;
    }
  }
  // Wavelets of the orientation sit between pixels, so halves are rounded to the other side in the turned
  // picture, and a few points with two nearly equal directions choose the other one.
  EXPECT_GE(same, static_cast<int>(0.9 * static_cast<double>(a.points.size())));
}

TEST(Surf, GrowsWithThePicture) {
  for (const double sigma : {3.0, 6.0}) {
    const auto small = featuresOf(blob({200, 200}, {99.3, 99.3}, sigma)).points.at(0);
    const auto large = featuresOf(blob({400, 400}, {199.1, 199.1}, 2 * sigma)).points.at(0);
    EXPECT_NEAR(large.size / small.size, 2, 0.2);  // sizes are rounded to whole pixels, of 20 to 90
  }
}

TEST(Surf, DescriptorsHaveUnitLength) {
  for (const bool extended : {false, true}) {
    SurfOptions options;
    options.extended = extended;
    const auto f = featuresOf(test::madePicture(200, 150), options);
    ASSERT_EQ(f.descriptors.cols, extended ? 128 : 64);
    ASSERT_EQ(f.descriptors.rows, static_cast<int>(f.points.size()));
    for (int k = 0; k < f.descriptors.rows; ++k) EXPECT_NEAR(cv::norm(f.descriptors.row(k)), 1, 1e-5);
  }
}

TEST(Surf, SortsByResponseAboveTheThreshold) {
  SurfOptions options;
  options.hessian_threshold = 500;
  const auto f = featuresOf(test::madePicture(320, 240), options);
  ASSERT_GT(f.points.size(), 10u);
  for (std::size_t k = 0; k < f.points.size(); ++k) {
    EXPECT_GT(f.points[k].response, 500);
    if (k > 0) {
      EXPECT_LE(f.points[k].response, f.points[k - 1].response);
    }
  }
  options.hessian_threshold = 100;
  EXPECT_GT(featuresOf(test::madePicture(320, 240), options).points.size(), f.points.size());
}

TEST(Surf, UprightPointsHaveNoOrientation) {
  SurfOptions options;
  options.upright = true;
  for (const auto& point : featuresOf(test::madePicture(200, 150), options).points)
    EXPECT_EQ(point.angle, 270);
}

TEST(Surf, KeepsToTheMask) {
  const cv::Mat picture = test::madePicture(320, 240);
  cv::Mat mask = cv::Mat::zeros(picture.size(), CV_8U);
  mask(cv::Rect(80, 60, 160, 120)) = 1;
  const auto masked = featuresOf(picture, {}, mask);
  EXPECT_LT(masked.points.size(), featuresOf(picture).points.size());
  EXPECT_GT(masked.points.size(), 20u);
  for (const auto& point : masked.points) EXPECT_NE(mask.at<std::uint8_t>(cv::Point(point.pt)), 0);
  EXPECT_TRUE(featuresOf(picture, {}, cv::Mat::zeros(picture.size(), CV_8U)).points.empty());
  EXPECT_TRUE(sameBits(featuresOf(picture, {}, cv::Mat::ones(picture.size(), CV_8U)), featuresOf(picture)));
}

TEST(Surf, FlatAndTinyPicturesHaveNoPoints) {
  EXPECT_TRUE(featuresOf(cv::Mat(240, 320, CV_8U, cv::Scalar(77))).points.empty());
  for (const int side : {1, 2, 9, 20, 27, 28, 30}) {
    EXPECT_TRUE(featuresOf(cv::Mat(side, side, CV_8U, cv::Scalar(77))).points.empty()) << side;
    const auto tiny = featuresOf(test::madePicture(side, side));
    EXPECT_EQ(tiny.descriptors.rows, static_cast<int>(tiny.points.size())) << side;
    const auto flat_and_long = featuresOf(test::madePicture(200, side));
    EXPECT_EQ(flat_and_long.descriptors.rows, static_cast<int>(flat_and_long.points.size())) << side;
  }
}

TEST(Surf, DescribesGivenPointsWhereverTheyLie) {
  const cv::Mat picture = test::madePicture(160, 120);
  std::vector<cv::KeyPoint> points;
  for (const float size : {4.0f, 9.0f, 40.0f}) {
    points.emplace_back(80.0f, 60.0f, size);
    points.emplace_back(1.0f, 1.0f, size);
    points.emplace_back(158.0f, 118.0f, size);
  }
  points.emplace_back(80.0f, 60.0f, 2000.0f);  // a wavelet larger than the image
  points.emplace_back(-500.0f, 60.0f, 9.0f);   // too far out for any wavelet
  cv::Mat descriptors;
  createSurf()->detectAndCompute(picture, cv::noArray(), points, descriptors, true);
  EXPECT_EQ(points.size(), 9u);
  EXPECT_EQ(descriptors.rows, 9);
}

TEST(Surf, TakesColourByItsGrey) {
  cv::Mat bgr, grey;
  const cv::Mat p = test::madePicture(200, 150);
  cv::merge(std::vector<cv::Mat>{p, 255 - p, p / 2}, bgr);
  cv::cvtColor(bgr, grey, cv::COLOR_BGR2GRAY);
  EXPECT_TRUE(sameBits(featuresOf(bgr), featuresOf(grey)));
}

TEST(Surf, RefusesWhatOpenCvRefuses) {
  const auto surf = createSurf();
  std::vector<cv::KeyPoint> points;
  cv::Mat descriptors;
  const cv::Mat good = test::madePicture(60, 60);
  EXPECT_THROW(surf->detect(cv::Mat(60, 60, CV_32F, cv::Scalar(0)), points), cv::Exception);
  EXPECT_THROW(surf->detect(cv::Mat(60, 60, CV_8UC2, cv::Scalar(0)), points), cv::Exception);
  EXPECT_THROW(surf->detect(good, points, cv::Mat(10, 10, CV_8U, cv::Scalar(1))), cv::Exception);
  EXPECT_THROW(surf->detect(good, points, cv::Mat(60, 60, CV_32S, cv::Scalar(1))), cv::Exception);
  EXPECT_THROW(surf->detectAndCompute(cv::Mat(), cv::noArray(), points, descriptors), cv::Exception);
  EXPECT_THROW(surf->detectAndCompute(good, cv::noArray(), points, cv::noArray(), true), cv::Exception);
}

TEST(Surf, RefusesOptionsOutOfRangeByName) {
  const auto messageOf = [](const SurfOptions& options) {
    return sunlit::messageOf([&] { createSurf(options); });
  };
  SurfOptions bad;
  bad.hessian_threshold = -1;
  EXPECT_EQ(messageOf(bad), "hessian_threshold is -1, but must be from 0 to 1000000");
  bad = {};
  bad.octaves = 0;
  EXPECT_EQ(messageOf(bad), "n_octaves is 0, but must be from 1 to 8");
  bad = {};
  bad.octave_layers = 17;
  EXPECT_EQ(messageOf(bad), "n_octave_layers is 17, but must be from 1 to 16");
  bad = {};
  bad.hessian_threshold = std::nan("");
  EXPECT_NE(messageOf(bad), "");
}

TEST(Surf, IsTheSameForAnyNumberOfThreads) {
  const cv::Mat picture = test::madePicture(320, 240);
  const auto with_threads = [&](std::size_t threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    return featuresOf(picture);
  };
  const auto one = with_threads(1);
  ASSERT_GT(one.points.size(), 100u);
  for (const std::size_t threads : {2, 3, 8}) EXPECT_TRUE(sameBits(one, with_threads(threads))) << threads;
}

TEST(Surf, PlainLoopsGiveTheSameBits) {
  const cv::Mat picture = test::madePicture(320, 240);
  Features plain;
  sunlit_plain::evaluate::createSurf({})->detectAndCompute(picture, cv::noArray(), plain.points,
                                                           plain.descriptors);
  EXPECT_TRUE(sameBits(plain, featuresOf(picture)));
}

}  // namespace
}  // namespace sunlit::evaluate
