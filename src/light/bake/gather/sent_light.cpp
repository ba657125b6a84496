#include "light/bake/gather/sent_light.h"

#include <tbb/parallel_for.h>

#include "sunlit/quantity/photometry.h"

namespace sunlit::light {
namespace {

PartSums sumsOf(const PassedOn& part, std::size_t sample) {
  return {part.coefficients.sum(sample) * Eigen::Map<const Eigen::Array3f>(part.tints[sample].data()),
          Eigen::Map<const Eigen::Array3f>(part.glows[sample].data())};
}

}  // namespace

SumsOfAll sumsOf(const TransportData& data) {
  SumsOfAll sums{std::vector<float>(data.sampleCount()), std::vector<PassedOnSums>(data.sampleCount())};
  tbb::parallel_for(std::size_t{0}, data.sampleCount(), [&](std::size_t i) {
    sums.direct[i] = data.direct.sum(i);
    sums.passed_on[i] = {sumsOf(data.above, i), sumsOf(data.below, i)};
  });
  return sums;
}

void store(const PartSums& sums, std::size_t sample, PassedOn* part) {
  part->glows[sample] = {sums.glow[0], sums.glow[1], sums.glow[2]};
  const float luminance = LinearRgb(sums.color).luminance();
  Eigen::Map<Eigen::Array3f>(part->tints[sample].data()) =
      luminance > 0.0f ? Eigen::Array3f(sums.color / luminance) : Eigen::Array3f(Eigen::Array3f::Ones());
}

}  // namespace sunlit::light
