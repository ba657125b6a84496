/// The faint light that is there without sun and moon: airglow, zodiacal light, the Milky Way.
#pragma once

#include <Eigen/Core>
#include <Eigen/StdVector>
#include <vector>

#include "extinction.h"
#include "sunlit/quantity/direction.h"
#include "sunlit/sky/night.h"

namespace sunlit::sky {

/// Luminance of the glow by direction in `map`.
class GlowSky {
 public:
  static constexpr int kColumns = 96;  // by azimuth, counter-clockwise from east

  /// cd/m²; of the horizon below it.
  Eigen::Array3f luminance(const Eigen::Vector3f& towards) const;

 private:
  friend class NightGlow;
  std::vector<Eigen::Array4f, Eigen::aligned_allocator<Eigen::Array4f>> nodes_;  // rows as in Extinction
};

/// Zodiacal light above the air, cd/m², towards a direction `elongation` from the sun, whose ecliptic
/// latitude has the sine `sin_latitude`. Own fit to tables 16 and 17 of Leinert et al. 1998 (A&AS 127, 1):
/// rms 9 %, worst 25 %, from 15° of elongation; nearer to the sun as at 15°.
double zodiacalLight_cd_per_m2(Angle elongation, double sin_latitude);

/// Light of stars too faint to be drawn (V > 6.5) and starlight on dust, cd/m², by galactic latitude and the
/// cosine of the longitude; own fit to the run of integrated starlight in Leinert et al. 1998, section 10,
/// good to a factor of 1.5.
double milkyWay_cd_per_m2(double sin_latitude, double cos_longitude);

/// Means of the two over the whole sphere, of the first from 45° of elongation, as the night has it.
constexpr double kMeanZodiacal_cd_per_m2 = 1.0e-4;
constexpr double kMeanMilkyWay_cd_per_m2 = 4.5e-5;

/// Airglow at the zenith, above the air; varies by a factor of 2 with the sun's activity (Leinert et al.
/// 1998, section 6). With the zodiacal light and the stars away from their bands it makes 2e-4 cd/m², 21.8
/// mag a square arc second, of the colour of measured dark skies: CIE xy (0.36, 0.365), 4,600 K, B − V = 0.9.
/// That is a pale brown, as a camera balanced for daylight has it; an eye sees no colour at this level.
constexpr double kAirglowZenith_cd_per_m2 = 1.3e-4;

/// What does not change with the hour: how each part of the glow comes through the air, by elevation.
class NightGlow {
 public:
  NightGlow(const RadiativeTransfer& transfer, const Extinction& extinction);

  /// `sun` without refraction, in `map`. Without a celestial frame: the mean over the whole sky, with the
  /// airglow of each elevation.
  GlowSky sky(const NightSky& night, const Direction& sun) const;

 private:
  struct Row {
    Eigen::Array4f airglow;             // cd/m², with what the air scatters of all three
    Eigen::Array4f zodiacal, galactic;  // RGB seen of 1 cd/m² above the air
  };
  std::vector<Row, Eigen::aligned_allocator<Row>> rows_;
};

}  // namespace sunlit::sky
