#include "sunlit/studio/stopwatch.h"

#include <gtest/gtest.h>

#include <map>
#include <string>

namespace sunlit::studio {
namespace {

TEST(Stopwatch, CountsEachCallOfAStage) {
  Stopwatch stopwatch;
  EXPECT_EQ(stopwatch.measure("light", "noon", [] { return 7; }), 7);
  stopwatch.measure("light", "noon", [] {});
  stopwatch.measure("light", "night", [] {});
  ASSERT_EQ(stopwatch.entries().size(), 2u);
  EXPECT_EQ(stopwatch.entries()[0].count, 2);
  EXPECT_EQ(stopwatch.entries()[1].what, "night");
}

TEST(Stopwatch, CountsAStageWithinAnotherOnce) {
  double now_s = 0.0;
  Stopwatch stopwatch([&now_s] { return now_s; });
  stopwatch.measure("load", "all", [&] {
    now_s += 1.0;
    for (int i = 0; i < 2; ++i)
      stopwatch.measure("load", "part", [&] {
        now_s += 4.0;
        stopwatch.measure("load", "piece", [&] { now_s += 16.0; });
      });
    now_s += 2.0;
  });
  std::map<std::string, double> seconds;
  for (const Stopwatch::Entry& entry : stopwatch.entries()) seconds[entry.what] = entry.seconds;
  EXPECT_EQ(seconds, (std::map<std::string, double>{{"all", 3.0}, {"part", 8.0}, {"piece", 32.0}}));
}

}  // namespace
}  // namespace sunlit::studio
