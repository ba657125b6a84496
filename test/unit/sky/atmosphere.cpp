#include "sunlit/sky/atmosphere.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "support/message_of.h"
#include "support/usual_air.h"

namespace sunlit::sky {
namespace {

AtmosphereOptions withTurbidity(double turbidity) {
  AtmosphereOptions options;
  options.turbidity = turbidity;
  return options;
}

SunInSky sunAt(double elevation_deg) {
  return {Direction(Azimuth::degrees(200.0), Angle::degrees(elevation_deg)), 1.0};
}

TEST(AtmosphereOptions, BadValuesAreNamedWithTheirRange) {
  EXPECT_EQ(messageOf([] { validate(AtmosphereOptions{}); }), "");
  EXPECT_EQ(messageOf([] { validate(withTurbidity(0.5)); }), "turbidity is 0.5, but must be from 1 to 10");
  EXPECT_EQ(messageOf([] { Atmosphere{withTurbidity(11.0)}; }), "turbidity is 11, but must be from 1 to 10");
  AtmosphereOptions options;
  options.ground_albedo = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(messageOf([&] { validate(options); }), "ground_albedo is nan, but must be from 0 to 1");
  options = {};
  options.ozone_du = 601.0;
  EXPECT_EQ(messageOf([&] { validate(options); }), "ozone is 601, but must be from 0 to 600 DU");
  options = {};
  options.observer_height_m = -1.0;
  EXPECT_EQ(messageOf([&] { validate(options); }), "observer_height is -1, but must be from 0 to 12000 m");
}

TEST(Atmosphere, ASunAtAnImpossibleDistanceIsRefused) {
  EXPECT_EQ(messageOf([] {
              usualAir().daylight({Direction(), 1.5});
            }),
            "distance_au is 1.5, but must be from 0.97 to 1.03 AU");
}

TEST(Atmosphere, OzoneDimsTheSunALittleAndMakesDuskBlue) {
  AtmosphereOptions options;
  options.ozone_du = 0.0;
  const Atmosphere without(options);
  // 300 DU are 8.1e22 molecules/m², whose Chappuis bands take up 4.9e-25 m² each at their height near 600 nm
  // and some half of that in the mean over what the eye sees: 1.5 to 3 % of a sun overhead.
  const float sun = usualAir().daylight(sunAt(89.9)).sun().illuminance.luminance() /
                    without.daylight(sunAt(89.9)).sun().illuminance.luminance();
  EXPECT_GT(sun, 0.97F);
  EXPECT_LT(sun, 0.985F);
  // Hulburt 1953: after sunset the zenith owes its blue to ozone.
  const auto blueness = [](const Atmosphere& atmosphere) {
    const LinearRgb zenith = atmosphere.daylight(sunAt(-4.0)).skyLuminance({0, 0, 1});
    return zenith.value[2] / zenith.value[0];
  };
  EXPECT_GT(blueness(usualAir()), 1.5F * blueness(without));
}

TEST(Atmosphere, HazeTakesFromTheSunAndGivesToTheSky) {
  const Daylight clear = usualAir().daylight(sunAt(40.0));
  const Daylight hazy = Atmosphere(withTurbidity(6.0)).daylight(sunAt(40.0));
  EXPECT_LT(hazy.sun().illuminance.luminance(), 0.85F * clear.sun().illuminance.luminance());
  const Eigen::Vector3f up(0, 0, 1);
  EXPECT_GT(hazy.skyIlluminance(up).luminance(), 1.2F * clear.skyIlluminance(up).luminance());
  // Haze is whiter than air.
  const auto blueness = [&](const Daylight& daylight) {
    const LinearRgb zenith = daylight.skyLuminance(up);
    return zenith.value[2] / zenith.value[0];
  };
  EXPECT_LT(blueness(hazy), blueness(clear));
}

TEST(Atmosphere, OnAMountainTheSunIsStrongerAndTheSkyDarker) {
  AtmosphereOptions high;
  high.observer_height_m = 4000.0;
  const Daylight mountain = Atmosphere(high).daylight(sunAt(50.0));
  const Daylight valley = usualAir().daylight(sunAt(50.0));
  EXPECT_GT(mountain.sun().illuminance.luminance(), valley.sun().illuminance.luminance());
  const Eigen::Vector3f up(0, 0, 1);
  EXPECT_LT(mountain.skyLuminance(up).luminance(), valley.skyLuminance(up).luminance());
}

TEST(Atmosphere, BrightLandBrightensTheSky) {
  AtmosphereOptions snow;
  snow.ground_albedo = 0.8;
  const Eigen::Vector3f up(0, 0, 1);
  EXPECT_GT(Atmosphere(snow).daylight(sunAt(30.0)).skyIlluminance(up).luminance(),
            1.05F * usualAir().daylight(sunAt(30.0)).skyIlluminance(up).luminance());
}

}  // namespace
}  // namespace sunlit::sky
