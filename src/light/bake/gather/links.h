/// What samples in rooms see.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>

#include "light/bake/gather/sent_light.h"
#include "light/bake/samples/transport_data.h"

namespace sunlit::light {

/// A sample that another one sees, and what its luminance × π counts there, in illuminance.
struct SampleSeen {
  std::uint32_t sample;
  float weight;
  PackedTint tint = {};  ///< by glass on the way

  /// Illuminance where it sends so much: luminance × π.
  Eigen::Array3f of(const Eigen::Array3f& sent) const { return weight * tint.times(sent); }
  /// Of each of several sources.
  template <int kSources>
  Colors<kSources> of(const Colors<kSources>& sent) const {
    if (tint.white()) return weight * sent;
    Colors<kSources> light;
    for (int k = 0; k < kSources; ++k) light.col(k) = of(sent.col(k));
    return light;
  }
};

/// Calls visit(SampleSeen, whether it is seen above the horizon) for all that a room sees.
template <typename Visit>
void visitLinks(const BakedRooms& rooms, std::size_t room, const Visit& visit) {
  // Copies, which no compiler has to fetch again after each visit.
  const BakedRooms::Link* const links = rooms.links.data();
  const PackedTint* const tints = rooms.link_tints.empty() ? nullptr : rooms.link_tints.data();
  const float scale = rooms.scales[room];
  const auto visitThose = [&](std::uint32_t first, std::uint32_t end, bool up) {
    for (std::uint32_t k = first; k < end; ++k) {
      visit(SampleSeen{links[k].sample(), scale * BakedRooms::weightOf(links[k]),
                       tints == nullptr ? PackedTint() : tints[k]},
            up);
    }
  };
  const std::uint32_t below = rooms.below[room];
  visitThose(rooms.first[room], below, true);
  visitThose(below, rooms.first[room + 1], false);
}

}  // namespace sunlit::light
