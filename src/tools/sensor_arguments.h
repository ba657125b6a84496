/// Command line options of what lens and sensor make of the light, and how a picture is exposed; shared by
/// the tools that take pictures.
#pragma once

#include <optional>

#include "sunlit/studio/command_line.h"
#include "sunlit/studio/studio.h"

namespace sunlit::tools {

struct SensorWords {
  image::ExposureOptions exposure;  ///< but for its mode
  image::NoiseOptions noise;
  image::VignettingOptions vignetting;
  image::GlareOptions glare;
  image::BlurOptions blur;
  image::MosaicOptions mosaic;
  std::optional<double> ev100;  ///< empty: auto

  void putInto(studio::StudioOptions* options) const;
  /// Throws std::invalid_argument for an option that another one makes meaningless.
  void requireSense(const studio::CommandLine& line) const;
};

/// --ev, --compensation, --noise, and those of vignetting, glare, blur and mosaic.
void addSensor(studio::CommandLine* line, SensorWords* words);

}  // namespace sunlit::tools
