#include "light/bake/gather/exchange.h"

#include <tbb/parallel_for.h>

#include <algorithm>

#include "light/bake/gather/room_mirrors.h"
#include "light/bake/samples/looked_for.h"
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
float relativeChange(const Arrived& before, const Arrived& after) {
  return relativeChange(before.all(), after.all());
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

void brighten(const Eigen::Array3f& traced, const Eigen::Array3f& all, std::size_t sample, PassedOn* part) {
  const float before = luminanceOf(traced), after = luminanceOf(all);
  if (before > 0.0f) {
    part->coefficients.scales[sample] *= after / before;
  } else if (after > 0.0f) {
    setEven(after, sample, &part->coefficients);
  }
  storeTint(all, sample, part);
}

}  // namespace

Exchange::Exchange(const SceneSamples& samples, const SkyPatches& patches, const BakedRooms& rooms)
    : seen(samples.receivers.size()),
      mirrored_sums(samples.receivers.size(), 0.0f),
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

Eigen::Array3f Exchange::sentBy(const Sending& sends, const SumsOfAll& has, std::size_t sample) {
  Eigen::Array3f sent = sends.direct * has.direct[sample] + sends.bounced * has.passed_on[sample].all();
  if (sends.other != LightMesh::kNone)
    sent += sends.through * (has.direct[sends.other] + has.passed_on[sends.other].all());
  return sent;
}

Arrived Exchange::received(const std::vector<Eigen::Array3f>& sent, std::size_t sample) const {
  Arrived sum;
  sum.below.setConstant(mirrored_sums[sample]);
  visitSeen(sample, all, [&](const SampleSeen& other, bool up) {
    (up ? sum.above : sum.below) += other.weight * sent[other.sample];
  });
  return sum;
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

Exchange::LookedFor Exchange::sentOf(const StraightLight& lamps, const std::vector<Arrived>& has) const {
  LookedFor sent(sentCount());
  // Of what a surface passes on besides, the same share as of the lamps' own light.
  const auto looked = [&](std::uint32_t sample) -> Eigen::Array3f {
    const float direct = lamps.direct[sample].sum();
    const float share = direct > 0.0f ? lamps.looked_for[sample].sum() / direct : 0.0f;
    return share * has[sample].all();
  };
  tbb::parallel_for(std::size_t{0}, sentCount(), [&](std::size_t i) {
    const Sending sends = sendingOf(i);
    const std::uint32_t sender = senderOf(i);
    Eigen::Array3f light = sends.lamps * lamps.direct[sender] + sends.bounced * has[sender].all();
    sent.part[i] = sends.lamps * lamps.looked_for[sender] + sends.bounced * looked(sender);
    sent.lamp_m[i] = lamps.lamp_m[sender];
    if (sends.other != LightMesh::kNone) {
      light += sends.through * (lamps.direct[sends.other] + has[sends.other].all());
      const Eigen::Array3f through = sends.through * (lamps.looked_for[sends.other] + looked(sends.other));
      if (through.sum() > sent.part[i].sum()) sent.lamp_m[i] = lamps.lamp_m[sends.other];
      sent.part[i] += through;
    }
    sent.sent.set(i, light);
  });
  return sent;
}

std::vector<Arrived> Exchange::receivedOf(const LookedFor& sent, std::vector<Arrived> found) const {
  std::vector<Eigen::Vector3f> places(seen.size());
  for (std::size_t i = 0; i < places.size(); ++i) places[i] = samples_.receivers[i].middle();
  const auto lit = [&](std::uint32_t other) { return sent.sent.any[other] != 0; };
  tbb::parallel_for(std::size_t{0}, seen.size(), [&](std::size_t i) {
    visitSeen(i, lit, [&](const SampleSeen& other, bool up) {
      const float from_m = (places[senderOf(other.sample)] - places[i]).norm();
      const float looked = lookedForFrom(sent.lamp_m[other.sample], from_m);
      const Eigen::Array3f met = sent.sent.light[other.sample] - looked * sent.part[other.sample];
      (up ? found[i].above : found[i].below) += other.weight * met.max(0.0f);
    });
  });
  return found;
}

std::vector<Arrived> Exchange::passedOn(const std::vector<Arrived>& first, int most) const {
  std::vector<Arrived> has = first, next(seen.size());
  Sent sent(sentCount());
  const std::vector<Sending> sends_of = sendings();
  ChangingBlocks changing(seen.size(), [&](std::size_t i, const auto& see) { visitSenders(i, see); });
  for (int bounce = 1; bounce < most && changing.any(); ++bounce) {
    tbb::parallel_for(std::size_t{0}, sentCount(), [&](std::size_t i) {
      const Sending& sends = sends_of[i];
      Eigen::Array3f light = sends.bounced * has[senderOf(i)].all();
      if (sends.other != LightMesh::kNone) light += sends.through * has[sends.other].all();
      sent.set(i, light);
    });
    const auto receive = [&](std::size_t i) {
      const Arrived further = receivedOf(sent, i);
      return Arrived{first[i].above + further.above, first[i].below + further.below};
    };
    changing.receive(receive, &has, &next);
  }
  return has;
}

void Exchange::addLaterBounces(TransportData* data) const {
  const std::size_t count = seen.size();
  SumsOfAll has = sumsOf(*data);
  const std::vector<Arrived> traced = has.passed_on;
  std::vector<Arrived> next(count);
  std::vector<Eigen::Array3f> sent(sentCount());
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
