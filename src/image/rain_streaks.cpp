#include "sunlit/image/rain_streaks.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "random_sequence.h"
#include "sunlit/image/picture_name.h"
#include "sunlit/quantity/angle.h"
#include "sunlit/quantity/raindrops.h"

namespace sunlit::image {
namespace {

constexpr double kSmallest_mm = 1.0, kFarthest_m = 5.0, kNearest_m = 0.1;
constexpr double kCell_m = 1.0;  ///< of `map`, that drops are counted in

/// One drop in the picture.
struct Drop {
  double u, v;     ///< px, where it is at the middle of the exposure
  double depth_m;  ///< as the picture's are
  double diameter_px;
  Eigen::Vector2d path_px;  ///< during the exposure
};

/// Opacity of one drop, put on pixel after pixel.
class Painter {
 public:
  Painter(const RainStreaks& rain, const RainedView& view, LinearImage* picture)
      : rain_(rain), view_(view), picture_(*picture) {}

  void paint(const Drop& drop) {
    // The drop's shadow, in pixels' areas, spread along its way in steps of half its width.
    const double width = std::max(drop.diameter_px, 1.0);
    const Eigen::Vector2d reach = 0.5 * drop.path_px.cwiseAbs().array() + width;
    if (drop.u + reach.x() < 0.0 || drop.u - reach.x() > picture_.width) return;
    if (drop.v + reach.y() < 0.0 || drop.v - reach.y() > picture_.height) return;
    const double area = 0.25 * kPi * drop.diameter_px * drop.diameter_px;
    const int steps = 1 + static_cast<int>(2.0 * drop.path_px.norm() / width);
    for (int i = 0; i < steps; ++i) {
      const double along = (i + 0.5) / steps - 0.5;
      splat(drop.u + along * drop.path_px.x(), drop.v + along * drop.path_px.y(), drop.depth_m,
            {width, area / steps});
    }
  }

 private:
  struct Mark {
    double width_px, area_px;
  };
  /// A disc whose edge is a pixel wide; of a pixel or two a square, whose middle is where it should be.
  void splat(double u, double v, double depth_m, const Mark& mark) {
    const double reach = 0.5 * mark.width_px + 0.5;
    const int left = static_cast<int>(std::ceil(u - reach)), right = static_cast<int>(std::floor(u + reach));
    const int top = static_cast<int>(std::ceil(v - reach)), bottom = static_cast<int>(std::floor(v + reach));
    const auto overlap = [&](double middle, int pixel) {
      return std::clamp(reach - std::abs(pixel - middle), 0.0, std::min(1.0, mark.width_px));
    };
    constexpr double kDisc_px = 2.5;
    const bool disc = mark.width_px > kDisc_px;
    const auto covered = [&](int x, int y) {
      const double off_x = x - u, off_y = y - v;
      return disc ? std::clamp(reach - std::sqrt(off_x * off_x + off_y * off_y), 0.0, 1.0)
                  : overlap(u, x) * overlap(v, y);
    };
    // Of all pixels together; of a disc by its integral, which is within a percent.
    const double all =
        disc ? kPi * (0.25 * mark.width_px * mark.width_px + 1.0 / 12.0) : mark.width_px * mark.width_px;
    for (int y = std::max(top, 0); y <= std::min(bottom, picture_.height - 1); ++y) {
      for (int x = std::max(left, 0); x <= std::min(right, picture_.width - 1); ++x) {
        if (*view_.depth.at(x, y) < static_cast<float>(depth_m)) continue;  // behind what is seen
        const auto share = static_cast<float>(std::min(mark.area_px * covered(x, y) / all, 1.0));
        float* const rgb = picture_.at(x, y);
        for (int c = 0; c < 3; ++c) rgb[c] += share * (rain_.luminance[c] - rgb[c]);
      }
    }
  }

  const RainStreaks& rain_;
  const RainedView& view_;
  LinearImage& picture_;
};

/// Cells of space about a camera.
class Cells {
 public:
  explicit Cells(const RainedView& view)
      : eye_(view.map_from_optical.translation()),
        axis_(view.map_from_optical.linear().col(2)),
        widest_rad_(view.lens.widest().rad()) {}

  /// Calls visit(lowest corner) for those that the camera may see drops in.
  template <typename Visit>
  void forEach(const Visit& visit) const {
    const Eigen::Vector3d low = ((eye_.array() - kFarthest_m) / kCell_m).floor();
    const int across = static_cast<int>(2.0 * kFarthest_m / kCell_m) + 1;
    for (int i = 0; i < across * across * across; ++i) {
      const Eigen::Vector3d cell =
          low + Eigen::Vector3d(i % across, i / across % across, i / (across * across));
      if (seen(cell)) visit(cell);
    }
  }

