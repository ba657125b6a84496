#include "sunlit/evaluate/verify/point_maps.h"

#include <gtest/gtest.h>

#include <limits>

#include "support/message_of.h"
#include "support/temporary_folder.h"

namespace sunlit::evaluate {
namespace {

const PictureSizes kHundreds{{100, 100}, {100, 100}};

Eigen::Matrix3d shift(double x, double y) {
  Eigen::Matrix3d matrix = Eigen::Matrix3d::Identity();
  matrix(0, 2) = x;
  matrix(1, 2) = y;
  return matrix;
}

TEST(HomographyMaps, TakePointsThereAndBack) {
  Eigen::Matrix3d matrix;
  matrix << 0.9, 0.1, 4.0, -0.05, 1.1, -3.0, 1e-3, -2e-3, 1.0;
  const PointMaps maps = homographyMaps(matrix, kHundreds);
  const Eigen::Vector2d point(40.0, 30.0);
  // By hand: (36 + 3 + 4, −2 + 33 − 3) / (0.04 − 0.06 + 1).
  const auto there = maps.b_from_a(point);
  ASSERT_TRUE(there);
  EXPECT_NEAR(there->x(), 43.0 / 0.98, 1e-12);
  EXPECT_NEAR(there->y(), 28.0 / 0.98, 1e-12);
  const auto back = maps.a_from_b(*there);
  ASSERT_TRUE(back);
  EXPECT_NEAR((*back - point).norm(), 0.0, 1e-12);  // rounding of an inverse of condition 1e2
}

TEST(HomographyMaps, EndTheCommonPartAtTheOuterEdgesOfPixels) {
  const PointMaps maps = homographyMaps(shift(3.0, 0.0), kHundreds);
  EXPECT_TRUE(maps.b_from_a({96.25, 0.0}));  // 99.25: the last pixel ends at 99.5
  EXPECT_FALSE(maps.b_from_a({96.5, 0.0}));  // 99.5
  EXPECT_TRUE(maps.a_from_b({2.5, 0.0}));    // −0.5: where the first pixel begins
  EXPECT_FALSE(maps.a_from_b({2.25, 0.0}));  // −0.75
  EXPECT_TRUE(maps.b_from_a({-0.5, -0.5}));  // (2.5, −0.5)
  EXPECT_FALSE(maps.b_from_a({0.0, 99.5}));
}

TEST(HomographyMaps, KeepToTheSizeOfEachPicture) {
  const PointMaps maps = homographyMaps(Eigen::Vector3d(2.0, 2.0, 1.0).asDiagonal(), {{100, 50}, {200, 60}});
  EXPECT_TRUE(maps.b_from_a({99.0, 29.0}));
  EXPECT_FALSE(maps.b_from_a({99.0, 30.0}));  // 60
  EXPECT_TRUE(maps.a_from_b({198.0, 59.0}));
  EXPECT_FALSE(maps.a_from_b({199.0, 59.0}));  // 99.5
}

TEST(HomographyMaps, ShowNothingThatIsBehindTheOtherCamera) {
  Eigen::Matrix3d matrix = Eigen::Matrix3d::Identity();
  matrix(2, 0) = -0.02;  // w = 1 − x / 50
  for (const double scale : {1.0, -7.0}) {
    const PointMaps maps = homographyMaps(scale * matrix, kHundreds);
    const auto seen = maps.b_from_a({20.0, 30.0});
    ASSERT_TRUE(seen) << scale;
    EXPECT_NEAR((*seen - Eigen::Vector2d(20.0, 30.0) / 0.6).norm(), 0.0, 1e-12) << scale;
    EXPECT_FALSE(maps.b_from_a({50.0, 30.0})) << scale;
    EXPECT_FALSE(maps.b_from_a({90.0, -30.0})) << scale;  // (−112, 37)
  }
  // Beyond the line, yet its numbers lie within b: (−60, −12) / −0.8.
  matrix(0, 2) = -150.0;
  matrix(1, 1) = -0.4;
  const PointMaps maps = homographyMaps(matrix, kHundreds);
  EXPECT_FALSE(maps.b_from_a({90.0, 30.0}));
}

TEST(HomographyMaps, RefuseWhatHasNoInverseOrNoSide) {
  Eigen::Matrix3d matrix;
  matrix << 1, 2, 3, 2, 4, 6, 0, 0, 1;
  EXPECT_EQ(messageOf([&] { homographyMaps(matrix, kHundreds); }), "the homography cannot be inverted");
  matrix = Eigen::Matrix3d::Identity();
  matrix(1, 1) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(messageOf([&] { homographyMaps(matrix, kHundreds); }), "the homography cannot be inverted");
  matrix = Eigen::Matrix3d::Identity();
  matrix(2, 0) = -1.0 / 64.0;  // w = 1 − x / 64, and the centre of 129 pixels is 64
  EXPECT_EQ(messageOf([&] {
              homographyMaps(matrix, {{129, 100}, {100, 100}});
            }),
            "the homography moves the centre of the first picture to infinity");
}

TEST(IdentityMaps, LeaveEachPointToTheBit) {
  const PointMaps maps = identityMaps({640, 480});
  const Eigen::Vector2d point(1.0 / 3.0, 479.1);
  EXPECT_EQ(*maps.b_from_a(point), point);
  EXPECT_EQ(*maps.a_from_b(point), point);
}

class HomographyFile : public ::testing::Test {
 protected:
  std::string refusalOf(const std::string& content) const {
    setContent(path(), content);
    const std::string message = messageOf<std::runtime_error>([&] { readHomography(path()); });
    EXPECT_EQ(message.rfind(path(), 0), 0u) << message;
    return message.substr(std::min(message.size(), path().size()));
  }
  std::string path() const { return folder_.file("H.txt"); }

