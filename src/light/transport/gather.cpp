#include "light/transport/gather.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <mutex>
#include <stdexcept>
#include <string>

#include "light/angles.h"
#include "light/mirror_lobe.h"
#include "light/transport/adaptive_probe.h"
#include "light/transport/burial_test.h"
#include "light/transport/ground_mirror.h"
#include "light/transport/later_bounces.h"
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
    LaterBounces above, below;
    for (int bounce = 0; bounce < options_.bounces; ++bounce) {
      passOn(data, (1.0 - direct_share) / options_.bounces);
      above.note(data->above);
      below.note(data->below);
    }
    above.addTo(&data->above);
    below.addTo(&data->below);
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
    const float told = std::max(look->all - look->inside, 0.05f * look->all);
    const float scale = told > 0.0f ? kPiFloat / told : 0.0f;
    for (float& value : look->row) value *= scale;
    data->direct.set(sample, look->row.data());
    data->above.hides[sample] = look->blocked_up * scale / kPiFloat;
    data->below.hides[sample] = look->blocked_down * scale / kPiFloat;
    const Receiver& receiver = samples_.receivers[sample];
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

  /// Adds one bounce: what every sample passes on of all that it has by now.
  void passOn(TransportData* data, double share) {
    Coefficients sent;  // luminance × π
    sent.resize(count_);
    std::vector<Sent> others(count_);
    const std::size_t blocks = (count_ + kBlock - 1) / kBlock;
    tbb::parallel_for(std::size_t{0}, blocks, [&](std::size_t block) {
      for (std::size_t i = block * kBlock; i < std::min(count_, (block + 1) * kBlock); ++i)
        others[i] = send(*data, i, &sent);
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

  Sent send(const TransportData& data, std::size_t i, Coefficients* sent) const {
    const Reflectance mean = reflectance(samples_.paints[i], kMeanView);
    const Eigen::Array3f all = mean.all();
    // The sky that the ground mirrors has gone its own way.
    const Eigen::Array3f spread = isGround(static_cast<std::uint32_t>(i)) ? mean.diffuse : all;
    Row row{};
    Sent others{Eigen::Array3f::Zero(), Eigen::Array3f::Zero()};
    const auto addCoefficients = [&](const Coefficients& coefficients, std::size_t from,
                                     const Eigen::Array3f& color) {
      const float factor = luminanceOf(color) * coefficients.scales[from];
      addTimes(factor, coefficients.row(from), row.data());
      others.color += color * coefficients.sum(from);
    };
    const auto add = [&](std::size_t from, const Eigen::Array3f& of_direct,
                         const Eigen::Array3f& of_bounced) {
      addCoefficients(data.direct, from, of_direct);
      for (const PassedOn* part : {&data.above, &data.below}) {
        addCoefficients(part->coefficients, from,
                        of_bounced * Eigen::Map<const Eigen::Array3f>(part->tints[from].data()));
        others.glow += of_bounced * Eigen::Map<const Eigen::Array3f>(part->glows[from].data());
      }
    };
    const OtherSide& other = samples_.other_side[i];
    if (other.sample == LightMesh::kNone) {
      add(i, spread, all);
    } else {  // what is mirrored stays on its side
      const Eigen::Array3f through = other.share * mean.diffuse.min(all);
      add(i, all - through, all - through);
      add(other.sample, through, through);
    }
    sent->set(i, row.data());
    return others;
  }

  /// Ground scatters less towards a glancing ray than towards the mean one: Fresnel's share is larger there.
  float scattered(std::uint32_t from, const Eigen::Vector3f& towards) const {
    if (towards.z() >= 0.0f || !isGround(from)) return 1.0f;
    static const float mean = 1.0f - meanGrazing(kMeanView);
    return (1.0f - meanGrazing(-towards.z())) / mean;
  }

  /// Sums over the surfaces of one part that a sample sees.
  struct Received {
    Row row{};
    Eigen::Array3f color = Eigen::Array3f::Zero(), glow = Eigen::Array3f::Zero();
  };

  void receive(const Coefficients& sent, const std::vector<Sent>& others, std::size_t i,
               TransportData* data) const {
    Received above, below;
    addTimes(mirrored_.scales[i], mirrored_.row(i), below.row.data());
    below.color.setConstant(mirrored_sums_[i]);
    for (std::size_t k = 0; k < seen_[i].hits.size(); ++k) {
      Received& part = k < seen_[i].up ? above : below;
      const RaySeen ray = raySeen(i, k);
      const float weight = ray.weight * scattered(ray.from, ray.towards);
      addTimes(weight * sent.scales[ray.from], sent.row(ray.from), part.row.data());
      part.color += weight * others[ray.from].color;
      // What shines by itself does so evenly.
      part.glow += weight * others[ray.from].glow + ray.weight * kPiFloat * samples_.emissions[ray.from];
    }
    store(above, i, &data->above);
    store(below, i, &data->below);
  }

  static void store(const Received& received, std::size_t i, PassedOn* part) {
    part->coefficients.set(i, received.row.data());
    part->glows[i] = {received.glow[0], received.glow[1], received.glow[2]};
    const float luminance = luminanceOf(received.color);
    Eigen::Map<Eigen::Array3f>(part->tints[i].data()) = luminance > 0.0f
                                                            ? Eigen::Array3f(received.color / luminance)
                                                            : Eigen::Array3f(Eigen::Array3f::Ones());
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
