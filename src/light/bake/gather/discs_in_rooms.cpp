#include "light/bake/gather/discs_in_rooms.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <limits>

#include "light/bake/gather/floor_glints.h"
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

}  // namespace

DiscsInRooms::DiscsInRooms(const TransportData& data, const sky::Daylight& day, const Visibility& visibility,
                           const DiscsThroughCloud& through)
    : data_(data) {
  const std::size_t count = data_.rooms.sources.size();
  struct Shining {
    const sky::DiscLight& disc;
    const ThroughCloud& through;
  };
  std::vector<Shining> shining;
  for (const Shining& one : {Shining{day.sun(), through.sun}, Shining{day.moon(), through.moon}})
    if (one.disc.illuminance.value.maxCoeff() > leastDisc_lx(day)) shining.push_back(one);
  if (count == 0 || shining.empty()) return;
  direct_.resize(count, Eigen::Array3f::Zero());
  has_.resize(data_.sampleCount(), Eigen::Array3f::Zero());
  sent_.resize(data_.sampleCount(), Eigen::Array4f::Zero());
  mirrored_.resize(data_.rooms.samples.size(), Eigen::Array3f::Zero());
  glints_.resize(data_.rooms.samples.size(), Eigen::Array3f::Zero());
  arrived_.resize(data_.rooms.samples.size());
  findAsked();
  for (const auto& [disc, through_to] : shining) {
    const DiscOnSources work(data_, disc, visibility, through_to);
    tbb::parallel_for(std::size_t{0}, blocks(count), [&](std::size_t block) {
      work.add(block * kOfTask, std::min(count, (block + 1) * kOfTask), &direct_);
    });
    startFromPatches(disc, through_to);
    FloorGlints(data_, disc, visibility, through_to).addTo(&glints_);
  }
  double change = 1.0;
  for (int bounce = 0; bounce < kMostBounces && change > kLittle; ++bounce) {
    send();
    change = receive();
  }
}

void DiscsInRooms::findAsked() {
  std::vector<char> asked(data_.sampleCount(), 0);
  for (const std::uint32_t sample : data_.rooms.samples) asked[sample] = 1;
  for (const BakedRooms::Source& source : data_.rooms.sources) {
    asked[source.sample] = 1;
    if (source.other != LightMesh::kNone) asked[source.other] = 1;
  }
  for (std::uint32_t i = 0; i < asked.size(); ++i)
    if (asked[i] != 0) asked_.push_back(i);
}

/// Adds what the patches around the disc tell.
void DiscsInRooms::startFromPatches(const sky::DiscLight& disc, const ThroughCloud& through) {
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

void DiscsInRooms::send() {
  const image::KeptArray<BakedRooms::Source>& sources = data_.rooms.sources;
  tbb::parallel_for(std::size_t{0}, sources.size(), [&](std::size_t s) {
    const BakedRooms::Source& source = sources[s];
    Eigen::Array3f sum =
        direct_[s] + Eigen::Map<const Eigen::Array3f>(source.bounced.data()) * has_[source.sample];
    if (source.other != LightMesh::kNone)
      sum += Eigen::Map<const Eigen::Array3f>(source.through.data()) * has_[source.other];
    sent_[source.sample].head<3>() = sum;
  });
}

/// From all that a room sees.
Arrived DiscsInRooms::arriving(std::size_t room) const {
  Eigen::Array4f above = Eigen::Array4f::Zero(), below = Eigen::Array4f::Zero();
  visitLinks(data_.rooms, room, [&](const SampleSeen& other, bool up) {
    Eigen::Array4f light = other.weight * sent_[other.sample];
    if (!other.tint.white()) light.head<3>() = other.of(sent_[other.sample].head<3>());
    (up ? above : below) += light;
  });
  return {above.head<3>(), below.head<3>()};
}

/// Returns by how much the light of rooms has changed, as a share of it, on average over those of a block:
/// the most of all blocks, for most of a land may be of rooms that have all their light at once.
double DiscsInRooms::receive() {
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

}  // namespace sunlit::light
