#include "sunlit/image/lens_blur.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "finite_luminance.h"
#include "rows.h"

namespace sunlit::image {
namespace {

/// Weights of the pixels 0, 1, 2 … from the middle, of a Gaussian over their squares; the whole sums to 1.
std::vector<float> weightsOf(double sigma_px) {
  constexpr double kReach = 4.0;  // beyond it lie 6e-5 of the light
  const int reach = static_cast<int>(std::ceil(kReach * sigma_px));
  const auto below = [&](double x) { return 0.5 * std::erf(x / (std::sqrt(2.0) * sigma_px)); };
  const double all = 2.0 * below(reach + 0.5);
  std::vector<float> weights;
  for (int i = 0; i <= reach; ++i)
    weights.push_back(static_cast<float>((below(i + 0.5) - below(i - 0.5)) / all));
  return weights;
}

void addScaled(const float* from, float weight, std::size_t count, float* to) {
  for (std::size_t i = 0; i < count; ++i) to[i] += weight * from[i];
}

void blurAcross(const std::vector<float>& weights, LinearImage* picture) {
  const int reach = static_cast<int>(weights.size()) - 1;
  const std::size_t count = 3 * static_cast<std::size_t>(picture->width);
  eachRow(picture->height, [&](int y) {
    thread_local std::vector<float> wide;
    copyWide(*picture, y, reach, &wide);
    for (float& value : wide) value = finiteLuminance(value);
    float* row = picture->at(0, y);
    std::fill_n(row, count, 0.0F);
    for (int i = -reach; i <= reach; ++i)
      addScaled(wide.data() + 3 * (i + reach), weights[static_cast<std::size_t>(std::abs(i))], count, row);
  });
}

void blurDown(const std::vector<float>& weights, LinearImage* picture) {
  const LinearImage from = *picture;
  const int reach = static_cast<int>(weights.size()) - 1;
  const std::size_t count = 3 * static_cast<std::size_t>(from.width);
  eachRow(from.height, [&](int y) {
    float* row = picture->at(0, y);
    std::fill_n(row, count, 0.0F);
    for (int i = -reach; i <= reach; ++i)
      addScaled(from.at(0, mirrored(y + i, from.height)), weights[static_cast<std::size_t>(std::abs(i))],
                count, row);
  });
}

}  // namespace

void validate(const BlurOptions& options) {
  requireFields(options);
}

void blur(const BlurOptions& options, LinearImage* picture) {
  if (options.none()) return;
  const std::vector<float> weights = weightsOf(options.sigma_px);
  blurAcross(weights, picture);
  blurDown(weights, picture);
}

}  // namespace sunlit::image
