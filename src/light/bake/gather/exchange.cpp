#include "light/bake/gather/exchange.h"

#include <tbb/parallel_for.h>

#include <algorithm>

#include "light/bake/gather/room_mirrors.h"
#include "light/shading/mirror_lobe.h"
#include "light/shading/polished_floor.h"
#include "light/shading/reflectances.h"
#include "sunlit/quantity/angle.h"
#include "sunlit/quantity/photometry.h"

namespace sunlit::light {
namespace {

float luminanceOf(const Eigen::Array3f& rgb) {
  return LinearRgb(rgb).luminance();
}

/// Of what the samples of a block have, on average; more still follows. By blocks, and not of all samples: a
/// white room in a wide land would be left after a few bounces.
constexpr float kNextToNothing = 2e-4f;

/// Of ground towards a ray that comes down along `towards`, in what it scatters towards the mean one.
float scatteredDown(const Eigen::Vector3f& towards) {
  static const float mean = 1.0f - meanGrazing(kMeanView);
  return (1.0f - meanGrazing(-towards.z())) / mean;
}

float relativeChange(const Eigen::Array3f& before, const Eigen::Array3f& after) {
  const float most = after.maxCoeff();
  return most > 0.0f ? (after - before).abs().maxCoeff() / most : 0.0f;
}
float relativeChange(const PassedOnSums& before, const PassedOnSums& after) {
  return std::max(relativeChange(before.color(), after.color()), relativeChange(before.glow(), after.glow()));
}
float relativeChange(const Arrived& before, const Arrived& after) {
  return relativeChange(before.above + before.below, after.above + after.below);
}

/// Blocks of kSamplesOfTask samples, neighbours mostly, and which of them still change as light goes on from
/// surface to surface. Parallel; the same bits for any number of threads.
class ChangingBlocks {
 public:
  /// visit(sample, see) is to call see() with all samples whose light a sample gets.
  template <typename Visit>
  ChangingBlocks(std::size_t samples, const Visit& visit)
      : samples_(samples), seen_((samples + kSamplesOfTask - 1) / kSamplesOfTask), changed_(seen_.size(), 1) {
    tbb::parallel_for(std::size_t{0}, seen_.size(), [&](std::size_t block) {
      std::vector<std::uint8_t> is_seen(seen_.size(), 0);
      for (std::size_t i = block * kSamplesOfTask; i < end(block); ++i)
        visit(i, [&](std::uint32_t sample) { is_seen[sample / kSamplesOfTask] = 1; });
      for (std::uint32_t other = 0; other < is_seen.size(); ++other)
        if (is_seen[other] != 0) seen_[block].push_back(other);
    });
  }
  /// Whether the last bounce changed anything.
  bool any() const { return std::find(changed_.begin(), changed_.end(), 1) != changed_.end(); }
  /// Sets `has` of those samples whose light changes by `receive`; `next` is as long, for what is under way.
  template <typename Value, typename Receive>
  void receive(const Receive& receive, std::vector<Value>* has, std::vector<Value>* next) {
    std::vector<std::uint8_t> changes(seen_.size(), 0);
    std::vector<std::uint8_t> is_new(seen_.size(), 0);
    tbb::parallel_for(std::size_t{0}, seen_.size(), [&](std::size_t block) {
      is_new[block] = std::any_of(seen_[block].begin(), seen_[block].end(),
                                  [&](std::uint32_t other) { return changed_[other] != 0; });
      if (is_new[block] == 0) return;
      float change = 0.0f;
      for (std::size_t i = block * kSamplesOfTask; i < end(block); ++i) {
        (*next)[i] = receive(i);
        change += relativeChange((*has)[i], (*next)[i]);
      }
      changes[block] = change > kNextToNothing * static_cast<float>(end(block) - block * kSamplesOfTask);
    });
    tbb::parallel_for(std::size_t{0}, seen_.size(), [&](std::size_t block) {
      if (is_new[block] == 0) return;
      const auto first = static_cast<std::ptrdiff_t>(block * kSamplesOfTask);
      std::copy(next->begin() + first, next->begin() + static_cast<std::ptrdiff_t>(end(block)),
                has->begin() + first);
    });
    changed_.swap(changes);
  }

 private:
  std::size_t end(std::size_t block) const { return std::min(samples_, (block + 1) * kSamplesOfTask); }

