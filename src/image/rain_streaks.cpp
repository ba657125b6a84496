#include "sunlit/image/rain_streaks.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "random_sequence.h"
#include "sunlit/image/mean_luminance.h"
#include "sunlit/image/picture_name.h"
#include "sunlit/quantity/angle.h"
#include "sunlit/quantity/raindrops.h"

namespace sunlit::image {
namespace {

constexpr double kSmallest_mm = 1.0, kFarthest_m = 5.0, kNearest_m = 0.1;
constexpr double kCell_m = 1.0;        ///< of `map`, that drops are counted in
constexpr double kFastest_m_s = 9.65;  ///< that none falls faster than

/// m, in the optical frame.
struct Drop {
  Eigen::Vector3d middle;  ///< where it is at the middle of the exposure
  Eigen::Vector3d half;    ///< its way from there to the end of the exposure
  double diameter_m;

  Eigen::Vector3d at(double time) const { return middle + time * half; }
};

/// Opacity of drops, put on pixel after pixel.
class Painter {
 public:
  Painter(const RainStreaks& rain, const RainedView& view, LinearImage* picture)
      : rain_(rain),
        view_(view),
        picture_(*picture),
        focal_px_(std::sqrt(view.lens.camera().fx * view.lens.camera().fy)) {}

  void paint(const Drop& drop) { follow({drop, momentOf(drop, -1.0), momentOf(drop, 1.0)}, kHalvings); }

 private:
  static constexpr int kHalvings = 10;
  static constexpr double kDisc_px = 2.5;  ///< wider drops are discs, narrower ones squares
  struct Moment {
    double time;  ///< −1 … 1 from begin to end of the exposure
    Eigen::Vector3d place;
    std::optional<Eigen::Vector2d> pixel;  ///< nothing where the lens does not show it
  };
  struct Part {
    const Drop& drop;
    Moment from, to;
  };
  struct Mark {
    double width_px, area_px;
  };

  Moment momentOf(const Drop& drop, double time) const {
    Moment moment{time, drop.at(time), view_.lens.project(drop.at(time))};
    // Nearly beside a camera that shows no more than a half-space.
    constexpr double kFarOutside_px = 1e6;
    if (moment.pixel && !(moment.pixel->cwiseAbs().maxCoeff() < kFarOutside_px)) moment.pixel.reset();
    return moment;
  }
  double depthOf(const Eigen::Vector3d& place) const { return view_.lens.wide() ? place.norm() : place.z(); }
  double diameterOf(const Drop& drop, const Eigen::Vector3d& place) const {
    return drop.diameter_m * focal_px_ / depthOf(place);
  }

  /// A part of a drop's way, halved until each half is straight and evenly passed in the picture. What lies
  /// beside the picture is left out, and so is what the lens does not show, to a thousandth of the exposure.
  void follow(const Part& part, int halvings) {
    const Moment middle = momentOf(part.drop, 0.5 * (part.from.time + part.to.time));
    if (std::max(part.from.place.norm(), part.to.place.norm()) < kNearest_m) return;
    if (!part.from.pixel && !middle.pixel && !part.to.pixel) return;
    if (part.from.pixel && middle.pixel && part.to.pixel) {
      const double begin_m = depthOf(part.from.place), end_m = depthOf(part.to.place);
      const double bend = (*middle.pixel - 0.5 * (*part.from.pixel + *part.to.pixel)).norm();
      const double width =
          std::max({diameterOf(part.drop, part.from.place), diameterOf(part.drop, part.to.place), 1.0});
      if (isBeside(part, bend + width)) return;
      constexpr double kStraight_px = 0.1, kEven = 1.1;
      const bool is_even = std::max(begin_m, end_m) < kEven * std::min(begin_m, end_m);
      if ((bend < kStraight_px && is_even) || halvings == 0) return paintStraight(part, width);
    }
    if (halvings == 0) return;
    follow({part.drop, part.from, middle}, halvings - 1);
    follow({part.drop, middle, part.to}, halvings - 1);
  }

  /// Whether the picture has nothing of what lies within `reach_px` of the straight line.
  bool isBeside(const Part& part, double reach_px) const {
    const Eigen::Array2d size(picture_.width, picture_.height);
    const Eigen::Array2d from = part.from.pixel->array(), to = part.to.pixel->array();
    return (from.max(to) + reach_px < 0.0).any() || (from.min(to) - reach_px > size).any();
  }

