#include "light/picture/sky/disc_in_view.h"

#include <algorithm>
#include <cmath>

#include "sunlit/quantity/angle.h"
#include "sunlit/sky/disc_segment.h"
#include "sunlit/sky/eclipse.h"

namespace sunlit::light {
namespace {

/// Points across the radius of a disc that its edge and its phase are averaged over, at least.
constexpr double kPointsPerRadius = 32.0;
/// Points across a crescent's width, at least, until kMostPointsPerRadius are not enough.
constexpr double kPointsPerCrescent = 16.0;
constexpr double kMostPointsPerRadius = 128.0;
/// A pixel, at least and at most, along an axis.
constexpr double kLeastPoints = 4.0, kMostPoints = 256.0;

/// Brightness of a whole Lommel-Seeliger sphere at a phase angle, relative to full: 1 − sin(α/2) tan(α/2)
/// ln cot(α/4) (Lester, McCall and Tatum 1979).
double lommelSeeligerPhase(double alpha) {
  if (alpha < 1e-6) return 1.0;
  if (alpha > kPi - 1e-6) return 0.0;
  return 1.0 - std::sin(0.5 * alpha) * std::tan(0.5 * alpha) * -std::log(std::tan(0.25 * alpha));
}

}  // namespace

DiscInView::DiscInView(const Surfaces& surfaces, const sky::DiscLight& disc)
    : surfaces_(surfaces), towards_(disc.towards.vector().cast<float>()), centre_(disc.towards.vector()) {
  const double radius = disc.angular_radius.rad();
  radius_rad_ = radius;
  disc_cosine_ = static_cast<float>(std::cos(radius));
  disc_sine_ = std::sin(radius);
  // Of a pinhole no pixel spans a larger angle than at the image centre, where it is its size at depth 1.
  const double pixel = surfaces.bent ? surfaces.bent->widestPixel()
                                     : std::hypot(surfaces.pixel_right.norm(), surfaces.pixel_down.norm());
  near_cosine_ = static_cast<float>(std::cos(std::min(radius + 2.0 * pixel, kPi)));
  const double above = sky::discSegment(disc.towards.elevation().rad() / radius);
  double lit = 1.0;
  points_per_radius_ = kPointsPerRadius;
  if (disc.lit_from) {
    lit_from_ = disc.lit_from->vector();
    const double cosine = -disc.lit_from->vector().dot(disc.towards.vector());
    lit = lommelSeeligerPhase(std::acos(std::clamp(cosine, -1.0, 1.0)));
    // At full phase µ0 = µ: one half everywhere.
    showPart(lit, 1.0 + cosine);
    brightness_scale_ *= 2.0;
  }
  if (disc.cover) {
    cover_ = disc.cover->towards.vector();
    cover_chord_ = 2.0 * std::sin(0.5 * disc.cover->angular_radius.rad());
    const double apart = 2.0 * std::asin(std::min(0.5 * (*cover_ - centre_).norm(), 1.0));
    lit = sky::uncoveredArea({Angle::radians(apart), disc.angular_radius, disc.cover->angular_radius});
    showPart(lit, 1.0 + (apart - disc.cover->angular_radius.rad()) / radius);
  }
  shines_ = disc.illuminance.value.maxCoeff() > 0.0f && above > 1e-4 && lit > 1e-6;
  // The disc fills a solid angle of 2π (1 − cos r), here without cancellation.
  const double half_sine = std::sin(0.5 * radius);
  mean_luminance_ =
      disc.illuminance.value / static_cast<float>(4.0 * kPi * half_sine * half_sine * std::max(above, 1e-4));
}

void DiscInView::showPart(double lit, double width) {
  const double points = kPointsPerCrescent / std::max(width, 1e-3);
  points_per_radius_ = std::clamp(points, kPointsPerRadius, kMostPointsPerRadius);
  brightness_scale_ = 1.0 / std::max(lit, 1e-9);
}

double DiscInView::brightness(const Eigen::Vector3d& towards) const {
  // Where on the disc this is seen, in radii from its centre.
  const Eigen::Vector3d across = (towards - towards.dot(centre_) * centre_) / disc_sine_;
  const double square = across.squaredNorm();
  if (square > 1.0) return 0.0;
  if (cover_ && (towards - *cover_).squaredNorm() < cover_chord_ * cover_chord_) return 0.0;
  if (!lit_from_) return brightness_scale_;
  // The normal of the sphere there has this cosine to the line of sight.
  const double mu = std::sqrt(1.0 - square);
  const double mu0 = (across - mu * centre_).dot(*lit_from_);
  return mu0 > 0.0 ? brightness_scale_ * mu0 / (mu0 + mu) : 0.0;
}

DiscInView::Pixel DiscInView::pixel(int x, int y) const {
  if (surfaces_.bent) {
    const PixelRays& rays = *surfaces_.bent;
    const Eigen::Matrix3d& turned = surfaces_.map_from_optical;
    return {turned * rays.at(x, y), turned * rays.right(x, y), turned * rays.down(x, y)};
  }
  const Eigen::Vector3d right = surfaces_.pixel_right.cast<double>();
  const Eigen::Vector3d down = surfaces_.pixel_down.cast<double>();
  return {surfaces_.pixel_origin.cast<double>() + x * right + y * down, right, down};
}

/// Pixels differ in size by far in a wide view, and so do the two axes of one that is near its edge.
DiscInView::Grid DiscInView::gridOf(const Pixel& pixel) const {
  const auto angle = [](const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
    return std::acos(std::clamp(a.normalized().dot(b.normalized()), -1.0, 1.0));
  };
  const Eigen::Vector3d &middle = pixel.middle, &right = pixel.right, &down = pixel.down;
  double reach = 0.0;
  for (const Eigen::Vector3d& corner : {Eigen::Vector3d(right + down), Eigen::Vector3d(right - down)})
    reach = std::max({reach, angle(middle, middle + 0.5 * corner), angle(middle, middle - 0.5 * corner)});
  if (!shines_ || angle(middle, centre_) > radius_rad_ + reach) return {};
  const auto along = [&](const Eigen::Vector3d& side) {
    const double across_rad = angle(middle - 0.5 * side, middle + 0.5 * side);
    const double points = std::ceil(points_per_radius_ * across_rad / radius_rad_);
    return static_cast<int>(std::clamp(points, kLeastPoints, kMostPoints));
  };
  return {along(right), along(down)};
}

int DiscInView::points(int x, int y) const {
  const Grid grid = gridOf(pixel(x, y));
  return grid.across * grid.down;
}

Eigen::Array3f DiscInView::luminance(int x, int y) const {
  const auto [middle, right, down] = pixel(x, y);
  const Grid grid = gridOf({middle, right, down});
  if (grid.across == 0) return Eigen::Array3f::Zero();
  const double step_right = 1.0 / grid.across, step_down = 1.0 / grid.down;
  double sum = 0.0;
  for (int j = 0; j < grid.down; ++j) {
    for (int i = 0; i < grid.across; ++i) {
      const Eigen::Vector3d towards =
          (middle + ((i + 0.5) * step_right - 0.5) * right + ((j + 0.5) * step_down - 0.5) * down)
              .normalized();
      if (towards.z() > 0.0) sum += brightness(towards);
    }
  }
  return static_cast<float>(sum * step_right * step_down) * mean_luminance_;
}

}  // namespace sunlit::light