  std::size_t samples_;
  std::vector<std::vector<std::uint32_t>> seen_;  ///< blocks whose light each block gets
  std::vector<std::uint8_t> changed_;             ///< whether the last bounce changed it
};

/// Of a sample that only later bounces reach nobody knows where in the sky its light is from.
void setEven(float sum, std::size_t sample, Coefficients* coefficients) {
  std::array<float, SkyPatches::kCount> row{};
  for (int patch = 0; patch < SkyPatches::kAbove; ++patch)
    row[static_cast<std::size_t>(patch)] = sum * SkyPatches::solidAngle(patch) / (2.0f * kPiFloat);
  coefficients->set(sample, row.data());
}

void brighten(const PartSums& traced, const PartSums& all, std::size_t sample, PassedOn* part) {
  const float before = luminanceOf(traced.color), after = luminanceOf(all.color);
  if (before > 0.0f) {
    part->coefficients.scales[sample] *= after / before;
  } else if (after > 0.0f) {
    setEven(after, sample, &part->coefficients);
  }
  store(all, sample, part);
}

}  // namespace

Exchange::Exchange(const SceneSamples& samples, const SkyPatches& patches, const BakedRooms& rooms)
    : seen(samples.receivers.size()),
      mirrored_sums(samples.receivers.size(), 0.0f),
      shining(samples.receivers.size()),
      samples_(samples),
      patches_(patches),
      rooms_(rooms),
      ground_(samples.receivers.size()),
      mirrors_(samples.receivers.size()) {
  constexpr float kLevel = 0.97f;  // within 14°, half a patch
  for (std::size_t i = 0; i < ground_.size(); ++i) {
    const Receiver& receiver = samples.receivers[i];
    const bool sheet = receiver.thin || samples.other_side[i].sample != LightMesh::kNone;
    mirrors_[i] = !sheet && !receiver.coarse && mirrorsRays(samples.paints[i]) ? 1 : 0;
    ground_[i] = receiver.normal.z() > kLevel && !sheet && samples.paints[i].metalness < 0.5f ? 1 : 0;
  }
  for (std::size_t direction = 0; direction < scattered_down_.size(); ++direction)
    scattered_down_[direction] = scatteredDown(patches.coarseRays()[SkyPatches::kAbove + direction].towards);
}

void Exchange::useRooms() {
  if (rooms_.samples.empty()) return;
  room_of_.assign(seen.size(), LightMesh::kNone);
  for (std::uint32_t room = 0; room < rooms_.samples.size(); ++room) room_of_[rooms_.samples[room]] = room;
  std::vector<std::uint8_t> found(seen.size(), 0);
  for (const BakedRooms::Link link : rooms_.links) found[link.sample()] = mirrors_[link.sample()];
  if (std::find(found.begin(), found.end(), 1) == found.end()) return;
  for (std::uint32_t i = 0; i < found.size(); ++i) {
    sent_to_rooms_.push_back(found[i] != 0 ? static_cast<std::uint32_t>(sentCount()) : i);
    if (found[i] != 0) seen_mirrors_.push_back(i);
  }
}

void Exchange::passOver(const std::vector<bool>& useless, const LightMesh::Parted& parted) {
  const std::vector<std::uint32_t> useful = samples_.mesh.usefulSamples(useless, parted);
  instead_.assign(useless.size(), LightMesh::kNone);
  // A sample may count most in several nodes, some of them behind the wall.
  for (const bool anywhere : {false, true}) {
    for (std::size_t n = 0; n < useful.size(); ++n) {
      const std::uint32_t sample = samples_.nearest_sample[n];
      if (!useless[sample] || instead_[sample] != LightMesh::kNone || useful[n] == LightMesh::kNone) continue;
      if (anywhere || !parted(sample, useful[n])) instead_[sample] = useful[n];
    }
  }
  tbb::parallel_for(std::size_t{0}, seen.size(), [&](std::size_t i) {
    for (SampleAndByte& hit : seen[i].hits) hit = SampleAndByte::of(usefulBeside(hit.sample()), hit.byte());
  });
}

bool Exchange::isPolished(std::uint32_t sample) const {
  return isGround(sample) && samples_.receivers[sample].normal.z() > kFlat &&
         samples_.paints[sample].roughness < kPolished;
}

float Exchange::scattered(std::uint32_t from, const Eigen::Vector3f& towards) const {
  return towards.z() >= 0.0f || !isGround(from) ? 1.0f : scatteredDown(towards);
}

Sending Exchange::sending(std::size_t sample) const {
  const Reflectance mean = reflectance(samples_.paints[sample], kMeanView);
  const Eigen::Array3f all = mean.all();
  const OtherSide& other = samples_.other_side[sample];
  if (other.sample == LightMesh::kNone) {
    // The sky that the ground mirrors has gone its own way.
    const bool ground = isGround(static_cast<std::uint32_t>(sample));
    return {ground ? mean.diffuse : all, all, all, Eigen::Array3f::Zero(), other.sample};
  }
  const Eigen::Array3f through = other.share * mean.diffuse.min(all);  // what is mirrored stays on its side
  return {all - through, all - through, all - through, through, other.sample};
}

Sending Exchange::sendingToRooms(std::size_t sample) const {
  Sending sends = sending(sample);
  if (mirrors_[sample] != 0) sends.bounced = reflectance(samples_.paints[sample], kMeanView).diffuse;
  return sends;
}

SentSums Exchange::sentBy(const Sending& sends, const SumsOfAll& has, std::size_t sample) const {
  const Eigen::Array3f shining_there = shining[sample].above + shining[sample].below;
  SentSums sent{sends.direct * has.direct[sample] + sends.bounced * has.passed_on[sample].color(),
                sends.bounced * has.passed_on[sample].glow() + (sends.lamps - sends.bounced) * shining_there};
  if (sends.other != LightMesh::kNone) {
    const PassedOnSums& behind = has.passed_on[sends.other];
    sent.color += sends.through * (has.direct[sends.other] + behind.color());
    sent.glow += sends.through * behind.glow();
  }
  return sent;
}

PassedOnSums Exchange::received(const std::vector<SentSums>& sent, std::size_t sample) const {
  PassedOnSums sums;
  sums.below.color.setConstant(mirrored_sums[sample]);
  sums.above.glow = shining[sample].above;
  sums.below.glow = shining[sample].below;
  visitSeen(sample, all, [&](const SampleSeen& other, bool up) {
    PartSums& part = up ? sums.above : sums.below;
    part.color += other.weight * sent[other.sample].color;
    part.glow += other.weight * sent[other.sample].glow;
  });
  return sums;
}

Arrived Exchange::receivedOf(const Sent& sent, std::size_t sample) const {
  Arrived sum;
  const auto lit = [&](std::uint32_t other) { return sent.any[other] != 0; };
  visitSeen(sample, lit, [&](const SampleSeen& other, bool up) {
    (up ? sum.above : sum.below) += other.weight * sent.light[other.sample];
  });
  return sum;
}

template <typename See>
void Exchange::visitSenders(std::size_t sample, const See& see) const {
  visitSeen(sample, all, [&](const SampleSeen& other, bool) {
    const std::uint32_t sender = senderOf(other.sample), behind = samples_.other_side[sender].sample;
    see(sender);
    if (behind != LightMesh::kNone) see(behind);
  });
}

std::vector<Sending> Exchange::sendings() const {
  std::vector<Sending> all(sentCount());
  tbb::parallel_for(std::size_t{0}, all.size(), [&](std::size_t i) { all[i] = sendingOf(i); });
  return all;
}

std::vector<Arrived> Exchange::passedOn(const std::vector<Eigen::Array3f>& direct, int most) const {
  std::vector<Arrived> has(seen.size()), next(seen.size());
  Sent sent{std::vector<Eigen::Array3f>(sentCount()), std::vector<std::uint8_t>(sentCount())};
  const std::vector<Sending> sends_of = sendings();
  const auto bounced = [&](std::size_t i) -> Eigen::Array3f { return has[i].above + has[i].below; };
  ChangingBlocks changing(seen.size(), [&](std::size_t i, const auto& see) { visitSenders(i, see); });
  for (int bounce = 0; bounce < most && changing.any(); ++bounce) {
    tbb::parallel_for(std::size_t{0}, sentCount(), [&](std::size_t i) {
      const Sending& sends = sends_of[i];
      const std::uint32_t sender = senderOf(i);
      Eigen::Array3f light = sends.lamps * direct[sender] + sends.bounced * bounced(sender);
      if (sends.other != LightMesh::kNone)
        light += sends.through * (direct[sends.other] + bounced(sends.other));
      sent.light[i] = light;
      sent.any[i] = light.isZero(0.0f) ? 0 : 1;
    });
    changing.receive([&](std::size_t i) { return receivedOf(sent, i); }, &has, &next);
  }
  return has;
}

void Exchange::addLaterBounces(TransportData* data) const {
  const std::size_t count = seen.size();
  SumsOfAll has = sumsOf(*data);
  const std::vector<PassedOnSums> traced = has.passed_on;
  std::vector<PassedOnSums> next(count);
  std::vector<SentSums> sent(sentCount());
  const std::vector<Sending> sends_of = sendings();
  ChangingBlocks changing(count, [&](std::size_t i, const auto& see) { visitSenders(i, see); });
  for (int bounce = 0; bounce < kAllBounces && changing.any(); ++bounce) {
    tbb::parallel_for(std::size_t{0}, sent.size(),
                      [&](std::size_t i) { sent[i] = sentBy(sends_of[i], has, senderOf(i)); });
    changing.receive([&](std::size_t i) { return received(sent, i); }, &has.passed_on, &next);
  }
  tbb::parallel_for(std::size_t{0}, count, [&](std::size_t i) {
    brighten(traced[i].above, has.passed_on[i].above, i, &data->above);
    brighten(traced[i].below, has.passed_on[i].below, i, &data->below);
  });
}

}  // namespace sunlit::light
