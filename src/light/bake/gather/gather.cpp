#include "light/bake/gather/gather.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <stdexcept>
#include <string>
#include <utility>

#include "light/bake/gather/exchange.h"
#include "light/bake/gather/lamp_bounces.h"
#include "light/bake/gather/rooms.h"
#include "light/bake/gather/sky_in_ground.h"
#include "light/bake/samples/adaptive_probe.h"
#include "light/bake/samples/burial_test.h"
#include "light/bake/samples/met_sample.h"
#include "light/bake/samples/parting_walls.h"
#include "light/patches/angles.h"
#include "light/shading/mirror_lobe.h"
#include "sunlit/light/visibility.h"
#include "sunlit/quantity/angle.h"
#include "sunlit/quantity/photometry.h"

namespace sunlit::light {
namespace {

constexpr std::size_t kPatches = SkyPatches::kCount;
constexpr float kMostInside = 0.6f;  ///< share of rays that may end inside bodies
/// Of what a sample looks at, by cosine, walls and the like: where they are less, most light comes from the
/// sky, or in many parts through leaves.
constexpr float kWalls = 0.8f;
/// The same of surfaces of any kind: less than the reveal of a window sees.
constexpr float kOutdoors = 0.4f;

/// What of the work is done, about: once rays to the sky are cast, rooms are found, the first bounces and the
/// others are told, and what shines has lit all; lamps take the rest.
constexpr double kDirect = 0.5, kRooms = 0.75, kBounces = 0.85, kLater = 0.9, kShone = 0.92;

/// Fewer were asked for to see just these.
constexpr int kBouncesBeforeAll = 3;

using Row = std::array<float, kPatches>;

/// Whether any glass of the scene changes the colour of light.
bool hasTintedGlass(const scene::Scene& scene) {
  return std::any_of(scene.materials.begin(), scene.materials.end(), [](const scene::Material& material) {
    return isGlass(material) && !PackedTint(material.base_color.value).white();
  });
}

class Gatherer {
 public:
  Gatherer(const BakeScene& scene, const SceneSamples& samples, const GatherOptions& options,
           const BakedRooms& rooms)
      : scene_(scene),
        geometry_(scene.geometry),
        traits_(scene.traits),
        samples_(samples),
        options_(options),
        patches_(options.rays_per_patch),
        probe_(scene.rays, scene.traits, patches_),
        exchange_(samples, patches_, rooms),
        count_(samples.receivers.size()) {}

  UselessSamples gather(TransportData* data) {
    data->direct.resize(count_);
    if (hasTintedGlass(*geometry_.scene)) {
      data->direct_tints.resize(count_);
      exchange_.tints.resize(count_);
    }
    data->above.resize(count_);
    data->below.resize(count_);
    findStarts();
    const std::size_t packets = (starts_.size() + kPacket - 1) / kPacket;
    WorkDone done(partOf(options_.progress, 0.0, options_.bounces > 0 ? kDirect : 1.0), packets);
    tbb::parallel_for(std::size_t{0}, packets, [&](std::size_t p) {
      lookAround(p * kPacket, data);
      done.add();
    });
    UselessSamples useless{std::vector<bool>(count_), {}};
    for (std::size_t i = 0; i < count_; ++i) useless.are[i] = exchange_.seen[i].inside;
    useless.in_place = exchange_.passOver(useless.are, PartingWalls(scene_, samples_));
    const bool all = options_.bounces >= kBouncesBeforeAll;
    if (options_.bounces > 0) {
      const RoomBaker rooms(scene_, samples_, exchange_);
      rooms.look(data, partOf(options_.progress, kDirect, kRooms));
      exchange_.useRooms();
      const SkyInGround in_ground(samples_, exchange_);
      SkyInGround::OfSamples mirrored = in_ground.find(*data);
      if (all) {
        rooms.finish(&data->rooms);
        in_ground.tellRooms(mirrored, data);
      }
      mirrored_ = std::move(mirrored.coefficients);
      exchange_.mirrored_sums = std::move(mirrored.sums);
    }
    for (int bounce = 0; bounce < options_.bounces; ++bounce) {
      const double each = (kBounces - kRooms) / options_.bounces, from = kRooms + each * bounce;
      passOn(data, partOf(options_.progress, from, from + each));
    }
    if (all) exchange_.addLaterBounces(data);
    const int bounces = all ? Exchange::kAllBounces : options_.bounces;
    const LampBounces lamps(scene_, samples_, exchange_, bounces);
    if (bounces > 0 && options_.shining.any())
      lamps.bakeShining(options_.shining, partOf(options_.progress, kLater, kShone), data);
    data->lamps = lamps.bake(partOf(options_.progress, kShone, 1.0));
    return useless;
  }

