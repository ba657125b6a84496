#include "sunlit/astronomy/star_catalogue.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <functional>
#include <limits>
#include <locale>
#include <map>
#include <sstream>
#include <stdexcept>

#include "sunlit/astronomy/celestial.h"
#include "sunlit/quantity/range.h"

namespace sunlit::astronomy {
namespace {

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

struct Place {
  double declination_deg = 0.0;
  double right_ascension_rad = 0.0;
  double magnitude = 0.0;
  int number = 0;  ///< in the Bright Star Catalogue; 0: not told
};

struct TypedStar {
  double right_ascension_rad;
  double magnitude;
  std::string type;
};

/// Calls `read` with every line that is neither empty nor a comment. False where there is no such file.
bool forEachLine(const std::string& path, const std::function<void(const std::string&)>& read) {
  std::ifstream file(path);
  if (!file) return false;
  int number = 0;
  for (std::string line; std::getline(file, line);) {
    ++number;
    const std::size_t first = line.find_first_not_of(" \t\r");
    if (first == std::string::npos || line[first] == '#') continue;
    try {
      read(line);
    } catch (const std::invalid_argument& error) {
      throw std::runtime_error(path + ":" + std::to_string(number) + ": " + error.what());
    }
  }
  if (file.bad()) throw std::runtime_error(path + ": cannot be read");
  return true;
}

Place placeOf(const std::string& line) {
  std::istringstream numbers(line);
  numbers.imbue(std::locale::classic());
  Place place;
  double right_ascension_h = 0.0;
  if (!(numbers >> place.declination_deg >> right_ascension_h >> place.magnitude))
    throw std::invalid_argument("is no star: declination, right ascension and magnitude are expected");
  require("declination", place.declination_deg, {-90.0, 90.0}, "deg");
  require("right ascension", right_ascension_h, {0.0, 24.0}, "h");
  require("magnitude", place.magnitude, {-30.0, 30.0});
  place.right_ascension_rad = right_ascension_h * kPi / 12.0;
  const std::size_t name_end = line.rfind('"');
  if (name_end != std::string::npos) std::istringstream(line.substr(name_end + 1)) >> place.number;
  return place;
}

TypedStar typedStarOf(const std::string& line) {
  std::vector<std::string> fields;
  std::istringstream columns(line);
  for (std::string field; std::getline(columns, field, ',');) fields.push_back(field);
  if (fields.size() != 5)
    throw std::invalid_argument("has " + std::to_string(fields.size()) + " fields instead of 5");
  std::istringstream numbers(fields[1] + " " + fields[3]);
  numbers.imbue(std::locale::classic());
  TypedStar star{0.0, 0.0, fields[4]};
  if (!(numbers >> star.right_ascension_rad >> star.magnitude))
    throw std::invalid_argument("has no numbers for right ascension and magnitude");
  return star;
}

/// Of the brightest stars, by their numbers: B − V of the Bright Star Catalogue (Hoffleit & Warren 1991). A
/// type would do most of them wrong: supergiants, and pairs that have one type.
double bMinusVOfBrightest(int number) {
  static const std::map<int, double> kColours{
      {424, 0.60},  {472, -0.16},  {1457, 1.54},  {1708, 0.80},  {1713, -0.03}, {2061, 1.85}, {2326, 0.15},
      {2491, 0.00}, {2618, -0.21}, {2943, 0.42},  {2990, 1.00},  {3982, -0.11}, {4301, 1.07}, {4730, -0.24},
      {4763, 1.59}, {4853, -0.23}, {5056, -0.23}, {5267, -0.23}, {5340, 1.23},  {5459, 0.71}, {5460, 0.88},
      {6134, 1.83}, {6527, -0.22}, {7001, 0.00},  {7557, 0.22},  {7924, 0.09},  {8728, 0.09}};
  const auto found = kColours.find(number);
  return found == kColours.end() ? kUnknown : found->second;
}

/// `types` by right ascension. Empty where none fits.
std::string typeOf(const Place& place, const std::vector<TypedStar>& types) {
  // 20″: the digits of the places, and nine years of proper motion between the epochs of the two files.
  constexpr double kReach_rad = 1e-4;
  constexpr double kMagnitudes = 0.2;  // pairs count as one star in one of them; such are left out
  const double reach = kReach_rad / std::max(0.2, std::cos(place.declination_deg * kRadPerDeg));
  const auto first = std::lower_bound(types.begin(), types.end(), place.right_ascension_rad - reach,
                                      [](const TypedStar& star, double right_ascension) {
                                        return star.right_ascension_rad < right_ascension;
                                      });
  std::string nearest;
  double distance = reach;
  for (auto star = first;
       star != types.end() && star->right_ascension_rad <= place.right_ascension_rad + reach; ++star) {
    const double apart = std::abs(star->right_ascension_rad - place.right_ascension_rad);
    if (std::abs(star->magnitude - place.magnitude) > kMagnitudes || apart > distance) continue;
    nearest = star->type;
    distance = apart;
  }
  return nearest;
}

std::string missing(const std::string& path, const std::string& consequence, const std::string& package) {
  return path + " cannot be read, so " + consequence + "; it is part of the Debian package " + package;
}

}  // namespace

double bMinusVOfType(const std::string& spectral_class) {
  struct Entry {
    double position;  // of the class: letter in tens, digit in ones
    double b_minus_v;
  };
  static const Entry kTable[] = {{5, -0.33}, {10, -0.30}, {15, -0.17}, {20, -0.02}, {25, 0.15},
                                 {30, 0.30}, {35, 0.44},  {40, 0.58},  {45, 0.86},  {50, 1.00},
                                 {55, 1.50}, {60, 1.56},  {62, 1.60},  {65, 1.63}};
  if (spectral_class.size() < 2) return kUnknown;
  const std::size_t letter = std::string("OBAFGKM").find(spectral_class[0]);
  const char digit = spectral_class[1];
  if (letter == std::string::npos || digit < '0' || digit > '9') return kUnknown;
  const double position = 10.0 * static_cast<double>(letter) + (digit - '0');
  if (position <= kTable[0].position) return kTable[0].b_minus_v;
  for (std::size_t i = 1; i < std::size(kTable); ++i) {
    if (position > kTable[i].position) continue;
    const double t = (position - kTable[i - 1].position) / (kTable[i].position - kTable[i - 1].position);
    return kTable[i - 1].b_minus_v + t * (kTable[i].b_minus_v - kTable[i - 1].b_minus_v);
  }
  return std::end(kTable)[-1].b_minus_v;
}

StarCatalogue readStarCatalogue(const StarCatalogueFiles& files) {
  StarCatalogue catalogue;
  std::vector<Place> places;
  if (files.places.empty()) return catalogue;
  if (!forEachLine(files.places, [&](const std::string& line) { places.push_back(placeOf(line)); })) {
    catalogue.warnings.push_back(missing(files.places, "there are no stars", "xplanet"));
    return catalogue;
  }
  std::vector<TypedStar> types;
  if (!files.types.empty() &&
      !forEachLine(files.types, [&](const std::string& line) { types.push_back(typedStarOf(line)); })) {
    catalogue.warnings.push_back(missing(files.types, "most stars are white", "openuniverse-common"));
  }
  std::stable_sort(types.begin(), types.end(), [](const TypedStar& a, const TypedStar& b) {
    return a.right_ascension_rad < b.right_ascension_rad;
  });
  std::stable_sort(places.begin(), places.end(),
                   [](const Place& a, const Place& b) { return a.magnitude < b.magnitude; });
  for (const Place& place : places) {
    const double known = bMinusVOfBrightest(place.number);
    catalogue.stars.push_back(
        {equatorial(Angle::radians(place.right_ascension_rad), Angle::degrees(place.declination_deg)),
         place.magnitude, std::isnan(known) ? bMinusVOfType(typeOf(place, types)) : known});
  }
  return catalogue;
}

}  // namespace sunlit::astronomy
