// Alignments that can be worked out on paper, random ones, and those that nothing decides.
#include "sunlit/evaluate/trajectory/alignment.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "sunlit/quantity/angle.h"
#include "support/message_of.h"

namespace sunlit::evaluate {
namespace {

using Points = std::vector<Eigen::Vector3d>;

Trajectory at(const Points& positions) {
  Trajectory trajectory;
  for (const Eigen::Vector3d& position : positions) {
    trajectory.emplace_back();
    trajectory.back().position = position;
  }
  return trajectory;
}

Points imageOf(const Points& points, const Similarity& similarity) {
  Points image;
  for (const Eigen::Vector3d& point : points) image.push_back(similarity * point);
  return image;
}

Similarity align(Alignment alignment, const Points& estimate, const Points& truth) {
  return truthFromEstimate(alignment, {at(truth), at(estimate)});
}

double sumOfSquares(const Similarity& similarity, const Points& estimate, const Points& truth) {
  double sum = 0.0;
  for (std::size_t i = 0; i < truth.size(); ++i) sum += (similarity * estimate[i] - truth[i]).squaredNorm();
  return sum;
}

Eigen::Vector3d meanOf(const Points& points) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& point : points) sum += point;
  return sum / static_cast<double>(points.size());
}

Points randomPoints(std::size_t n, std::mt19937_64& generator) {
  std::normal_distribution<double> normal;
  Points points;
  for (std::size_t i = 0; i < n; ++i)
    points.emplace_back(30.0 * normal(generator), 20.0 * normal(generator), 2.0 * normal(generator));
  return points;
}

Eigen::Matrix3d randomRotation(std::mt19937_64& generator) {
  std::normal_distribution<double> normal;
  const double w = normal(generator), x = normal(generator), y = normal(generator), z = normal(generator);
  return Eigen::Quaterniond(w, x, y, z).normalized().toRotationMatrix();
}

void expectNear(const Similarity& actual, const Similarity& expected, double tolerance) {
  EXPECT_NEAR(actual.scale, expected.scale, tolerance * expected.scale);
  EXPECT_LT((actual.rotation - expected.rotation).norm(), tolerance);
  EXPECT_LT((actual.translation - expected.translation).norm(),
            tolerance * (1.0 + expected.translation.norm()));
}

/// A right-angled triangle turned by a quarter about z, twice as large, and moved.
const Points kTriangle{{0, 0, 0}, {3, 0, 0}, {0, 1, 0}};
const Points kTurned{{10, 0, 5}, {10, 6, 5}, {8, 0, 5}};

TEST(Alignment, Sim3OfATriangle) {
  const Similarity found = align(Alignment::kSim3, kTriangle, kTurned);
  Similarity expected{
      2.0, Eigen::AngleAxisd(kPi / 2, Eigen::Vector3d::UnitZ()).toRotationMatrix(), {10, 0, 5}};
  expectNear(found, expected, 1e-14);  // a few roundings
}

TEST(Alignment, Se3KeepsTheSizeAndTakesMeanToMean) {
  const Similarity found = align(Alignment::kSe3, kTriangle, kTurned);
  EXPECT_EQ(found.scale, 1.0);
  // Mean (1, 1/3, 0) turned is (−1/3, 1, 0); that of the truth is (28/3, 2, 5).
  EXPECT_LT((found.translation - Eigen::Vector3d(29.0 / 3.0, 1, 5)).norm(), 1e-13);
}

TEST(Alignment, NoneIsTheIdentity) {
  const Similarity found = align(Alignment::kNone, {{0, 0, 0}}, {{1, 2, 3}});
  EXPECT_EQ(found.scale, 1.0);
  EXPECT_EQ(found.rotation, Eigen::Matrix3d(Eigen::Matrix3d::Identity()));
  EXPECT_EQ(found.translation, Eigen::Vector3d(0, 0, 0));
}

