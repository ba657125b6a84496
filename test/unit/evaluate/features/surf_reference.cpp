// SURF beside OpenCV's own, by numbers that OpenCV's gave (test/golden/README.md) on a made picture and on
// real ones.
#include <gtest/gtest.h>

#include <fstream>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <sstream>

#include "sunlit/evaluate/features/surf.h"
#include "unit/evaluate/features/surf_picture.h"

namespace sunlit::evaluate {
namespace {

struct Features {
  std::vector<cv::KeyPoint> points;
  cv::Mat descriptors;
};

Features featuresOf(const cv::Mat& image) {
  Features f;
  createSurf()->detectAndCompute(image, cv::noArray(), f.points, f.descriptors);
  return f;
}

Features readGolden(const std::string& path) {
  std::ifstream file(path);
  if (!file) throw std::runtime_error("cannot read " + path);
  Features golden;
  std::string line;
  std::getline(file, line);  // names
  while (std::getline(file, line)) {
    std::istringstream numbers(line);
    cv::KeyPoint p;
    numbers >> p.pt.x >> p.pt.y >> p.size >> p.angle >> p.response >> p.octave >> p.class_id;
    cv::Mat1f row(1, 64);
    for (float& value : row) numbers >> value;
    if (!numbers)
      throw std::runtime_error(path + ": malformed line " + std::to_string(golden.points.size() + 2));
    golden.points.push_back(p);
    golden.descriptors.push_back(row);
  }
  return golden;
}

TEST(SurfReference, AgreesPointByPointOnAMadePicture) {
  const auto golden = readGolden(SUNLIT_SOURCE_DIR "/test/golden/surf_made_picture.txt");
  const auto ours = featuresOf(test::madePicture(144, 108));
  ASSERT_GT(golden.points.size(), 50u);
  ASSERT_EQ(ours.points.size(), golden.points.size());
  for (std::size_t k = 0; k < golden.points.size(); ++k) {
    const cv::KeyPoint &g = golden.points[k], &o = ours.points[k];
    // OpenCV adds boxes in single precision: parts in 1e6 of the response, which the quadratic's curvature
    // magnifies.
    EXPECT_NEAR(o.response, g.response, 1e-4f * g.response) << k;
    EXPECT_LT(cv::norm(o.pt - g.pt), 2e-3) << k;
    EXPECT_EQ(o.size, g.size) << k;
    EXPECT_NEAR(std::remainder(o.angle - g.angle, 360.0f), 0, 1e-2) << k;
    EXPECT_EQ(o.octave, g.octave) << k;
    EXPECT_EQ(o.class_id, g.class_id) << k;
    // A grey level of the 441 of a patch that rounds the other way moves a unit vector by about a hundredth.
    EXPECT_LT(
        cv::norm(ours.descriptors.row(static_cast<int>(k)), golden.descriptors.row(static_cast<int>(k))),
        0.02)
        << k;
  }
}

// Accepted by Lowe's ratio test, strict, at 0.5.
int matches(const Features& a, const Features& b) {
  std::vector<std::vector<cv::DMatch>> nearest;
  cv::BFMatcher(cv::NORM_L2).knnMatch(a.descriptors, b.descriptors, nearest, 2);
  int accepted = 0;
  for (const auto& two : nearest) accepted += two.size() == 2 && two[0].distance < 0.5f * two[1].distance;
  return accepted;
}

double difference(const Features& a, const Features& b) {
  const double matched = matches(a, b);
  const double total = static_cast<double>(a.points.size() + b.points.size()) - matched;
  return (total - matched) / total;
}

struct LeuvenRow {
  const char* other;
  int points, matches;
  double difference, reverse;
};

TEST(SurfReference, AgreesOnRealPhotographsUnderFallingLight) {
  const std::string folder = SUNLIT_SHARED_DIR "/data/leuven/";
  const cv::Mat first = cv::imread(folder + "img1.ppm");
  if (first.empty()) GTEST_SKIP() << "no photographs in " << folder;
  const auto a = featuresOf(first);
  // OpenCV's own counts. Descriptors that differ by a rounded grey level may move a match across the ratio: 1
  // %.
  EXPECT_NEAR(static_cast<double>(a.points.size()), 5111, 2);
  for (const LeuvenRow& row : {LeuvenRow{"img2.ppm", 4360, 1493, 0.8129, 0.8166},
                               LeuvenRow{"img6.ppm", 2221, 238, 0.9665, 0.9734}}) {
    const auto b = featuresOf(cv::imread(folder + row.other));
    EXPECT_NEAR(static_cast<double>(b.points.size()), row.points, 2) << row.other;
    EXPECT_NEAR(matches(a, b), row.matches, 0.01 * row.matches) << row.other;
    EXPECT_NEAR(difference(a, b), row.difference, 0.002) << row.other;
    EXPECT_NEAR(difference(b, a), row.reverse, 0.002) << row.other;
  }
}

}  // namespace
}  // namespace sunlit::evaluate
