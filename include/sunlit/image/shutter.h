/// When the rows of a sensor see light, and for how long.
#pragma once

#include <optional>
#include <vector>

#include "sunlit/quantity/field.h"

namespace sunlit::image {

/// The default is a global shutter that takes no time: what moves is sharp and straight.
struct ShutterOptions {
  double line_delay_us = 0.0;
  std::optional<double> exposure_ms = 0.0;  ///< nothing: exposureTime_s() of each picture
  int exposures = 16;

  bool none() const { return line_delay_us == 0.0 && exposure_ms == 0.0; }
};

inline std::vector<Field> fieldsOf(ShutterOptions& options) {
  return {
      {"line_delay",
       &options.line_delay_us,
       "us",
       {0, 1000},
       "from one row to the next, whose middle of exposure is the stamp's for the first; 0: all at once"},
      {"exposure_time",
       NumberOrWord{&options.exposure_ms, "auto"},
       "ms",
       {0, 1000},
       "that smears what moves; auto: by the light, f/2.8 at ISO 100 and 1/30 s at most; 0: sharp"},
      {"exposures", &options.exposures, "", {2, 64}, "pictures at most that a smeared one is the mean of"}};
}

/// Throws std::invalid_argument naming key, value and range.
void validate(const ShutterOptions& options);

/// Time that a picture of this EV100 is exposed for (exposure_program.h): by f/2.8 at ISO 100, 1/30 s at
/// most.
double exposureTime_s(double ev100);
/// That smears what moves; 0: nothing does.
double smearTime_s(const ShutterOptions& options, double ev100);
/// That a drop of rain is seen for: as above, and by the light where nothing else is smeared.
double streakTime_s(const ShutterOptions& options, double ev100);

}  // namespace sunlit::image