TEST(Alignment, FindsARandomSimilarity) {
  std::mt19937_64 generator(17);
  std::uniform_real_distribution<double> exponent(-2.0, 2.0);
  for (int i = 0; i < 100; ++i) {
    const Points estimate = randomPoints(40, generator);
    const Similarity truth{std::pow(10.0, exponent(generator)), randomRotation(generator),
                           randomPoints(1, generator)[0]};
    expectNear(align(Alignment::kSim3, estimate, imageOf(estimate, truth)), truth, 1e-12);
    const Similarity rigid{1.0, truth.rotation, truth.translation};
    expectNear(align(Alignment::kSe3, estimate, imageOf(estimate, rigid)), rigid, 1e-12);
  }
}

TEST(Alignment, FindsARotationAsFarFromTheOriginAsMapsAre) {
  std::mt19937_64 generator(19);
  const Points estimate = randomPoints(40, generator);
  // Easting and northing; a double has 1e-9 m left there, which is 1e-10 of the spread.
  const Similarity truth{1.0, randomRotation(generator), {500000, 6180000, 90}};
  const Similarity found = align(Alignment::kSe3, estimate, imageOf(estimate, truth));
  EXPECT_LT((found.rotation - truth.rotation).norm(), 1e-10);
  EXPECT_LT((found.translation - truth.translation).norm(), 1e-8);
}

TEST(Alignment, NeverReflects) {
  // Six points on the axes, mirrored in x. The nearest rotation is half a turn about y (Umeyama, eq. 43): it
  // loses the shortest axis, c, instead of the longest, a.
  const double a = 3, b = 2, c = 1;
  const Points estimate{{a, 0, 0}, {-a, 0, 0}, {0, b, 0}, {0, -b, 0}, {0, 0, c}, {0, 0, -c}};
  Points truth = estimate;
  for (Eigen::Vector3d& point : truth) point.x() = -point.x();
  const Similarity found = align(Alignment::kSim3, estimate, truth);
  EXPECT_LT((found.rotation - Eigen::Matrix3d(Eigen::Vector3d(-1, 1, -1).asDiagonal())).norm(), 1e-14);
  EXPECT_NEAR(found.rotation.determinant(), 1.0, 1e-14);
  // c = tr(DS) / σ² = (a² + b² − c²) / (a² + b² + c²).
  EXPECT_NEAR(found.scale, 12.0 / 14.0, 1e-15);
}

TEST(Alignment, IsTheLeastOfAllNearby) {
  std::mt19937_64 generator(23);
  std::normal_distribution<double> normal;
  const Points estimate = randomPoints(30, generator);
  Points truth = imageOf(estimate, {1.7, randomRotation(generator), {4, 5, 6}});
  for (Eigen::Vector3d& point : truth) point += randomPoints(1, generator)[0];  // as large as the points
  for (const Alignment alignment : {Alignment::kSe3, Alignment::kSim3, Alignment::kYaw}) {
    const Similarity found = align(alignment, estimate, truth);
    const double least = sumOfSquares(found, estimate, truth);
    const Eigen::Vector3d mean = meanOf(estimate);
    for (int i = 0; i < 200; ++i) {
      Similarity other = found;
      const Eigen::Vector3d axis = alignment == Alignment::kYaw
                                       ? Eigen::Vector3d(Eigen::Vector3d::UnitZ())
                                       : Eigen::Vector3d(randomPoints(1, generator)[0].normalized());
      other.rotation = Eigen::AngleAxisd(0.01 * normal(generator), axis) * other.rotation;
      if (alignment == Alignment::kSim3) other.scale *= std::exp(0.01 * normal(generator));
      // Turned about the mean, so that no shift hides what a turn gains; every third is shifted.
      other.translation = found * mean - other.scale * (other.rotation * mean);
      if (i % 3 == 0) other.translation += 0.01 * randomPoints(1, generator)[0];
      EXPECT_GT(sumOfSquares(other, estimate, truth), least);
    }
  }
}

