#include "render/image_motion.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

namespace sunlit::render {

namespace {

/// What all but the fastest twentieth stay below; 0 of none.
double withoutFastest(std::vector<double>* speeds) {
  if (speeds->empty()) return 0.0;
  const auto nth = speeds->begin() + static_cast<std::ptrdiff_t>(speeds->size() * 19 / 20);
  std::nth_element(speeds->begin(), nth, speeds->end());
  return *nth;
}

}  // namespace

double imageMotion_px_s(const image::DepthImage& depth, const image::Lens& lens, const Motion& motion) {
  constexpr double kFar_m = 1e6, kMoment_s = 1e-5;
  // Seen from the camera all goes the other way.
  const Eigen::Isometry3d seen_then = motion.after(kMoment_s, Eigen::Vector3d::Zero()).inverse();
  // `all` null: of things alone.
  const auto look = [&](int step_px, std::vector<double>* all, std::vector<double>* things) {
    for (int y = step_px / 2; y < depth.height; y += step_px) {
      for (int x = step_px / 2; x < depth.width; x += step_px) {
        const auto metres = static_cast<double>(*depth.at(x, y));
        const bool sky = !std::isfinite(metres);
        if (sky && all == nullptr) continue;
        const std::optional<Eigen::Vector3d> ray = lens.unproject({x, y});
        if (!ray) continue;
        const std::optional<Eigen::Vector2d> then =
            lens.project(seen_then * ((sky ? kFar_m : metres) * *ray));
        if (!then) continue;
        const double speed = (*then - Eigen::Vector2d(x, y)).norm() / kMoment_s;
        if (all != nullptr) all->push_back(speed);
        if (!sky) things->push_back(speed);
      }
    }
  };
  constexpr int kStep_px = 8;
  constexpr std::size_t kFew = 200;
  std::vector<double> all, things;
  look(kStep_px, &all, &things);
  if (things.size() < kFew) {  // a post may stand between points that far apart
    things.clear();
    look(1, nullptr, &things);
  }
  // A sign before the sky is what such a picture is taken for.
  return std::max(withoutFastest(&all), withoutFastest(&things));
}

int exposuresOf(double smear_px, int most) {
  return static_cast<int>(std::clamp(std::ceil(smear_px), 1.0, static_cast<double>(most)));
}

int bandCount(double skew_px, int height) {
  constexpr double kWithinBand_px = 0.25;
  constexpr int kFewestRows = 4;
  int bands = 1;
  while (bands < kMostBands && bands * kWithinBand_px < skew_px) bands *= 4;
  return std::max(1, std::min(bands, height / kFewestRows));
}

image::PinholeCamera shifted(const image::PinholeCamera& camera, int pattern) {
  if (pattern == 0) return camera;
  // A lattice that is its own opposite: point 15 - i lies across the middle from point i. Pairs that follow
  // each other are far apart.
  constexpr std::array<int, kPatterns / 2> kFirst = {0, 4, 2, 6, 1, 5, 3, 7};
  constexpr int kAlong = 7, kFrom = 3;
  const int pair = (pattern - 1) / 2, first = kFirst[static_cast<std::size_t>(pair)];
  const int point = pattern % 2 == 1 ? first : kPatterns - 1 - first;
  image::PinholeCamera aside = camera;
  aside.cx += (point + 0.5) / kPatterns - 0.5;
  aside.cy += ((point * kAlong + kFrom) % kPatterns + 0.5) / kPatterns - 0.5;
  return aside;
}

int patternOf(int exposure, int exposures) {
  if (exposures % 2 == 0) return 1 + exposure % kPatterns;
  return exposure == 0 ? 0 : 1 + (exposure - 1) % kPatterns;
}

image::PinholeCamera rowsOf(const image::PinholeCamera& camera, int first, int count) {
  image::PinholeCamera rows = camera;
  rows.height = count;
  rows.cy -= first;
  return rows;
}

}  // namespace sunlit::render
