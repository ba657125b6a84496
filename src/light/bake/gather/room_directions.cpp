#include "light/bake/gather/room_directions.h"

#include <algorithm>
#include <cmath>

#include "light/patches/even_directions.h"
#include "light/patches/sky_patches.h"
#include "sunlit/quantity/angle.h"

namespace sunlit::light {

RoomDirections::RoomDirections(std::size_t count) {
  for (const Eigen::Vector3f& towards : evenDirections(count))
    coarse.push_back({towards, SkyPatches::patchAt(towards)});
  const auto all = static_cast<float>(count);
  const float apart_rad = 1.7f * std::sqrt(4.0f * kPiFloat / all);
  // They go down in even steps: those within that angle are near in their order, too.
  const auto visitNear = [&](const Eigen::Vector3f& towards, const auto& visit) {
    const float number = 0.5f * (1.0f - towards.z()) * all, most = 0.5f * apart_rad * all + 1.0f;
    const auto end =
        std::min(static_cast<std::uint32_t>(number + most) + 1, static_cast<std::uint32_t>(count));
    for (auto k = static_cast<std::uint32_t>(std::max(number - most, 0.0f)); k < end; ++k)
      visit(k, coarse[k].towards.dot(towards));
  };
  const float beyond = std::cos(apart_rad);
  for (std::uint32_t i = 0; i < count; ++i) {
    first_beside.push_back(static_cast<std::uint32_t>(beside.size()));
    visitNear(coarse[i].towards, [&](std::uint32_t k, float cosine) {
      if (k != i && cosine > beyond) beside.push_back(k);
    });
  }
  first_beside.push_back(static_cast<std::uint32_t>(beside.size()));
  std::vector<std::vector<Direction>> nearest(count);
  for (const Eigen::Vector3f& towards : evenDirections(kFine * count)) {
    std::uint32_t best = 0;
    float largest = -1.0f;
    visitNear(towards, [&](std::uint32_t k, float cosine) {
      if (cosine > largest) largest = cosine, best = k;
    });
    nearest[best].push_back({towards, SkyPatches::patchAt(towards)});
  }
  for (const std::vector<Direction>& near : nearest) {
    first_fine.push_back(static_cast<std::uint32_t>(fine.size()));
    fine.insert(fine.end(), near.begin(), near.end());
  }
  first_fine.push_back(static_cast<std::uint32_t>(fine.size()));
}

}  // namespace sunlit::light
