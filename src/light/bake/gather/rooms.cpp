#include "light/bake/gather/rooms.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>

#include "light/bake/gather/room_directions.h"
#include "light/bake/gather/room_mirrors.h"
#include "light/bake/samples/met_sample.h"
#include "sunlit/quantity/angle.h"
#include "sunlit/quantity/random.h"

namespace sunlit::light {
namespace {

/// Over the sphere. A patch of the sun that takes a twentieth of what a wall looks at is met by fifty of
/// them; fewer where there are many rooms, so that the links of the first 780,000 take 800 MB at most, about.
constexpr std::size_t kMostDirections = 2048, kFewestDirections = 512;
constexpr std::size_t kMostLinks = 200'000'000;

/// Puts together what was seen twice.
void merge(std::vector<SampleSeen>* seen) {
  std::stable_sort(seen->begin(), seen->end(),
                   [](const SampleSeen& a, const SampleSeen& b) { return a.sample < b.sample; });
  std::size_t kept = 0;
  for (const SampleSeen& other : *seen) {
    if (kept > 0 && (*seen)[kept - 1].sample == other.sample) {
      SampleSeen& both = (*seen)[kept - 1];
      if (!(both.tint.white() && other.tint.white())) {
        both.tint = PackedTint(both.of(Eigen::Array3f::Ones()) + other.of(Eigen::Array3f::Ones()));
      }
      both.weight += other.weight;
    } else {
      (*seen)[kept++] = other;
    }
  }
  seen->resize(kept);
}

/// Whether more than a share `many` of a sample's rays meet `others`, each of these counted once.
bool seesMany(const SampleHits& seen, const std::vector<std::uint8_t>& others, float many) {
  std::vector<std::uint32_t> met;
  for (const SampleAndByte hit : seen.hits)
    if (others[hit.sample()] != 0) met.push_back(hit.sample());
  std::sort(met.begin(), met.end());
  const auto different = std::unique(met.begin(), met.end()) - met.begin();
  return static_cast<float>(different) > many * static_cast<float>(seen.hits.size());
}

/// What one room sees.
struct Packed {
  std::vector<BakedRooms::Link> links;
  std::vector<PackedTint> tints;  ///< of each, where they are kept
  std::uint32_t below;            ///< the first that is seen below the horizon
  float scale;                    ///< of their weights
};
Packed pack(const std::array<std::vector<SampleSeen>, 2>& seen, bool tinted) {
  Packed result{};
  float most = 1e-12f, all = 0.0f, packed = 0.0f;
  for (const auto& half : seen)
    for (const SampleSeen& other : half) most = std::max(most, other.weight);
  for (const auto& half : seen) {
    result.below = static_cast<std::uint32_t>(result.links.size());
    for (const SampleSeen& other : half) {
      const auto root = static_cast<std::uint32_t>(std::lround(255.0f * std::sqrt(other.weight / most)));
      result.links.push_back(BakedRooms::Link::of(other.sample, std::max(root, 1u)));
      if (tinted) result.tints.push_back(other.tint);
      all += other.weight;
      packed += BakedRooms::weightOf(result.links.back());
    }
  }
  result.scale = packed > 0.0f ? all / packed : 0.0f;
  return result;
}

}  // namespace

/// What a sample sees along many rays: numbers are sums of their weights.
struct RoomBaker::View {
  std::array<std::vector<SampleSeen>, 2> seen;  ///< above the horizon and below it
  std::array<float, 2> hidden{};
  std::array<float, SkyPatches::kCount> open{};
  Eigen::Array3f open_color = Eigen::Array3f::Zero();  ///< of `open`, in sum

