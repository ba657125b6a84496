#include "sunlit/image/shutter.h"

#include <algorithm>
#include <cmath>

#include "sunlit/image/exposure_program.h"

namespace sunlit::image {

void validate(const ShutterOptions& options) {
  requireFields(options);
}

double exposureTime_s(double ev100) {
  return std::min(kUsualStop * kUsualStop / std::exp2(ev100), kLongest_s);
}

double smearTime_s(const ShutterOptions& options, double ev100) {
  return options.exposure_ms ? 1e-3 * *options.exposure_ms : exposureTime_s(ev100);
}

double streakTime_s(const ShutterOptions& options, double ev100) {
  const double smear_s = smearTime_s(options, ev100);
  return smear_s > 0.0 ? smear_s : exposureTime_s(ev100);
}

}  // namespace sunlit::image
