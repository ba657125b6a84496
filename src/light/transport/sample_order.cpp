#include "light/transport/sample_order.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace sunlit::light {
namespace {

/// Two zero bits between any two bits of the lowest 21.
std::uint64_t spread(std::uint64_t x) {
  x &= 0x1fffff;
  x = (x | x << 32) & 0x1f00000000ffffull;
  x = (x | x << 16) & 0x1f0000ff0000ffull;
  x = (x | x << 8) & 0x100f00f00f00f00full;
  x = (x | x << 4) & 0x10c30c30c30c30c3ull;
  return (x | x << 2) & 0x1249249249249249ull;
}
std::uint64_t morton(const Eigen::Vector3i& cell) {
  return spread(static_cast<std::uint64_t>(cell.x() + (1 << 20))) |
         spread(static_cast<std::uint64_t>(cell.y() + (1 << 20))) << 1 |
         spread(static_cast<std::uint64_t>(cell.z() + (1 << 20))) << 2;
}

}  // namespace

void orderSamples(SceneSamples* samples) {
  struct Key {
    std::uint64_t block, place;
    bool coarse;
    int facing;
    std::uint32_t sample;
  };
  std::vector<Key> keys;
  for (std::uint32_t i = 0; i < samples->sites.size(); ++i) {
    const Site& site = samples->sites[i];
    int axis = 0;
    site.normal.cwiseAbs().maxCoeff(&axis);
    const Eigen::Vector3i block = (site.origins[0] / 32.0f).array().floor().cast<int>();
    const Eigen::Vector3i place = (site.origins[0] * 8.0f).array().floor().cast<int>();
    keys.push_back(
        {morton(block), morton(place), site.coarse, 2 * axis + (site.normal[axis] > 0.0f ? 1 : 0), i});
  }
  std::sort(keys.begin(), keys.end(), [](const Key& a, const Key& b) {
    return std::tie(a.block, a.coarse, a.facing, a.place, a.sample) <
           std::tie(b.block, b.coarse, b.facing, b.place, b.sample);
  });
  std::vector<Site> sites;
  std::vector<Behind> behind;
  std::vector<std::uint32_t> moved_to(keys.size());
  for (const Key& key : keys) {
    moved_to[key.sample] = static_cast<std::uint32_t>(sites.size());
    sites.push_back(samples->sites[key.sample]);
    behind.push_back(samples->behind[key.sample]);
  }
  for (Behind& other : behind) {
    if (other.sample != LightMesh::kNone) other.sample = moved_to[other.sample];
  }
  samples->behind = std::move(behind);
  samples->sites = std::move(sites);
  for (LightMesh::Share& share : samples->mesh.shares) share.sample = moved_to[share.sample];
}

}  // namespace sunlit::light