 private:
  /// Sums over the rays of one sample.
  struct Look {
    Row row{};
    Eigen::Array3f open = Eigen::Array3f::Zero();  ///< of `row`, in sum, with its colours
    BurialTest burial;
    float all = 0.0f, inside = 0.0f, leaves = 0.0f, blocked_up = 0.0f, blocked_down = 0.0f,
          coarse_blocked_up = 0.0f;
    std::array<SampleAndByte, SkyPatches::kCoarse> hits;  ///< as SampleHits::hits
    std::array<PackedTint, SkyPatches::kCoarse> tints;    ///< of each
    std::size_t hit_count = 0, up = 0;
  };

  /// Of two samples on both sides of a sheet, rays of the first serve both.
  void findStarts() {
    for (std::uint32_t i = 0; i < count_; ++i) {
      const OtherSide& other = samples_.other_side[i];
      if (!other.shares_rays || other.sample > i) starts_.push_back(i);
    }
  }

  /// The sample behind one that its rays serve, too, or LightMesh::kNone.
  std::uint32_t servedToo(std::uint32_t sample) const {
    const OtherSide& other = samples_.other_side[sample];
    return other.shares_rays ? other.sample : LightMesh::kNone;
  }

  void lookAround(std::size_t first, TransportData* data) {
    const std::size_t count = std::min(kPacket, starts_.size() - first);
    std::array<Receiver, kPacket> receivers;
    std::array<std::array<Look, 2>, kPacket> looks;
    for (std::size_t i = 0; i < count; ++i) {
      const std::uint32_t sample = starts_[first + i];
      receivers[i] = samples_.receivers[sample];
      // Half: both sides' rays count alike. Doubled again below, for each sample has one side to itself.
      if (servedToo(sample) != LightMesh::kNone) receivers[i].transmission = 0.5f;
    }
    const auto& rays = patches_.rays();
    probe_.look({receivers.data(), static_cast<int>(count)},
                [&](int lane, std::size_t r, float weight, const HitLayers& hits) {
                  const auto i = static_cast<std::size_t>(lane);
                  const std::uint32_t sample = starts_[first + i], behind = servedToo(sample);
                  const bool two_sided = behind != LightMesh::kNone;
                  const bool turned = two_sided && receivers[i].normal.dot(rays[r].towards) < 0.0f;
                  if (two_sided) weight *= 2.0f;
                  note(rays[r], {receivers[i].normal, weight, hits, lane}, turned ? behind : sample,
                       &looks[i][turned ? 1 : 0]);
                });
    for (std::size_t i = 0; i < count; ++i) {
      const std::uint32_t sample = starts_[first + i], behind = servedToo(sample);
      finish(sample, &looks[i][0], data);
      if (behind != LightMesh::kNone) finish(behind, &looks[i][1], data);
    }
  }

  /// As BurialTest::Cast, with all that the ray met.
  struct Cast {
    const Eigen::Vector3f& normal;
    float weight;
    const HitLayers& hits;
    int lane;
  };
  void note(const SkyPatches::Ray& ray, const Cast& cast, std::uint32_t sample, Look* look) const {
    cast.hits.visit(cast.lane, [&](const HitPacket& hits, float share, PackedTint tint) {
      const bool known = hasSampleAt(scene_, samples_, {hits, cast.lane, ray.towards});
      noteMet(ray, {hits.triangle[cast.lane], known, cast.weight * share, tint}, look);
    });
    look->all += cast.weight;
    look->burial.add({cast.normal, ray.towards, cast.weight, cast.hits.ends, cast.lane}, geometry_, traits_);
    if (ray.coarse == SkyPatches::Ray::kFineOnly) return;
    // A veil buries nothing, and what passes light on is one a ray.
    const std::uint32_t from = sampleAt(scene_, samples_, {cast.hits.byChance(), cast.lane, ray.towards});
    if (from == LightMesh::kNone) return;
    const bool up = ray.patch != SkyPatches::kBelow;
    if (up) {
      look->coarse_blocked_up +=
          SkyPatches::solidAngle(ray.patch) * samples_.receivers[sample].weight(ray.towards);
    }
    const auto direction = static_cast<std::uint32_t>(up ? ray.coarse : ray.coarse - SkyPatches::kAbove);
    look->tints[look->hit_count] = cast.hits.tintByChance(cast.lane);
    look->hits[look->hit_count++] = SampleAndByte::of(from, direction);
    look->up += up;
  }

