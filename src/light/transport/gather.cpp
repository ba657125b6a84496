#include "light/transport/gather.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <mutex>
#include <numeric>
#include <stdexcept>
#include <string>

#include "light/angles.h"
#include "light/mirror_lobe.h"
#include "light/transport/adaptive_probe.h"
#include "light/transport/burial_test.h"
#include "light/transport/ground_mirror.h"
#include "sunlit/quantity/angle.h"
#include "sunlit/quantity/photometry.h"
#include "sunlit/quantity/vector_clones.h"

namespace sunlit::light {
namespace {

constexpr std::size_t kPatches = SkyPatches::kCount;
constexpr std::uint32_t kDirectionShift = 24;  ///< in memory, a hit: the sample there, and the direction
constexpr std::uint32_t kSampleMask = (1u << kDirectionShift) - 1;
static_assert(SkyPatches::kAbove <= 256 && SkyPatches::kDown <= 256, "a direction fits above a sample");
constexpr std::size_t kPacket = RayPacket::kSize;
constexpr float kMostInside = 0.6f;  ///< share of rays that may end inside bodies

constexpr std::size_t kBlock = 256;  ///< samples, of one task

/// Fewer were asked for to see just these.
constexpr int kBouncesBeforeAll = 3;

using Row = std::array<float, kPatches>;

float luminanceOf(const Eigen::Array3f& rgb) {
  return LinearRgb(rgb).luminance();
}

/// Adds a row of coefficients, each times `factor` and one of `shares`.
SUNLIT_WIDE_VECTOR_CLONES
void addShares(float factor, const float* shares, const std::uint8_t* coefficients, float* row) {
  for (std::size_t p = 0; p < kPatches; ++p)
    row[p] += factor * shares[p] * static_cast<float>(coefficients[p]);
}

class Gatherer {
 public:
  Gatherer(const BakeScene& scene, const SceneSamples& samples, const GatherOptions& options)
      : geometry_(scene.geometry),
        traits_(scene.traits),
        samples_(samples),
        options_(options),
        patches_(options.rays_per_patch),
        probe_(scene.rays, scene.traits, patches_),
        count_(samples.receivers.size()) {}

  std::vector<bool> gather(TransportData* data) {
    data->direct.resize(count_);
    data->above.resize(count_);
    data->below.resize(count_);
    seen_.resize(count_);
    findStarts();
    const std::size_t packets = (starts_.size() + kPacket - 1) / kPacket;
    const double direct_share = options_.bounces > 0 ? 0.7 : 1.0;
    tbb::parallel_for(std::size_t{0}, packets, [&](std::size_t p) {
      lookAround(p * kPacket, data);
      step(direct_share / static_cast<double>(packets));
    });
    if (options_.bounces > 0) lookIntoGround(*data);
    for (int bounce = 0; bounce < options_.bounces; ++bounce)
      passOn(data, (1.0 - direct_share) / options_.bounces);
    if (options_.bounces >= kBouncesBeforeAll) addLaterBounces(data);
    std::vector<bool> inside(count_);
    for (std::size_t i = 0; i < count_; ++i) inside[i] = seen_[i].inside;
    return inside;
  }

 private:
  /// What a sample's coarse rays hit.
  struct SampleHits {
    std::vector<std::uint32_t> hits;           ///< directions of each half of the sphere from 0
    std::size_t up = 0;                        ///< the first of them, above the horizon
    float scale_up = 0.0f, scale_down = 0.0f;  ///< of the hits' weights, by direction
    bool inside = false;                       ///< of a body
  };
  /// Sums over the rays of one sample.
  struct Look {
    Row row{};
    BurialTest burial;
    float all = 0.0f, inside = 0.0f, blocked_up = 0.0f, blocked_down = 0.0f, coarse_blocked_up = 0.0f;
    std::array<std::uint32_t, SkyPatches::kCoarse> hits;  ///< as SampleHits::hits
    std::size_t hit_count = 0, up = 0;
  };

  void step(double share) {
    const std::lock_guard<std::mutex> lock(progress_mutex_);
    done_ += share;
    if (options_.progress) options_.progress(std::min(done_, 1.0));
  }

  /// Whose light a ray meets: a cell tree, or kNone for the inside of a body.
  std::uint32_t rootAt(const HitPacket& hits, int lane, const Eigen::Vector3f& towards) const {
    const std::uint32_t t = hits.triangle[lane];
    const std::size_t side = geometry_.planes[t].normal.dot(towards) > 0.0f ? 1 : 0;
    if (side == 1 && traits_[t].solid) return LightMesh::kNone;
    const std::uint32_t root = samples_.mesh.roots[t][side];
    const std::uint32_t other = samples_.mesh.roots[t][1 - side];
    if (LightMesh::isCell(root)) return root;
    return LightMesh::isCell(other) ? other : LightMesh::kNone;
  }