  const TemporaryFolder folder_;
};

TEST_F(HomographyFile, HasThreeLinesOfThreeNumbers) {
  setContent(path(), "# of A into B\n  5.0e-01  -1 2\r\n\n1\t2.5 3\n \n  # 1 2 3\n0 0 1");
  Eigen::Matrix3d expected;
  expected << 0.5, -1, 2, 1, 2.5, 3, 0, 0, 1;
  EXPECT_EQ(readHomography(path()), expected);
}

TEST_F(HomographyFile, IsRefusedByWhatIsWrongAndWhere) {
  const std::string form = "; a homography is three lines of three numbers";
  EXPECT_EQ(refusalOf("1 0 0\n0 1\n0 0 1\n"), ":2: numbers of this line: 2" + form);
  EXPECT_EQ(refusalOf("1 0 0 0 1 0 0 0 1\n"), ":1: numbers of this line: 9" + form);
  EXPECT_EQ(refusalOf("1 0 0\n0 1 0\n"), ": lines with numbers: 2" + form);
  EXPECT_EQ(refusalOf(""), ": lines with numbers: 0" + form);
  EXPECT_EQ(refusalOf("1 0 0\n0 1 0\n0 0 1\n\n1 1 1\n"), ":5: a fourth line" + form);
  EXPECT_EQ(refusalOf("1 0 0\n0 1 0\n0 0 one\n"), ":3: \"one\" is not a number");
  EXPECT_EQ(refusalOf("1 0 0\n0 nan 0\n0 0 1\n"), ":2: nan is not finite");
  EXPECT_EQ(refusalOf("1 2 3\n2 4 6\n0 0 1\n"), ": this homography cannot be inverted");
  const std::string absent = folder_.file("absent.txt");
  EXPECT_EQ(messageOf<std::runtime_error>([&] { readHomography(absent); }),
            absent + ": cannot be read" + form);
  EXPECT_NE(messageOf<std::runtime_error>([&] { readHomography(folder_.path()); }), "");
}

}  // namespace
}  // namespace sunlit::evaluate
