// Light in 16 bits is the same light.
#include "light/bake/samples/node_lights.h"

#include <gtest/gtest.h>

#include <cmath>

namespace sunlit::light {
namespace {

TEST(PackedLight, IsOffByHalfAThousandthAtMost) {
  for (double value = 1e-7; value < 5e8; value *= 1.0007)
    EXPECT_NEAR(static_cast<double>(PackedLight(static_cast<float>(value)).value()) / value, 1.0,
                0x1p-11 * 1.001 + 3e-14 / value);
}

TEST(PackedLight, KeepsDarknessDark) {
  EXPECT_EQ(PackedLight(0.0f).value(), 0.0f);
  EXPECT_EQ(PackedLight(-1e-3f).value(), 0.0f);  // of rounding
  EXPECT_NEAR(PackedLight(1e-11f).value(), 1e-11f, 3e-14f);
}

TEST(PackedLight, RisesWithTheLight) {
  float last = -1.0f;
  for (double value = 1e-12; value < 5e8; value *= 1.01) {
    const float packed = PackedLight(static_cast<float>(value)).value();
    EXPECT_GE(packed, last);
    last = packed;
  }
}

TEST(PackedLight, HoldsWhatItCan) {
  EXPECT_EQ(PackedLight(1e30f).value(), 0x1p29f);
}

TEST(PackedLight, OfWhatItGaveIsTheSame) {
  for (float value = 1e-6f; value < 1e6f; value *= 1.37f) {
    const float once = PackedLight(value).value();
    EXPECT_EQ(PackedLight(once).value(), once);
  }
}

}  // namespace
}  // namespace sunlit::light