  /// The sample nearest to where a ray hit.
  std::uint32_t sampleAt(std::uint32_t root, float u, float v) const {
    const LightMesh::Place place = samples_.mesh.locate(root, {1.0f - u - v, u, v});
    const auto largest = std::max_element(place.weight.begin(), place.weight.end()) - place.weight.begin();
    return samples_.nearest_sample[place.node[static_cast<std::size_t>(largest)]];
  }

  /// Of two samples on both sides of a sheet, rays of the first serve both.
  void findStarts() {
    for (std::uint32_t i = 0; i < count_; ++i) {
      if (samples_.other_side[i].sample > i) starts_.push_back(i);  // or there is none
    }
  }

  void lookAround(std::size_t first, TransportData* data) {
    const std::size_t count = std::min(kPacket, starts_.size() - first);
    std::array<Receiver, kPacket> receivers;
    std::array<std::array<Look, 2>, kPacket> looks;
    for (std::size_t i = 0; i < count; ++i) {
      const std::uint32_t sample = starts_[first + i];
      receivers[i] = samples_.receivers[sample];
      // Half: both sides' rays count alike. Doubled again below, for each sample has one side to itself.
      if (samples_.other_side[sample].sample != LightMesh::kNone) receivers[i].transmission = 0.5f;
    }
    const auto& rays = patches_.rays();
    probe_.look({receivers.data(), static_cast<int>(count)}, [&](int lane, std::size_t r, float weight,
                                                                 const HitPacket& hits) {
      const auto i = static_cast<std::size_t>(lane);
      const std::uint32_t sample = starts_[first + i], behind = samples_.other_side[sample].sample;
      const bool two_sided = behind != LightMesh::kNone;
      const bool turned = two_sided && receivers[i].normal.dot(rays[r].towards) < 0.0f;
      if (two_sided) weight *= 2.0f;
      note(rays[r], {rays[r].towards, weight, hits, lane}, turned ? behind : sample,
           &looks[i][turned ? 1 : 0]);
    });
    for (std::size_t i = 0; i < count; ++i) {
      const std::uint32_t sample = starts_[first + i], behind = samples_.other_side[sample].sample;
      finish(sample, &looks[i][0], data);
      if (behind != LightMesh::kNone) finish(behind, &looks[i][1], data);
    }
  }

  void note(const SkyPatches::Ray& ray, const BurialTest::Cast& cast, std::uint32_t sample,
            Look* look) const {
    look->all += cast.weight;
    look->burial.add(cast, geometry_, traits_);
    if (cast.hits.triangle[cast.lane] == HitPacket::kNothing) {
      look->row[static_cast<std::size_t>(ray.patch)] += cast.weight;
      return;
    }
    const std::uint32_t root = rootAt(cast.hits, cast.lane, ray.towards);
    if (root == LightMesh::kNone) {
      look->inside += cast.weight;
      return;
    }
    const bool up = ray.patch != SkyPatches::kBelow;
    (up ? look->blocked_up : look->blocked_down) += cast.weight;
    if (ray.coarse == SkyPatches::Ray::kFineOnly) return;
    if (up) {
      look->coarse_blocked_up +=
          SkyPatches::solidAngle(ray.patch) * samples_.receivers[sample].weight(ray.towards);
    }
    const std::uint32_t from = sampleAt(root, cast.hits.u[cast.lane], cast.hits.v[cast.lane]);
    const auto direction = static_cast<std::uint32_t>(up ? ray.coarse : ray.coarse - SkyPatches::kAbove);
    look->hits[look->hit_count++] = direction << kDirectionShift | from;
    look->up += up;
  }

  void finish(std::uint32_t sample, Look* look, TransportData* data) {
    // The quadrature of a cosine over the hemisphere is π; rays that end inside bodies tell nothing.
    const Receiver& receiver = samples_.receivers[sample];
    const float told = std::max(look->all - look->inside, 0.05f * look->all);
    const float scale = told > 0.0f ? kPiFloat * receiver.open() / told : 0.0f;
    for (float& value : look->row) value *= scale;
    data->direct.set(sample, look->row.data());
    data->above.hides[sample] = look->blocked_up * scale / kPiFloat;
    data->below.hides[sample] = look->blocked_down * scale / kPiFloat;
    SampleHits& seen = seen_[sample];
    seen.hits.assign(look->hits.begin(), look->hits.begin() + look->hit_count);
    seen.up = look->up;
    seen.inside = look->inside > kMostInside * look->all || (!receiver.thin && look->burial.buried());
    seen.scale_down = scale;
    seen.scale_up = scale;
    if (look->coarse_blocked_up > 0.0f && !receiver.coarse) {
      // The coarse rays stand for all that hit something.
      seen.scale_up *= std::clamp(look->blocked_up / look->coarse_blocked_up, 0.25f, 4.0f);
    }
  }

