/// The axes of the stars against ERFA's matrices, ERFA's apparent places of stars, and SPA's sun.
#include "sunlit/astronomy/celestial.h"

#include <erfa.h>
#include <erfam.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <random>

#include "sunlit/astronomy/civil_time.h"
#include "sunlit/astronomy/delta_t.h"
#include "sunlit/astronomy/sun_position.h"

namespace sunlit::astronomy {
namespace {

constexpr double kArcsecPerRad = 3600.0 / kRadPerDeg;
using RowMajorMatrix = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;

double arcsecBetween(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b)) * kArcsecPerRad;
}

/// Random places and times of some years.
class Samples {
 public:
  Samples(int first_year, int last_year)
      : day_(julianDayNumber(first_year, 1, 1), julianDayNumber(last_year, 12, 31)) {}
  Instant instant() { return Instant(day_(random_), nanosecond_(random_)); }
  Site site() {
    return {Angle::radians(std::asin(sine_(random_))), Angle::degrees(180.0 * sine_(random_)), 100.0};
  }
  Eigen::Vector3d star() {
    return equatorial(Angle::degrees(180.0 * sine_(random_)), Angle::radians(std::asin(sine_(random_))));
  }

 private:
  std::mt19937_64 random_{11};
  std::uniform_int_distribution<std::int64_t> day_;
  std::uniform_int_distribution<std::int64_t> nanosecond_{0, Instant::kNanosecondsPerDay - 1};
  std::uniform_real_distribution<double> sine_{-1.0, 1.0};
};

TEST(Celestial, IsARotation) {
  Samples samples(-2000, 5999);
  for (int i = 0; i < 100; ++i) {
    const Eigen::Matrix3d r = mapFromCelestial(samples.instant(), EarthRotation(), samples.site());
    // The offset of the ICRS from the pole of J2000, 17 mas, is a rotation to first order only in eraLtpb.
    EXPECT_LT((r * r.transpose() - Eigen::Matrix3d::Identity()).norm(), 1e-13);
    EXPECT_NEAR(r.determinant(), 1.0, 1e-13);
  }
}

TEST(Celestial, AgreesWithTheMatricesOfErfa) {
  Samples samples(1900, 2099);
  double largest = 0.0;
  for (int i = 0; i < 500; ++i) {
    const Instant ut1 = samples.instant();
    const Site site = samples.site();
    const double delta_t_s = deltaT(ut1);
    const double day = static_cast<double>(ut1.julianDay());
    double rows[3][3];
    eraC2t06a(day, ut1.dayFraction() + delta_t_s / ERFA_DAYSEC, day, ut1.dayFraction(), 0.0, 0.0, rows);
    const Eigen::Matrix3d terrestrial = Eigen::Map<const RowMajorMatrix>(&rows[0][0]);
    const double lon = site.longitude.rad(), lat = site.latitude.rad();
    Eigen::Matrix3d map_from_terrestrial;
    map_from_terrestrial << -std::sin(lon), std::cos(lon), 0.0,                         //
        -std::sin(lat) * std::cos(lon), -std::sin(lat) * std::sin(lon), std::cos(lat),  //
        std::cos(lat) * std::cos(lon), std::cos(lat) * std::sin(lon), std::sin(lat);
    const Eigen::Matrix3d difference =
        mapFromCelestial(ut1, {0.0, delta_t_s}, site) * (map_from_terrestrial * terrestrial).transpose();
    largest = std::max(largest, Eigen::AngleAxisd(difference).angle() * kArcsecPerRad);
  }
  // SPA's nutation of 1980 and its sidereal time of 1982, whose precession is 0.3″ a century off.
  EXPECT_LT(largest, 1.0);
  std::printf("celestial axes against ERFA, 1900 to 2100: largest rotation %.3f arcsec\n", largest);
}

