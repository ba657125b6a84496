/// What a bake leaves behind, and its cache file holds.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <mutex>
#include <vector>

#include "light/bake/samples/leaf_openness.h"
#include "light/bake/samples/light_mesh.h"
#include "light/bake/samples/light_place.h"
#include "light/bake/samples/packed_tint.h"
#include "light/bake/samples/sample_and_byte.h"
#include "light/patches/sky_patches.h"
#include "sunlit/image/kept_array.h"

namespace sunlit::light {

/// Illuminance of each sample for 1 cd/m² of each sky patch, lx.
struct Coefficients {
  /// One row of SkyPatches::kCount bytes a sample; times the sample's scale.
  image::KeptArray<std::uint8_t> rows;
  image::KeptArray<float> scales;

  void resize(std::size_t samples);
  /// Stores `row` of SkyPatches::kCount values ≥ 0, each within 1/255 of the largest, and so is the sum of
  /// all up to each.
  void set(std::size_t sample, const float* row);
  /// Stores the row `from` of others.
  void copy(const Coefficients& others, std::size_t from, std::size_t sample);
  const std::uint8_t* row(std::size_t sample) const { return rows.data() + sample * SkyPatches::kCount; }
  /// For 1 cd/m² of all patches.
  float sum(std::size_t sample) const;
};

/// Adds a row of Coefficients, without its scale, times `factor` to the SkyPatches::kCount values of `row`.
void addTimes(float factor, const std::uint8_t* coefficients, float* row);

/// What surfaces pass on to each sample.
struct PassedOn {
  Coefficients coefficients;                     ///< luminance of it
  image::KeptArray<std::array<float, 3>> tints;  ///< its colour, of luminance 1
  image::KeptArray<std::array<float, 3>> glows;  ///< illuminance, lx, from surfaces that shine by themselves
  image::KeptArray<float> hides;  ///< share of an even sphere's light, by cosine, that these surfaces hide

  void resize(std::size_t samples);
};

/// What standing lamps give samples by way of surfaces, for each of lampSets(), by blocks of samples that
/// have any of it.
struct BakedLamps {
  static constexpr std::size_t kBlock = 256;  ///< samples
  /// Illuminance, lx, r g b: from surfaces above the horizon, from those below it.
  using Light = std::array<float, 6>;

  image::KeptArray<std::uint32_t> first;   ///< of each set, into `blocks`; and the end
  image::KeptArray<std::uint32_t> blocks;  ///< their numbers
  image::KeptArray<Light> light;           ///< kBlock of each block

  std::size_t setCount() const { return first.empty() ? 0 : first.size() - 1; }
};

/// Samples that see little but other surfaces, as in rooms, streets and tunnels, where the sun lights few
/// places and these the rest: which samples they see, so that light of sun and moon comes from where it
/// really lies.
struct BakedRooms {
  /// One that is seen, and how much its luminance × π counts in illuminance: a root, 1 … 255, of parts of the
  /// room's scale, for most count little beside a few.
  using Link = SampleAndByte;
  static float weightOf(Link link) {
    const auto root = static_cast<float>(link.byte());
    return root * root;
  }

  image::KeptArray<std::uint32_t> samples;  ///< that look so, in rising order: below called rooms
  image::KeptArray<std::uint32_t> first;    ///< of each room, into `links`; and the end
  image::KeptArray<std::uint32_t> below;  ///< of each, into `links`: the first that is seen below the horizon
  image::KeptArray<float> scales;         ///< of each room's weights
  image::KeptArray<Link> links;
  image::KeptArray<PackedTint> link_tints;  ///< by glass on the way, of each of them; empty: there is none

  /// Of each room: sky by way of the ground as a mirror, luminance; of those in `glossy` but for floors that
  /// are polished.
  Coefficients mirrored;
  image::KeptArray<PackedTint> mirrored_tints;  ///< its colour by glass; empty: there is none

  /// A sample that is seen.
  struct Source {
    std::uint32_t sample, other;  ///< and the one on the other side of its sheet, or LightMesh::kNone
    std::array<float, 3> direct, bounced, through;  ///< as Sending
    std::array<float, 3> normal;
    std::uint32_t first_point, points;  ///< 0: its light is told by its coefficients
    std::uint32_t probes;               ///< so many of them cast a ray first; where these are at odds, all do
  };
  struct Point {
    float x, y, z;  ///< m in `map`, clear of the surface
    float share;    ///< of its source's area
  };
  /// A room that sees polished floor, on which sun and moon shine into it as in a mirror.
  struct Glossy {
    std::uint32_t room;
    std::uint32_t source;  ///< the same sample, as it is seen
    float roughness;       ///< of the floor, in the mean
  };
  image::KeptArray<Source> sources;  ///< in rising order of samples
  image::KeptArray<Point> points;
  image::KeptArray<Glossy> glossy;  ///< in rising order of rooms
};

/// The numbers of a CompactSource, member by member.
using KeptSource = std::array<float, 28>;

struct TransportData {
  LightMesh mesh;
  Coefficients direct;  ///< straight from the sky
  /// Its colour by glass on the way, in the mean over an even sky; empty: there is no such glass.
  image::KeptArray<PackedTint> direct_tints;
  /// Surfaces that a sample sees above the horizon, such as walls and leaves, and below it, mostly the
  /// ground: they differ in brightness, and mirrors look at the one or the other.
  PassedOn above, below;
  LeafOpenness leaves;
  BakedLamps lamps;
  BakedRooms rooms;
  /// What shines and lights straight in pictures: the light of samples is without that.
  image::KeptArray<KeptSource> compact_sources;

  std::size_t sampleCount() const { return direct.scales.size(); }
  PackedTint directTint(std::size_t sample) const { return tintOf(direct_tints, sample); }
  /// Where each sample lies, about: at one of the nodes that have its light. Found when first asked for.
  const std::vector<Eigen::Vector3f>& places(const Geometry& geometry) const;
  /// Whoever looked at all of it has done so; pictures look at a few places of it.
  void letGo() const;
  /// The same of some samples' coefficients, which are most of it.
  void letGoOfRows(std::size_t begin, std::size_t end) const;

 private:
  mutable std::once_flag places_found_;
  mutable std::vector<Eigen::Vector3f> places_;
};

/// Nodes whose light is without what discs throw on them by way of polished floors. Its edges are as sharp as
/// those of patches of sun, so that pictures look for it by rays of their own.
struct GlintNodes {
  std::vector<float> shares;  ///< of each node, of such samples
  float roughness;            ///< of the floors, in the mean

  /// How much a place lacks of that light, 0 … 1; nothing where it is unknown.
  float at(const LightPlace& place) const {
    float sum = 0.0f;
    for (std::size_t k = 0; k < 3 && place.known(); ++k) sum += place.weight[k] * shares[place.node[k]];
    return sum;
  }
};
/// Null: there are none.
std::shared_ptr<const GlintNodes> glintNodes(const TransportData& data);

/// Share of the sky's light, by cosine, that each node of `data` would get straight of an even sky, 0 … 1.
std::vector<float> openSky(const TransportData& data);

}  // namespace sunlit::light
