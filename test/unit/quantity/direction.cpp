#include "sunlit/quantity/direction.h"

#include <gtest/gtest.h>

namespace sunlit {
namespace {

constexpr double kRounding = 1e-15;  // a few units of the last place of 1

void expectVector(const Direction& direction, double east, double north, double up) {
  EXPECT_NEAR(direction.vector().x(), east, kRounding);
  EXPECT_NEAR(direction.vector().y(), north, kRounding);
  EXPECT_NEAR(direction.vector().z(), up, kRounding);
}

TEST(Direction, MapIsEastNorthUp) {
  expectVector(Direction(Azimuth::degrees(0.0), Angle()), 0, 1, 0);
  expectVector(Direction(Azimuth::degrees(90.0), Angle()), 1, 0, 0);
  expectVector(Direction(Azimuth::degrees(180.0), Angle()), 0, -1, 0);
  expectVector(Direction(Azimuth::degrees(270.0), Angle()), -1, 0, 0);
  expectVector(Direction(Azimuth::degrees(123.0), Angle::degrees(90.0)), 0, 0, 1);
  expectVector(Direction(), 0, 0, 1);
}

TEST(Direction, IsAUnitVectorOfAnyVector) {
  expectVector(Direction(Eigen::Vector3d(0.0, 0.0, -5.0)), 0, 0, -1);
  EXPECT_NEAR(Direction(Eigen::Vector3d(1e-30, 2e-30, 3e-30)).vector().norm(), 1.0, kRounding);
}

TEST(Direction, AzimuthAndElevationComeBack) {
  for (int azimuth = 0; azimuth < 360; azimuth += 15) {
    for (int elevation = -75; elevation <= 75; elevation += 15) {
      const Direction direction(Azimuth::degrees(azimuth), Angle::degrees(elevation));
      // The turn may close on either side of north.
      EXPECT_NEAR(std::remainder(direction.azimuth().deg() - azimuth, 360.0), 0.0, 1e-12);
      EXPECT_NEAR(direction.elevation().deg(), elevation, 1e-12);
    }
  }
}

}  // namespace
}  // namespace sunlit