  struct MetOnWay {
    std::uint32_t triangle;  ///< as HitPacket::triangle
    bool known;              ///< whether it has samples
    float weight;
    PackedTint tint;  ///< by glass before it
  };
  void noteMet(const SkyPatches::Ray& ray, const MetOnWay& met, Look* look) const {
    if (met.triangle == HitPacket::kNothing) {
      look->row[static_cast<std::size_t>(ray.patch)] += met.weight;
      look->open += met.tint.times(Eigen::Array3f::Constant(met.weight));
      return;
    }
    if (!met.known) {
      look->inside += met.weight;
      return;
    }
    if (isLeaf(traits_[met.triangle].kind)) look->leaves += met.weight;
    (ray.patch != SkyPatches::kBelow ? look->blocked_up : look->blocked_down) += met.weight;
  }

  void finish(std::uint32_t sample, Look* look, TransportData* data) {
    // The quadrature of a cosine over the hemisphere is π; rays that end inside bodies tell nothing.
    const Receiver& receiver = samples_.receivers[sample];
    const float told = std::max(look->all - look->inside, 0.05f * look->all);
    const float scale = told > 0.0f ? kPiFloat * receiver.open() / told : 0.0f;
    for (float& value : look->row) value *= scale;
    data->direct.set(sample, look->row.data());
    if (!data->direct_tints.empty()) {
      data->direct_tints[sample] = PackedTint(look->open);
      exchange_.tints[sample].assign(look->tints.begin(), look->tints.begin() + look->hit_count);
    }
    data->above.hides[sample] = look->blocked_up * scale / kPiFloat;
    data->below.hides[sample] = look->blocked_down * scale / kPiFloat;
    SampleHits& seen = exchange_.seen[sample];
    seen.hits.assign(look->hits.begin(), look->hits.begin() + look->hit_count);
    seen.up = look->up;
    seen.inside = look->inside > kMostInside * look->all || (!receiver.thin && look->burial.buried());
    seen.outdoors = look->blocked_up + look->blocked_down < kOutdoors * told;
    seen.walled_in = look->blocked_up + look->blocked_down - look->leaves > kWalls * told;
    seen.scale_down = scale;
    seen.scale_up = scale;
    if (look->coarse_blocked_up > 0.0f && !receiver.coarse) {
      // The coarse rays stand for all that hit something.
      seen.scale_up *= std::clamp(look->blocked_up / look->coarse_blocked_up, 0.25f, 4.0f);
    }
  }

  /// Adds one bounce: what every sample passes on of all that it has by now.
  void passOn(TransportData* data, const Progress& progress) {
    Coefficients sent;  // luminance × π
    const std::size_t all = exchange_.sentCount();
    sent.resize(all);
    std::vector<Eigen::Array3f> others(all);
    const SumsOfAll has = sumsOf(*data);
    const std::vector<Sending>& sends_of = exchange_.sendings();
    tbb::parallel_for(std::size_t{0}, all, [&](std::size_t i) {
      const Sending& sends = sends_of[i];
      const std::uint32_t sender = exchange_.senderOf(i);
      others[i] = Exchange::sentBy(sends, has, sender);
      sent.set(i, sentRow(*data, sends, sender).data());
    });
    const std::size_t blocks = (count_ + kSamplesOfTask - 1) / kSamplesOfTask;
    WorkDone done(partOf(progress, 0.2, 1.0), blocks);
    tbb::parallel_for(std::size_t{0}, blocks, [&](std::size_t block) {
      for (std::size_t i = block * kSamplesOfTask; i < std::min(count_, (block + 1) * kSamplesOfTask); ++i)
        receive(sent, others, i, data);
      done.add();
    });
  }

