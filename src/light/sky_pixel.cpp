#include "light/sky_pixel.h"

#include <cmath>

#include "sunlit/quantity/angle.h"

namespace sunlit::light {
namespace {
constexpr int kDiscGrid = 8;  ///< points a pixel and axis that the disc's edge is averaged over
}

SkyPixel::SkyPixel(const Surfaces& surfaces, const sky::Daylight& day)
    : surfaces_(surfaces), daylight_(day), towards_sun_(day.sun().towards.vector().cast<float>()) {
  const double radius = day.sun().angular_radius.rad();
  disc_cosine_ = static_cast<float>(std::cos(radius));
  // No pixel spans a larger angle than at the image centre, where it is its size at depth 1.
  const double pixel = std::hypot(surfaces.pixel_right.norm(), surfaces.pixel_down.norm());
  near_cosine_ = static_cast<float>(std::cos(std::min(radius + pixel, kPi)));
  // The disc fills a solid angle of 2π (1 − cos r), here without cancellation.
  const double half_sine = std::sin(0.5 * radius);
  disc_luminance_ = day.sun().illuminance.value / static_cast<float>(4.0 * kPi * half_sine * half_sine);
}

Eigen::Array3f SkyPixel::luminance(int x, int y) const {
  const Eigen::Vector3f towards = (surfaces_.pixel_origin + static_cast<float>(x) * surfaces_.pixel_right +
                                   static_cast<float>(y) * surfaces_.pixel_down)
                                      .normalized();
  Eigen::Array3f sum = daylight_.skyLuminance(towards).value;
  if (towards.dot(towards_sun_) > near_cosine_) sum += discShare(x, y) * disc_luminance_;
  return sum;
}

float SkyPixel::discShare(int x, int y) const {
  int inside = 0;
  for (int j = 0; j < kDiscGrid; ++j) {
    for (int i = 0; i < kDiscGrid; ++i) {
      const float u = static_cast<float>(x) + (static_cast<float>(i) + 0.5f) / kDiscGrid - 0.5f;
      const float v = static_cast<float>(y) + (static_cast<float>(j) + 0.5f) / kDiscGrid - 0.5f;
      const Eigen::Vector3f towards =
          surfaces_.pixel_origin + u * surfaces_.pixel_right + v * surfaces_.pixel_down;
      if (towards.dot(towards_sun_) > disc_cosine_ * towards.norm()) ++inside;
    }
  }
  return static_cast<float>(inside) / (kDiscGrid * kDiscGrid);
}

}  // namespace sunlit::light
