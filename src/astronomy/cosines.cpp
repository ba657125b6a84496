#include "astronomy/cosines.h"

#include "sunlit/quantity/angle.h"
#include "sunlit/quantity/vector_clones.h"

namespace sunlit::astronomy {
namespace {

// 2π in two parts (Cody and Waite): the first has 32 bits, so that up to 2^21 turns times it are exact.
constexpr double kTurnHigh = 0x1.921fb544p+2;
constexpr double kTurnLow = 0x1.0b4611a626331p-32;

// Adding 1.5 · 2^52 leaves no room for a fraction: the sum is rounded to a whole number.
constexpr double kRounder = 6755399441055744.0;

/// sin x for |x| ≤ π/2: Taylor's series to x^19, good to 3e-16 there.
inline double sine(double x) {
  const double x2 = x * x;
  double sum = -1.0 / 121645100408832000.0;
  sum = sum * x2 + 1.0 / 355687428096000.0;
  sum = sum * x2 - 1.0 / 1307674368000.0;
  sum = sum * x2 + 1.0 / 6227020800.0;
  sum = sum * x2 - 1.0 / 39916800.0;
  sum = sum * x2 + 1.0 / 362880.0;
  sum = sum * x2 - 1.0 / 5040.0;
  sum = sum * x2 + 1.0 / 120.0;
  sum = sum * x2 - 1.0 / 6.0;
  return x + x * x2 * sum;
}

}  // namespace

SUNLIT_VECTOR_CLONES
void cosines(double* values, int count) {
  for (int i = 0; i < count; ++i) {
    const double turns = (values[i] * (0.5 / kPi) + kRounder) - kRounder;
    const double in_turn = (values[i] - turns * kTurnHigh) - turns * kTurnLow;
    const double s = sine(0.5 * in_turn);
    values[i] = 1.0 - 2.0 * s * s;
  }
}

}  // namespace sunlit::astronomy
