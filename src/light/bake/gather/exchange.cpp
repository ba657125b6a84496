#include "light/bake/gather/exchange.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <utility>

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

/// Of what a sample sends: of less than that it waits until more has come.
constexpr float kNextToNothing = 2e-4f;
/// lx: from lamps the same, though that is all that there is. A tenth of what is worth to be stored.
constexpr float kUntold_lx = 1e-6f;

/// Of ground towards a ray that comes down along `towards`, in what it scatters towards the mean one.
float scatteredDown(const Eigen::Vector3f& towards) {
  constexpr float kMeanView = 0.64f;  // where Fresnel takes what it does on average, within 0.2 %
  static const float mean = 1.0f - meanGrazing(kMeanView);
  return (1.0f - meanGrazing(-towards.z())) / mean;
}

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
      mirrored_sums(samples.receivers.size(), Eigen::Array3f::Zero()),
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
    const Paint& paint = samples.paints[i];
    // GroundMirror knows one dielectric, and what mirrors nothing is none.
    const bool mirrors = paint.metalness < 0.5f && paint.dielectric_grazing > 0.5f;
    ground_[i] = receiver.normal.z() > kLevel && !sheet && mirrors ? 1 : 0;
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

std::vector<std::uint32_t> Exchange::passOver(const std::vector<bool>& useless,
                                              const LightMesh::Parted& parted) {
  std::vector<std::uint32_t> useful = samples_.mesh.usefulSamples(useless, parted);
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
  return useful;
}

bool Exchange::isPolished(std::uint32_t sample) const {
  return isGround(sample) && samples_.receivers[sample].normal.z() > kFlat &&
         samples_.paints[sample].roughness < kPolished;
}

float Exchange::scattered(std::uint32_t from, const Eigen::Vector3f& towards) const {
  return towards.z() >= 0.0f || !isGround(from) ? 1.0f : scatteredDown(towards);
}

Sending Exchange::sending(std::size_t sample) const {
  const Reflectance mean = meanReflectance(samples_.paints[sample]);
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
  if (mirrors_[sample] != 0) sends.bounced = meanReflectance(samples_.paints[sample]).diffuse;
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
  sum.below = mirrored_sums[sample];
  visitSeen(sample, all, [&](const SampleSeen& other, bool up) {
    (up ? sum.above : sum.below) += other.of(sent[other.sample]);
  });
  return sum;
}

template <int kSources>
ArrivedOf<kSources> Exchange::receivedOf(const SentOf<kSources>& sent, std::size_t sample) const {
  ArrivedOf<kSources> sum;
  const auto lit = [&](std::uint32_t other) { return sent.any[other] != 0; };
  visitSeen(sample, lit, [&](const SampleSeen& other, bool up) {
    (up ? sum.above : sum.below) += other.of(sent.light[other.sample]);
  });
  return sum;
}

const std::vector<Sending>& Exchange::sendings() const {
  std::call_once(sendings_found_, [&] {
    sendings_.resize(sentCount());
    tbb::parallel_for(std::size_t{0}, sendings_.size(), [&](std::size_t i) {
      sendings_[i] = i < seen.size() ? sending(i) : sendingToRooms(senderOf(i));
    });
  });
  return sendings_;
}

