/// Command line options of what lens and sensor make of the light, and how a picture is exposed; shared by
/// the tools that take pictures.
#pragma once

#include <optional>

#include "sunlit/studio/command_line.h"
#include "sunlit/studio/studio.h"

namespace sunlit::tools {

struct SensorWords {
  studio::ChainOptions chain;   ///< but for the mode of its exposure
  std::optional<double> ev100;  ///< empty: auto

  void putInto(studio::StudioOptions* options) const;
  /// Throws std::invalid_argument for an option that another one makes meaningless.
  void requireSense(const studio::CommandLine& line) const;
};

/// --ev, --compensation, --noise, and those of vignetting, glare, blur and mosaic.
void addSensor(studio::CommandLine* line, SensorWords* words);
/// Of tools whose camera moves: --line-delay, --exposure-time and --exposures.
void addShutter(studio::CommandLine* line, SensorWords* words);

}  // namespace sunlit::tools
