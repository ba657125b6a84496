/// What is told of an image beside its pixels.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "sunlit/quantity/instant.h"

namespace sunlit::evaluate {

/// How an image was taken.
struct CaptureRecord {
  std::int64_t pose = 0;
  std::int64_t stamp_ns = 0;
  double ev100 = 0.0;
  std::string exposure_mode;               ///< how that was chosen: "fixed" or "auto"
  double sun_azimuth_deg = 0.0;            ///< clockwise from north
  double sun_elevation_deg = 0.0;          ///< apparent
  double moon_azimuth_deg = 0.0;           ///< clockwise from north; NaN, as the next two, without a night
  double moon_elevation_deg = 0.0;         ///< apparent
  double moon_illuminated_fraction = 0.0;  ///< 0 new … 1 full
  double scene_illuminance_lx = 0.0;
  std::optional<Instant> utc = {};  ///< civil time of its sky, where it is told
  std::string utc_text = {};        ///< the same as it was told, or what was told instead of one
};

/// Where the camera stood, in `map`.
struct PlaceRecord {
  std::int64_t stamp_ns = 0;
  double x_m = 0.0, y_m = 0.0, z_m = 0.0;
  double yaw_deg = 0.0;  ///< of the camera's x axis, counter-clockwise from east
};

}  // namespace sunlit::evaluate