Exchange::LookedFor Exchange::sentOf(const StraightLight& lamps, const std::vector<Arrived>& has) const {
  LookedFor sent(sentCount());
  // Of what a surface passes on besides, the same share as of the lamps' own light.
  const auto looked = [&](std::uint32_t sample) -> Eigen::Array3f {
    const float direct = lamps.direct[sample].sum();
    const float share = direct > 0.0f ? lamps.looked_for[sample].sum() / direct : 0.0f;
    return share * has[sample].all();
  };
  const std::vector<Sending>& sends_of = sendings();
  tbb::parallel_for(std::size_t{0}, sentCount(), [&](std::size_t i) {
    const Sending& sends = sends_of[i];
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
  const std::vector<Eigen::Vector3f>& places = this->places();
  const auto lit = [&](std::uint32_t other) { return sent.sent.any[other] != 0; };
  inLitBlocks(sent.sent, [&](std::size_t i) {
    visitSeen(i, lit, [&](const SampleSeen& other, bool up) {
      const float from_m = (places[senderOf(other.sample)] - places[i]).norm();
      const float looked = lookedForFrom(sent.lamp_m[other.sample], from_m);
      const Eigen::Array3f met = sent.sent.light[other.sample] - looked * sent.part[other.sample];
      (up ? found[i].above : found[i].below) += other.of(met.max(0.0f));
    });
  });
  return found;
}

const std::vector<Eigen::Vector3f>& Exchange::places() const {
  std::call_once(places_found_, [&] {
    places_.resize(seen.size());
    tbb::parallel_for(std::size_t{0}, places_.size(),
                      [&](std::size_t i) { places_[i] = samples_.receivers[i].middle(); });
  });
  return places_;
}

/// Asked for once all is seen.
const std::vector<std::vector<std::uint32_t>>& Exchange::senders() const {
  std::call_once(senders_found_, [&] {
    senders_.resize((seen.size() + kSamplesOfTask - 1) / kSamplesOfTask);
    tbb::parallel_for(std::size_t{0}, senders_.size(), [&](std::size_t block) {
      std::vector<std::uint8_t> is_seen(senders_.size(), 0);
      for (std::size_t i = block * kSamplesOfTask; i < endOf(block); ++i) {
        visitSeen(i, all, [&](const SampleSeen& other, bool) {
          is_seen[senderOf(other.sample) / kSamplesOfTask] = 1;
        });
      }
      for (std::uint32_t other = 0; other < is_seen.size(); ++other)
        if (is_seen[other] != 0) senders_[block].push_back(other);
    });
  });
  return senders_;
}

/// Calls visit(sample) for all of those blocks that get any of the light. Parallel. Returns whether there is
/// any.
template <int kSources, typename Visit>
bool Exchange::inLitBlocks(const SentOf<kSources>& sent, const Visit& visit) const {
  const std::vector<std::vector<std::uint32_t>>& senders = this->senders();
  std::vector<std::uint8_t> lit(senders.size(), 0);
  for (std::size_t i = 0; i < sentCount(); ++i) lit[senderOf(i) / kSamplesOfTask] |= sent.any[i];
  if (std::find(lit.begin(), lit.end(), 1) == lit.end()) return false;
  tbb::parallel_for(std::size_t{0}, senders.size(), [&](std::size_t block) {
    const bool is_lit = std::any_of(senders[block].begin(), senders[block].end(),
                                    [&](std::uint32_t other) { return lit[other] != 0; });
    if (!is_lit) return;
    for (std::size_t i = block * kSamplesOfTask; i < endOf(block); ++i) visit(i);
  });
  return true;
}

/// Of what is sent, send(number) by what samples have, all know what they were `told`. The rest goes on.
template <int kSources, typename Send>
void Exchange::passOnChanges(const Send& send, float dark, OnItsWay<kSources>* light) const {
  SentOf<kSources> changes(sentCount());
  for (int bounce = 0;; ++bounce) {
    tbb::parallel_for(std::size_t{0}, sentCount(), [&](std::size_t i) {
      const Colors<kSources> now = send(i);
      Colors<kSources> change = now - light->told[i];
      for (int k = 0; k < kSources; ++k) {
        const bool matters =
            bounce < light->most[static_cast<std::size_t>(k)] &&
            change.col(k).abs().maxCoeff() > std::max(kNextToNothing * now.col(k).maxCoeff(), dark);
        if (matters) {
          light->told[i].col(k) = now.col(k);
        } else {
          change.col(k).setZero();
        }
      }
      changes.set(i, change);
    });
    if (!inLitBlocks(changes, [&](std::size_t i) { (*light->has)[i] += receivedOf(changes, i); })) return;
  }
}

std::vector<std::vector<Arrived>> Exchange::passedOn(std::vector<FirstBounce> first) const {
  for (std::size_t begin = 0; begin < first.size(); begin += kTogether) {
    const int count = static_cast<int>(std::min<std::size_t>(kTogether, first.size() - begin));
    if (count == 1) {
      passOnTogether<1>(&first[begin], count);
    } else {
      passOnTogether<kTogether>(&first[begin], count);
    }
  }
  std::vector<std::vector<Arrived>> has;
  for (FirstBounce& source : first) has.push_back(std::move(source.has));
  return has;
}

/// Of `count` sources, which may be fewer than there is room for; sets what samples have of them in the end.
template <int kSources>
void Exchange::passOnTogether(FirstBounce* first, int count) const {
  std::vector<ArrivedOf<kSources>> has(seen.size());
  OnItsWay<kSources> light{&has, std::vector<Colors<kSources>>(sentCount(), Colors<kSources>::Zero()), {}};
  for (int k = 0; k < count; ++k) {
    light.most[static_cast<std::size_t>(k)] = first[k].most - 1;
    for (std::size_t i = 0; i < has.size(); ++i) {
      has[i].above.col(k) = first[k].has[i].above;
      has[i].below.col(k) = first[k].has[i].below;
    }
  }
  const std::vector<Sending>& sends_of = sendings();
  const auto send = [&](std::size_t i) -> Colors<kSources> {
    const Sending& sends = sends_of[i];
    Colors<kSources> sent = has[senderOf(i)].all().colwise() * sends.bounced;
    if (sends.other != LightMesh::kNone) sent += has[sends.other].all().colwise() * sends.through;
    return sent;
  };
  passOnChanges(send, kUntold_lx, &light);
  for (int k = 0; k < count; ++k)
    for (std::size_t i = 0; i < has.size(); ++i) first[k].has[i] = {has[i].above.col(k), has[i].below.col(k)};
}

void Exchange::addLaterBounces(TransportData* data) const {
  SumsOfAll has = sumsOf(*data);
  const std::vector<Arrived> traced = has.passed_on;
  const std::vector<Sending>& sends_of = sendings();
  const auto send = [&](std::size_t i) { return sentBy(sends_of[i], has, senderOf(i)); };
  OnItsWay<1> light{&has.passed_on, std::vector<Eigen::Array3f>(sentCount()), {kAllBounces - 1}};
  tbb::parallel_for(std::size_t{0}, sentCount(), [&](std::size_t i) { light.told[i] = send(i); });
  tbb::parallel_for(std::size_t{0}, seen.size(),
                    [&](std::size_t i) { has.passed_on[i] = received(light.told, i); });
  passOnChanges(send, 0.0f, &light);
  tbb::parallel_for(std::size_t{0}, seen.size(), [&](std::size_t i) {
    brighten(traced[i].above, has.passed_on[i].above, i, &data->above);
    brighten(traced[i].below, has.passed_on[i].below, i, &data->below);
  });
}

}  // namespace sunlit::light