  /// The coefficients of what a sample sends.
  Row sentRow(const TransportData& data, const Sending& sends, std::size_t i) const {
    Row row{};
    const auto addCoefficients = [&](const Coefficients& coefficients, std::size_t from,
                                     const Eigen::Array3f& color) {
      addTimes(LinearRgb(color).luminance() * coefficients.scales[from], coefficients.row(from), row.data());
    };
    const auto add = [&](std::size_t from, const Eigen::Array3f& of_direct,
                         const Eigen::Array3f& of_bounced) {
      addCoefficients(data.direct, from, data.directTint(from).times(of_direct));
      for (const PassedOn* part : {&data.above, &data.below}) {
        addCoefficients(part->coefficients, from,
                        of_bounced * Eigen::Map<const Eigen::Array3f>(part->tints[from].data()));
      }
    };
    add(i, sends.direct, sends.bounced);
    if (sends.other != LightMesh::kNone) add(sends.other, sends.through, sends.through);
    return row;
  }

  /// Of a row of coefficients, and how much it counts.
  struct Sender {
    float factor;
    const std::uint8_t* row;
    bool up;
  };
  /// How much the luminance of what is sent, of the colour of `sum`, counts.
  static float lightOf(const SampleSeen& seen, const Eigen::Array3f& sum) {
    if (seen.tint.white()) return seen.weight;
    const float sent = LinearRgb(sum).luminance();
    return sent > 0.0f ? LinearRgb(seen.of(sum)).luminance() / sent : seen.weight;
  }
  static void prefetchRow(const std::uint8_t* row) {
    constexpr std::size_t kCacheLine = 64;
    for (std::size_t at = 0; at < kPatches; at += kCacheLine) __builtin_prefetch(row + at);
  }

  void receive(const Coefficients& sent, const std::vector<Eigen::Array3f>& others, std::size_t i,
               TransportData* data) const {
    Row above{}, below{};
    addTimes(mirrored_.scales[i], mirrored_.row(i), below.data());
    std::vector<Sender> senders;
    exchange_.visitSeen(i, Exchange::all, [&](const SampleSeen& seen, bool up) {
      senders.push_back(
          {lightOf(seen, others[seen.sample]) * sent.scales[seen.sample], sent.row(seen.sample), up});
    });
    constexpr std::size_t kAhead = 6;  // rows lie all over the memory
    for (std::size_t k = 0; k < senders.size(); ++k) {
      prefetchRow(senders[std::min(k + kAhead, senders.size() - 1)].row);
      addTimes(senders[k].factor, senders[k].row, (senders[k].up ? above : below).data());
    }
    const Arrived sums = exchange_.received(others, i);
    data->above.coefficients.set(i, above.data());
    data->below.coefficients.set(i, below.data());
    storeTint(sums.above, i, &data->above);
    storeTint(sums.below, i, &data->below);
  }

  const BakeScene& scene_;
  const Geometry& geometry_;
  const std::vector<TriangleTraits>& traits_;
  const SceneSamples& samples_;
  const GatherOptions& options_;
  SkyPatches patches_;
  AdaptiveProbe probe_;
  Exchange exchange_;
  std::size_t count_;
  std::vector<std::uint32_t> starts_;  ///< samples whose rays are cast
  Coefficients mirrored_;              ///< sky by way of the ground as a mirror, luminance
};

}  // namespace

UselessSamples gatherLight(const BakeScene& scene, const SceneSamples& samples, const GatherOptions& options,
                           TransportData* data) {
  if (samples.receivers.size() > Exchange::kMostSamples) {
    throw std::runtime_error("bake of light: the scene takes " + std::to_string(samples.receivers.size()) +
                             " samples, of at most " + std::to_string(Exchange::kMostSamples) +
                             ": its meshes need fewer triangles, or no light is baked");
  }
  return Gatherer(scene, samples, options, data->rooms).gather(data);
}

}  // namespace sunlit::light
