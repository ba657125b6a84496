// Light in 16 bits is the same light.
#include "light/bake/samples/node_lights.h"

#include <gtest/gtest.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <vector>

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

TEST(NodeLights, KeepsWhatArrivesFromWhere) {
  std::vector<NodeLight> nodes;
  for (float first = 1.0f; first < 30.0f; first += 9.0f) {
    const auto next = [first](float i) {
      return Eigen::Array3f(first + i, first + i + 1.0f, first + i + 2.0f);
    };
    nodes.push_back({next(0.0f), {next(3.0f), next(6.0f)}});
  }
  const NodeLights kept(nodes.size(), [&](std::size_t from, std::size_t end, NodeLight* light) {
    std::copy(nodes.begin() + static_cast<std::ptrdiff_t>(from),
              nodes.begin() + static_cast<std::ptrdiff_t>(end), light);
  });
  ASSERT_EQ(kept.size(), nodes.size());
  for (std::size_t i = 0; i < nodes.size(); ++i) {  // whole numbers up to 1024 keep their bits
    EXPECT_TRUE((kept.irradiance(i).head<3>() == nodes[i].irradiance).all());
    EXPECT_TRUE((kept.above(i).head<3>() == nodes[i].around.above).all());
    EXPECT_TRUE((kept.below(i).head<3>() == nodes[i].around.below).all());
  }
}

TEST(NodeLights, AreFoundOnceHoweverManyAskAndNotWhereNobodyDoes) {
  constexpr std::size_t kCount = 1000, kAsked = 700;
  std::vector<std::atomic<int>> found(kCount);
  const NodeLights kept(kCount, [&](std::size_t first, std::size_t end, NodeLight* light) {
    for (std::size_t n = first; n < end; ++n) {
      ++found[n];
      const Eigen::Array3f all = Eigen::Array3f::Constant(static_cast<float>(n));
      light[n - first] = {all, {all, all}};
    }
  });
  // Each by several threads at about the same time.
  tbb::parallel_for(std::size_t{0}, 8 * kAsked, [&](std::size_t i) {
    const std::size_t node = i * 577 % kAsked;
    EXPECT_EQ(kept.below(node)[0], static_cast<float>(node));
    EXPECT_EQ(kept.irradiance(i / 8)[2], static_cast<float>(i / 8));
  });
  for (std::size_t n = 0; n < kAsked; ++n) EXPECT_EQ(found[n], 1) << n;
  for (std::size_t n = kAsked + 100; n < kCount; ++n) EXPECT_EQ(found[n], 0) << n;
}

}  // namespace
}  // namespace sunlit::light
