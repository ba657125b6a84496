#include "sunlit/studio/other_site.h"

#include <gtest/gtest.h>

#include "sunlit/astronomy/civil_time.h"

namespace sunlit::studio {
namespace {

scene::WorldSite zurich() {
  return {{Angle::degrees(47.397742), Angle::degrees(8.545594), 488.0}, "field.world:7"};
}

Site moved(double north_deg, double east_deg, double up_m = 0.0) {
  Site site = zurich().site;
  site.latitude = Angle::degrees(site.latitude.deg() + north_deg);
  site.longitude = Angle::degrees(site.longitude.deg() + east_deg);
  site.elevation_m += up_m;
  return site;
}

Instant morning() {
  return astronomy::midnightOf({2024, 7, 1, 2.0}).plusSeconds(7.0 * 3600.0);
}

SkyBodies skyOf(const Site& site) {
  return bodiesAt(morning(), site);
}

SkyBodies sunAloneOf(const Site& site) {
  SkyBodies bodies = skyOf(site);
  bodies.moon.reset();
  bodies.map_from_celestial.reset();
  return bodies;
}

bool areSame(const Site& site) {
  const bool same = isSiteOf(zurich(), site);
  EXPECT_EQ(isSkyOver(zurich(), skyOf(site), morning()), same);
  EXPECT_EQ(isSkyOver(zurich(), sunAloneOf(site), morning()), same);
  return same;
}

TEST(OtherSites, AreNotThoseOfRoundedNumbers) {
  EXPECT_TRUE(areSame(zurich().site));
  EXPECT_TRUE(areSame({Angle::degrees(47.4), Angle::degrees(8.55), 490.0}));
}

TEST(OtherSites, AreThoseOfAnotherSunOrAnotherAir) {
  EXPECT_FALSE(areSame(moved(0.05, 0.0)));
  EXPECT_FALSE(areSame(moved(0.0, 0.1)));
  EXPECT_FALSE(areSame(moved(0.0, 180.0)));
  EXPECT_FALSE(areSame(moved(0.0, 0.0, -488.0)));
}

TEST(OtherSites, AreToldByTheStarsWhereTheSunStandsAlike) {
  // At the equinox the sun rises in the east all along a meridian.
  const Instant equinox = astronomy::midnightOf({2024, 3, 20, 0.0}).plusSeconds(3.1 * 3600.0 + 360.0);
  const scene::WorldSite equator{{Angle::degrees(0.0), Angle::degrees(45.0), 0.0}, ""};
  const Site north{Angle::degrees(0.5), Angle::degrees(45.0), 0.0};
  EXPECT_FALSE(isSkyOver(equator, bodiesAt(equinox, north), equinox));
}

TEST(OtherSites, AreToldAllAroundTheEarth) {
  const scene::WorldSite fiji{{Angle::degrees(-17.0), Angle::degrees(179.995), 0.0}, ""};
  EXPECT_TRUE(isSiteOf(fiji, {Angle::degrees(-17.0), Angle::degrees(-179.995), 0.0}));
}

TEST(OtherSites, AreNamedWithWhatToType) {
  EXPECT_EQ(otherSiteText(zurich()),
            "field.world:7: the sun is of another site than these <spherical_coordinates>: --site "
            "47.397742,8.545594,488, of launch files site:=\"[47.397742, 8.545594, 488]\"");
}

}  // namespace
}  // namespace sunlit::studio
