/// What the sun_position node can be told; config/sun_position.yaml is its manual.
#pragma once

#include <string>
#include <vector>

#include "sunlit/astronomy/solar_coordinates.h"
#include "sunlit/quantity/instant.h"
#include "sunlit/quantity/site.h"
#include "sunlit/ros/conditions.h"
#include "sunlit/ros/parameter_reader.h"

namespace sunlit::ros_interface {

/// One sun. Defaults are the paper's Table 1 at noon, in real time.
struct SunPositionOptions {
  CivilDateTime date_time{2024, 7, 1, 12, 0, 0.0, 3.0};
  double rate = 1.0;  ///< s of sun time a second of ROS time, −1e8 … 1e8; 0 freezes the sun
  bool wait_for_subscriber = false;  ///< of `sun`: until the first one comes, its clock stands at date_time
  Site site{Angle::degrees(55.792115), Angle::degrees(49.122254), 90.0};
  Air air;                                      ///< 1013.25 hPa, 0 °C, 0.5667°
  astronomy::EarthRotation earth{0.0, 69.184};  ///< s; delta_t without a value: from published polynomials
  double publish_rate_hz = 10.0;                ///< Hz, 0.01 … 1000
  double tf_distance_m = 100.0;   ///< m, 0.001 … 1e9: from the origin of `map` to those of `sun` and `moon`
  std::string sun_frame = "sun";  ///< TF names
  std::string moon_frame = "moon";
  std::string celestial_frame = "celestial";
};

/// Reads everything but the TF names. Throws std::invalid_argument naming parameter, value and range.
SunPositionOptions readSunPositionOptions(const ParameterReader& parameters);

/// A condition and its sun.
struct NamedSun {
  Condition condition;
  SunPositionOptions options;
};

/// All suns of one node. Throws as above, and for any parameter that nobody knows.
std::vector<NamedSun> readSuns(const ParameterReader& parameters);

}  // namespace sunlit::ros_interface
