// Which poses belong together: gaps, ties, poses that nobody asks for.
#include "sunlit/evaluate/trajectory/association.h"

#include <gtest/gtest.h>

#include <limits>
#include <vector>

namespace sunlit::evaluate {
namespace {

Trajectory at(const std::vector<std::int64_t>& stamps) {
  Trajectory trajectory;
  for (const std::int64_t stamp : stamps) {
    trajectory.emplace_back();
    trajectory.back().stamp_ns = stamp;
  }
  return trajectory;
}

using Indices = std::vector<std::size_t>;
using Pairs = std::vector<std::pair<std::size_t, std::size_t>>;

Pairs pairsOf(const Association& association) {
  Pairs pairs;
  for (const Association::Pair& pair : association.pairs) pairs.emplace_back(pair.truth, pair.estimate);
  return pairs;
}

TEST(Association, TakesTheNearestOfADenserTruth) {
  const Association found = associate(at({0, 10, 20, 30, 40, 50}), at({9, 31, 44}), 5);
  EXPECT_EQ(pairsOf(found), (Pairs{{1, 0}, {3, 1}, {4, 2}}));
  EXPECT_EQ(found.truth_left, (Indices{0, 2, 5}));
  EXPECT_TRUE(found.estimate_left.empty());
}

TEST(Association, TakesTheNearestOfADenserEstimate) {
  const Association found = associate(at({9, 31, 44}), at({0, 10, 20, 30, 40, 50}), 5);
  EXPECT_EQ(pairsOf(found), (Pairs{{0, 1}, {1, 3}, {2, 4}}));
  EXPECT_EQ(found.estimate_left, (Indices{0, 2, 5}));
}

TEST(Association, NamesWhatStandsInAGap) {
  const Association found = associate(at({0, 10, 50, 60}), at({1, 11, 30, 51}), 5);
  EXPECT_EQ(pairsOf(found), (Pairs{{0, 0}, {1, 1}, {2, 3}}));
  EXPECT_EQ(found.truth_left, (Indices{3}));
  EXPECT_EQ(found.estimate_left, (Indices{2}));
}

TEST(Association, GivesAPoseToTheNearestOfThoseThatAskForIt) {
  // All three estimates are nearest to the truth at 100.
  const Association found = associate(at({0, 100, 200}), at({90, 98, 104}), 1000);
  EXPECT_EQ(pairsOf(found), (Pairs{{1, 1}}));
  EXPECT_EQ(found.truth_left, (Indices{0, 2}));
  EXPECT_EQ(found.estimate_left, (Indices{0, 2}));
}

TEST(Association, TheEarlierOfEquallyNearOnesHasIt) {
  EXPECT_EQ(pairsOf(associate(at({0, 10, 20}), at({5}), 5)), (Pairs{{0, 0}}));
  EXPECT_EQ(pairsOf(associate(at({5, 100}), at({0, 10}), 5)), (Pairs{{0, 0}}));
}

TEST(Association, TheLargestDifferenceIsAllowed) {
  EXPECT_EQ(associate(at({0}), at({10000000}), 10000000).pairs.size(), 1u);
  EXPECT_EQ(associate(at({0}), at({10000001}), 10000000).pairs.size(), 0u);
  EXPECT_EQ(associate(at({7}), at({7}), 0).pairs.size(), 1u);
  EXPECT_EQ(associate(at({7}), at({8}), 0).pairs.size(), 0u);
}

TEST(Association, StampsAtBothEndsOfTimeAreFarApart) {
  constexpr auto kFirst = std::numeric_limits<std::int64_t>::min();
  constexpr auto kLast = std::numeric_limits<std::int64_t>::max();
  EXPECT_TRUE(associate(at({kFirst}), at({kLast}), 1000000000).pairs.empty());
  EXPECT_NEAR(leastDifference(at({kFirst}), at({kLast})), 1.8446744e10, 1e3);
}

TEST(Association, OfNothingIsEmpty) {
  const Association found = associate({}, at({1, 2}), 5);
  EXPECT_TRUE(found.pairs.empty());
  EXPECT_EQ(found.estimate_left, (Indices{0, 1}));
}

TEST(Association, KnowsHowFarOffTheNearestIs) {
  EXPECT_DOUBLE_EQ(leastDifference(at({0, 2000000000}), at({3500000000, 7000000000})), 1.5);
}

}  // namespace
}  // namespace sunlit::evaluate
