#include "sunlit/image/rain_streaks.h"

#include <algorithm>
#include <cmath>

#include "random_sequence.h"
#include "sunlit/quantity/angle.h"
#include "sunlit/quantity/raindrops.h"

namespace sunlit::image {
namespace {

constexpr double kSmallest_mm = 1.0, kFarthest_m = 5.0, kNearest_m = 0.1;

/// One drop in the optical frame.
struct Drop {
  double u, v;  ///< px, where it is at the middle of the exposure
  double depth_m;
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
  /// A square of even opacity.
  void splat(double u, double v, double depth_m, const Mark& mark) {
    const double half = 0.5 * mark.width_px, opacity = mark.area_px / (mark.width_px * mark.width_px);
    const int left = std::max(static_cast<int>(std::ceil(u - half - 0.5)), 0);
    const int right = std::min(static_cast<int>(std::floor(u + half + 0.5)), picture_.width - 1);
    const int top = std::max(static_cast<int>(std::ceil(v - half - 0.5)), 0);
    const int bottom = std::min(static_cast<int>(std::floor(v + half + 0.5)), picture_.height - 1);
    const auto overlap = [half](double middle, int pixel) {
      return std::max(0.0, std::min(middle + half, pixel + 0.5) - std::max(middle - half, pixel - 0.5));
    };
    for (int y = top; y <= bottom; ++y) {
      for (int x = left; x <= right; ++x) {
        if (*view_.depth.at(x, y) < static_cast<float>(depth_m)) continue;  // behind what is seen
        const auto share = static_cast<float>(std::min(opacity * overlap(u, x) * overlap(v, y), 1.0));
        float* const rgb = picture_.at(x, y);
        for (int c = 0; c < 3; ++c) rgb[c] += share * (rain_.luminance[c] - rgb[c]);
      }
    }
  }

  const RainStreaks& rain_;
  const RainedView& view_;
  LinearImage& picture_;
};

}  // namespace

void addRain(const RainStreaks& rain, const RainedView& view, LinearImage* picture) {
  if (!(rain.mm_per_h > 0.0)) return;
  const PinholeCamera& camera = view.camera;
  // Streaks whose middle is out of the picture show, too.
  const double margin = 0.1 * camera.height;
  const double wide = camera.width + 2.0 * margin, high = camera.height + 2.0 * margin;
  const double volume_m3 = wide * high / (camera.fx * camera.fy) * std::pow(kFarthest_m, 3) / 3.0;
  const double slope = raindropSlope(rain.mm_per_h);
  RandomSequence random(mixed(rain.series), static_cast<std::uint64_t>(rain.index) << 24U);
  const double count = random.poisson(volume_m3 * kRaindropsAtZero / slope * std::exp(-slope * kSmallest_mm));
  Painter painter(rain, view, picture);
  for (double i = 0.0; i < count; i += 1.0) {
    const double u = wide * random.uniform() - margin - 0.5, v = high * random.uniform() - margin - 0.5;
    const double z = kFarthest_m * std::cbrt(random.uniform());
    const double diameter_mm = kSmallest_mm - std::log1p(-random.uniform()) / slope;
    if (z < kNearest_m) continue;
    const double speed = 9.65 - 10.3 * std::exp(-0.6 * diameter_mm);
    const Eigen::Vector3d way = speed * rain.exposure_s * view.down;
    const Eigen::Vector3d place = z * camera.unproject({u, v});
    const Eigen::Vector2d path(camera.fx * (way.x() - place.x() / z * way.z()) / z,
                               camera.fy * (way.y() - place.y() / z * way.z()) / z);
    painter.paint({u, v, z, 1e-3 * diameter_mm * std::sqrt(camera.fx * camera.fy) / z, path});
  }
}

}  // namespace sunlit::image
