/// The grain of a camera: light comes in single photons, and reading them out adds some.
#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "sunlit/image/exposure_program.h"
#include "sunlit/image/images.h"
#include "sunlit/image/picture_name.h"
#include "sunlit/quantity/field.h"

namespace sunlit::image {

/// Electrons are counted per pixel and channel, as by a camera with a sensor for each colour. Down to
/// `gain_ev100` the camera exposes so long that saturation fills the well, at its base sensitivity; in less
/// light its shutter and aperture are at their end (exposure_program.h), and the gain (ISO) rises: a picture
/// that is white at EV100 then holds full_well_e · 2^(EV100 − gain_ev100) electrons where it is white.
struct NoiseOptions {
  bool enabled = false;
  double full_well_e = 20000.0;
  double read_e = 3.0;
  double gain_ev100 = leastFullEv100();  ///< 5.9
  int seed = 0;
};

inline std::vector<Field> fieldsOf(NoiseOptions& options) {
  return {{"enabled", &options.enabled, "", {}, "shot noise and read noise of the sensor"},
          {"full_well_e",
           &options.full_well_e,
           "electrons",
           {100, 1e6},
           "of a white pixel at base sensitivity, down to gain_ev100"},
          {"read_e", &options.read_e, "electrons", {0, 1000}, "that reading a pixel out adds, rms"},
          {"gain_ev100",
           &options.gain_ev100,
           "EV",
           {-16, 24},
           "below it the gain rises; 5.9 is f/1.4 and 1/30 s"},
          {"seed",
           &options.seed,
           "",
           {0, std::numeric_limits<int>::max()},
           "another seed, other grain of the same strength"}};
}

/// Throws std::invalid_argument naming key, value and range.
void validate(const NoiseOptions& options);

/// Electrons that a pixel holds where a picture of this EV100 is just white.
double electronsAtSaturation(double ev100, const NoiseOptions& options);

/// Adds shot noise (Poisson: its variance is the number of electrons) and read noise (Gaussian) to `picture`
/// (cd/m², to be developed at `ev100`). The mean stays; values below zero may come out, as from a camera's
/// raw data. Depends on the arguments alone, with the same bits for any thread count.
void addSensorNoise(double ev100, const NoiseOptions& options, const PictureName& name, LinearImage* picture);

}  // namespace sunlit::image
