#include "sunlit/evaluate/places/place_scores.h"

#include <gtest/gtest.h>

#include <limits>

#include "support/message_of.h"

namespace sunlit::evaluate {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
// Sums and quotients of a few small whole numbers: a few roundings of 1e-16.
constexpr double kRounding = 1e-15;

PlaceMatrix matrixOf(std::initializer_list<std::initializer_list<double>> rows) {
  PlaceMatrix matrix(static_cast<Eigen::Index>(rows.size()), static_cast<Eigen::Index>(rows.begin()->size()));
  Eigen::Index i = 0;
  for (const auto& row : rows) {
    Eigen::Index j = 0;
    for (const double value : row) matrix(i, j++) = value;
    ++i;
  }
  return matrix;
}

PlaceScores scoresOf(const PlaceMatrix& distances, std::size_t tolerance) {
  return placeScores(distances, nearestPlaces(distances), tolerance);
}

TEST(NearestPlaces, AreTheFirstOfEquallyNearOnes) {
  const std::vector<PlaceGuess> guesses =
      nearestPlaces(matrixOf({{3, 2, 2}, {kInfinity, kInfinity, kInfinity}, {kInfinity, 5, 7}}));
  ASSERT_EQ(guesses.size(), 3u);
  EXPECT_EQ(guesses[0].place, 1u);
  EXPECT_EQ(guesses[0].doubt, 2.0);
  EXPECT_FALSE(guesses[1].place);
  EXPECT_EQ(guesses[2].place, 1u);
}

TEST(PlaceRecall, CountsAmongTheFirstNOfAllQueries) {
  // Query 0: its place is first. Query 1: six places are nearer. Query 2: four are as near, one of which
  // comes before it. Query 3: none is a candidate.
  PlaceMatrix distances = PlaceMatrix::Constant(4, 12, 9.0);
  distances(0, 0) = 1;
  for (const int nearer : {2, 3, 4, 5, 6, 7}) distances(1, nearer) = 1;
  distances(1, 1) = 2;
  for (const int as_near : {5, 6, 7, 0}) distances(2, as_near) = 1;
  distances(2, 2) = 1;
  distances.row(3).setConstant(kInfinity);
  const PlaceScores scores = scoresOf(distances, 0);
  EXPECT_EQ(scores.queries, 4u);
  EXPECT_EQ(scores.recall_1, 1.0 / 4.0);
  EXPECT_EQ(scores.recall_5, 2.0 / 4.0);
  EXPECT_EQ(scores.recall_10, 3.0 / 4.0);
  EXPECT_EQ(scores.without_guess, 1u);
  EXPECT_EQ(scores.without_truth, 0u);
}

TEST(PlaceRecall, IsLostByATieWithAFalsePlaceOfLowerIndexOnly) {
  EXPECT_EQ(scoresOf(matrixOf({{1, 1}}), 0).recall_1, 1.0);                      // 0 comes before 1
  EXPECT_EQ(scoresOf(matrixOf({{1, 2}, {1, 1}}), 0).recall_1, 1.0 / 2.0);        // query 1: 0 before 1
  EXPECT_EQ(scoresOf(matrixOf({{1, 2, 2}, {1, 1, 2}}), 1).recall_1, 1.0);        // both are true now
  EXPECT_EQ(scoresOf(matrixOf({{2, 2, 1, 2}, {9, 9, 9, 1}}), 1).recall_1, 0.0);  // two off
  EXPECT_EQ(scoresOf(matrixOf({{2, 2, 1, 2}, {9, 9, 9, 1}}), 2).recall_1, 1.0);  // within two
  EXPECT_EQ(scoresOf(matrixOf({{2, 2, 1, 2}}), std::size_t(-1)).recall_1, 1.0);  // all is true
}

TEST(PlaceRecall, ComparesIndexWithIndexWhereOneDriveIsLonger) {
  // Queries 0 … 4 on a map of 0 … 2, all taken for 2: true of 1 … 3 within one frame; 4 has no true place.
  const PlaceMatrix distances = PlaceMatrix::Constant(5, 1, 1.0) * matrixOf({{2, 2, 1}});
  const PlaceScores scores = scoresOf(distances, 1);
  EXPECT_EQ(scores.recall_1, 3.0 / 5.0);  // of all five
  EXPECT_EQ(scores.without_truth, 1u);
  // One threshold, since all doubts are equal: recall 3 of the 4 that have a place, precision 3 of 5.
  EXPECT_NEAR(scores.pr_auc, 0.75 * (1.0 + 0.6) / 2.0, kRounding);
  EXPECT_EQ(scores.recall_at_100_precision, 0.0);
}

TEST(PrecisionRecall, FollowsFromPencilAndPaper) {
  // Right, right, wrong, right in the order of their doubt, which is not that of the queries.
  const std::vector<PlaceGuess> guesses = {{0, 0.4}, {9, 0.3}, {2, 0.1}, {3, 0.2}};
  const std::vector<CurvePoint> curve = precisionRecallCurve(guesses, 10, 0);
  const double expected[5][2] = {{0, 1}, {0.25, 1}, {0.5, 1}, {0.5, 2.0 / 3.0}, {0.75, 0.75}};
  ASSERT_EQ(curve.size(), 5u);
  for (std::size_t k = 0; k < curve.size(); ++k) {
    EXPECT_EQ(curve[k].recall, expected[k][0]) << k;
    EXPECT_EQ(curve[k].precision, expected[k][1]) << k;
  }
  EXPECT_NEAR(areaUnder(curve), 0.5 + 0.25 * (2.0 / 3.0 + 0.75) / 2.0, kRounding);
  EXPECT_EQ(recallAtFullPrecision(curve), 0.5);
}

TEST(PrecisionRecall, AcceptsEqualDoubtsTogether) {
  const std::vector<CurvePoint> curve = precisionRecallCurve({{0, 0.5}, {0, 0.5}, {2, 0.5}}, 3, 0);
  ASSERT_EQ(curve.size(), 2u);
  EXPECT_EQ(curve[1].recall, 2.0 / 3.0);
  EXPECT_EQ(curve[1].precision, 2.0 / 3.0);
  EXPECT_EQ(recallAtFullPrecision(curve), 0.0);
}

TEST(PrecisionRecall, DividesByQueriesThatHaveATruePlaceAndLeavesOutThoseWithoutAGuess) {
  // Of four queries on a map of three the last has no true place; the second has no guess.
  const std::vector<CurvePoint> curve =
      precisionRecallCurve({{0, 0.1}, {std::nullopt, 0.0}, {2, 0.2}, {2, 0.3}}, 3, 0);
  ASSERT_EQ(curve.size(), 4u);
  EXPECT_EQ(curve[1].recall, 1.0 / 3.0);
  EXPECT_EQ(curve[2].recall, 2.0 / 3.0);
  EXPECT_EQ(curve[2].precision, 1.0);
  EXPECT_EQ(curve[3].recall, 2.0 / 3.0);
  EXPECT_EQ(curve[3].precision, 2.0 / 3.0);
  EXPECT_EQ(recallAtFullPrecision(curve), 2.0 / 3.0);
  EXPECT_NEAR(areaUnder(curve), 2.0 / 3.0, kRounding);
}

TEST(PrecisionRecall, IsOnlyItsBeginningWithoutAnyGuess) {
  const std::vector<CurvePoint> curve = precisionRecallCurve({{std::nullopt, 0.0}}, 1, 0);
  ASSERT_EQ(curve.size(), 1u);
  EXPECT_EQ(areaUnder(curve), 0.0);
  EXPECT_EQ(recallAtFullPrecision(curve), 0.0);
}

TEST(PlaceScores, RefuseWhatDoesNotGoTogether) {
  const auto refusal = [](const PlaceMatrix& distances, const std::vector<PlaceGuess>& guesses) {
    return messageOf([&] { placeScores(distances, guesses, 0); });
  };
  EXPECT_NE(refusal(matrixOf({{1}}), {}).find("0 guesses for distances of 1 queries"), std::string::npos);
  EXPECT_NE(refusal(PlaceMatrix(0, 3), {}).find("at least one of each"), std::string::npos);
}

}  // namespace
}  // namespace sunlit::evaluate