  void add(const SampleSeen& other, float scattered, bool up) {
    hidden[up ? 0 : 1] += other.weight;
    seen[up ? 0 : 1].push_back({other.sample, other.weight * scattered, other.tint});
  }
  /// By way of a mirror, which hides what is there: above the horizon or below it is where that is.
  void addMirrored(const SampleSeen& other, bool up) { seen[up ? 0 : 1].push_back(other); }
  /// Makes sums of weights illuminance for a luminance of 1 / π, with what fewer rays have told before.
  void finish(const Receiver& receiver, std::size_t sample, TransportData* data) {
    const float all = std::accumulate(open.begin(), open.end(), hidden[0] + hidden[1]);
    if (!(all > 0.0f)) return;
    const float scale = receiver.open() / all;
    std::array<float, SkyPatches::kCount> row{};
    for (std::size_t p = 0; p < row.size(); ++p) row[p] = kPiFloat * scale * open[p];
    data->direct.set(sample, row.data());
    if (!data->direct_tints.empty()) data->direct_tints[sample] = PackedTint(open_color);
    for (std::size_t half = 0; half < 2; ++half) {
      float& hides = (half == 0 ? data->above : data->below).hides[sample];
      hides = scale * hidden[half];
      merge(&seen[half]);
      for (SampleSeen& other : seen[half]) other.weight *= hides / hidden[half];
    }
  }
};

/// Not those in joints and gaps, which see but few others, close by. In corners, too, half of what is seen or
/// more is one surface close by: who sees many of those that see many others is one of them.
std::vector<std::uint32_t> RoomBaker::lookers() const {
  constexpr float kMany = 0.5f;
  // Where three surfaces meet, a quarter of the half sphere is left.
  constexpr float kManyRooms = 1.0f / 6.0f;
  const std::vector<std::uint8_t> all(samples_.receivers.size(), 1);
  std::vector<std::uint8_t> rooms(all.size(), 0), corners(all.size(), 0);
  const auto find = [&](const std::vector<std::uint8_t>& others, float many, std::vector<std::uint8_t>* to) {
    tbb::parallel_for(std::size_t{0}, all.size(), [&](std::size_t i) {
      const Receiver& receiver = samples_.receivers[i];
      const SampleHits& seen = exchange_.seen[i];
      if (!seen.walled_in || seen.inside || receiver.coarse || receiver.thin) return;
      if (seesMany(seen, others, many)) (*to)[i] = 1;
    });
  };
  find(all, kMany, &rooms);
  find(rooms, kManyRooms, &corners);
  std::vector<std::uint32_t> found;
  for (std::uint32_t i = 0; i < rooms.size(); ++i)
    if (rooms[i] != 0 || corners[i] != 0) found.push_back(i);
  return found;
}

/// A packet of samples looks around.
class RoomBaker::Looking {
 public:
  Looking(const RoomBaker& baker, const Receiver* receivers, std::size_t count)
      : baker_(baker), group_(receivers, static_cast<int>(count)), views_(count) {}

  std::vector<View> around(const RoomDirections& sphere) {
    std::vector<Met> all(sphere.coarse.size());
    const auto count = static_cast<std::uint32_t>(all.size());
    for (std::size_t r = 0; r < all.size(); ++r) cast(r, sphere.coarse[r], &all[r]);
    Met met;
    for (std::size_t r = 0; r < all.size(); ++r) {
      const std::uint32_t first = sphere.first_fine[r], end = sphere.first_fine[r + 1];
      if (!isEdge(sphere, r, all)) {
        add(sphere.coarse[r], all[r], {static_cast<float>(end - first), static_cast<std::uint32_t>(r)});
        continue;
      }
      for (std::uint32_t f = first; f < end; ++f) {
        cast(r + f, sphere.fine[f], &met);
        add(sphere.fine[f], met, {1.0f, count + f});
      }
    }
    return std::move(views_);
  }

 private:
  using Lanes = ReceiverGroup::Lanes;
  struct Met {
    Lanes cast = 0, open = 0;
    Lanes outdoors = 0;  ///< those that see the sky, or what sees much of it
    Lanes dim = 0;       ///< behind veils that keep most of the light back
    std::array<float, kPacket> weights;
    std::array<std::uint32_t, kPacket> senders;  ///< where rays end; LightMesh::kNone: inside a body
    HitLayers hits;
  };
  /// What one surface on the way of each ray sends.
  struct Layer {
    const HitPacket& hits;
    std::array<std::uint32_t, kPacket> senders;
    std::array<float, kPacket> weights;  ///< 0: nothing there
    std::array<PackedTint, kPacket> tints;
  };
  struct Ray {
    float directions;      ///< for how many it stands
    std::uint32_t number;  ///< its own
  };

