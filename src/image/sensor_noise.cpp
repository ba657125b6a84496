#include "sunlit/image/sensor_noise.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "finite_luminance.h"
#include "random_sequence.h"
#include "sunlit/image/exposure.h"

namespace sunlit::image {
namespace {

constexpr std::uint64_t kNumbersAValue = 8;  // of a random sequence; poisson() and normal() take 6 at most
constexpr std::size_t kValuesAtOnce = 8192;  // for one thread

}  // namespace

void validate(const NoiseOptions& options) {
  requireFields(options);
}

double electronsAtSaturation(double ev100, const NoiseOptions& options) {
  return options.full_well_e * std::exp2(std::min(0.0, ev100 - options.gain_ev100));
}

void addSensorNoise(double ev100, const NoiseOptions& options, const PictureName& name,
                    LinearImage* picture) {
  const double luminance_per_electron = saturationLuminance(ev100) / electronsAtSaturation(ev100, options);
  const std::uint64_t start = randomStart(static_cast<std::uint64_t>(options.seed), name);
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, picture->data.size(), kValuesAtOnce),
                    [&](const tbb::blocked_range<std::size_t>& part) {
                      for (std::size_t i = part.begin(); i < part.end(); ++i) {
                        RandomSequence random(start, i * kNumbersAValue);
                        const double mean = finiteLuminance(picture->data[i]) / luminance_per_electron;
                        const double electrons = random.poisson(mean) + options.read_e * random.normal();
                        picture->data[i] = static_cast<float>(electrons * luminance_per_electron);
                      }
                    });
}

}  // namespace sunlit::image
