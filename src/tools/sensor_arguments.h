/// Command line options of how a picture is exposed and what its sensor adds; shared by the tools that take
/// pictures.
#pragma once

#include <optional>

#include "sunlit/image/exposure.h"
#include "sunlit/image/sensor_noise.h"
#include "sunlit/studio/command_line.h"

namespace sunlit::tools {

struct SensorWords {
  image::ExposureOptions exposure;  ///< but for its mode
  image::NoiseOptions noise;
  std::optional<double> ev100;  ///< empty: auto

  image::ExposureOptions exposureOptions() const;
  /// Throws std::invalid_argument for an option that another one makes meaningless.
  void requireSense(const studio::CommandLine& line) const;
};

/// --ev, --compensation and --noise.
void addSensor(studio::CommandLine* line, SensorWords* words);

}  // namespace sunlit::tools
