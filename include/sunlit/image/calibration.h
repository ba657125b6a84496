/// A camera as its calibration file describes it.
#pragma once

#include <array>
#include <string>

#include "sunlit/image/lens.h"

namespace sunlit::image {

/// What camera_calibration writes and camera_info_manager reads; all numbers as they stand in the file.
struct Calibration {
  std::string name;  ///< camera_name
  PinholeCamera camera;
  Distortion distortion;
  std::array<double, 9> rectification{1, 0, 0, 0, 1, 0, 0, 0, 1};  ///< R, by rows
  std::array<double, 12> projection{};                             ///< P, by rows
};

/// YAML with image_width, image_height, camera_matrix, distortion_model (without it plumb_bob, as
/// camera_info_manager has it), distortion_coefficients, rectification_matrix and projection_matrix;
/// camera_name may be missing. How many coefficients there are is counted, whatever `rows` and `cols` say:
/// calibrators wrote cols: 5 for eight. Throws std::runtime_error naming file, line, key, value and what is
/// allowed, and for a picture that the lens cannot show, see Lens::widest().
Calibration readCalibration(const std::string& file);

/// Where people name such a file, kept at `file`.
inline Field calibrationRow(std::string* file) {
  return {"calibration",
          file,
          "",
          {},
          "a camera's own file, as camera_info_manager reads it: size, lens and all"};
}

/// Of a camera without distortion: plumb_bob with five zeros, R the identity, P as K.
Calibration calibrationOf(const PinholeCamera& camera);

/// What was typed beside a file: width, height or horizontal_fov, in px or deg, called as its author calls
/// it.
struct TypedBeside {
  std::string key, called;
  double value;
};
/// Throws std::invalid_argument naming both where `file`, which `calibration` was read from, says otherwise;
/// of the field of view, by more than 0.1 degrees.
void requireAgreement(const Calibration& calibration, const std::string& file, const TypedBeside& typed);

}  // namespace sunlit::image
