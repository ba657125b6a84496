#include "light/reference/sky_sampler.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "sunlit/quantity/angle.h"

namespace sunlit::light {
namespace {

constexpr float kTurn = static_cast<float>(2.0 * kPi);

/// Sine of the elevation of the lower edge of a row: a quadratic scale from the horizon up and down.
float edge(int row, int rows) {
  const float x = 2.0f * static_cast<float>(row) / static_cast<float>(rows) - 1.0f;
  return x * std::abs(x);
}

Eigen::Vector3f direction(float sine, float azimuth) {
  const float across = std::sqrt(std::max(0.0f, 1.0f - sine * sine));
  return {across * std::cos(azimuth), across * std::sin(azimuth), sine};
}

}  // namespace

SkySampler::SkySampler(const sky::Daylight& day) {
  std::vector<double> power;
  double sum = 0.0, sphere = 0.0;
  std::vector<double> solid_angles;
  for (int row = 0; row < kRows; ++row) {
    const float low = edge(row, kRows), high = edge(row + 1, kRows);
    const double solid_angle = static_cast<double>(high - low) * 2.0 * kPi / kColumns;
    for (int column = 0; column < kColumns; ++column) {
      const float azimuth = kTurn * (static_cast<float>(column) + 0.5f) / kColumns;
      const LinearRgb light = day.skyLuminance(direction(0.5f * (low + high), azimuth));
      power.push_back(static_cast<double>(light.luminance()) * solid_angle);
      solid_angles.push_back(solid_angle);
      sum += power.back();
      sphere += solid_angle;
    }
  }
  // A tenth goes evenly to all, for what the middle of a cell does not tell.
  double so_far = 0.0;
  for (std::size_t i = 0; i < power.size(); ++i) {
    const double bright = sum > 0.0 ? 0.9 * power[i] / sum : 0.9 * solid_angles[i] / sphere;
    const double probability = bright + 0.1 * solid_angles[i] / sphere;
    so_far += probability;
    up_to_.push_back(static_cast<float>(so_far));
    density_.push_back(static_cast<float>(probability / solid_angles[i]));
  }
}

Eigen::Vector3f SkySampler::sample(float first, float second) const {
  const auto found = std::upper_bound(up_to_.begin(), up_to_.end() - 1, first);
  const auto cell = static_cast<int>(found - up_to_.begin());
  const float before = cell == 0 ? 0.0f : *(found - 1);
  const float within = std::clamp((first - before) / std::max(*found - before, 1e-12f), 0.0f, 1.0f);
  const int row = cell / kColumns, column = cell % kColumns;
  const float low = edge(row, kRows), high = edge(row + 1, kRows);
  return direction(low + second * (high - low), kTurn * (static_cast<float>(column) + within) / kColumns)
      .normalized();
}

float SkySampler::density(const Eigen::Vector3f& towards) const {
  const float sine = std::clamp(towards.z(), -1.0f, 1.0f);
  const float place = 0.5f * (std::copysign(std::sqrt(std::abs(sine)), sine) + 1.0f);
  const int row = std::clamp(static_cast<int>(place * kRows), 0, kRows - 1);
  float turn = std::atan2(towards.y(), towards.x()) / kTurn;
  if (turn < 0.0f) turn += 1.0f;
  const int column = std::clamp(static_cast<int>(turn * kColumns), 0, kColumns - 1);
  return density_[static_cast<std::size_t>(row * kColumns + column)];
}

}  // namespace sunlit::light
