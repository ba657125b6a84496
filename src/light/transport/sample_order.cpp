#include "light/transport/sample_order.h"

#include <algorithm>
#include <tuple>

#include "light/morton.h"

namespace sunlit::light {
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
    keys.push_back({mortonCode(site.origins[0], 32.0f), mortonCode(site.origins[0], 0.125f), site.coarse,
                    2 * axis + (site.normal[axis] > 0.0f ? 1 : 0), i});
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
