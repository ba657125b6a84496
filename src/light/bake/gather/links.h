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

/// What a room sees, by the numbers of its links, from `first` to `end`: above the horizon before `below`.
struct RoomLinks {
  RoomLinks(const BakedRooms& rooms, std::size_t room)
      : first(rooms.first[room]),
        below(rooms.below[room]),
        end(rooms.first[room + 1]),
        links_(rooms.links.data()),
        tints_(rooms.link_tints.empty() ? nullptr : rooms.link_tints.data()),
        scale_(rooms.scales[room]) {}

  SampleSeen at(std::uint32_t number) const {
    return {links_[number].sample(), scale_ * BakedRooms::weightOf(links_[number]),
            tints_ == nullptr ? PackedTint() : tints_[number]};
  }

  const std::uint32_t first, below, end;

 private:
  // Copies, which no compiler has to fetch again after each look.
  const BakedRooms::Link* links_;
  const PackedTint* tints_;
  float scale_;
};

/// Calls visit(SampleSeen, whether it is seen above the horizon) for all that a room sees.
template <typename Visit>
void visitLinks(const BakedRooms& rooms, std::size_t room, const Visit& visit) {
  const RoomLinks links(rooms, room);
  for (std::uint32_t k = links.first; k < links.below; ++k) visit(links.at(k), true);
  for (std::uint32_t k = links.below; k < links.end; ++k) visit(links.at(k), false);
}

}  // namespace sunlit::light