 private:
  /// By the ball about a cell.
  bool seen(const Eigen::Vector3d& cell) const {
    const double radius_m = 0.5 * std::sqrt(3.0) * kCell_m;
    const Eigen::Vector3d middle = kCell_m * (cell.array() + 0.5).matrix() - eye_;
    const double away_m = middle.norm();
    if (away_m <= radius_m) return true;
    if (away_m > kFarthest_m + radius_m) return false;
    // A streak begins up to this far out of the picture.
    constexpr double kMargin_rad = 0.1;
    const double off_rad = std::acos(std::clamp(middle.dot(axis_) / away_m, -1.0, 1.0));
    return off_rad <= widest_rad_ + kMargin_rad + std::asin(radius_m / away_m);
  }

  Eigen::Vector3d eye_, axis_;
  double widest_rad_;
};

/// Drops as a camera sees them.
class Rain {
 public:
  Rain(const RainStreaks& rain, const RainedView& view)
      : rain_(rain),
        view_(view),
        optical_from_map_(view.map_from_optical.inverse()),
        focal_px_(std::sqrt(view.lens.camera().fx * view.lens.camera().fy)),
        slope_(raindropSlope(rain.mm_per_h)),
        in_cell_(kRaindropsAtZero / slope_ * std::exp(-slope_ * kSmallest_mm) * kCell_m * kCell_m * kCell_m),
        start_(randomStart(rain.seed, {rain.moment, ""})) {}

  /// Those of a cell, from lowest corner on.
  void fallIn(const Eigen::Vector3d& cell, Painter* painter) const {
    std::uint64_t place = start_;
    for (const double coordinate : {cell.x(), cell.y(), cell.z()})
      place = mixed(place ^ static_cast<std::uint64_t>(static_cast<std::int64_t>(coordinate)));
    RandomSequence random(place, 0);
    const double count = random.poisson(in_cell_);
    for (double i = 0.0; i < count; i += 1.0) {
      const double x = random.uniform(), y = random.uniform(), z = random.uniform();
      const double diameter_mm = kSmallest_mm - std::log1p(-random.uniform()) / slope_;
      if (const auto drop = seen(kCell_m * (cell + Eigen::Vector3d(x, y, z)), diameter_mm))
        painter->paint(*drop);
    }
  }

 private:
  /// At `place` in the middle of the exposure.
  std::optional<Drop> seen(const Eigen::Vector3d& place, double diameter_mm) const {
    const Eigen::Vector3d middle = optical_from_map_ * place;
    const double away_m = middle.norm();
    if (away_m < kNearest_m || away_m > kFarthest_m) return std::nullopt;
    if (view_.open && !view_.open(place)) return std::nullopt;
    const Eigen::Vector3d from_eye = place - view_.map_from_optical.translation();
    const double speed = 9.65 - 10.3 * std::exp(-0.6 * diameter_mm);
    const Eigen::Vector3d falls(rain_.wind_m_s.x(), rain_.wind_m_s.y(), -speed);
    const Eigen::Vector3d past =
        falls - view_.motion.velocity_m_s - view_.motion.turning_rad_s.cross(from_eye);
    const Eigen::Vector3d half = 0.5 * rain_.exposure_s * (optical_from_map_.linear() * past);
    const std::optional<Eigen::Vector2d> at = view_.lens.project(middle);
    if (!at) return std::nullopt;
    const std::optional<Eigen::Vector2d> from = view_.lens.project(middle - half),
                                         to = view_.lens.project(middle + half);
    if (!from || !to) return std::nullopt;  // passes the camera itself
    const double depth_m = view_.lens.wide() ? away_m : middle.z();
    return Drop{at->x(), at->y(), depth_m, 1e-3 * diameter_mm * focal_px_ / depth_m, *to - *from};
  }

  const RainStreaks& rain_;
  const RainedView& view_;
  Eigen::Isometry3d optical_from_map_;
  double focal_px_;
  double slope_;
  double in_cell_;  ///< drops, in the mean
  std::uint64_t start_;
};

}  // namespace

void addRain(const RainStreaks& rain, const RainedView& view, LinearImage* picture) {
  if (!(rain.mm_per_h > 0.0)) return;
  const Rain drops(rain, view);
  Painter painter(rain, view, picture);
  Cells(view).forEach([&](const Eigen::Vector3d& cell) { drops.fallIn(cell, &painter); });
}

}  // namespace sunlit::image
