/// The stars of the Bright Star Catalogue, from files that Debian ships.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

namespace sunlit::astronomy {

/// A star as it stands in a catalogue: mean place of epoch and equinox J2000, no proper motion.
struct CatalogueStar {
  Eigen::Vector3d towards;  ///< unit, in the axes that mapFromCelestial() takes
  double v_magnitude;       ///< visual
  double b_minus_v;         ///< colour index, −0.4 … 2; NaN: unknown
};

/// Where the files lie. An empty name: do without.
struct StarCatalogueFiles {
  /// Places and magnitudes; Debian package xplanet. A line has declination (deg), right ascension (h),
  /// magnitude, then, optionally, a name in double quotes and the number in the catalogue. '#' begins a
  /// comment.
  std::string places = "/usr/share/xplanet/stars/BSC";
  /// Spectral types of the brighter ones; Debian package openuniverse-common. A line is
  /// name,right ascension (rad),-,magnitude,type.
  std::string types = "/usr/share/openuniverse/data/stars.dat";
};

struct StarCatalogue {
  std::vector<CatalogueStar> stars;   ///< brightest first
  std::vector<std::string> warnings;  ///< for a person to read: what is missing, and how to get it
};

/// A file that does not exist is a warning that names its package: without places there are no stars, without
/// types most are of unknown colour. A line that cannot be understood throws std::runtime_error with file and
/// line.
///
/// Colours: the 27 brightest from the catalogue itself, the others by bMinusVOfType() where a star of the
/// same right ascension and magnitude has a type. (Declinations are not compared: those of the file of types
/// lack their degrees.) That is right to 0.1 as a rule; for single stars with a companion of another type,
/// and for supergiants, it is off by up to 0.4.
StarCatalogue readStarCatalogue(const StarCatalogueFiles& files = {});

/// B − V of a spectral class such as "K2", for the luminosity classes that prevail among stars seen by eye:
/// main sequence up to G0, giants from G5. NaN for other letters. Allen's Astrophysical Quantities (4th ed.
/// 2000), table 15.7.
double bMinusVOfType(const std::string& spectral_class);

}  // namespace sunlit::astronomy
