/// The command line of `snapshot`.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sunlit/quantity/angle.h"
#include "sunlit/quantity/field.h"
#include "tools/place_arguments.h"
#include "tools/view_arguments.h"

namespace sunlit::tools {

/// Of a sun alone, where there is no hour.
struct TypedSun {
  Angle azimuth = Angle::degrees(180.0);
  Angle elevation = Angle::degrees(40.0);
};

inline std::vector<Field> fieldsOf(TypedSun& sun) {
  return {{"azimuth", &sun.azimuth, "deg", {}, "clockwise from north"},
          {"elevation", &sun.elevation, "deg", {-90, 90}, ""}};
}

struct SnapshotOptions {
  ViewOptions view;
  PlaceOptions place;
  std::optional<double> hour;  ///< set: the sky of that hour over `place`
  TypedSun sun;
  std::string output;
  std::string depth_output;  ///< empty: none
};

/// Empty if help was asked for, and has been printed. Throws std::invalid_argument naming the option, its
/// value and what is allowed.
std::optional<SnapshotOptions> parseSnapshotOptions(const std::vector<std::string>& arguments);

}  // namespace sunlit::tools
