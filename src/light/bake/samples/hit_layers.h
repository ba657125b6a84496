/// What rays meet one after another.
#pragma once

#include <algorithm>
#include <vector>

#include "light/bake/samples/packed_tint.h"
#include "light/bake/samples/ray_packet.h"

namespace sunlit::light {

/// Veils, which let a share of the light through, and what ends each ray.
struct HitLayers {
  /// Where a ray meets fewer, its triangle is HitPacket::kNothing and its share 0.
  struct Veil {
    HitPacket hits;
    float shares[RayPacket::kSize];      ///< of the light that a ray brings, what comes from here
    PackedTint tints[RayPacket::kSize];  ///< of it, by the veils before

    static Veil none() {
      Veil veil{};
      std::fill_n(veil.hits.triangle, RayPacket::kSize, HitPacket::kNothing);
      return veil;
    }
  };
  std::vector<Veil> veils;  ///< nearest first
  HitPacket ends;
  /// Where there are veils: of the light that a ray brings, what comes from its end.
  float through[RayPacket::kSize];
  PackedTint through_tints[RayPacket::kSize];  ///< of it
  HitPacket stopped;                           ///< where there are veils: see byChance()
  PackedTint stopped_tints[RayPacket::kSize];  ///< by the veils before it

  /// For what takes one hit a ray: each veil has stopped as many rays as it keeps light back.
  const HitPacket& byChance() const { return veils.empty() ? ends : stopped; }

  PackedTint tintByChance(int lane) const { return veils.empty() ? PackedTint() : stopped_tints[lane]; }

  float shareOfEnd(int lane) const { return veils.empty() ? 1.0f : through[lane]; }
  PackedTint tintOfEnd(int lane) const { return veils.empty() ? PackedTint() : through_tints[lane]; }
  /// Calls visit(hits, share, tint) for what a ray meets, veils first; shares, of luminance, add up to 1.
  template <typename Visit>
  void visit(int lane, const Visit& visit) const {
    for (const Veil& veil : veils)
      if (veil.shares[lane] > 0.0f) visit(veil.hits, veil.shares[lane], veil.tints[lane]);
    visit(ends, shareOfEnd(lane), tintOfEnd(lane));
  }
};

}  // namespace sunlit::light
