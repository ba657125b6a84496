// What is not evaluated although all of it came: pictures of two places, under another sun than that of their
// condition, or of which no capture says at which pose they were taken.
#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "evaluate/run/evaluation_state.h"
#include "sunlit/evaluate/same_place.h"

namespace sunlit::evaluate {
namespace {

constexpr const char* kSunIsMendedBy =
    " Left out; the same run again, with sun and site let alone, evaluates it";

using Stamps = std::pair<std::int64_t, std::int64_t>;  // from, to

bool isOutside(const Stamps& stamps, std::int64_t stamp_ns) {
  return stamp_ns < stamps.first || stamp_ns > stamps.second;
}

// Whoever goes on with a drive sends its images again, or what follows; those of another recording would be
// counted as more of it.
std::string furtherDrive(const Stamps& held, std::int64_t first_ns) {
  return " holds a drive of stamps from " + formatStamp(held.first) + " to " + formatStamp(held.second) +
         ", and the first image is of " + formatStamp(first_ns) +
         ": taken for more of that drive. Where it is another one, choose another output_dir";
}

}  // namespace

// Counts and names it where it is. A stream is where it is itself.
bool Evaluation::State::isOfTwoPlaces(std::int64_t stamp_ns, std::optional<std::int64_t> pose,
                                      std::size_t pair) {
  const std::string fault = places_.fault(stamp_ns);
  if (isSelfTested(pair) || fault.empty()) return false;
  ++counts_.pairs[pair].two_places;
  report({kTwoPlaces, pose, stamp_ns, options_.pairs[pair].name(), fault});
  return true;
}

// Counts it, too. Captures of other suns are named by nameOtherSuns().
bool Evaluation::State::isLeftOut(std::int64_t stamp_ns, std::optional<std::int64_t> pose, std::size_t pair) {
  if (isOfTwoPlaces(stamp_ns, pose, pair)) return true;
  const PairSpec& streams = options_.pairs[pair];
  if (!suns_.isOther(streams.a, stamp_ns) && !suns_.isOther(streams.b, stamp_ns)) return false;
  ++counts_.pairs[pair].other_sun;
  return true;
}

// What was evaluated before that was known. What earlier runs evaluated is not of this run's images.
void Evaluation::State::separate(std::int64_t stamp_ns) {
  std::vector<PairRecord> evaluated;
  for (const PairRecord& record : records_) {
    if (record.stamp_ns == stamp_ns && !isOfEarlierRun(record)) evaluated.push_back(record);
  }
  for (const PairRecord& record : evaluated) {
    if (isLeftOut(stamp_ns, record.pose, record.pair)) withdraw(stamp_ns, record.pair);
  }
  const std::optional<std::int64_t> pose = poses_.known(stamp_ns);
  if (pose && !places_.fault(stamp_ns).empty()) removePictures(stamp_ns, *pose);
}

// Of two places, but for those of streams that are compared with themselves.
void Evaluation::State::removePictures(std::int64_t stamp_ns, std::int64_t pose) {
  if (!pictures_) return;
  std::set<std::size_t> kept;
  for (std::size_t p = 0; p < options_.pairs.size(); ++p) {
    if (isSelfTested(p) && isWanted(p, pose)) kept.insert({pair_streams_[p].first, pair_streams_[p].second});
  }
  for (std::size_t s = 0; s < options_.streams.size(); ++s)
    if (kept.count(s) == 0) pictures_->removeOf(options_.streams[s], pose, stamp_ns);
}

// Of a picture that is asked for: what earlier runs evaluated is not of this run's images.
bool Evaluation::State::isLeftOutCapture(const std::string& stream, const CaptureRecord& capture) const {
  const auto number = static_cast<std::size_t>(
      std::find(options_.streams.begin(), options_.streams.end(), stream) - options_.streams.begin());
  const std::int64_t pose = poses_.known(capture.stamp_ns).value_or(capture.pose);
  return suns_.isOther(stream, capture.stamp_ns) && isAskedFor(number, capture.stamp_ns, pose);
}

// With the first capture of an image, what was by order until then waits for captures of its own.
void Evaluation::State::forgetOrder() {
  completed_.forgetNumbers();
  for (PictureWriter* writer : {pictures_.get(), drawn_.get()}) {
    if (writer != nullptr) writer->setAside();
  }
}

// Its capture may have come before it.
std::optional<std::int64_t> Evaluation::State::poseOfImage(std::int64_t stamp_ns) {
  const bool was_by_order = poses_.isByOrder();
  const bool is_first = std::all_of(counts_.streams.begin(), counts_.streams.end(),
                                    [](const StreamCounts& counts) { return counts.received == 0; });
  const auto held = poses_.numberedStamps();
  if (was_by_order && is_first && held && callbacks_.note && isOutside(*held, stamp_ns))
    callbacks_.note(options_.output_dir + furtherDrive(*held, stamp_ns));
  const std::optional<std::int64_t> pose = poses_.of(stamp_ns);
  if (was_by_order && !poses_.isByOrder()) forgetOrder();
  return pose;
}

void Evaluation::State::learn(const CaptureRecord& capture) {
  const bool was_by_order = poses_.isByOrder();
  poses_.learn(capture.stamp_ns, capture.pose);
  if (was_by_order && !poses_.isByOrder()) forgetOrder();
  for (PictureWriter* writer : {pictures_.get(), drawn_.get()}) {
    if (writer != nullptr && poses_.wasByOrder(capture.stamp_ns))
      writer->give(capture.stamp_ns, capture.pose);
  }
  const bool is_done = sets_.isTaken(capture.stamp_ns) && under_way_.count(capture.stamp_ns) == 0;
  if (is_done && poses_.wasByOrder(capture.stamp_ns)) complete(capture.pose);
}

// What was evaluated by order before the first capture came, at the end: each stamp has the pose that its
// capture tells by now, or none. Of two stamps of one pose the earlier one counts, as in takes().
void Evaluation::State::leaveOutUnplaced() {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (!poses_.isByCapture()) return;
  StampsOfPairs counting;
  for (const PairRecord& record : records_) {
    const std::optional<std::int64_t> pose = poses_.settled(record.stamp_ns, record.pose);
    if (!pose) continue;
    std::int64_t& stamp = counting.emplace(std::make_pair(*pose, record.pair), record.stamp_ns).first->second;
    stamp = std::min(stamp, record.stamp_ns);
  }
  std::vector<PairRecord> left_out;
  for (const PairRecord& record : records_) {
    const std::optional<std::int64_t> pose = poses_.settled(record.stamp_ns, record.pose);
    if (!pose || counting.at({*pose, record.pair}) != record.stamp_ns) left_out.push_back(record);
  }
  for (const PairRecord& record : left_out) {
    const std::optional<std::int64_t> pose = poses_.settled(record.stamp_ns, record.pose);
    withdraw(record.stamp_ns, record.pair);
    PairCounts& counts = counts_.pairs[record.pair];
    ++(pose ? counts.duplicate : counts.unplaced);
    report({pose ? "duplicate" : "unplaced", pose, record.stamp_ns, options_.pairs[record.pair].name(),
            pose ? kEarlierCounts : kNoCapture});
  }
}

// Streams and stamps that a run in `folder`, or one before it, left out.
void Evaluation::State::noteLeftOutBefore(const std::string& folder) {
  for (const char* kind : {kOtherSun, kTwoPlaces, kLeftOutBefore}) {
    for (const auto& [stamp, where] : problemsOf(kind, folder)) {
      left_out_before_.emplace(where, stamp);
      for (const PairSpec& pair : options_.pairs) {
        if (pair.name() == where) left_out_before_.insert({{pair.a, stamp}, {pair.b, stamp}});
      }
    }
  }
}

void Evaluation::State::nameOtherSuns(std::size_t stream, const std::vector<OtherSun>& others) {
  StreamCounts& counts = counts_.streams[stream];
  for (const OtherSun& other : others) {
    const std::optional<std::int64_t> pose = poses_.known(other.stamp_ns);
    if (pose && !isAskedFor(stream, other.stamp_ns, *pose)) continue;
    const std::string fault = other.fault + kSunIsMendedBy;
    report({kOtherSun, pose, other.stamp_ns, options_.streams[stream], fault});
    separate(other.stamp_ns);
    if (pictures_ && pose) pictures_->removeOf(options_.streams[stream], *pose, other.stamp_ns);
    if (++counts.other_sun > 1) continue;
    counts.other_sun_fault =
        (pose ? "pose " + std::to_string(*pose) : formatStamp(other.stamp_ns)) + ": " + fault;
    if (callbacks_.note) callbacks_.note(options_.streams[stream] + ": " + counts.other_sun_fault);
  }
}

}  // namespace sunlit::evaluate
