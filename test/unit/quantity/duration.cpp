#include "sunlit/quantity/duration.h"

#include <gtest/gtest.h>

#include <cmath>

namespace sunlit {
namespace {

// Those of test/unit/experiment/progress_test.py, which words them in Python.
TEST(Duration, ReadsAsPeopleSayIt) {
  EXPECT_EQ(textOfDuration(0.4), "0 s");
  EXPECT_EQ(textOfDuration(59.4), "59 s");
  EXPECT_EQ(textOfDuration(59.6), "1 min 00 s");
  EXPECT_EQ(textOfDuration(3599.4), "59 min 59 s");
  EXPECT_EQ(textOfDuration(7260.0), "2 h 01 min");
}

TEST(Duration, OfTheTimeLeftIsToldWhereItIsKnown) {
  EXPECT_EQ(textOfTimeLeft(12.0), ", 12 s left");
  EXPECT_EQ(textOfTimeLeft(std::nan("")), "");
}

}  // namespace
}  // namespace sunlit
