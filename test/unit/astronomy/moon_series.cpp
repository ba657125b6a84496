/// The moon of our own series against the example of the book that it is from.
#include "astronomy/moon_series.h"

#include <gtest/gtest.h>

namespace sunlit::astronomy {
namespace {

TEST(MoonSeries, IsThatOf47a) {
  // Meeus, example 47.a: 12 April 1992, 0 h TD, all digits that he prints.
  const EclipticMoon moon = moonByMeeus(-0.077221081451);
  EXPECT_NEAR(moon.longitude_deg, 133.162655, 0.6e-6);
  EXPECT_NEAR(moon.latitude_deg, -3.229126, 0.6e-6);
  EXPECT_NEAR(moon.distance_m, 368409.7e3, 60.0);
}

}  // namespace
}  // namespace sunlit::astronomy
