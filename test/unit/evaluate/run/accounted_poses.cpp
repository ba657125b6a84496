#include "evaluate/run/accounted_poses.h"

#include <gtest/gtest.h>

namespace sunlit::evaluate {
namespace {

PoseRange rangeOf(std::size_t count, std::int64_t first = 0, std::int64_t stride = 1) {
  PoseRange range;
  range.count = count;
  range.first = first;
  range.stride = stride;
  return range;
}

TEST(AccountedPoses, ThatWereTakenUpArePassedUpToTheFirstHole) {
  AccountedPoses poses(rangeOf(16, 10, 2));  // 10, 12, … 24
  for (const std::int64_t pose : {16, 10, 18, 12}) poses.takeUp(pose);
  EXPECT_EQ(poses.size(), 4u);
  EXPECT_EQ(poses.passed(), 2u);
  poses.add(14);
  EXPECT_EQ(poses.passed(), 5u) << "the hole is mended";
  poses.takeUp(24);
  poses.takeUp(99);
  EXPECT_EQ(poses.passed(), 5u);
  for (const std::int64_t pose : {20, 22}) poses.add(pose);
  EXPECT_TRUE(poses.isWhole());
  EXPECT_EQ(poses.unexpected(), 1u);
  EXPECT_EQ(poses.passed(), poses.size());
}

// Else one image that is lost would hold up who waits for its reader.
TEST(AccountedPoses, OfThisRunArePassedBeyondOneThatIsLost) {
  AccountedPoses poses(rangeOf(9));
  for (const std::int64_t pose : {0, 4, 5}) poses.takeUp(pose);
  for (const std::int64_t pose : {2, 3, 4}) poses.add(pose);  // pose 1 was lost
  EXPECT_EQ(poses.passed(), 4u) << "pose 4 comes again";
  poses.add(100);
  EXPECT_EQ(poses.passed(), 5u) << "nobody need wait for what is turned away";
  EXPECT_EQ(poses.expected(), 5u);
}

TEST(AccountedPoses, AreAllPassedWhereNobodySaidWhichAreExpected) {
  AccountedPoses poses(rangeOf(0));
  for (const std::int64_t pose : {50, 51, 60}) poses.takeUp(pose);
  EXPECT_EQ(poses.passed(), 3u);
  EXPECT_FALSE(poses.isWhole());
}

TEST(AccountedPoses, ByTheirOrderCountUntilTheyAreKnown) {
  AccountedPoses poses(rangeOf(3));
  for (const std::int64_t number : {0, 1, 2}) poses.addNumber(number);
  EXPECT_TRUE(poses.isWhole());
  poses.addNumber(7);
  poses.add(1);
  EXPECT_EQ(poses.passed(), 4u);
  EXPECT_EQ(poses.unexpected(), 1u);
  poses.forgetNumbers();
  EXPECT_EQ(poses.size(), 1u);
  EXPECT_TRUE(poses.has(1));
  EXPECT_EQ(poses.unexpected(), 0u);
  EXPECT_FALSE(poses.isWhole());
  EXPECT_EQ(poses.passed(), 4u) << "what a sender was told stays";
  for (const std::int64_t pose : {0, 2}) poses.add(pose);
  EXPECT_TRUE(poses.isWhole());
}

}  // namespace
}  // namespace sunlit::evaluate