  /// The drop's shadow, in pixels' areas, spread along its way: a wide one evenly, others in steps of half
  /// their width, `width_px` at most.
  void paintStraight(const Part& part, double width_px) {
    const Eigen::Vector2d from = *part.from.pixel, way = *part.to.pixel - from;
    const int steps = 1 + static_cast<int>(2.0 * way.norm() / width_px);
    if (steps > 1 && width_px > kDisc_px) return sweep(part);
    // Those in the picture: a way may be far longer.
    const Eigen::Vector2d size(picture_.width, picture_.height);
    double first = 0.0, last = 1.0;
    for (int i = 0; i < 2; ++i) {
      if (way[i] == 0.0) continue;
      const double low = (-width_px - from[i]) / way[i], high = (size[i] + width_px - from[i]) / way[i];
      first = std::clamp(std::min(low, high), first, 1.0);
      last = std::clamp(std::max(low, high), 0.0, last);
    }
    const double share = 0.5 * (part.to.time - part.from.time) / steps;  // of the exposure
    for (int i = static_cast<int>(first * steps); i < std::ceil(last * steps); ++i) {
      const double along = (i + 0.5) / steps;
      const Eigen::Vector3d place = part.from.place + along * (part.to.place - part.from.place);
      if (place.norm() < kNearest_m) continue;
      const double diameter_px = diameterOf(part.drop, place);
      splat(from + along * way, depthOf(place),
            {std::max(diameter_px, 1.0), share * 0.25 * kPi * diameter_px * diameter_px});
    }
  }

  /// The shadow of a drop several pixels wide, passed evenly: each pixel has it for as long as the disc takes
  /// to pass, so that the streak is even along its way.
  void sweep(const Part& part) {
    const Eigen::Vector2d from = *part.from.pixel, to = *part.to.pixel;
    const double length = (to - from).norm();
    const Eigen::Vector2d along = (to - from) / length;
    const double share = 0.5 * (part.to.time - part.from.time) / length;  // of the exposure, a pixel of way
    const double radius =
        0.25 * (diameterOf(part.drop, part.from.place) + diameterOf(part.drop, part.to.place));
    const double reach = radius + 0.5;
    const int top = std::max(0, static_cast<int>(std::ceil(std::min(from.y(), to.y()) - reach)));
    const int bottom =
        std::min(picture_.height - 1, static_cast<int>(std::floor(std::max(from.y(), to.y()) + reach)));
    for (int y = top; y <= bottom; ++y) {
      const auto [left, right] = rowOf(part, along, reach, y);
      for (int x = left; x <= right; ++x) {
        const Eigen::Vector2d off = Eigen::Vector2d(x, y) - from;
        const double at = along.dot(off);
        const double chord = halfChord(along.x() * off.y() - along.y() * off.x(), radius);
        const double passed = std::min(at + chord, length) - std::max(at - chord, 0.0);
        if (passed <= 0.0) continue;
        const Eigen::Vector3d place =
            part.from.place + std::clamp(at / length, 0.0, 1.0) * (part.to.place - part.from.place);
        if (place.norm() >= kNearest_m) cover(x, y, depthOf(place), share * passed);
      }
    }
  }

  /// The columns of row `y` that lie within `reach` of the part's line and ends.
  std::pair<int, int> rowOf(const Part& part, const Eigen::Vector2d& along, double reach, int y) const {
    const Eigen::Vector2d from = *part.from.pixel, to = *part.to.pixel;
    double left = std::min(from.x(), to.x()) - reach, right = std::max(from.x(), to.x()) + reach;
    if (std::abs(along.y()) > 1e-3) {
      const double middle = from.x() + (y - from.y()) * along.x() / along.y();
      left = std::max(left, middle - reach / std::abs(along.y()));
      right = std::min(right, middle + reach / std::abs(along.y()));
    }
    return {std::max(0, static_cast<int>(std::ceil(std::min(left, 1.0 * picture_.width)))),
            static_cast<int>(std::floor(std::min(right, picture_.width - 1.0)))};
  }

  /// Half of a disc's chords that pass at `off` from its middle, in the mean over a pixel's width.
  static double halfChord(double off, double radius) {
    const auto area = [radius](double to) {
      const double t = std::clamp(to / radius, -1.0, 1.0);
      return 0.5 * radius * radius * (t * std::sqrt(1.0 - t * t) + std::asin(t));
    };
    return area(off + 0.5) - area(off - 0.5);
  }

  void cover(int x, int y, double depth_m, double share) {
    if (*view_.depth.at(x, y) < static_cast<float>(depth_m)) return;  // behind what is seen
    const auto opacity = static_cast<float>(std::min(share, 1.0));
    float* const rgb = picture_.at(x, y);
    for (int c = 0; c < 3; ++c) rgb[c] += opacity * (rain_.luminance[c] - rgb[c]);
  }

  /// A disc whose edge is a pixel wide; of a pixel or two a square, whose middle is where it should be.
  void splat(const Eigen::Vector2d& middle, double depth_m, const Mark& mark) {
    const double u = middle.x(), v = middle.y();
    const double reach = 0.5 * mark.width_px + 0.5;
    const int left = static_cast<int>(std::ceil(u - reach)), right = static_cast<int>(std::floor(u + reach));
    const int top = static_cast<int>(std::ceil(v - reach)), bottom = static_cast<int>(std::floor(v + reach));
    const auto overlap = [&](double place, int pixel) {
      return std::clamp(reach - std::abs(pixel - place), 0.0, std::min(1.0, mark.width_px));
    };
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
        cover(x, y, depth_m, mark.area_px * covered(x, y) / all);
      }
    }
  }

  const RainStreaks& rain_;
  const RainedView& view_;
  LinearImage& picture_;
  double focal_px_;
};

