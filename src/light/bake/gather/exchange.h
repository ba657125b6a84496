/// Which samples of a scene see each other, and what each of them passes on.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cstdint>
#include <mutex>
#include <vector>

#include "light/bake/gather/links.h"
#include "light/bake/gather/sent_light.h"
#include "light/bake/samples/scene_samples.h"
#include "light/bake/samples/transport_data.h"
#include "light/patches/sky_patches.h"
#include "sunlit/quantity/angle.h"

namespace sunlit::light {

/// Of one task of parallel work.
constexpr std::size_t kSamplesOfTask = 256;

/// What a sample's coarse rays hit.
struct SampleHits {
  std::vector<SampleAndByte> hits;           ///< with the direction, of its half of the sphere
  std::size_t up = 0;                        ///< the first of them, above the horizon
  float scale_up = 0.0f, scale_down = 0.0f;  ///< of the hits' weights, by direction
  bool inside = false;                       ///< of a body
  bool walled_in = false;                    ///< sees little but surfaces, other than leaves
  bool outdoors = false;                     ///< sees clearly more of the sky than of surfaces
};

/// A ray from a sample to one that it sees.
struct RaySeen {
  std::uint32_t from;       ///< the one that it sees
  std::uint32_t direction;  ///< of its half of the sphere
  Eigen::Vector3f towards;
  float weight;     ///< of the luminance × π that arrives along it, in the sample's illuminance
  PackedTint tint;  ///< by glass on its way
};

class Exchange {
 public:
  static constexpr std::size_t kMostSamples = std::size_t{1} << SampleAndByte::kSampleBits;

  /// Keeps references. `rooms` counts once useRooms() was called.
  Exchange(const SceneSamples& samples, const SkyPatches& patches, const BakedRooms& rooms);

  /// To be called when `rooms` is filled: what they see is then known by their links, not by `seen`.
  void useRooms();

  std::vector<SampleHits> seen;  ///< of each sample
  /// By glass on the way of each of their hits; empty: there is none.
  std::vector<std::vector<PackedTint>> tints;
  std::vector<Eigen::Array3f> mirrored_sums;  ///< sky by way of the ground as a mirror, lx

  RaySeen ray(std::size_t sample, std::size_t hit) const {
    const SampleHits& view = seen[sample];
    const bool up = hit < view.up;
    const std::uint32_t direction = view.hits[hit].byte();
    const SkyPatches::Ray& ray = patches_.coarseRays()[up ? direction : direction + SkyPatches::kAbove];
    return {view.hits[hit].sample(), direction, ray.towards,  // the ray's own weight is in the scales
            ray.solid_angle * samples_.receivers[sample].weight(ray.towards) *
                (up ? view.scale_up : view.scale_down) / kPiFloat,
            tints.empty() ? PackedTint() : tints[sample][hit]};
  }
  /// Of all that is `seen`, puts samples beside it in the place of those that are of no use: if any, such as
  /// they are not parted from. Returns LightMesh::usefulSamples(). Parallel.
  std::vector<std::uint32_t> passOver(const std::vector<bool>& useless, const LightMesh::Parted& parted);
  /// The sample itself, or the one that passOver() puts in its place.
  std::uint32_t usefulBeside(std::uint32_t sample) const {
    const std::uint32_t other = instead_.empty() ? LightMesh::kNone : instead_[sample];
    return other != LightMesh::kNone ? other : sample;
  }
  /// Whether a sample mirrors as GroundMirror says.
  bool isGround(std::uint32_t sample) const { return ground_[sample] != 0; }
  /// Whether it is level and so smooth that sun and moon in it are as in a mirror.
  bool isPolished(std::uint32_t sample) const;
  /// Whether rays of rooms go on from a sample as mirroredRay() says, and find there what it mirrors.
  bool mirrors(std::uint32_t sample) const { return mirrors_[sample] != 0; }
  /// Ground scatters less towards a glancing ray than towards the mean one: Fresnel's share is larger there.
  float scattered(std::uint32_t from, const Eigen::Vector3f& towards) const;
  /// What is sent has numbers of its own: those of the samples, and behind them one for each mirror that
  /// rooms see, of what it sends these.
  std::size_t sentCount() const { return seen.size() + seen_mirrors_.size(); }
  std::uint32_t senderOf(std::size_t sent) const {
    return sent < seen.size() ? static_cast<std::uint32_t>(sent) : seen_mirrors_[sent - seen.size()];
  }
  /// Calls visit(SampleSeen, whether it is seen above the horizon) for what is sent with wanted(number) to a
  /// sample.
  template <typename Wanted, typename Visit>
  void visitSeen(std::size_t sample, const Wanted& wanted, const Visit& visit) const;
  static bool all(std::uint32_t) { return true; }

  Sending sending(std::size_t sample) const;
  /// The same towards rooms: of a mirror without what their links find in it.
  Sending sendingToRooms(std::size_t sample) const;
  /// By the number of what is sent; to be asked for once useRooms() was called.
  const std::vector<Sending>& sendings() const;
  /// Of what a sample has by the sky, and of what it has from the other side, by the sums over all patches:
  /// luminance × π.
  static Eigen::Array3f sentBy(const Sending& sends, const SumsOfAll& has, std::size_t sample);
  /// What a sample gets of all that is sent, and of the ground's mirror.
  Arrived received(const std::vector<Eigen::Array3f>& sent, std::size_t sample) const;

