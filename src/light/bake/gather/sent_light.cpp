#include "light/bake/gather/sent_light.h"

#include <tbb/parallel_for.h>

#include "sunlit/quantity/photometry.h"

namespace sunlit::light {
namespace {

Eigen::Array3f sumOf(const PassedOn& part, std::size_t sample) {
  return part.coefficients.sum(sample) * Eigen::Map<const Eigen::Array3f>(part.tints[sample].data());
}

}  // namespace

SumsOfAll sumsOf(const TransportData& data) {
  SumsOfAll sums{std::vector<Eigen::Array3f>(data.sampleCount()), std::vector<Arrived>(data.sampleCount())};
  tbb::parallel_for(std::size_t{0}, data.sampleCount(), [&](std::size_t i) {
    sums.direct[i] = data.directTint(i).times(Eigen::Array3f::Constant(data.direct.sum(i)));
    sums.passed_on[i] = {sumOf(data.above, i), sumOf(data.below, i)};
  });
  return sums;
}

void storeTint(const Eigen::Array3f& sum, std::size_t sample, PassedOn* part) {
  const float luminance = LinearRgb(sum).luminance();
  Eigen::Map<Eigen::Array3f>(part->tints[sample].data()) =
      luminance > 0.0f ? Eigen::Array3f(sum / luminance) : Eigen::Array3f(Eigen::Array3f::Ones());
}

}  // namespace sunlit::light
