/// How weak sun and moon may be to be left out.
#pragma once

#include "sunlit/sky/daylight.h"

namespace sunlit::light {

/// A disc that gives less, on a plane facing it, than a thousandth of what lies on the ground changes no
/// pixel by a visible amount: such as the moon by day.
inline float leastDisc_lx(const sky::Daylight& day) {
  return 1e-3f * day.groundIlluminance().value.maxCoeff();
}

}  // namespace sunlit::light