  /// The sky that each sample sees mirrored by the ground.
  void lookIntoGround(const TransportData& data) {
    const GroundMirror mirror(patches_);
    mirrored_.resize(count_);
    mirrored_sums_.assign(count_, 0.0f);
    tbb::parallel_for(std::size_t{0}, (count_ + kBlock - 1) / kBlock, [&](std::size_t block) {
      for (std::size_t i = block * kBlock; i < std::min(count_, (block + 1) * kBlock); ++i) {
        Row row{};
        for (std::size_t k = seen_[i].up; k < seen_[i].hits.size(); ++k)
          addMirrored(data, mirror, raySeen(i, k), &row);
        mirrored_.set(i, row.data());
        for (const float value : row) mirrored_sums_[i] += value;
      }
    });
  }

  /// A ray from a sample to one that it sees.
  struct RaySeen {
    std::uint32_t from;       ///< the one that it sees
    std::uint32_t direction;  ///< of its half of the sphere
    Eigen::Vector3f towards;
    float weight;  ///< of the luminance × π that arrives along it, in the sample's illuminance
  };
  RaySeen raySeen(std::size_t i, std::size_t hit) const {
    const SampleHits& seen = seen_[i];
    const bool up = hit < seen.up;
    const std::uint32_t direction = seen.hits[hit] >> kDirectionShift;
    const SkyPatches::Ray& ray = patches_.coarseRays()[up ? direction : direction + SkyPatches::kAbove];
    return {seen.hits[hit] & kSampleMask, direction, ray.towards,  // the ray's own weight is in the scales
            ray.solid_angle * samples_.receivers[i].weight(ray.towards) *
                (up ? seen.scale_up : seen.scale_down) / kPiFloat};
  }

  /// Whether a sample mirrors as GroundMirror says.
  bool isGround(std::uint32_t sample) const {
    constexpr float kLevel = 0.97f;  // within 14°, half a patch
    const Receiver& receiver = samples_.receivers[sample];
    return receiver.normal.z() > kLevel && !receiver.thin && samples_.paints[sample].metalness < 0.5f;
  }

  void addMirrored(const TransportData& data, const GroundMirror& mirror, const RaySeen& ray,
                   Row* row) const {
    if (!isGround(ray.from)) return;
    const GroundMirror::Row& shares = mirror.towards(ray.direction, samples_.paints[ray.from].roughness);
    addShares(ray.weight * data.direct.scales[ray.from], shares.data(), data.direct.row(ray.from),
              row->data());
  }

  /// Light that a sample has from surfaces of one part, by the sum over the patches of the sky.
  struct PartSums {
    Eigen::Array3f color = Eigen::Array3f::Zero(), glow = Eigen::Array3f::Zero();
  };
  struct PassedOnSums {
    PartSums above, below;
    Eigen::Array3f color() const { return above.color + below.color; }
    Eigen::Array3f glow() const { return above.glow + below.glow; }
  };
  /// Of every sample.
  struct SumsOfAll {
    std::vector<float> direct;
    std::vector<PassedOnSums> passed_on;
  };

  static PartSums sumsOf(const PassedOn& part, std::size_t i) {
    return {part.coefficients.sum(i) * Eigen::Map<const Eigen::Array3f>(part.tints[i].data()),
            Eigen::Map<const Eigen::Array3f>(part.glows[i].data())};
  }
  SumsOfAll sumsOf(const TransportData& data) const {
    SumsOfAll sums{std::vector<float>(count_), std::vector<PassedOnSums>(count_)};
    tbb::parallel_for(std::size_t{0}, count_, [&](std::size_t i) {
      sums.direct[i] = data.direct.sum(i);
      sums.passed_on[i] = {sumsOf(data.above, i), sumsOf(data.below, i)};
    });
    return sums;
  }

