/// What the surfaces of a picture have around them: all that light derives of them one by one, whatever the
/// sky and the sun. Made once a pose.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <variant>
#include <vector>

#include "light/bake/samples/light_place.h"
#include "light/bake/samples/packed_tint.h"
#include "light/patches/sky_openness.h"
#include "sunlit/light/surfaces.h"

namespace sunlit::light {

/// How much of each patch of the sky is seen where FinalGather looked, or between such places.
struct GatheredSky {
  static constexpr std::size_t kPatches = 176;   ///< SkyPatches tells where they lie
  std::array<std::uint8_t, kPatches> open = {};  ///< 255 for all; of a patch that the surface's own plane
                                                 ///< cuts, of the part before it
};

/// What a smooth surface mirrors: parts of its lobe of equal weight, each about one direction.
struct SmoothMirror {
  static constexpr std::size_t kParts = 16;
  std::array<std::uint16_t, kParts> place = {};  ///< the direction, as an index into MirrorSky
  std::array<std::uint8_t, kParts> open = {};    ///< how much of the sky there is not hidden, 255 for all
  float hidden_below = 0.0f;                     ///< share of the lobe that is hidden and below the horizon
  PackedTint tint;                               ///< of the sky, by glass before it
};

/// What a rough surface mirrors: how much of its lobe looks at each patch of the sky.
struct RoughMirror {
  static constexpr std::size_t kPatches = 176;  ///< SkyPatches tells where they lie
  std::array<std::uint8_t, kPatches> share =
      {};  ///< of the lobe, in parts of `scale`, where nothing hides it
  float scale = 0.0f;
  /// Share of the lobe that other surfaces hide, 0 … 1: of those above the horizon and those below.
  float hidden_above = 0.0f, hidden_below = 0.0f;
  PackedTint tint;  ///< of the sky, by glass before it
};

/// What a surface mirrors.
using Mirror = std::variant<SmoothMirror, RoughMirror>;

/// What thin sheets and leaves have besides.
struct SheetOutlook {
  LightPlace behind;  ///< where the other side of a thin sheet lies in the bake
  SkyOpenness sky;    ///< of leaves
};

/// Of one surface.
struct Outlook {
  LightPlace light;          ///< where it lies in the bake; unknown: outside of it, or on a body that moves
  std::uint16_t mirror = 0;  ///< what it mirrors: index into TileOutlooks::mirrors, where `light` is known
  static constexpr std::uint32_t kNoSheet = 0xffffffffu;
  std::uint32_t sheet = kNoSheet;  ///< index into TileOutlooks::sheets
  static constexpr std::uint32_t kNotGathered = 0xffffffffu;
  std::uint32_t gathered = kNotGathered;  ///< index into TileOutlooks::gathered
  static constexpr std::int32_t kNoBody = -1;
  std::int32_t body = kNoBody;  ///< that moves, which it belongs to
  float unhidden = 1.0f;        ///< share of the light from all around that bodies leave to it, 0 … 1
};

/// All that is known of one surface.
struct WholeOutlook {
  const Outlook& own;
  const SheetOutlook& sheet;    ///< one of which nothing is known, where it is neither sheet nor leaf
  const GatheredSky* gathered;  ///< null: FinalGather did not look there
};

/// Of the surfaces of one tile.
struct TileOutlooks {
  std::vector<Outlook> surfaces;  ///< in the order of Tile::surfaces
  std::vector<Mirror> mirrors;
  std::vector<SheetOutlook> sheets;
  std::vector<GatheredSky> gathered;  ///< empty where FinalGather did not look
  /// Of each of `surfaces`, how much of what polished floors throw on it its nodes lack, 0 … 1: see
  /// GlintNodes. Empty: nothing.
  std::vector<float> without_glints;

  /// Of one of `surfaces`. Holds until any of these vectors grows.
  WholeOutlook whole(std::size_t surface) const {
    static const SheetOutlook none;
    const Outlook& own = surfaces[surface];
    return {own, own.sheet == Outlook::kNoSheet ? none : sheets[own.sheet],
            own.gathered == Outlook::kNotGathered ? nullptr : &gathered[own.gathered]};
  }
  /// As of surfaces of which nothing is known. Keeps memory.
  void forget(std::size_t count) {
    surfaces.assign(count, Outlook());
    mirrors.clear();
    sheets.clear();
    gathered.clear();
    without_glints.clear();
  }
};

/// In the order of Surfaces::tiles.
using Outlooks = std::vector<TileOutlooks>;

/// Of `surfaces` of which nothing is known. Keeps memory.
inline void forget(const Surfaces& surfaces, Outlooks* outlooks) {
  outlooks->resize(surfaces.tiles.size());
  for (std::size_t i = 0; i < surfaces.tiles.size(); ++i)
    (*outlooks)[i].forget(surfaces.tiles[i].surfaces.size());
}

}  // namespace sunlit::light