TEST(Alignment, YawFindsItsAngleAndLeavesTheTilt) {
  const Similarity truth{
      1.0, Eigen::AngleAxisd(2.5, Eigen::Vector3d::UnitZ()).toRotationMatrix(), {1, -2, 3}};
  const Points estimate{{1, 0, 0}, {0, 4, 2}, {-5, 1, 7}, {2, 2, -1}};
  expectNear(align(Alignment::kYaw, estimate, imageOf(estimate, truth)), truth, 1e-14);
  // Two poses are enough, also where they are all that Umeyama's method refuses.
  expectNear(align(Alignment::kYaw, {{0, 0, 0}, {1, 0, 0}}, {{5, 5, 5}, {5, 6, 5}}),
             {1.0, Eigen::AngleAxisd(kPi / 2, Eigen::Vector3d::UnitZ()).toRotationMatrix(), {5, 5, 5}},
             1e-14);
  const Points tilted =
      imageOf(estimate, {1.0, Eigen::AngleAxisd(0.3, Eigen::Vector3d::UnitX()).matrix(), {0, 0, 0}});
  EXPECT_EQ(align(Alignment::kYaw, tilted, estimate).rotation.col(2), Eigen::Vector3d(0, 0, 1));
}

TEST(Alignment, YawIsTheBestOfAllAngles) {
  std::mt19937_64 generator(29);
  for (int i = 0; i < 10; ++i) {
    const Points estimate = randomPoints(20, generator), truth = randomPoints(20, generator);
    const Similarity found = align(Alignment::kYaw, estimate, truth);
    const double least = sumOfSquares(found, estimate, truth);
    for (int step = 0; step < 360; ++step) {
      Similarity other;
      other.rotation = Eigen::AngleAxisd(step * kRadPerDeg, Eigen::Vector3d::UnitZ()).toRotationMatrix();
      other.translation = meanOf(truth) - other.rotation * meanOf(estimate);
      EXPECT_GE(sumOfSquares(other, estimate, truth), least * (1.0 - 1e-14));
    }
  }
}

