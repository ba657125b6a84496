#include "light/picture/lamps/power_rays.h"

#include <algorithm>
#include <cmath>

#include "light/patches/angles.h"
#include "sunlit/quantity/angle.h"

namespace sunlit::light {
namespace {

/// How a lamp's power is spread over the cosine c to its axis: all from the inner cone in, falling as
/// ((c − outer) / (inner − outer))ᵖ from there out.
class Cone {
 public:
  explicit Cone(const scene::Lamp& lamp) {
    if (!lamp.isSpot()) return;
    outer_ = std::cos(static_cast<double>(lamp.outer_rad));
    inner_ = std::max(std::cos(static_cast<double>(lamp.inner_rad)), outer_);
    exponent_ = static_cast<double>(lamp.exponent);
  }
  /// Of full intensity that would give as much.
  double steradians() const { return 2.0 * kPi * all(); }
  /// Within which the share `part` of the power lies.
  double cosine(double part) const {
    const double within = part * all();
    if (within <= 1.0 - inner_) return 1.0 - within;
    const double edge = (all() - within) / edgeOfAll();
    return outer_ + (inner_ - outer_) * std::pow(std::max(edge, 0.0), 1.0 / (exponent_ + 1.0));
  }

 private:
  double edgeOfAll() const { return (inner_ - outer_) / (exponent_ + 1.0); }
  double all() const { return 1.0 - inner_ + edgeOfAll(); }
  double inner_ = -1.0, outer_ = -1.0, exponent_ = 0.0;
};

/// Point `number` of `count` of a Fibonacci spiral over the cone.
Eigen::Vector3d pointOf(const Cone& cone, std::size_t number, std::size_t count) {
  const double z = cone.cosine((static_cast<double>(number) + 0.5) / static_cast<double>(count));
  const double r = std::sqrt(std::max(1.0 - z * z, 0.0)), turn = kGoldenAngle * static_cast<double>(number);
  return {r * std::cos(turn), r * std::sin(turn), z};
}

}  // namespace

PowerRays powerRays(const scene::Lamp& lamp, std::size_t count, std::size_t groups) {
  const Cone cone(lamp);
  std::vector<Eigen::Vector3d> middles;
  for (std::size_t group = 0; group < groups; ++group) middles.push_back(pointOf(cone, group, groups));
  PowerRays rays;
  rays.each_sr = static_cast<float>(cone.steradians() / static_cast<double>(count));
  for (std::size_t i = 0; i < count; ++i) {
    const Eigen::Vector3d direction = pointOf(cone, i, count);
    // By the chord: cosines of neighbours in a narrow cone hardly differ.
    const auto nearest = std::min_element(middles.begin(), middles.end(), [&](const auto& a, const auto& b) {
      return (a - direction).squaredNorm() < (b - direction).squaredNorm();
    });
    rays.directions.push_back(direction.cast<float>());
    rays.groups.push_back(static_cast<std::uint32_t>(nearest - middles.begin()));
  }
  return rays;
}

}  // namespace sunlit::light
