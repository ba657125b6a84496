#include "night_glow.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "ray_path.h"
#include "sunlit/quantity/angle.h"
#include "table_place.h"

namespace sunlit::sky {
namespace {

/// One star of V = 10 a square degree.
constexpr double kS10_cd_per_m2 = kZeroMagnitude_lx * 1e-4 / (kRadPerDeg * kRadPerDeg);

constexpr double kAirglowHeight_km = 90.0;

/// Photons a band, R: a continuum that grows from 0.23 R/Å at 395 nm over 0.28 at 515 nm and 0.40 at 575 nm
/// to 0.48 from 620 nm on; O I 557.7 nm 220 R, Na D 30 R, O I 630.0 and 636.4 nm 107 R, OH 290 R from 640 to
/// 740 nm. Lines are as in Leinert et al. 1998, table 13, each shared by the two bands whose middles are next
/// to it, or else that of 557.7 nm would be green instead of yellow-green. The continuum is what zodiacal
/// light and stars leave of the dark sky over Kitt Peak (Neugent & Massey 2010); over La Palma it has 0.44
/// R/Å at 672 nm (Viuho et al. 2025).
constexpr std::array<double, kBands> kAirglowPhotons = {69,  78,  84,  84,  84,  226,
                                                        229, 166, 256, 189, 206, 320};

Spectrum unitLuminance(const Spectrum& light) {
  return light / colourOf(light).luminance();
}

Spectrum airglowSpectrum() {
  Spectrum light;
  for (int band = 0; band < kBands; ++band) {
    light[band] = static_cast<float>(kAirglowPhotons[static_cast<std::size_t>(band)] / bandCentre_nm(band));
  }
  return unitLuminance(asBrightAsTheSun(light));
}

/// Brightening of a thin luminous layer away from the zenith (van Rhijn 1921).
double vanRhijn(double elevation) {
  const double s = std::cos(elevation) * kEarthRadius_km / (kEarthRadius_km + kAirglowHeight_km);
  return 1.0 / std::sqrt(1.0 - s * s);
}

/// Of what the whole air takes from a vertical beam: the part that it scatters.
Spectrum scatteredPart(const Medium& medium) {
  Spectrum scattered = Spectrum::Zero();
  Spectrum taken = Spectrum::Zero();
  for (double altitude_km = 0.25; altitude_km < kAtmosphereHeight_km; altitude_km += 0.5) {
    const LocalMedium air = medium.at(altitude_km);
    scattered += air.rayleigh_scattering + air.aerosol_scattering;
    taken += air.extinction;
  }
  return scattered / taken;
}

/// Mean light from all sides within air that is lit evenly from above with 1. Air that lets a part T through
/// in all sends 1 − T back, so the means at its top and bottom are (2 − T) / 2 and T (1 + albedo) / 2; T is
/// 0.7-0.9.
float lightWithin(float ground_albedo) {
  constexpr float kThrough = 0.8F;
  return 0.5F + 0.25F * kThrough * ground_albedo;
}

/// In J2000 equatorial coordinates, as the other directions of the celestial frame.
Eigen::Vector3d eclipticPole() {
  constexpr double kObliquity = 23.4392911 * kRadPerDeg;  // at J2000 (IAU 1976)
  return {0.0, -std::sin(kObliquity), std::cos(kObliquity)};
}

Eigen::Vector3d equatorial(double right_ascension_deg, double declination_deg) {
  const double a = right_ascension_deg * kRadPerDeg;
  const double d = declination_deg * kRadPerDeg;
  return {std::cos(d) * std::cos(a), std::cos(d) * std::sin(a), std::sin(d)};
}

}  // namespace

double zodiacalLight_cd_per_m2(Angle elongation, double sin_latitude) {
  const double deg = std::max(elongation.deg(), 15.0);
  const double sin_elongation = deg < 90.0 ? std::sin(deg * kRadPerDeg) : 1.0;
  const double fan = std::exp(-2.040 * std::abs(sin_latitude) / std::pow(sin_elongation, 0.454));
  const double at_poles =
      0.658 + 2.932 * std::pow(deg / 90.0, -2.048) * fan + 2.364 * std::exp((deg - 180.0) / 20.60);
  return 60.0 * kS10_cd_per_m2 * at_poles;
}

double milkyWay_cd_per_m2(double sin_latitude, double cos_longitude) {
  const double latitude_deg = std::asin(std::clamp(std::abs(sin_latitude), 0.0, 1.0)) / kRadPerDeg;
  return kS10_cd_per_m2 * (14.0 + 180.0 * (1.0 + 0.5 * cos_longitude) * std::exp(-latitude_deg / 13.0));
}

NightGlow::NightGlow(const RadiativeTransfer& transfer, const Extinction& extinction) {
  const Spectrum airglow = airglowSpectrum() * static_cast<float>(kAirglowZenith_cd_per_m2);
  const Spectrum sun = unitLuminance(Spectrum::Ones());
  const Spectrum starlight = unitLuminance(blackBody(5000.0));
  // Mean over the upper hemisphere of what comes in from above; rows are even in √elevation.
  Spectrum mean = sun * static_cast<float>(kMeanZodiacal_cd_per_m2) +
                  starlight * static_cast<float>(kMeanMilkyWay_cd_per_m2);
  for (int row = 0; row < Extinction::kRows; ++row) {
    const double elevation = Extinction::elevationOf(row);
    const double t = static_cast<double>(row) / (Extinction::kRows - 1);
    const double share = std::cos(elevation) * kPi * t / (Extinction::kRows - 1);
    mean += airglow * static_cast<float>(vanRhijn(elevation) * share);
  }
  const Medium& medium = transfer.medium();
  const auto albedo = static_cast<float>(medium.parameters().ground_albedo);
  const Spectrum air = mean * scatteredPart(medium) * lightWithin(albedo);
  for (int row = 0; row < Extinction::kRows; ++row) {
    const Spectrum& passed = extinction.transmittance(row);
    const auto longer = static_cast<float>(vanRhijn(Extinction::elevationOf(row)));
    rows_.push_back({paddedColourOf(airglow * longer * passed + air * (1.0F - passed)),
                     paddedColourOf(sun * passed), paddedColourOf(starlight * passed)});
  }
}

GlowSky NightGlow::sky(const NightSky& night, const Direction& sun) const {
  GlowSky sky;
  constexpr int kColumns = GlowSky::kColumns;
  sky.nodes_.resize(static_cast<std::size_t>(Extinction::kRows * kColumns));
  Eigen::Vector3d towards_ecliptic = Eigen::Vector3d::Zero();
  Eigen::Vector3d towards_galactic = Eigen::Vector3d::Zero();
  Eigen::Vector3d towards_centre = Eigen::Vector3d::Zero();
  if (night.map_from_celestial) {
    towards_ecliptic = *night.map_from_celestial * eclipticPole();
    towards_galactic = *night.map_from_celestial * equatorial(192.85948, 27.12825);  // IAU 1958, J2000
    towards_centre = *night.map_from_celestial * equatorial(266.40499, -28.93617);
  }
  tbb::parallel_for(0, Extinction::kRows, [&](int row) {
    const Row& seen = rows_[static_cast<std::size_t>(row)];
    for (int column = 0; column < kColumns; ++column) {
      double zodiacal = kMeanZodiacal_cd_per_m2;
      double galactic = kMeanMilkyWay_cd_per_m2;
      if (night.map_from_celestial) {
        const double elevation = Extinction::elevationOf(row);
        const double yaw = 2.0 * kPi * column / kColumns;
        const Eigen::Vector3d towards(std::cos(elevation) * std::cos(yaw),
                                      std::cos(elevation) * std::sin(yaw), std::sin(elevation));
        const double cos_elongation = std::clamp(towards.dot(sun.vector()), -1.0, 1.0);
        zodiacal =
            zodiacalLight_cd_per_m2(Angle::radians(std::acos(cos_elongation)), towards.dot(towards_ecliptic));
        const double sin_latitude = towards.dot(towards_galactic);
        const double cos_latitude = std::sqrt(std::max(1e-12, 1.0 - sin_latitude * sin_latitude));
        galactic = milkyWay_cd_per_m2(sin_latitude, towards.dot(towards_centre) / cos_latitude);
      }
      sky.nodes_[static_cast<std::size_t>(row * kColumns + column)] =
          seen.airglow + seen.zodiacal * static_cast<float>(zodiacal) +
          seen.galactic * static_cast<float>(galactic);
    }
  });
  return sky;
}

Eigen::Array3f GlowSky::luminance(const Eigen::Vector3f& towards) const {
  const TablePlace row = placeAt(Extinction::rowOf(elevationAboveHorizon(towards)), Extinction::kRows);
  const float from_east = azimuthFrom(Eigen::Vector2f::UnitX(), towards);
  const float yaw = towards.y() >= 0.0F ? from_east : static_cast<float>(2.0 * kPi) - from_east;
  const TablePlace column = placeAt(yaw * static_cast<float>(kColumns / (2.0 * kPi)), kColumns + 1);
  const int next = column.index + 1 == kColumns ? 0 : column.index + 1;
  const Eigen::Array4f* low = &nodes_[static_cast<std::size_t>(row.index * kColumns)];
  const Eigen::Array4f* high = low + kColumns;
  const float u = column.fraction;
  const float v = row.fraction;
  const Eigen::Array4f sum = low[column.index] * ((1.0F - u) * (1.0F - v)) + low[next] * (u * (1.0F - v)) +
                             high[column.index] * ((1.0F - u) * v) + high[next] * (u * v);
  return sum.head<3>();
}

}  // namespace sunlit::sky