  /// Adds one bounce: what every sample passes on of all that it has by now.
  void passOn(TransportData* data, double share) {
    Coefficients sent;  // luminance × π
    sent.resize(count_);
    std::vector<Sent> others(count_);
    const SumsOfAll has = sumsOf(*data);
    const std::size_t blocks = (count_ + kBlock - 1) / kBlock;
    tbb::parallel_for(std::size_t{0}, blocks, [&](std::size_t block) {
      for (std::size_t i = block * kBlock; i < std::min(count_, (block + 1) * kBlock); ++i) {
        const Sending sends = sending(i);
        others[i] = sentOf(sends, has, i);
        sendRow(*data, sends, i, &sent);
      }
    });
    step(0.2 * share);
    tbb::parallel_for(std::size_t{0}, blocks, [&](std::size_t block) {
      for (std::size_t i = block * kBlock; i < std::min(count_, (block + 1) * kBlock); ++i)
        receive(sent, others, i, data);
      step(0.8 * share / static_cast<double>(blocks));
    });
  }

  /// What a sample passes on beside its coefficients, each as luminance × π.
  struct Sent {
    Eigen::Array3f color;  ///< of the coefficients, times their sum
    Eigen::Array3f glow;   ///< of others, that it reflects
  };

  /// What a sample reflects of its own light, and passes on of that of the other side of its sheet.
  struct Sending {
    Eigen::Array3f direct, bounced;  ///< shares of light straight from the sky, and of other surfaces'
    Eigen::Array3f through;
    std::uint32_t other;  ///< the sample on the other side, or LightMesh::kNone
  };
  Sending sending(std::size_t i) const {
    const Reflectance mean = reflectance(samples_.paints[i], kMeanView);
    const Eigen::Array3f all = mean.all();
    const OtherSide& other = samples_.other_side[i];
    // The sky that the ground mirrors has gone its own way.
    if (other.sample == LightMesh::kNone) {
      const bool ground = isGround(static_cast<std::uint32_t>(i));
      return {ground ? mean.diffuse : all, all, Eigen::Array3f::Zero(), other.sample};
    }
    const Eigen::Array3f through = other.share * mean.diffuse.min(all);  // what is mirrored stays on its side
    return {all - through, all - through, through, other.sample};
  }

  /// The sums of what a sample has, and of what it has from the other side.
  Sent sentOf(const Sending& sends, const SumsOfAll& has, std::size_t i) const {
    Sent sent{sends.direct * has.direct[i] + sends.bounced * has.passed_on[i].color(),
              sends.bounced * has.passed_on[i].glow()};
    if (sends.other != LightMesh::kNone) {
      const PassedOnSums& behind = has.passed_on[sends.other];
      sent.color += sends.through * (has.direct[sends.other] + behind.color());
      sent.glow += sends.through * behind.glow();
    }
    return sent;
  }

  /// The coefficients of what a sample sends.
  void sendRow(const TransportData& data, const Sending& sends, std::size_t i, Coefficients* sent) const {
    Row row{};
    const auto addCoefficients = [&](const Coefficients& coefficients, std::size_t from,
                                     const Eigen::Array3f& color) {
      addTimes(luminanceOf(color) * coefficients.scales[from], coefficients.row(from), row.data());
    };
    const auto add = [&](std::size_t from, const Eigen::Array3f& of_direct,
                         const Eigen::Array3f& of_bounced) {
      addCoefficients(data.direct, from, of_direct);
      for (const PassedOn* part : {&data.above, &data.below}) {
        addCoefficients(part->coefficients, from,
                        of_bounced * Eigen::Map<const Eigen::Array3f>(part->tints[from].data()));
      }
    };
    add(i, sends.direct, sends.bounced);
    if (sends.other != LightMesh::kNone) add(sends.other, sends.through, sends.through);
    sent->set(i, row.data());
  }

  /// Ground scatters less towards a glancing ray than towards the mean one: Fresnel's share is larger there.
  float scattered(std::uint32_t from, const Eigen::Vector3f& towards) const {
    if (towards.z() >= 0.0f || !isGround(from)) return 1.0f;
    static const float mean = 1.0f - meanGrazing(kMeanView);
    return (1.0f - meanGrazing(-towards.z())) / mean;
  }

  void receive(const Coefficients& sent, const std::vector<Sent>& others, std::size_t i,
               TransportData* data) const {
    Row above{}, below{};
    addTimes(mirrored_.scales[i], mirrored_.row(i), below.data());
    for (std::size_t k = 0; k < seen_[i].hits.size(); ++k) {
      const RaySeen ray = raySeen(i, k);
      addTimes(ray.weight * scattered(ray.from, ray.towards) * sent.scales[ray.from], sent.row(ray.from),
               (k < seen_[i].up ? above : below).data());
    }
    const PassedOnSums sums = receivedSums(others, i);
    data->above.coefficients.set(i, above.data());
    data->below.coefficients.set(i, below.data());
    store(sums.above, i, &data->above);
    store(sums.below, i, &data->below);
  }