  void cast(std::size_t turn, const RoomDirections::Direction& direction, Met* met) const {
    met->cast = group_.weigh(direction.towards, met->weights.data());
    met->open = 0;
    met->outdoors = met->dim = 0;
    if (met->cast == 0) return;
    group_.cast(baker_.scene_.rays, {turn, direction.towards, met->cast}, &met->hits);
    for (int lane = 0; lane < group_.count(); ++lane) {
      if (!ReceiverGroup::has(met->cast, lane)) continue;
      if (met->hits.ends.triangle[lane] == HitPacket::kNothing) met->open |= Lanes{1} << lane;
      if (met->hits.shareOfEnd(lane) < 0.5f) met->dim |= Lanes{1} << lane;
      const std::uint32_t from = senderAt({met->hits.ends, lane, direction.towards});
      met->senders[static_cast<std::size_t>(lane)] = from;
      if (from != LightMesh::kNone && baker_.exchange_.seen[from].outdoors) met->outdoors |= Lanes{1} << lane;
    }
    met->outdoors |= met->open;
  }
  /// Whether sky, or what is outdoors, ends for any at a coarse direction or beside it. A gap that one's ray
  /// has met all look for finely: by those alone whose ray met it, it would count where it is met, by what it
  /// takes there, and where it is missed not at all.
  static bool isEdge(const RoomDirections& sphere, std::size_t r, const std::vector<Met>& all) {
    Lanes open = 0, shut = 0, dim = 0, bright = 0, outdoors = 0, indoors = 0;
    const auto add = [&](const Met& met) {
      open |= met.open;
      shut |= met.cast & ~met.open;
      dim |= met.dim;
      bright |= met.cast & ~met.dim;
      outdoors |= met.outdoors;
      indoors |= met.cast & ~met.outdoors;
    };
    add(all[r]);
    for (std::uint32_t k = sphere.first_beside[r]; k < sphere.first_beside[r + 1]; ++k)
      add(all[sphere.beside[k]]);
    return ((open & shut) | (dim & bright) | (outdoors & indoors)) != 0;
  }
  /// Rays that have met mirrors.
  struct InMirrors {
    Lanes lanes = 0;
    HitPacket hits;
    std::array<Eigen::Vector3f, kPacket> towards;
    std::array<float, kPacket> weights;          ///< with all mirrors on the way
    std::array<PackedTint, kPacket> tints;       ///< by glass before the first of them
    std::array<std::uint32_t, kPacket> samples;  ///< of the mirrors
  };

  void add(const RoomDirections::Direction& direction, const Met& met, const Ray& ray) {
    if (met.cast == 0) return;
    std::array<float, kPacket> weights{};
    for (std::size_t i = 0; i < kPacket; ++i)
      if (ReceiverGroup::has(met.cast, static_cast<int>(i))) weights[i] = ray.directions * met.weights[i];
    for (const HitLayers::Veil& veil : met.hits.veils) {
      Layer layer{veil.hits, {}, weights, {}};
      for (std::size_t i = 0; i < kPacket; ++i) {
        layer.weights[i] *= veil.shares[i];
        layer.tints[i] = veil.tints[i];
        if (layer.weights[i] > 0.0f)
          layer.senders[i] = senderAt({veil.hits, static_cast<int>(i), direction.towards});
      }
      addLayer(direction, layer, ray.number);
    }
    Layer layer{met.hits.ends, met.senders, weights, {}};
    for (std::size_t i = 0; i < views_.size(); ++i) {
      const int lane = static_cast<int>(i);
      layer.weights[i] *= met.hits.shareOfEnd(lane);
      layer.tints[i] = met.hits.tintOfEnd(lane);
      if (!ReceiverGroup::has(met.open, lane)) continue;
      views_[i].open[static_cast<std::size_t>(direction.patch)] += layer.weights[i];
      views_[i].open_color += layer.tints[i].times(Eigen::Array3f::Constant(layer.weights[i]));
    }
    addLayer(direction, layer, ray.number);
  }

  void addLayer(const RoomDirections::Direction& direction, const Layer& layer, std::uint32_t number) {
    InMirrors in_mirrors;
    for (int lane = 0; lane < group_.count(); ++lane) {
      const auto i = static_cast<std::size_t>(lane);
      if (!(layer.weights[i] > 0.0f)) continue;
      const std::uint32_t from = layer.senders[i];
      if (from == LightMesh::kNone) continue;
      views_[i].add({from, layer.weights[i], layer.tints[i]},
                    baker_.exchange_.scattered(from, direction.towards),
                    direction.patch != SkyPatches::kBelow);
      if (!baker_.exchange_.mirrors(from)) continue;
      in_mirrors.lanes |= Lanes{1} << lane;
      in_mirrors.weights[i] = layer.weights[i];
      in_mirrors.tints[i] = layer.tints[i];
      in_mirrors.samples[i] = from;
    }
    if (in_mirrors.lanes == 0) return;
    in_mirrors.hits = layer.hits;
    in_mirrors.towards.fill(direction.towards);
    followMirrors(direction, number, &in_mirrors);
  }

  /// LightMesh::kNone: inside a body, or nothing.
  std::uint32_t senderAt(const LaneHit& hit) const {
    const std::uint32_t sample = sampleAt(baker_.scene_, baker_.samples_, hit);
    return sample == LightMesh::kNone ? sample : baker_.exchange_.usefulBeside(sample);
  }

