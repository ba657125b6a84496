/// The air between the eye and surfaces.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "directions.h"
#include "sky/radiative_transfer.h"
#include "sunlit/sky/atmosphere.h"

namespace sunlit::sky {
namespace {

/// Airlight by small steps through the same air.
LinearRgb slowAirlight(const RadiativeTransfer& transfer, const Direction& sun, const Direction& sight,
                       double distance_km) {
  std::vector<double> edges_km;
  constexpr int kSteps = 400;
  for (int i = 0; i <= kSteps; ++i) {
    edges_km.push_back(distance_km * i / kSteps);
  }
  const SightPath path =
      sightPath(transfer.medium(), transfer.sunlight(), {0.0, sight.vector().z()}, edges_km);
  const double cos_angle = sight.vector().dot(sun.vector());
  const SunAlong sun_along(path, sun.vector().z(), cos_angle);
  Scattered light;
  for (const SightStep& step : path.steps) {
    transfer.addStep(step, sun_along, cos_angle, &light);
  }
  return inGamut(colourOf(light.radiance(cos_angle)));
}

TEST(AirBetween, AgreesWithSmallStepsThroughTheSameAir) {
  const RadiativeTransfer transfer{MediumParameters{}};
  for (const double sun_deg : {40.0, 5.0, -4.0}) {
    const Direction sun = at(0.0, sun_deg);
    const Daylight day = usualAir().daylight({sun, 1.0});
    for (const double elevation_deg : {-40.0, -0.5, 0.0, 3.0, 20.0}) {
      for (const double azimuth_deg : {3.0, 40.0, 100.0, 180.0}) {
        const Direction sight = at(azimuth_deg, elevation_deg);
        for (const double distance_km : {0.02, 0.2, 1.0, 5.0, 20.0, 40.0}) {
          if (distance_km * sight.vector().z() > 9.0) {
            continue;  // no surface is that high
          }
          const AirColumn air =
              day.airOver(sight.vector().cast<float>(), static_cast<float>(distance_km * 1e3));
          const LinearRgb slow = slowAirlight(transfer, sun, sight, distance_km);
          // Straight between nodes of the table; measured 4 % at most.
          EXPECT_NEAR(LinearRgb(air.airlight).luminance() / slow.luminance(), 1.0F, 0.06F)
              << "sun " << sun_deg << "°, " << azimuth_deg << "°, " << elevation_deg << "°, " << distance_km;
        }
      }
    }
  }
}

TEST(AirBetween, IsLeftOutWhereItIsNotAskedFor) {
  Weather foggy;
  foggy.visibility_m = 200.0;
  const Daylight day = usualAir().daylight({at(0.0, 30.0), 1.0}, {}, foggy);
  const Daylight clear = day.withoutAir().seenFrom({1.0F, 2.0F, 3.0F});
  const Eigen::Vector3f towards = at(20.0, -90.0).vector().cast<float>();
  EXPECT_LT(day.airOver(towards, 1e4F).transmittance.maxCoeff(), 0.1F);
  EXPECT_EQ(clear.airOver(towards, 1e4F).transmittance.minCoeff(), 1.0F);
  EXPECT_EQ(clear.airOver(towards, 1e4F).airlight.maxCoeff(), 0.0F);
  EXPECT_GT(day.fog().per_m, 0.0F);
  EXPECT_EQ(clear.fog().per_m, 0.0F);
  EXPECT_EQ(clear.groundIlluminance().luminance(), day.groundIlluminance().luminance());
}

TEST(AirBetween, NoDistanceIsNoAir) {
  const Daylight day = usualAir().daylight({at(0.0, 30.0), 1.0});
  for (const double elevation_deg : {-90.0, 0.0, 33.0}) {
    const AirColumn air = day.airOver(at(20.0, elevation_deg).vector().cast<float>(), 0.0F);
    EXPECT_EQ(air.transmittance.minCoeff(), 1.0F);
    EXPECT_EQ(air.airlight.maxCoeff(), 0.0F);
  }
}

TEST(AirBetween, ItDimsAsBeersLawSays) {
  // Green light over level ground: e^−(d · extinction at sea level), the last from the medium itself. Green
  // of sRGB spans 100 nm, and over 30 km the ray rises 70 m: 5 %.
  const Daylight day = usualAir().daylight({at(0.0, 30.0), 1.0});
  const float per_km = Medium(MediumParameters{}).at(0.0).extinction[5];
  for (const float distance_km : {1.0F, 10.0F, 30.0F}) {
    const AirColumn air = day.airOver({1.0F, 0.0F, 0.0F}, distance_km * 1e3F);
    EXPECT_NEAR(-std::log(air.transmittance[1]) / (distance_km * per_km), 1.0F, 0.05F) << distance_km;
  }
}

TEST(AirBetween, ABlackWallFarAwayIsTheHorizonsSky) {
  std::vector<NightSky> nights(2);
  nights[1].moon = MoonInSky{at(60.0, 30.0), std::nullopt, 384400e3, Angle::degrees(20.0)};
  for (const double sun_deg : {40.0, 5.0, -4.0, -30.0}) {
    for (const NightSky& night : nights) {
      const Daylight day = usualAir().daylight({at(0.0, sun_deg), 1.0}, night);
      for (int azimuth_deg = 0; azimuth_deg < 360; azimuth_deg += 20) {
        const Eigen::Vector3f level = at(azimuth_deg, 0.0).vector().cast<float>();
        const AirColumn air = day.airOver(level, std::numeric_limits<float>::infinity());
        const LinearRgb sky = day.skyLuminance(level);
        EXPECT_LT(air.transmittance.maxCoeff(), 1e-3F);
        // Two tables of different steps.
        EXPECT_NEAR(LinearRgb(air.airlight).luminance() / sky.luminance(), 1.0F, 0.03F)
            << "sun " << sun_deg << "°, azimuth " << azimuth_deg;
      }
    }
  }
}

TEST(AirBetween, MoreAirDimsMoreAndShinesMore) {
  const Daylight day = usualAir().daylight({at(0.0, 10.0), 1.0});
  for (const double elevation_deg : {-30.0, -1.0, 0.0, 2.0, 30.0}) {
    const Eigen::Vector3f v = at(50.0, elevation_deg).vector().cast<float>();
    AirColumn before = day.airOver(v, 0.0F);
    for (float distance_m = 1.0F; distance_m < 1e6F; distance_m *= 1.3F) {
      const AirColumn now = day.airOver(v, distance_m);
      EXPECT_TRUE((now.transmittance <= before.transmittance).all()) << distance_m;
      EXPECT_TRUE((now.airlight >= before.airlight * 0.999F).all()) << distance_m;  // rounding of cut gamuts
      before = now;
    }
  }
}

TEST(AirBetween, HasNoSeams) {
  // A hundredth of a degree and one part in a thousand of distance are next to nothing, wherever the table's
  // nodes lie.
  const Daylight day = usualAir().daylight({at(137.0, 8.0), 1.0});
  for (int i = 0; i < 2000; ++i) {
    const double azimuth_deg = 0.18 * i;
    const double elevation_deg = 40.0 * std::sin(0.37 * i);
    const float distance_m = 10.0F * std::pow(10.0F, 4.0F * static_cast<float>(i % 97) / 97.0F);
    const AirColumn here = day.airOver(at(azimuth_deg, elevation_deg).vector().cast<float>(), distance_m);
    const AirColumn there =
        day.airOver(at(azimuth_deg + 0.01, elevation_deg + 0.01).vector().cast<float>(), 1.001F * distance_m);
    EXPECT_LT(((here.airlight - there.airlight).abs() / here.airlight).maxCoeff(), 0.015F) << i;
    EXPECT_LT((here.transmittance - there.transmittance).abs().maxCoeff(), 2e-3F) << i;
  }
}

}  // namespace
}  // namespace sunlit::sky