  PassedOnSums receivedSums(const std::vector<Sent>& others, std::size_t i) const {
    PassedOnSums sums;
    sums.below.color.setConstant(mirrored_sums_[i]);
    for (std::size_t k = 0; k < seen_[i].hits.size(); ++k) {
      PartSums& part = k < seen_[i].up ? sums.above : sums.below;
      const RaySeen ray = raySeen(i, k);
      const float weight = ray.weight * scattered(ray.from, ray.towards);
      part.color += weight * others[ray.from].color;
      // What shines by itself does so evenly.
      part.glow += weight * others[ray.from].glow + ray.weight * kPiFloat * samples_.emissions[ray.from];
    }
    return sums;
  }

  static void store(const PartSums& sums, std::size_t i, PassedOn* part) {
    part->glows[i] = {sums.glow[0], sums.glow[1], sums.glow[2]};
    const float luminance = luminanceOf(sums.color);
    Eigen::Map<Eigen::Array3f>(part->tints[i].data()) =
        luminance > 0.0f ? Eigen::Array3f(sums.color / luminance) : Eigen::Array3f(Eigen::Array3f::Ones());
  }

  /// All bounces that follow, by sums over the patches of the sky: until they add next to nothing. How the
  /// light of single patches goes on, the traced bounces tell.
  void addLaterBounces(TransportData* data) {
    constexpr int kMost = 200;               // of white walls, that pass on 0.98
    constexpr float kNextToNothing = 2e-4f;  // of what the samples have, on average; more still follows
    SumsOfAll has = sumsOf(*data);
    const std::vector<PassedOnSums> traced = has.passed_on;
    std::vector<PassedOnSums> next(count_);
    std::vector<Sent> sent(count_);
    std::vector<double> changes((count_ + kBlock - 1) / kBlock);
    double change = 1.0;
    for (int bounce = 0; bounce < kMost && change > kNextToNothing; ++bounce) {
      tbb::parallel_for(std::size_t{0}, count_, [&](std::size_t i) { sent[i] = sentOf(sending(i), has, i); });
      tbb::parallel_for(std::size_t{0}, changes.size(), [&](std::size_t block) {
        changes[block] = 0.0;
        for (std::size_t i = block * kBlock; i < std::min(count_, (block + 1) * kBlock); ++i) {
          next[i] = receivedSums(sent, i);
          changes[block] += static_cast<double>(relativeChange(has.passed_on[i], next[i]));
        }
      });
      change = std::accumulate(changes.begin(), changes.end(), 0.0) / static_cast<double>(count_);
      has.passed_on.swap(next);
    }
    tbb::parallel_for(std::size_t{0}, count_, [&](std::size_t i) {
      brighten(traced[i].above, has.passed_on[i].above, i, &data->above);
      brighten(traced[i].below, has.passed_on[i].below, i, &data->below);
    });
  }

  static float relativeChange(const PassedOnSums& before, const PassedOnSums& after) {
    const auto change = [](const Eigen::Array3f& from, const Eigen::Array3f& to) {
      const float most = to.maxCoeff();
      return most > 0.0f ? (to - from).abs().maxCoeff() / most : 0.0f;
    };
    return std::max(change(before.color(), after.color()), change(before.glow(), after.glow()));
  }

  static void brighten(const PartSums& traced, const PartSums& all, std::size_t i, PassedOn* part) {
    const float before = luminanceOf(traced.color);
    if (before > 0.0f) part->coefficients.scales[i] *= luminanceOf(all.color) / before;
    store(all, i, part);
  }

  const Geometry& geometry_;
  const std::vector<TriangleTraits>& traits_;
  const SceneSamples& samples_;
  const GatherOptions& options_;
  SkyPatches patches_;
  AdaptiveProbe probe_;
  std::size_t count_;
  std::vector<std::uint32_t> starts_;  ///< samples whose rays are cast
  std::vector<SampleHits> seen_;
  Coefficients mirrored_;             ///< sky by way of the ground as a mirror, without colour
  std::vector<float> mirrored_sums_;  ///< of its coefficients
  std::mutex progress_mutex_;
  double done_ = 0.0;
};

}  // namespace

std::vector<bool> gatherLight(const BakeScene& scene, const SceneSamples& samples,
                              const GatherOptions& options, TransportData* data) {
  if (samples.receivers.size() > std::size_t{kSampleMask} + 1) {
    throw std::runtime_error("bake of light: the scene takes " + std::to_string(samples.receivers.size()) +
                             " samples, of at most " + std::to_string(std::size_t{kSampleMask} + 1));
  }
  return Gatherer(scene, samples, options).gather(data);
}

}  // namespace sunlit::light