TEST(Alignment, OfPointsOnALineIsRefused) {
  const Points line{{0, 0, 0}, {1, 2, 3}, {2, 4, 6}, {5, 10, 15}};
  const Points same(4, Eigen::Vector3d(0.1, 1e6, 0.3));
  const Points free{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  for (const Alignment alignment : {Alignment::kSe3, Alignment::kSim3}) {
    for (const Points& bad : {line, same}) {
      for (const auto& [estimate, truth] :
           {std::make_pair(bad, free), std::make_pair(free, bad), std::make_pair(bad, bad)}) {
        const std::string error = messageOf([&] { align(alignment, estimate, truth); });
        EXPECT_NE(error.find("all on one line or at one point"), std::string::npos) << error;
      }
    }
  }
  // A road that bends by a thousandth of its length is enough.
  EXPECT_NO_THROW(
      align(Alignment::kSe3, {{0, 0, 0}, {500, 1, 0}, {1000, 0, 0}}, {{0, 0, 0}, {500, 1, 0}, {1000, 0, 0}}));
}

TEST(Alignment, TellsHowLooseItsTurnIs) {
  // A cross of arms of 3 m along x and 1 m along y. The ends of the latter are 0.1 m up and down, which is a
  // roll about x, and undone; or both 0.1 m up, and the others down, which no roll undoes.
  const Points cross{{3, 0, 0}, {-3, 0, 0}, {0, 1, 0}, {0, -1, 0}};
  const Points bent{{3, 0, -0.1}, {-3, 0, -0.1}, {0, 1, 0.1}, {0, -1, 0.1}};
  const double roll = std::atan(0.1);
  Points rolled = cross;
  for (Eigen::Vector3d& point : rolled) point = Eigen::AngleAxisd(roll, Eigen::Vector3d::UnitX()) * point;
  EXPECT_NEAR(align(Alignment::kSe3, rolled, cross).loose_rad, 0.0, 1e-12);
  // Two of four with a torque of 1 m · 0.1 m, and 2 m² / 4 that hold against it.
  EXPECT_NEAR(align(Alignment::kSe3, bent, cross).loose_rad, std::sqrt(2 * 0.01 / 4) / 0.5, 1e-3);
  // Nothing of that turns it about z; nor does another scale, about any axis.
  EXPECT_NEAR(align(Alignment::kYaw, bent, cross).loose_rad, 0.0, 1e-12);
  Points smaller = cross;
  for (Eigen::Vector3d& point : smaller) point *= 0.5;
  EXPECT_NEAR(align(Alignment::kSe3, smaller, cross).loose_rad, 0.0, 1e-12);
  EXPECT_EQ(align(Alignment::kNone, bent, cross).loose_rad, 0.0);
}

TEST(Alignment, OfYawAboveOnePlaceIsRefused) {
  const Points lift{{0.1, 0.7, 0}, {0.1, 0.7, 1}, {0.1, 0.7, 2}};
  const Points same(3, Eigen::Vector3d(0.1, 0.7, 1e6));
  const Points free{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  for (const Points& bad : {lift, same}) {
    EXPECT_NE(messageOf([&] { align(Alignment::kYaw, bad, free); }).find("at one place seen from above"),
              std::string::npos);
    EXPECT_NE(messageOf([&] { align(Alignment::kYaw, free, bad); }), "");
    EXPECT_NE(messageOf([&] { align(Alignment::kYaw, bad, bad); }), "");
  }
}

// Of what is mirrored, half a turn about any of many axes is as good.
TEST(Alignment, OfAMirroredPathThatIsAsLongAsWideIsRefused) {
  const Points cross{{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}};
  Points mirrored = cross;
  for (Eigen::Vector3d& point : mirrored) point.x() = -point.x();
  EXPECT_NE(messageOf([&] { align(Alignment::kYaw, cross, mirrored); }).find("or one is the other mirrored"),
            std::string::npos);
  // In the plane se3 turns it over; in space, as deep as wide, nothing does.
  EXPECT_NO_THROW(align(Alignment::kSe3, cross, mirrored));
  const Points star{{3, 0, 0}, {-3, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  Points reflected = star;
  for (Eigen::Vector3d& point : reflected) point.x() = -point.x();
  for (const Alignment alignment : {Alignment::kSe3, Alignment::kSim3}) {
    EXPECT_NE(
        messageOf([&] { align(alignment, star, reflected); }).find("the estimate is the truth mirrored"),
        std::string::npos);
    EXPECT_NO_THROW(align(alignment, star, star)) << "where nothing is mirrored, nothing is open";
  }
}

TEST(Alignment, OfTooFewPosesIsRefused) {
  const Points two{{0, 0, 0}, {1, 0, 0}};
  EXPECT_EQ(messageOf([&] { align(Alignment::kSe3, two, two); }),
            "the alignment needs 3 pairs of poses, but has 2");
  EXPECT_EQ(messageOf([&] { align(Alignment::kSim3, two, two); }),
            "the alignment needs 3 pairs of poses, but has 2");
  EXPECT_EQ(messageOf([&] { align(Alignment::kYaw, {two[0]}, {two[0]}); }),
            "the alignment needs 2 pairs of poses, but has 1");
}

TEST(Alignment, TurnsOrientationsWithoutScalingThem) {
  Trajectory trajectory = at({{1, 0, 0}});
  trajectory[0].orientation = Eigen::AngleAxisd(0.5, Eigen::Vector3d::UnitX());
  const Similarity quarter{
      3.0, Eigen::AngleAxisd(kPi / 2, Eigen::Vector3d::UnitZ()).toRotationMatrix(), {0, 0, 1}};
  const Trajectory moved = aligned(quarter, trajectory);
  EXPECT_LT((moved[0].position - Eigen::Vector3d(0, 3, 1)).norm(), 1e-15);
  const Eigen::Quaterniond expected =
      Eigen::AngleAxisd(kPi / 2, Eigen::Vector3d::UnitZ()) * trajectory[0].orientation;
  EXPECT_LT(moved[0].orientation.angularDistance(expected), 1e-14);
}

}  // namespace
}  // namespace sunlit::evaluate