  /// Adds what mirrors show, and mirrors in these. The sky in them others add: GroundMirror, and
  /// Sending::direct of those that are not level.
  void followMirrors(const RoomDirections::Direction& direction, std::uint32_t number,
                     InMirrors* in_mirrors) {
    // The same facets for all samples: what chance does to one would be seen beside the next.
    static const EvenPoints even(0);
    constexpr std::size_t kMostMirrors = 3;
    for (std::size_t mirror = 0; mirror < kMostMirrors && in_mirrors->lanes != 0; ++mirror) {
      castOn({even.at(number, 2 * mirror), even.at(number, 2 * mirror + 1)}, in_mirrors);
      for (int lane = 0; lane < group_.count(); ++lane) {
        if (!ReceiverGroup::has(in_mirrors->lanes, lane)) continue;
        const auto i = static_cast<std::size_t>(lane);
        const std::uint32_t from = senderAt({in_mirrors->hits, lane, in_mirrors->towards[i]});
        const bool known = from != LightMesh::kNone;
        if (known) {
          views_[i].addMirrored(
              {from, in_mirrors->weights[i] * baker_.exchange_.scattered(from, in_mirrors->towards[i]),
               in_mirrors->tints[i]},
              direction.patch != SkyPatches::kBelow);
        }
        in_mirrors->samples[i] = from;
        if (!known || !baker_.exchange_.mirrors(from)) in_mirrors->lanes &= ~(Lanes{1} << lane);
      }
    }
  }

  /// Casts rays on from the mirrors that were met. Those that meet nothing are gone.
  void castOn(const Eigen::Vector2f& facet, InMirrors* in_mirrors) const {
    RayPacket rays;
    for (std::size_t i = 0; i < kPacket; ++i) {
      rays.set(i, Eigen::Vector3f::Zero(), Eigen::Vector3f::UnitZ(), false);
      const int lane = static_cast<int>(i);
      if (!ReceiverGroup::has(in_mirrors->lanes, lane)) continue;
      const MirroredRay ray =
          mirroredRay(baker_.scene_.geometry, baker_.samples_.paints[in_mirrors->samples[i]],
                      {in_mirrors->hits, lane, in_mirrors->towards[i]}, facet);
      rays.set(i, ray.origin, ray.towards, ray.share > 0.0f);
      in_mirrors->towards[i] = ray.towards;
      in_mirrors->weights[i] *= ray.share;
    }
    baker_.scene_.rays.cast(rays, &in_mirrors->hits);
    for (std::size_t i = 0; i < kPacket; ++i) {
      if (rays.valid[i] == 0 || in_mirrors->hits.triangle[i] == HitPacket::kNothing)
        in_mirrors->lanes &= ~(Lanes{1} << i);
    }
  }

  const RoomBaker& baker_;
  ReceiverGroup group_;
  std::vector<View> views_;
};

std::vector<RoomBaker::View> RoomBaker::lookFrom(const std::uint32_t* lookers, std::size_t count,
                                                 const RoomDirections& sphere) const {
  std::array<Receiver, kPacket> receivers;
  for (std::size_t i = 0; i < count; ++i) receivers[i] = samples_.receivers[lookers[i]];
  return Looking(*this, receivers.data(), count).around(sphere);
}

void RoomBaker::look(TransportData* data, const Progress& progress) const {
  BakedRooms& rooms = data->rooms;
  rooms.samples = lookers();
  const std::size_t count = rooms.samples.size();
  if (count == 0) return;
  const RoomDirections sphere(std::clamp(2 * kMostLinks / count, kFewestDirections, kMostDirections));
  const bool tinted = !data->direct_tints.empty();
  std::vector<Packed> packed(count);
  const std::size_t packets = (count + kPacket - 1) / kPacket;
  WorkDone done(progress, packets);
  tbb::parallel_for(std::size_t{0}, packets, [&](std::size_t p) {
    const std::size_t first = p * kPacket;
    std::vector<View> views =
        lookFrom(rooms.samples.data() + first, std::min(kPacket, count - first), sphere);
    for (std::size_t i = 0; i < views.size(); ++i) {
      const std::uint32_t sample = rooms.samples[first + i];
      views[i].finish(samples_.receivers[sample], sample, data);
      packed[first + i] = pack(views[i].seen, tinted);
    }
    done.add();
  });
  std::size_t sum = 0;
  for (const Packed& room : packed) sum += room.links.size();
  if (sum > std::numeric_limits<std::uint32_t>::max())
    throw std::runtime_error("bake of light: rooms of this scene see too much of each other; fewer samples");
  std::vector<BakedRooms::Link>& all = rooms.links.own();
  std::vector<PackedTint>& tints = rooms.link_tints.own();
  all.reserve(sum);
  if (tinted) tints.reserve(sum);
  for (Packed& room : packed) {
    const auto start = static_cast<std::uint32_t>(all.size());
    rooms.first.push_back(start);
    rooms.below.push_back(start + room.below);
    rooms.scales.push_back(room.scale);
    all.insert(all.end(), room.links.begin(), room.links.end());
    tints.insert(tints.end(), room.tints.begin(), room.tints.end());
    room = {};
  }
  rooms.first.push_back(static_cast<std::uint32_t>(all.size()));
}

}  // namespace sunlit::light