  /// Light that is sent, of which others look for a part.
  struct LookedFor {
    explicit LookedFor(std::size_t count) : sent(count), part(count), lamp_m(count) {}
    SentOf<1> sent;
    std::vector<Eigen::Array3f> part;  ///< of `sent`, as lookedFor() tells
    std::vector<float> lamp_m;         ///< for lookedForFrom()
  };
  /// What samples send of light that is straight from lamps, and of what they have besides. Parallel.
  LookedFor sentOf(const StraightLight& lamps, const std::vector<Arrived>& has) const;
  /// What each sample has of that: what rays meet, and what it `found` where it looked. Parallel.
  std::vector<Arrived> receivedOf(const LookedFor& sent, std::vector<Arrived> found) const;
  /// What samples have of a source by one bounce.
  struct FirstBounce {
    std::vector<Arrived> has;
    int most;  ///< bounces that count
  };
  /// What each sample has of each source by surfaces that pass on its light: by its bounces, or until they
  /// add next to nothing. Of up to kTogether sources what samples see is looked up once. Parallel.
  std::vector<std::vector<Arrived>> passedOn(std::vector<FirstBounce> first) const;
  static constexpr int kTogether = 4;

  /// Bounces of white walls, that pass on 0.98, until next to nothing is left.
  static constexpr int kAllBounces = 200;

  /// Adds all bounces that follow those that `data` has: by sums over the patches, until they add next to
  /// nothing. How the light of single patches goes on, the bounces so far tell. Parallel.
  void addLaterBounces(TransportData* data) const;

 private:
  static_assert(SkyPatches::kAbove <= 256 && SkyPatches::kDown <= 256, "a direction fits above a sample");

  template <int kSources>
  ArrivedOf<kSources> receivedOf(const SentOf<kSources>& sent, std::size_t sample) const;
  /// Of each block of kSamplesOfTask samples, neighbours mostly: blocks whose light it gets.
  const std::vector<std::vector<std::uint32_t>>& senders() const;
  template <int kSources, typename Visit>
  bool inLitBlocks(const SentOf<kSources>& sent, const Visit& visit) const;
  /// Of each sample, Receiver::middle().
  const std::vector<Eigen::Vector3f>& places() const;
  /// What samples have, and what they sent of it that others have by now.
  template <int kSources>
  struct OnItsWay {
    std::vector<ArrivedOf<kSources>>* has;
    std::vector<Colors<kSources>> told;  ///< by the number of what is sent
    std::array<int, kSources> most;      ///< bounces of each source that are to come
  };
  template <int kSources, typename Send>
  void passOnChanges(const Send& send, float dark, OnItsWay<kSources>* light) const;
  template <int kSources>
  void passOnTogether(FirstBounce* first, int count) const;
  std::size_t endOf(std::size_t block) const { return std::min(seen.size(), (block + 1) * kSamplesOfTask); }

  const SceneSamples& samples_;
  const SkyPatches& patches_;
  const BakedRooms& rooms_;
  std::vector<std::uint8_t> ground_;   ///< of each sample: asked for along every ray, so kept close together
  std::vector<std::uint8_t> mirrors_;  ///< of each sample
  std::vector<std::uint32_t> seen_mirrors_;   ///< those that rooms see
  std::vector<std::uint32_t> sent_to_rooms_;  ///< of each sample, its number; empty: no room sees a mirror
  std::array<float, SkyPatches::kDown> scattered_down_;  ///< scattered() by ground, of each direction
  std::vector<std::uint32_t> instead_;  ///< of each sample of no use: one that is, or LightMesh::kNone
  std::vector<std::uint32_t> room_of_;  ///< of each sample, or LightMesh::kNone; empty: there are none
  mutable std::once_flag senders_found_, sendings_found_, places_found_;
  mutable std::vector<std::vector<std::uint32_t>> senders_;
  mutable std::vector<Sending> sendings_;
  mutable std::vector<Eigen::Vector3f> places_;
};

template <typename Wanted, typename Visit>
void Exchange::visitSeen(std::size_t sample, const Wanted& wanted, const Visit& visit) const {
  const std::uint32_t room = room_of_.empty() ? LightMesh::kNone : room_of_[sample];
  if (room != LightMesh::kNone) {
    return visitLinks(rooms_, room, [&](const SampleSeen& other, bool up) {
      const std::uint32_t sent = sent_to_rooms_.empty() ? other.sample : sent_to_rooms_[other.sample];
      if (wanted(sent)) visit(SampleSeen{sent, other.weight, other.tint}, up);
    });
  }
  const SampleHits& view = seen[sample];
  for (std::size_t k = 0; k < view.hits.size(); ++k) {
    if (!wanted(view.hits[k].sample())) continue;
    const RaySeen along = ray(sample, k);
    const bool up = k < view.up;
    const float scattered = up || !isGround(along.from) ? 1.0f : scattered_down_[along.direction];
    visit(SampleSeen{along.from, along.weight * scattered, along.tint}, up);
  }
}

}  // namespace sunlit::light
