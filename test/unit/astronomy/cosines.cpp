#include "astronomy/cosines.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

namespace sunlit::astronomy {
namespace {

TEST(Cosines, AgreeWithTheStandardLibrary) {
  std::mt19937_64 random(6);
  std::vector<double> arguments = {
      0.0, -0.0, 1.5707963267948966, 3.141592653589793, -3.141592653589793, 6.283185307179586};
  for (const double size : {1.0, 10.0, 1e3, 1e6, 1e7}) {
    std::uniform_real_distribution<double> argument(-size, size);
    for (int i = 0; i < 100000; ++i) arguments.push_back(argument(random));
  }
  std::vector<double> values = arguments;
  cosines(values.data(), static_cast<int>(values.size()));
  double largest = 0.0;
  for (std::size_t i = 0; i < values.size(); ++i)
    largest = std::max(largest, std::abs(values[i] - std::cos(arguments[i])));
  // A few units of the last place of 1, as promised: the largest amplitude of a series is 0.03 rad.
  EXPECT_LE(largest, 2e-15);
}

TEST(Cosines, DoNotDependOnTheirNeighbours) {
  // The vectorised part and the rest of a loop give the same bits.
  for (int count = 1; count < 40; ++count) {
    std::vector<double> values;
    for (int i = 0; i < count; ++i) values.push_back(1234.5 + 0.7 * i);
    std::vector<double> together = values;
    cosines(together.data(), count);
    for (int i = 0; i < count; ++i) {
      cosines(&values[static_cast<std::size_t>(i)], 1);
      ASSERT_EQ(values[static_cast<std::size_t>(i)], together[static_cast<std::size_t>(i)]);
    }
  }
}

}  // namespace
}  // namespace sunlit::astronomy
