#include "sunlit/image/sensor_noise.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "random_sequence.h"
#include "require_within.h"
#include "sunlit/image/exposure.h"
#include "sunlit/quantity/fingerprint.h"

namespace sunlit::image {
namespace {

constexpr std::uint64_t kNumbersAValue = 8;  // of a random sequence; poisson() and normal() take 6 at most
constexpr float kBrightest = 1e12F;          // cd/m², so that infinity stays a number
constexpr std::size_t kValuesAtOnce = 8192;  // for one thread

std::uint64_t startOf(int seed, const PictureName& name) {
  std::uint64_t start = mixed(static_cast<std::uint64_t>(seed));
  start = mixed(start ^ static_cast<std::uint64_t>(name.index));
  Fingerprint print;
  for (const char letter : name.series) print.add(static_cast<unsigned char>(letter));
  return mixed(start ^ print.value());
}

}  // namespace

void validate(const NoiseOptions& options) {
  requireWithin("full_well_e", options.full_well_e, 100.0, 1e6);
  requireWithin("read_e", options.read_e, 0.0, 1000.0);
  requireWithin("gain_ev100", options.gain_ev100, -16.0, 24.0);
  requireWithin("seed", options.seed, 0.0, 2147483647.0);
}

double electronsAtSaturation(double ev100, const NoiseOptions& options) {
  return options.full_well_e * std::exp2(std::min(0.0, ev100 - options.gain_ev100));
}

void addSensorNoise(double ev100, const NoiseOptions& options, const PictureName& name,
                    LinearImage* picture) {
  const double luminance_per_electron = saturationLuminance(ev100) / electronsAtSaturation(ev100, options);
  const std::uint64_t start = startOf(options.seed, name);
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, picture->data.size(), kValuesAtOnce),
                    [&](const tbb::blocked_range<std::size_t>& part) {
                      for (std::size_t i = part.begin(); i < part.end(); ++i) {
                        RandomSequence random(start, i * kNumbersAValue);
                        // NaN becomes black here, as it does in develop().
                        const float luminance = std::min(std::max(0.0F, picture->data[i]), kBrightest);
                        const double mean = luminance / luminance_per_electron;
                        const double electrons = random.poisson(mean) + options.read_e * random.normal();
                        picture->data[i] = static_cast<float>(electrons * luminance_per_electron);
                      }
                    });
}

}  // namespace sunlit::image
