#include "sunlit/evaluate/places/sequences.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "support/message_of.h"

namespace sunlit::evaluate {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// 1 everywhere but where a drive of this slope is: floor(first + numerator · query / 10), there 0.
PlaceMatrix driveOf(Eigen::Index queries, Eigen::Index places, int numerator) {
  PlaceMatrix matrix = PlaceMatrix::Constant(queries, places, 1.0);
  for (Eigen::Index i = 0; i < queries; ++i) matrix(i, i * numerator / 10) = 0.0;
  return matrix;
}

PlaceMatrix someDifferences(Eigen::Index queries, Eigen::Index places) {
  std::mt19937_64 generator(5);
  PlaceMatrix matrix(queries, places);
  for (Eigen::Index k = 0; k < matrix.size(); ++k)
    matrix.data()[k] = static_cast<double>(generator() >> 11) * 0x1p-53;
  return matrix;
}

TEST(Contrast, IsTheDeviationFromTheWindowAlongTheMap) {
  // 13 places, all 5 but the seventh, 16: its window holds 11 values, mean 6, deviations 10 and ten times −1,
  // sd² = 110 / 10 = 11.
  PlaceMatrix differences = PlaceMatrix::Constant(2, 13, 5.0);
  differences(0, 6) = 16.0;
  const PlaceMatrix enhanced = enhanceContrast(differences);
  // Place 1 sees 0 … 6: seven values, mean 46/7, deviation −11/7, sd² = 121/7. It has the least of all:
  const double least = -(11.0 / 7.0) / std::sqrt(121.0 / 7.0);
  constexpr double kRounding = 1e-14;  // of some ten operations
  EXPECT_NEAR(enhanced(0, 6), 10.0 / std::sqrt(11.0) - least, kRounding);
  EXPECT_NEAR(enhanced(0, 5), -1.0 / std::sqrt(11.0) - least, kRounding);
  EXPECT_NEAR(enhanced(0, 1), 0.0, kRounding);
  EXPECT_EQ(enhanced.minCoeff(), 0.0);
  // Place 0 sees 0 … 5: all equal, sd 0. The other query has none else.
  EXPECT_NEAR(enhanced(0, 0), -least, kRounding);
  EXPECT_NEAR(enhanced(1, 6), -least, kRounding);
}

TEST(Contrast, IsNothingOnAMapOfOnePlace) {
  EXPECT_EQ(enhanceContrast(PlaceMatrix::Constant(3, 1, 2.0)), PlaceMatrix(PlaceMatrix::Zero(3, 1)));
}

TEST(Sequences, FindADriveOfTheSameSpeed) {
  const PlaceMatrix scores = sequenceScores(driveOf(30, 30, 10));
  const std::vector<PlaceGuess> guesses = uniquePlaces(scores);
  for (Eigen::Index i = 0; i < 30; ++i) {
    EXPECT_EQ(scores(i, i), 0.0);  // eleven zeros, also at both ends
    EXPECT_EQ(guesses[static_cast<std::size_t>(i)].place, static_cast<std::size_t>(i));
    EXPECT_EQ(guesses[static_cast<std::size_t>(i)].doubt, 0.0);
  }
  // Of the lines through the next place that of slope 1.2, 0 1 2 3 4 6 7 8 9 10 12 from place 10 on, meets
  // the drive, 10 11 … 20, five times, that of slope 0.8, 0 0 1 2 3 4 4 5 6 7 8 from 12 on, five times too,
  // those of 0.9, 1.0 and 1.1 never.
  EXPECT_EQ(scores(15, 16), 6.0);
  // Five places off no line of 0.8 … 1.2 meets it: at most two steps are gained in a sequence.
  EXPECT_EQ(scores(15, 20), 11.0);
}

TEST(Sequences, FindADriveOfFourFifthsOfTheSpeed) {
  const PlaceMatrix scores = sequenceScores(driveOf(31, 25, 8));
  // 8 i / 10 repeats itself every five queries, and there the line of slope 0.8 has the same steps.
  for (const Eigen::Index i : {5, 10, 15, 20, 25}) {
    EXPECT_EQ(scores(i, i * 8 / 10), 0.0) << i;
    EXPECT_EQ(uniquePlaces(scores)[static_cast<std::size_t>(i)].place, static_cast<std::size_t>(i * 8 / 10));
  }
  // The ends have a whole line too: that of the queries 0 … 10, and 20 … 30.
  EXPECT_EQ(scores(0, 0), 0.0);
  EXPECT_EQ(scores(3, 2), 0.0);
  EXPECT_EQ(scores(30, 24), 0.0);
}

TEST(Sequences, DoNotFindADriveOfHalfTheSpeed) {
  const PlaceMatrix scores = sequenceScores(driveOf(31, 25, 5));
  EXPECT_GT(scores.row(15).minCoeff(), 5.0);  // most of eleven
}

TEST(Sequences, HaveNoLineThatLeavesTheMap) {
  const PlaceMatrix scores = sequenceScores(PlaceMatrix::Constant(30, 20, 1.0));
  // Query 15 is in the middle of its lines, 4 steps (slope 0.8) above their beginnings at least, and 4 below
  // their ends.
  EXPECT_EQ(scores(15, 3), kInfinity);
  EXPECT_EQ(scores(15, 4), 11.0);
  EXPECT_EQ(scores(15, 15), 11.0);
  EXPECT_EQ(scores(15, 16), kInfinity);
  // The first query is at the beginning of its own, the last at the end.
  EXPECT_EQ(scores(0, 0), 11.0);
  EXPECT_EQ(scores(0, 11), 11.0);
  EXPECT_EQ(scores(0, 12), kInfinity);
  EXPECT_EQ(scores(29, 7), kInfinity);
  EXPECT_EQ(scores(29, 8), 11.0);
  EXPECT_EQ(scores(29, 19), 11.0);
}

TEST(Sequences, AreTheLeastSumsThatARecountFinds) {
  // By the definition, from the query and the place outwards, with slopes as fractions of double.
  const PlaceMatrix enhanced = enhanceContrast(someDifferences(25, 22));
  const PlaceMatrix scores = sequenceScores(enhanced);
  for (Eigen::Index i = 5; i < 20; ++i) {
    for (Eigen::Index j = 0; j < 22; ++j) {
      double least = kInfinity;
      for (const double slope : {0.8, 0.9, 1.0, 1.1, 1.2}) {
        const auto risen = [&](Eigen::Index k) { return static_cast<Eigen::Index>(k * slope + 1e-9); };
        const Eigen::Index start = j - risen(5);
        if (start < 0 || start + risen(10) > 21) continue;
        double sum = 0.0;
        for (Eigen::Index k = 0; k <= 10; ++k) sum += enhanced(i - 5 + k, start + risen(k));
        least = std::min(least, sum);
      }
      EXPECT_EQ(scores(i, j), least) << i << ' ' << j;
    }
  }
}

TEST(Sequences, RefuseFewerPicturesThanOneHas) {
  EXPECT_EQ(messageOf([] { sequenceScores(PlaceMatrix::Zero(10, 30)); }),
            "queries of sequences is 10, but must be at least 11");
  EXPECT_EQ(messageOf([] { sequenceScores(PlaceMatrix::Zero(30, 8)); }),
            "places of sequences is 8, but must be at least 9");
  EXPECT_EQ(sequenceScores(PlaceMatrix::Zero(11, 9))(5, 4), 0.0);
}

TEST(UniquePlaces, CompareWithTheBestBeyondTheWindow) {
  PlaceMatrix scores = PlaceMatrix::Constant(5, 30, 8.0);
  scores(0, 10) = 2.0;
  scores(0, 15) = 3.0;  // five off: within the window
  scores(0, 16) = 5.0;  // beyond
  scores(1, 10) = 2.0;
  scores(1, 25) = 2.0;  // as good: of equal ones the first, and nothing speaks for it
  scores.row(2).setConstant(0.0);
  scores.row(3).setConstant(kInfinity);
  scores.row(4).setConstant(kInfinity);
  scores(4, 3) = 7.0;  // nothing to compare with
  const std::vector<PlaceGuess> guesses = uniquePlaces(scores);
  EXPECT_EQ(guesses[0].place, 10u);
  EXPECT_EQ(guesses[0].doubt, 2.0 / 5.0);
  EXPECT_EQ(guesses[1].place, 10u);
  EXPECT_EQ(guesses[1].doubt, 1.0);
  EXPECT_EQ(guesses[2].place, 0u);
  EXPECT_EQ(guesses[2].doubt, 1.0);
  EXPECT_FALSE(guesses[3].place);
  EXPECT_EQ(guesses[4].place, 3u);
  EXPECT_EQ(guesses[4].doubt, 1.0);
}

}  // namespace
}  // namespace sunlit::evaluate