/// Cells of space about a camera.
class Cells {
 public:
  Cells(const RainStreaks& rain, const RainedView& view)
      : eye_(view.map_from_optical.translation()),
        axis_(view.map_from_optical.linear().col(2)),
        widest_rad_(view.lens.widest().rad()),
        way_m_(0.5 * rain.exposure_s *
               (kFastest_m_s + rain.wind_m_s.norm() + view.motion.velocity_m_s.norm())),
        turn_rad_(0.5 * rain.exposure_s * view.motion.turning_rad_s.norm()) {}

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
  /// By the ball about a cell, and about where its drops come from and go to.
  bool seen(const Eigen::Vector3d& cell) const {
    const double radius_m = 0.5 * std::sqrt(3.0) * kCell_m;
    const Eigen::Vector3d middle = kCell_m * (cell.array() + 0.5).matrix() - eye_;
    const double away_m = middle.norm();
    if (away_m <= radius_m + way_m_) return true;
    if (away_m > kFarthest_m + radius_m) return false;
    // A drop's edge is seen while its middle is up to this far out of the picture.
    constexpr double kMargin_rad = 0.1;
    const double off_rad = std::acos(std::clamp(middle.dot(axis_) / away_m, -1.0, 1.0));
    return off_rad <= widest_rad_ + kMargin_rad + turn_rad_ + std::asin((radius_m + way_m_) / away_m);
  }

  Eigen::Vector3d eye_, axis_;
  double widest_rad_;
  double way_m_, turn_rad_;  ///< of half the exposure, at most
};

/// Drops as a camera sees them.
class Rain {
 public:
  Rain(const RainStreaks& rain, const RainedView& view)
      : rain_(rain),
        view_(view),
        optical_from_map_(view.map_from_optical.inverse()),
        slope_(raindropSlope(rain.mm_per_h)),
        in_cell_(kRaindropsAtZero / slope_ * std::exp(-slope_ * kSmallest_mm) * kCell_m * kCell_m * kCell_m),
        start_(randomStart(rain.seed, {rain.moment, "", rain.drive})) {}

  /// Those of a cell, from lowest corner on.
  void fallIn(const Eigen::Vector3d& cell, Painter* painter) const {
    std::uint64_t place = start_;
    for (const double coordinate : {cell.x(), cell.y(), cell.z()})
      place = mixed(place ^ static_cast<std::uint64_t>(static_cast<std::int64_t>(coordinate)));
    RandomSequence random(place, 0);
    const double count = std::floor(random.poisson(in_cell_) + 0.5);
    for (double i = 0.0; i < count; i += 1.0) {
      const double x = random.uniform(), y = random.uniform(), z = random.uniform();
      const double diameter_mm = kSmallest_mm - std::log1p(-random.uniform()) / slope_;
      if (const auto drop = dropAt(kCell_m * (cell + Eigen::Vector3d(x, y, z)), diameter_mm))
        painter->paint(*drop);
    }
  }

 private:
  /// At `place` in the middle of the exposure; nothing where it is too far away, or under a roof.
  std::optional<Drop> dropAt(const Eigen::Vector3d& place, double diameter_mm) const {
    const Eigen::Vector3d middle = optical_from_map_ * place;
    if (middle.norm() > kFarthest_m || (view_.open && !view_.open(place))) return std::nullopt;
    const Eigen::Vector3d from_eye = place - view_.map_from_optical.translation();
    const double speed = kFastest_m_s - 10.3 * std::exp(-0.6 * diameter_mm);
    const Eigen::Vector3d falls(rain_.wind_m_s.x(), rain_.wind_m_s.y(), -speed);
    const Eigen::Vector3d past =
        falls - view_.motion.velocity_m_s - view_.motion.turning_rad_s.cross(from_eye);
    return Drop{middle, 0.5 * rain_.exposure_s * (optical_from_map_.linear() * past), 1e-3 * diameter_mm};
  }

  const RainStreaks& rain_;
  const RainedView& view_;
  Eigen::Isometry3d optical_from_map_;
  double slope_;
  double in_cell_;  ///< drops, in the mean
  std::uint64_t start_;
};

}  // namespace

Eigen::Array3f dropLuminance(const LinearImage& picture, const Eigen::Array3f& illuminance_lx) {
  constexpr float kLampLit_cd_m2 = 1000.0f;
  const Eigen::Array3f most = illuminance_lx.max(kLampLit_cd_m2);
  LinearImage before = picture;
  for (std::size_t i = 0; i < before.data.size(); ++i) {
    float& value = before.data[i];
    const float limit = most[static_cast<Eigen::Index>(i % 3)];
    if (value > limit) value = limit;
  }
  return 0.5f * (meanLuminance(before).cast<float>() + illuminance_lx / kPiFloat);
}

void addRain(const RainStreaks& rain, const RainedView& view, LinearImage* picture) {
  if (!(rain.mm_per_h > 0.0)) return;
  const Rain drops(rain, view);
  Painter painter(rain, view, picture);
  Cells(rain, view).forEach([&](const Eigen::Vector3d& cell) { drops.fallIn(cell, &painter); });
}

}  // namespace sunlit::image
