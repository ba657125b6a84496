#include "light/bake/gather/discs_in_rooms.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <limits>

#include "light/bake/gather/floor_glints.h"
#include "light/bake/gather/links.h"
#include "light/bake/gather/small_light.h"
#include "light/geometry/ray_list.h"
#include "light/patches/disc_above_horizon.h"
#include "light/patches/least_disc.h"
#include "light/shading/glass_sheets.h"

namespace sunlit::light {
namespace {

/// Bounces that are followed: of white walls' light a sixth is left to be as the patches told.
constexpr int kMostBounces = 8;
constexpr double kLittle = 0.005;  // of rooms' light, on average over neighbours; less still follows

constexpr float kWhole = 0.999f;  ///< share of a source, but for rounding

constexpr std::size_t kOfTask = 256;  ///< rooms, or their sources
std::size_t blocks(std::size_t count) {
  return (count + kOfTask - 1) / kOfTask;
}

/// Towards the middle of the part of a disc that is above the horizon.
Eigen::Vector3f middleOf(const sky::DiscLight& disc) {
  const Eigen::Vector3f towards = disc.towards.vector().cast<float>();
  const double radius_rad = disc.angular_radius.rad();
  const auto height = static_cast<float>(
      radius_rad * DiscAboveHorizon(towards, radius_rad).place(Eigen::Vector2d::Zero()).y());
  const Eigen::Vector3f up = Eigen::Vector3f::UnitZ() - towards.z() * towards;
  return up.squaredNorm() > 1e-6f ? (towards + height * up.normalized()).normalized() : towards;
}

/// One of sun and moon, over many sources.
class DiscOnSources {
 public:
  DiscOnSources(const TransportData& data, const sky::DiscLight& disc, const Visibility& visibility,
                const ThroughCloud& through)
      : data_(data),
        through_(through),
        by_patches_(disc),
        towards_(middleOf(disc)),
        illuminance_(disc.illuminance.value),
        visibility_(visibility),
        glass_(visibility) {}

  /// Adds to `sent` of sources [first, end) what they send of light straight from the disc.
  void add(std::size_t first, std::size_t end, std::vector<Eigen::Array3f>* sent) const {
    const BakedRooms& rooms = data_.rooms;
    std::vector<Lit> lit, edges;
    for (std::size_t s = first; s < end; ++s) {
      const BakedRooms::Source& source = rooms.sources[s];
      if (source.points == 0) {
        (*sent)[s] += Eigen::Map<const Eigen::Array3f>(source.direct.data()) * byPatches(source.sample);
      } else if (cosine(source) > 0.0f) {
        lit.push_back({s});
      }
      if (source.other != LightMesh::kNone)
        (*sent)[s] += Eigen::Map<const Eigen::Array3f>(source.through.data()) * byPatches(source.other);
    }
    look([](const BakedRooms::Source& source) { return source.probes; }, &lit);
    for (const Lit& here : lit) {
      const BakedRooms::Source& source = rooms.sources[here.source];
      if (here.share > 0.0f && here.share < kWhole && source.probes < source.points) {
        edges.push_back(here);
        edges.back().lit_probes =
            static_cast<std::uint32_t>(here.share * static_cast<float>(source.probes) + 0.5f);
      } else {
        send(here, sent);
      }
    }
    look([](const BakedRooms::Source& source) { return source.points; }, &edges);
    for (Lit& here : edges) {
      if (here.lit_probes == 1) makeUpForUnseen(&here);
      send(here, sent);
    }
  }

 private:
  /// A source that faces the disc.
  struct Lit {
    std::size_t source;
    float share = 0.0f;       ///< of it that the disc shines on
    std::uint32_t point = 0;  ///< one of its points that it shines on
    std::uint32_t lit_probes = 0;
  };

  /// Of small patches of light many are missed by all n probes. Those that one probe has met make up for it:
  /// where probes meet a share s each by itself, none does with a chance of (1 − s)ⁿ, one with n s (1 −
  /// s)ⁿ⁻¹, so that the sum over all sources is right if of the other points (1 − s) / n more is lit then.
  void makeUpForUnseen(Lit* lit) const {
    const BakedRooms::Source& source = data_.rooms.sources[lit->source];
    const auto probes = static_cast<float>(source.probes), points = static_cast<float>(source.points);
    lit->share += (1.0f - probes / points) * (1.0f - lit->share) / probes;
  }