TEST(Celestial, StarsStandWhereErfaSeesThemToWithinAberration) {
  Samples samples(1973, 2016);  // years whose leap seconds ERFA knows
  double largest = 0.0;
  for (int i = 0; i < 500; ++i) {
    const Instant utc = samples.instant();
    const Site site = samples.site();
    const Eigen::Vector3d star = samples.star();
    double ra, dec, azimuth, zenith, hour_angle, apparent_dec, apparent_ra, origins, leap_s, longitude;
    const double towards[3] = {star.x(), star.y(), star.z()};
    eraC2s(const_cast<double*>(towards), &ra, &dec);
    longitude = site.longitude.rad();
    const double day = static_cast<double>(utc.julianDay());
    ASSERT_EQ(eraAtco13(ra, dec, 0.0, 0.0, 0.0, 0.0, day, utc.dayFraction(), 0.0, longitude,
                        site.latitude.rad(), site.elevation_m, 0.0, 0.0, 0.0, 0.0, 0.0, 0.55, &azimuth,
                        &zenith, &hour_angle, &apparent_dec, &apparent_ra, &origins),
              0);
    int year, month, day_of_month;
    double fraction;
    eraJd2cal(day, utc.dayFraction(), &year, &month, &day_of_month, &fraction);
    eraDat(year, month, day_of_month, fraction, &leap_s);
    const Eigen::Vector3d ours = mapFromCelestial(utc, {0.0, leap_s + ERFA_TTMTAI}, site) * star;
    const Direction expected(Azimuth(Angle::radians(azimuth)), Angle::degrees(90.0) - Angle::radians(zenith));
    largest = std::max(largest, arcsecBetween(ours, expected.vector()));
  }
  // Annual aberration is 20.8″ at the most, diurnal 0.3″, bending of light 1.8″ at the rim of the sun.
  EXPECT_LT(largest, 23.0);
  EXPECT_GT(largest, 15.0);  // or ours would have it too
}

TEST(Celestial, TheSunOfJ2000AxesIsSpas) {
  Samples samples(1900, 2099);
  for (int i = 0; i < 300; ++i) {
    const Instant ut1 = samples.instant();
    const Site site = samples.site();
    const double delta_t_s = deltaT(ut1);
    double heliocentric[2][3], barycentric[2][3];
    eraEpv00(static_cast<double>(ut1.julianDay()), ut1.dayFraction() + delta_t_s / ERFA_DAYSEC, heliocentric,
             barycentric);
    const Eigen::Vector3d sun(-heliocentric[0][0], -heliocentric[0][1], -heliocentric[0][2]);
    const Eigen::Vector3d velocity(barycentric[1][0], barycentric[1][1], barycentric[1][2]);
    constexpr double kLight_au_per_day = 173.1446326742403;
    const Eigen::Vector3d seen = sun.normalized() + velocity / kLight_au_per_day;
    const SunPosition spa = sunPosition(ut1, {0.0, delta_t_s}, site, Air{0.0, 0.0, Angle()});
    // Parallax 8.9″, SPA itself 0.6″.
    EXPECT_LT(arcsecBetween(mapFromCelestial(ut1, {0.0, delta_t_s}, site) * seen, spa.direction().vector()),
              9.6);
  }
}

TEST(Celestial, ThubanWasThePoleStarOfTheOldKingdom) {
  // α Dra, J2000: 14h 04m 23.3s, +64° 22′ 33″. It was nearest to the pole about 2787 BC, and the pole moves
  // by 20″ a year: 4.4° in 2000 BC, to half a degree.
  const Eigen::Vector3d thuban = equatorial(Angle::degrees(211.0973), Angle::degrees(64.3758));
  const Site north_pole{Angle::degrees(90.0), Angle(), 0.0};
  const Eigen::Vector3d then =
      mapFromCelestial(instantOf({-1999, 6, 1, 0, 0, 0.0, 0.0}), EarthRotation(), north_pole) * thuban;
  EXPECT_NEAR(Direction(then).elevation().deg(), 90.0 - 4.4, 0.5);
}

TEST(Celestial, PolarisStandsAtTheLatitude) {
  const Eigen::Vector3d polaris = equatorial(Angle::degrees(37.9546), Angle::degrees(89.2641));
  const Site site{Angle::degrees(55.792115), Angle::degrees(49.122254), 90.0};
  for (int hour = 0; hour < 24; ++hour) {
    const Eigen::Vector3d towards =
        mapFromCelestial(instantOf({2000, 1, 1, hour, 0, 0.0, 0.0}), EarthRotation(), site) * polaris;
    EXPECT_NEAR(Direction(towards).elevation().deg(), 55.792115, 0.75);
    EXPECT_LT(std::abs(towards.x()), 0.014);
    EXPECT_GT(towards.y(), 0.0);
  }
}

}  // namespace
}  // namespace sunlit::astronomy
