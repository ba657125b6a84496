#include "light/picture/disc/disc_points.h"

#include <cmath>

#include "light/patches/angles.h"
#include "light/patches/disc_above_horizon.h"
#include "sunlit/quantity/angle.h"

namespace sunlit::light {
namespace {

/// Points of a Fibonacci spiral fill the disc evenly: point i of n at radius sqrt((i + ½) / n). Of all ways
/// to part 16 of them into quads with one point in each quarter of the radii, the one whose quads have means
/// nearest to the middle and turns nearest to 90°. Outermost points come first: they tell best whether an
/// edge crosses the disc.
constexpr std::array<std::array<int, DiscPoints::kQuad>, 4> kQuads = {
    {{12, 6, 10, 0}, {13, 7, 11, 1}, {14, 8, 4, 2}, {15, 9, 5, 3}}};
/// How much further the points of each row of a block are turned: a quarter of the turn between those of a
/// quad.
constexpr double kTurnOfRow = kPi / 8.0;

}  // namespace

DiscPoints::DiscPoints(const Eigen::Vector3f& towards, float radius_rad)
    : DiscPoints(towards, radius_rad, 0.0f) {}

DiscPoints DiscPoints::inFloor(const Eigen::Vector3f& towards, float radius_rad, float alpha) {
  DiscPoints points(towards, radius_rad, alpha);
  const auto mirror = [](Eigen::Vector3f& direction) { direction.z() = -direction.z(); };
  mirror(points.across_);
  mirror(points.up_);
  for (auto& row : points.directions_)
    for (auto& pixel : row)
      for (Eigen::Vector3f& direction : pixel) mirror(direction);
  return points;
}

DiscPoints::DiscPoints(const Eigen::Vector3f& towards, float radius_rad, float alpha) {
  const Eigen::Vector3f aside =
      std::abs(towards.z()) < 0.9f ? Eigen::Vector3f::UnitZ() : Eigen::Vector3f::UnitX();
  across_ = aside.cross(towards).normalized();
  up_ = towards.cross(across_);
  const float rim = std::tan(radius_rad);
  const DiscAboveHorizon above(towards, static_cast<double>(radius_rad));
  // Of facets a share u leans by less than alpha · sqrt(u / (1 − u)) (Walter et al. 2007, eq. 35), which
  // turns light by twice that within the plane of the mirror's normal, by less across it. Squares add, about.
  const auto spread = [&](double u) {
    const double of_facets = 2.0 * static_cast<double>(alpha / rim) / std::sqrt(1.0 - u);
    return Eigen::Vector2d(std::hypot(1.0, of_facets * static_cast<double>(towards.z())),
                           std::hypot(1.0, of_facets));
  };
  for (std::size_t y = 0; y < kPeriod; ++y) {
    for (std::size_t x = 0; x < kPeriod; ++x) {
      for (std::size_t i = 0; i < kPoints; ++i) {
        const int point = kQuads[(x + 2 * y + i / kQuad) % kQuads.size()][i % kQuad];
        const double radius = std::sqrt((point + 0.5) / kPoints);
        const double turn = kGoldenAngle * point + kTurnOfRow * static_cast<double>(y);
        const Eigen::Vector2d whole = radius * Eigen::Vector2d(std::cos(turn), std::sin(turn));
        const Eigen::Vector2f at =
            rim * above.place(whole).cast<float>().cwiseProduct(spread(radius * radius).cast<float>());
        directions_[y][x][i] = towards + at.x() * across_ + at.y() * up_;
      }
    }
  }
}

}  // namespace sunlit::light