  /// Sets `share` and `point`, by pointsOf(source) of the points of each.
  template <typename PointsOf>
  void look(const PointsOf& pointsOf, std::vector<Lit>* sources) const {
    thread_local RayList rays;
    thread_local std::vector<std::uint8_t> blocked;
    rays.clear();
    const auto visit = [&](const auto& see) {
      for (Lit& here : *sources) {
        const BakedRooms::Source& source = data_.rooms.sources[here.source];
        const std::uint32_t count = pointsOf(source);
        for (std::uint32_t k = 0; k < count; ++k) see(&here, source, k * source.points / count);
      }
    };
    visit([&](Lit*, const BakedRooms::Source& source, std::uint32_t k) {
      rays.reserve(1);
      rays.add(0, at(source, k), towards_);
    });
    blocked.resize(rays.size());
    visibility_.occluded(rays.rays(), blocked.data());
    for (Lit& here : *sources) here.share = 0.0f;
    std::size_t ray = 0;
    visit([&](Lit* here, const BakedRooms::Source& source, std::uint32_t k) {
      if (blocked[ray++] != 0) return;
      const std::uint32_t count = pointsOf(source);
      here->share += count == source.points ? data_.rooms.points[source.first_point + k].share
                                            : 1.0f / static_cast<float>(count);
      here->point = k;
    });
  }

  void send(const Lit& lit, std::vector<Eigen::Array3f>* sent) const {
    if (!(lit.share > 0.0f)) return;
    const BakedRooms::Source& source = data_.rooms.sources[lit.source];
    (*sent)[lit.source] += Eigen::Map<const Eigen::Array3f>(source.direct.data()) * illuminance_ *
                           (cosine(source) * lit.share * through_.at(source.sample)) *
                           throughGlass(at(source, lit.point));
  }

  Eigen::Vector3f at(const BakedRooms::Source& source, std::uint32_t k) const {
    const BakedRooms::Point& point = data_.rooms.points[source.first_point + k];
    return {point.x, point.y, point.z};
  }
  float cosine(const BakedRooms::Source& source) const {
    return Eigen::Map<const Eigen::Vector3f>(source.normal.data()).dot(towards_);
  }
  Eigen::Array3f byPatches(std::uint32_t sample) const {
    return data_.directTint(sample).times(by_patches_.times(data_.direct.row(sample)) *
                                          (data_.direct.scales[sample] * through_.at(sample)));
  }
  Eigen::Array3f throughGlass(const Eigen::Vector3f& point) const {
    if (!glass_.any()) return Eigen::Array3f::Ones();
    return glass_.through({point, towards_, 0.0f, std::numeric_limits<float>::infinity()});
  }

  const TransportData& data_;
  const ThroughCloud& through_;
  SmallLight by_patches_;
  Eigen::Vector3f towards_;
  Eigen::Array3f illuminance_;
  const Visibility& visibility_;
  GlassSheets glass_;
};

/// Illuminance by a sample that is seen, of those that have `sent`; the fourth number as there, but for a
/// factor above 0. For loops over millions.
[[gnu::always_inline]] inline Eigen::Array4f lightOf(const SampleSeen& other, const Eigen::Array4f* sent) {
  Eigen::Array4f light = other.weight * sent[other.sample];
  if (!other.tint.white()) light.head<3>() = other.of(sent[other.sample].head<3>());
  return light;
}

/// Of sun and moon, or one of them.
class RoomsByDiscs {
 public:
  explicit RoomsByDiscs(const TransportData& data);
  /// Before follow().
  void add(const sky::DiscLight& disc, const Visibility& visibility, const ThroughCloud& through);
  /// Illuminance of each room's sample.
  std::vector<Arrived> follow();

 private:
  /// Of a room: what comes from samples that have all their light at once, and which links tell of others.
  struct Known {
    Arrived light;
    std::vector<std::uint32_t> others;
    bool none = false;  ///< most are others: all links are to be asked again
  };

  void findAsked();
  void startFromPatches(const sky::DiscLight& disc, const ThroughCloud& through);
  void send(std::size_t source);
  Arrived arriving(std::size_t room);
  Arrived arrivingAgain(std::size_t room) const;
  template <typename Arriving>
  double receive(const Arriving& arriving);

