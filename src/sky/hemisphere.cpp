#include "hemisphere.h"

#include <algorithm>
#include <cmath>

#include "sphere.h"
#include "sunlit/quantity/angle.h"

namespace sunlit::sky {
namespace {

constexpr int kBelts = 40;
constexpr int kSectors = 64;

float beltEdge(float part) {
  return kHalfPi * part * (0.4F + 0.6F * part);
}

}  // namespace

std::vector<SkyPiece> hemisphere(const Eigen::Vector2f& heading) {
  std::vector<SkyPiece> pieces;
  pieces.reserve(static_cast<std::size_t>(kBelts * kSectors));
  for (int belt = 0; belt < kBelts; ++belt) {
    // The midpoint in the sine of elevation has the piece's mean cosine on level ground.
    const float low = std::sin(beltEdge(static_cast<float>(belt) / kBelts));
    const float high = std::sin(beltEdge(static_cast<float>(belt + 1) / kBelts));
    const float z = 0.5F * (low + high);
    const float across = std::sqrt(1.0F - z * z);
    const float solid_angle = (high - low) * static_cast<float>(2.0 * kPi / kSectors);
    for (int sector = 0; sector < kSectors; ++sector) {
      const double azimuth = 2.0 * kPi * (sector + 0.5) / kSectors;
      const auto along = static_cast<float>(std::cos(azimuth)) * across;
      const auto aside = static_cast<float>(std::sin(azimuth)) * across;
      pieces.push_back(
          {{heading.x() * along - heading.y() * aside, heading.y() * along + heading.x() * aside, z},
           solid_angle});
    }
  }
  return pieces;
}

Eigen::Array3f onLevelGround(const DiscLight& disc) {
  return disc.illuminance.value * static_cast<float>(std::max(0.0, disc.towards.vector().z()));
}

}  // namespace sunlit::sky
