#include "light/bake/gather/room_directions.h"

#include <cmath>

#include "light/patches/even_directions.h"
#include "light/patches/sky_patches.h"
#include "sunlit/quantity/angle.h"

namespace sunlit::light {

RoomDirections::RoomDirections(std::size_t count) {
  for (const Eigen::Vector3f& towards : evenDirections(count))
    coarse.push_back({towards, SkyPatches::patchAt(towards)});
  const float beyond = std::cos(1.7f * std::sqrt(4.0f * kPiFloat / static_cast<float>(count)));
  for (std::uint32_t i = 0; i < count; ++i) {
    first_beside.push_back(static_cast<std::uint32_t>(beside.size()));
    for (std::uint32_t k = 0; k < count; ++k)
      if (k != i && coarse[i].towards.dot(coarse[k].towards) > beyond) beside.push_back(k);
  }
  first_beside.push_back(static_cast<std::uint32_t>(beside.size()));
  std::vector<std::vector<Direction>> nearest(count);
  for (const Eigen::Vector3f& towards : evenDirections(kFine * count)) {
    std::size_t best = 0;
    for (std::size_t i = 1; i < count; ++i)
      if (coarse[i].towards.dot(towards) > coarse[best].towards.dot(towards)) best = i;
    nearest[best].push_back({towards, SkyPatches::patchAt(towards)});
  }
  for (const std::vector<Direction>& near : nearest) {
    first_fine.push_back(static_cast<std::uint32_t>(fine.size()));
    fine.insert(fine.end(), near.begin(), near.end());
  }
  first_fine.push_back(static_cast<std::uint32_t>(fine.size()));
}

}  // namespace sunlit::light