  const TransportData& data_;
  std::vector<std::uint32_t> asked_;     ///< samples whose light matters here: rooms and what they see
  std::vector<std::uint32_t> changing_;  ///< sources that have, or pass on, light of rooms
  std::vector<Eigen::Array3f> direct_;   ///< of each source: luminance × π by light straight from the discs
  std::vector<Eigen::Array3f> has_;      ///< of each sample that is asked: illuminance by surfaces, lx
  /// Of each sample: luminance × π, and 1 where it is of a source in `changing_`, else 0.
  std::vector<Eigen::Array4f> sent_;
  std::vector<Eigen::Array3f> mirrored_;  ///< of each room: by way of the ground as a mirror, lx
  std::vector<Eigen::Array3f> glints_;    ///< of each room: by way of polished floors, lx
  std::vector<Known> known_;              ///< of each room
  std::vector<Arrived> arrived_;          ///< of each room
};

RoomsByDiscs::RoomsByDiscs(const TransportData& data)
    : data_(data),
      direct_(data.rooms.sources.size(), Eigen::Array3f::Zero()),
      has_(data.sampleCount(), Eigen::Array3f::Zero()),
      sent_(data.sampleCount(), Eigen::Array4f::Zero()),
      mirrored_(data.rooms.samples.size(), Eigen::Array3f::Zero()),
      glints_(data.rooms.samples.size(), Eigen::Array3f::Zero()),
      known_(data.rooms.samples.size()),
      arrived_(data.rooms.samples.size()) {
  findAsked();
}

void RoomsByDiscs::add(const sky::DiscLight& disc, const Visibility& visibility,
                       const ThroughCloud& through) {
  const DiscOnSources work(data_, disc, visibility, through);
  tbb::parallel_for(std::size_t{0}, blocks(direct_.size()), [&](std::size_t block) {
    work.add(block * kOfTask, std::min(direct_.size(), (block + 1) * kOfTask), &direct_);
  });
  startFromPatches(disc, through);
  FloorGlints(data_, disc, visibility, through).addTo(&glints_);
}

std::vector<Arrived> RoomsByDiscs::follow() {
  tbb::parallel_for(std::size_t{0}, direct_.size(), [&](std::size_t source) { send(source); });
  double change = receive([&](std::size_t room) { return arriving(room); });
  for (int bounce = 1; bounce < kMostBounces && change > kLittle; ++bounce) {
    tbb::parallel_for(std::size_t{0}, changing_.size(), [&](std::size_t k) { send(changing_[k]); });
    change = receive([&](std::size_t room) { return arrivingAgain(room); });
  }
  return std::move(arrived_);
}

void RoomsByDiscs::findAsked() {
  std::vector<char> asked(data_.sampleCount(), 0);
  for (const std::uint32_t sample : data_.rooms.samples) asked[sample] = 1;
  // So far rooms alone.
  const auto isRoom = [&](std::uint32_t sample) { return sample != LightMesh::kNone && asked[sample] != 0; };
  const image::KeptArray<BakedRooms::Source>& sources = data_.rooms.sources;
  for (std::uint32_t s = 0; s < sources.size(); ++s) {
    if (!isRoom(sources[s].sample) && !isRoom(sources[s].other)) continue;
    changing_.push_back(s);
    sent_[sources[s].sample][3] = 1.0f;
  }
  for (const BakedRooms::Source& source : sources) {
    asked[source.sample] = 1;
    if (source.other != LightMesh::kNone) asked[source.other] = 1;
  }
  for (std::uint32_t i = 0; i < asked.size(); ++i)
    if (asked[i] != 0) asked_.push_back(i);
}

/// Adds what the patches around the disc tell.
void RoomsByDiscs::startFromPatches(const sky::DiscLight& disc, const ThroughCloud& through) {
  const SmallLight light(disc);
  const auto add = [&](std::uint32_t sample) {
    for (const PassedOn* part : {&data_.above, &data_.below}) {
      has_[sample] += light.times(part->coefficients.row(sample)) *
                      (part->coefficients.scales[sample] * through.at(sample)) *
                      Eigen::Map<const Eigen::Array3f>(part->tints[sample].data());
    }
  };
  constexpr std::size_t kInMemory = 1u << 14;  // samples, with others between them
  for (std::size_t begin = 0; begin < asked_.size(); begin += kInMemory) {
    const std::size_t end = std::min(begin + kInMemory, asked_.size());
    tbb::parallel_for(begin, end, [&](std::size_t k) { add(asked_[k]); });
    data_.letGoOfRows(asked_[begin], asked_[end - 1] + 1);
  }
  const Coefficients& mirrored = data_.rooms.mirrored;
  tbb::parallel_for(std::size_t{0}, mirrored_.size(), [&](std::size_t room) {
    const PackedTint tint = tintOf(data_.rooms.mirrored_tints, room);
    mirrored_[room] += tint.times(light.times(mirrored.row(room)) *
                                  (mirrored.scales[room] * through.at(data_.rooms.samples[room])));
  });
}

void RoomsByDiscs::send(std::size_t number) {
  const BakedRooms::Source& source = data_.rooms.sources[number];
  Eigen::Array3f sum =
      direct_[number] + Eigen::Map<const Eigen::Array3f>(source.bounced.data()) * has_[source.sample];
  if (source.other != LightMesh::kNone)
    sum += Eigen::Map<const Eigen::Array3f>(source.through.data()) * has_[source.other];
  sent_[source.sample].head<3>() = sum;
}

/// From all that a room sees, of which it keeps what stays.
Arrived RoomsByDiscs::arriving(std::size_t room) {
  const RoomLinks links(data_.rooms, room);
  const Eigen::Array4f* const sent = sent_.data();
  Known known;
  const auto sumOf = [&](std::uint32_t first, std::uint32_t end, Eigen::Array3f* stays) -> Eigen::Array3f {
    Eigen::Array4f staying = Eigen::Array4f::Zero(), changing = Eigen::Array4f::Zero();
    for (std::uint32_t k = first; k < end; ++k) {
      const Eigen::Array4f light = lightOf(links.at(k), sent);
      if (light[3] > 0.0f) {
        changing += light;
        known.others.push_back(k);
      } else {
        staying += light;
      }
    }
    *stays = staying.head<3>();
    return (staying + changing).head<3>();
  };
  Arrived sum;
  sum.above = sumOf(links.first, links.below, &known.light.above);
  sum.below = sumOf(links.below, links.end, &known.light.below);
  known.none = known.others.size() > (links.end - links.first) / 2;
  if (known.none) known = {{}, {}, true};
  known_[room] = std::move(known);
  return sum;
}

/// The same once samples of rooms have other light than before.
Arrived RoomsByDiscs::arrivingAgain(std::size_t room) const {
  const RoomLinks links(data_.rooms, room);
  const Eigen::Array4f* const sent = sent_.data();
  const Known& known = known_[room];
  Eigen::Array4f above = Eigen::Array4f::Zero(), below = Eigen::Array4f::Zero();
  if (known.none) {
    for (std::uint32_t k = links.first; k < links.below; ++k) above += lightOf(links.at(k), sent);
    for (std::uint32_t k = links.below; k < links.end; ++k) below += lightOf(links.at(k), sent);
  } else {
    for (const std::uint32_t k : known.others)
      (k < links.below ? above : below) += lightOf(links.at(k), sent);
  }
  return {known.light.above + above.head<3>(), known.light.below + below.head<3>()};
}

/// Returns by how much the light of rooms has changed, as a share of it, on average over those of a block:
/// the most of all blocks, for most of a land may be of rooms that have all their light at once.
template <typename Arriving>
double RoomsByDiscs::receive(const Arriving& arriving) {
  const BakedRooms& rooms = data_.rooms;
  const std::size_t count = rooms.samples.size();
  std::vector<double> changes(blocks(count), 0.0);
  tbb::parallel_for(std::size_t{0}, changes.size(), [&](std::size_t block) {
    const std::size_t first = block * kOfTask, end = std::min(count, first + kOfTask);
    for (std::size_t room = first; room < end; ++room) {
      Arrived sum = arriving(room);
      sum.below += mirrored_[room];
      arrived_[room] = sum;
      Eigen::Array3f& has = has_[rooms.samples[room]];
      const Eigen::Array3f all = sum.above + sum.below + glints_[room];
      const float most = all.maxCoeff();
      if (most > 0.0f) changes[block] += static_cast<double>((all - has).abs().maxCoeff() / most);
      has = all;
    }
    changes[block] /= static_cast<double>(end - first);
  });
  return *std::max_element(changes.begin(), changes.end());
}

}  // namespace

std::vector<Arrived> discsInRooms(const TransportData& data, const sky::Daylight& day,
                                  const Visibility& visibility, const DiscsThroughCloud& through) {
  struct Shining {
    const sky::DiscLight& disc;
    const ThroughCloud& through;
  };
  std::vector<Shining> shining;
  for (const Shining& one : {Shining{day.sun(), through.sun}, Shining{day.moon(), through.moon}})
    if (one.disc.illuminance.value.maxCoeff() > leastDisc_lx(day)) shining.push_back(one);
  if (data.rooms.sources.empty() || shining.empty()) return {};
  RoomsByDiscs rooms(data);
  for (const auto& [disc, through_to] : shining) rooms.add(disc, visibility, through_to);
  return rooms.follow();
}

}  // namespace sunlit::light
