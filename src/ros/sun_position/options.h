/// What the sun_position node can be told; config/sun_position.yaml is its manual.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sunlit/astronomy/solar_coordinates.h"
#include "sunlit/quantity/instant.h"
#include "sunlit/quantity/site.h"
#include "sunlit/ros/conditions.h"
#include "sunlit/ros/frame_names.h"
#include "sunlit/ros/parameter_reader.h"

namespace sunlit::ros_interface {

/// One sun. Defaults are the paper's Table 1 at noon, in real time.
struct SunPositionOptions {
  CivilDateTime date_time{2024, 7, 1, 12, 0, 0.0, 3.0};
  double rate = 1.0;
  std::optional<double> start_stamp_s;  ///< nothing: at its start
  bool wait_for_subscriber = false;
  Site site{Angle::degrees(55.792115), Angle::degrees(49.122254), 90.0};
  Air air;
  astronomy::EarthRotation earth{0.0, 69.184};
  double publish_rate_hz = 10.0;
  double tf_distance_m = 100.0;
  std::string map_frame = kMapFrame;  ///< TF names
  std::string sun_frame = "sun";
  std::string moon_frame = "moon";
  std::string celestial_frame = "celestial";
};

std::vector<Field> fieldsOf(SunPositionOptions& options);

/// Rows of the node itself, beside those of each of its suns.
std::vector<Field> fieldsOfNode(double* diagnostic_period_s);

/// Throws std::invalid_argument naming parameter, value and range.
SunPositionOptions readSunPositionOptions(const ParameterReader& parameters);

/// A condition and its sun.
struct NamedSun {
  Condition condition;
  SunPositionOptions options;
};

/// All suns of one node. Throws as above, and for any parameter that nobody knows.
std::vector<NamedSun> readSuns(const ParameterReader& parameters);

}  // namespace sunlit::ros_interface
