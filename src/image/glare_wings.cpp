#include "glare_wings.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "rows.h"

namespace sunlit::image {
namespace {

/// 1 4 6 4 1, the samples `step` apart, once for each power of two: a variance of 1 + 4 + 16 + … and so, to a
/// percent, a Gaussian (the algorithm "à trous": Holschneider et al. 1989).
constexpr std::array<float, 3> kWeights = {6.0F / 16.0F, 4.0F / 16.0F, 1.0F / 16.0F};
constexpr int kOctaves = 6;
constexpr double kWidestPart = 0.25;  // of the longer side, standard deviation

/// Standard deviation after so many steps, px.
double widthAfter(int steps) {
  return std::sqrt((std::pow(4.0, steps) - 1.0) / 3.0);
}

int stepsFor(int longer_px) {
  int steps = 1;
  while (widthAfter(steps + 1) <= kWidestPart * longer_px) ++steps;
  return steps;
}

/// out[i] of the five lines, from far before to far behind.
void blend(const std::array<const float*, 5>& lines, std::size_t count, float* out) {
  const float *a = lines[0], *b = lines[1], *c = lines[2], *d = lines[3], *e = lines[4];
  for (std::size_t i = 0; i < count; ++i)
    out[i] = kWeights[0] * c[i] + kWeights[1] * (b[i] + d[i]) + kWeights[2] * (a[i] + e[i]);
}

void blurAcross(const LinearImage& from, int step, LinearImage* to) {
  eachRow(from.height, [&](int y) {
    thread_local std::vector<float> wide;
    copyWide(from, y, 2 * step, &wide);
    const std::size_t apart = 3 * static_cast<std::size_t>(step);
    const float* first = wide.data();
    blend({first, first + apart, first + 2 * apart, first + 3 * apart, first + 4 * apart},
          3 * static_cast<std::size_t>(from.width), to->at(0, y));
  });
}

/// Calls `done` with the number of each row of `to` as soon as it is there.
template <typename Done>
void blurDown(const LinearImage& from, int step, LinearImage* to, const Done& done) {
  const auto row = [&](int y) { return from.at(0, mirrored(y, from.height)); };
  eachRow(from.height, [&](int y) {
    blend({row(y - 2 * step), row(y - step), row(y), row(y + step), row(y + 2 * step)},
          3 * static_cast<std::size_t>(from.width), to->at(0, y));
    done(y);
  });
}

/// Of a point at `place`, with what comes in again at both ends, for each of `count` pixels; together 1.
std::vector<double> profile(double place, double width, int count) {
  std::vector<double> values;
  double sum = 0.0;
  for (int i = 0; i < count; ++i) {
    double value = 0.0;
    for (const double at : {static_cast<double>(i), -1.0 - i, 2.0 * count - 1.0 - i})
      value += std::exp(-0.5 * (at - place) * (at - place) / (width * width));
    values.push_back(value);
    sum += value;
  }
  for (double& value : values) value /= sum;
  return values;
}

}  // namespace

double addWings(const WingsFromBeyond& from, LinearImage* wings) {
  if (!(from.light > 0.0f).any()) return 1.0;  // behind the hood
  const int steps = stepsFor(std::max(wings->width, wings->height));
  const int kept = std::min(steps, kOctaves);
  double left = 1.0;
  for (int i = steps - kept; i < steps; ++i) {
    const double width = widthAfter(i + 1);
    const double part = std::exp(-0.5 * from.away_px * from.away_px / (width * width)) / kept;
    if (!(part > 1e-6)) continue;
    left -= part;
    const std::vector<double> across = profile(from.edge.x(), width, wings->width);
    const std::vector<double> down = profile(from.edge.y(), width, wings->height);
    eachRow(wings->height, [&](int y) {
      float* pixel = wings->at(0, y);
      for (int x = 0; x < wings->width; ++x, pixel += 3) {
        const auto there = static_cast<float>(part * down[static_cast<std::size_t>(y)] *
                                              across[static_cast<std::size_t>(x)]);
        for (int c = 0; c < 3; ++c) pixel[c] += there * from.light[c];
      }
    });
  }
  return left;
}

LinearImage glareWings(const LinearImage& picture) {
  const int steps = stepsFor(std::max(picture.width, picture.height));
  const int kept = std::min(steps, kOctaves);
  const float part = 1.0F / static_cast<float>(kept);
  LinearImage blurred = picture, across(picture.width, picture.height), sum(picture.width, picture.height);
  for (int i = 0; i < steps; ++i) {
    blurAcross(blurred, 1 << i, &across);
    blurDown(across, 1 << i, &blurred, [&](int y) {
      if (i < steps - kept) return;
      const float* from = blurred.at(0, y);
      float* to = sum.at(0, y);
      for (int k = 0; k < 3 * sum.width; ++k) to[k] += part * from[k];
    });
  }
  return sum;
}

}  // namespace sunlit::image
