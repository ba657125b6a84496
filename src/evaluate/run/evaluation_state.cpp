#include "evaluate/run/evaluation_state.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace sunlit::evaluate {
namespace {

bool hasBoth(const StampSet& set, const ImagePair& pair) {
  return set.streams[pair.first].has_come && set.streams[pair.second].has_come;
}

}  // namespace

bool Evaluation::State::isWanted(std::size_t pair, std::int64_t pose) const {
  return pose % options_.pairs[pair].every == 0;
}

// So that this stamp is not evaluated. By a rate the earlier of two stamps of a pose counts, even where that
// other one was evaluated before; without one, a run may give a pose another stamp than the run before. Where
// captures tell poses now, and order did before, nobody knows whether that run had this pose.
bool Evaluation::State::isHeld(std::int64_t stamp_ns, std::int64_t pose, std::size_t pair) const {
  const auto held = held_.find({pose, pair});
  if (held == held_.end()) return false;
  return poses_.hasRate() ? held->second <= stamp_ns : poses_.settled(held->second, pose) == pose;
}

bool Evaluation::State::isOfEarlierRun(const PairRecord& record) const {
  const auto held = held_.find({record.pose, record.pair});
  return held != held_.end() && held->second == record.stamp_ns;
}

// Whether a picture is of any pair that earlier runs did not evaluate.
bool Evaluation::State::isAskedFor(std::size_t stream, std::int64_t stamp_ns, std::int64_t pose) const {
  for (std::size_t p = 0; p < options_.pairs.size(); ++p) {
    const bool has = pair_streams_[p].first == stream || pair_streams_[p].second == stream;
    if (has && isWanted(p, pose) && !isHeld(stamp_ns, pose, p)) return true;
  }
  return false;
}

std::vector<char> Evaluation::State::neededStreams(std::int64_t stamp_ns, std::int64_t pose) const {
  std::vector<char> is_needed(options_.streams.size(), 0);
  for (std::size_t s = 0; s < is_needed.size(); ++s) is_needed[s] = isAskedFor(s, stamp_ns, pose) ? 1 : 0;
  return is_needed;
}

void Evaluation::State::add(std::size_t stream, std::int64_t stamp_ns, Arrival arrival) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (is_finished_) {
    ++counts_.after_end;
    return;
  }
  StreamCounts& counts = counts_.streams.at(stream);
  const std::string& name = options_.streams[stream];
  const std::optional<std::int64_t> pose = poseOfImage(stamp_ns);
  ++counts.received;
  places_.noteImage(stamp_ns);
  record_files_->noteImage(stamp_ns);
  if (!arrival.fault.empty()) {
    ++counts.undecodable;
    report({"undecodable", pose, stamp_ns, name, arrival.fault});
  }
  if (sets_.isOutOfOrder(stream, stamp_ns)) {
    ++counts.out_of_order;
    report({"out_of_order", pose, stamp_ns, name, "came after a later image; used all the same"});
  }
  const cv::Mat rgb = arrival.rgb;
  switch (sets_.add(stream, stamp_ns, std::move(arrival))) {
    case StampSets::Outcome::kKept:
      break;
    case StampSets::Outcome::kDuplicate:
      ++counts.duplicate;
      report({"duplicate", pose, stamp_ns, name, "this stamp had come before; the first image counts"});
      break;
    case StampSets::Outcome::kReplaced:
      report({"replaced", pose, stamp_ns, name,
              "an image of this stamp had come before that could not be used; this one counts"});
      break;
    case StampSets::Outcome::kClosed:
      if (pose) keepLate(stream, stamp_ns, *pose, rgb);
      addLate(stream, stamp_ns, pose);
      break;
  }
  if (observer_ && observer_->truth().cameras(stream).noteImage(stamp_ns))
    closeWhole(std::numeric_limits<std::int64_t>::max());
  closeIfWhole(stamp_ns);
  keepWithinMemory(stamp_ns);
}

// After its set was closed.
void Evaluation::State::addLate(std::size_t stream, std::int64_t stamp_ns, std::optional<std::int64_t> pose) {
  if (pose && !options_.poses.holds(*pose)) return turnAway(stream, stamp_ns, *pose);
  // Of pairs that an earlier run evaluated nobody waits for the second image: here it is told from one whose
  // pose another stamp has already.
  for (std::size_t p = 0; pose && p < options_.pairs.size(); ++p) {
    const auto& [a, b] = pair_streams_[p];
    const bool is_second = (a == stream || b == stream) && sets_.hasCome(a == stream ? b : a, stamp_ns);
    if (is_second && isWanted(p, *pose) && isHeld(stamp_ns, *pose, p)) takes(stamp_ns, *pose, p);
  }
  if (pose && !isAskedFor(stream, stamp_ns, *pose)) return;
  ++counts_.streams[stream].late;
  report(
      {"late", pose, stamp_ns, options_.streams[stream], "its stamp had been given up to bound the memory"});
}

void Evaluation::State::turnAway(std::size_t stream, std::int64_t stamp_ns, std::int64_t pose) {
  ++counts_.streams[stream].unexpected;
  report(
      {kUnexpected, pose, stamp_ns, options_.streams[stream], "is not one of the expected poses; left out"});
}

// What is whole will be compared and makes room by itself; what waits may wait for ever. Half of the memory
// is kept from images that wait for nothing but pose, depth or camera, so that they turn no other away.
void Evaluation::State::keepWithinMemory(std::int64_t newest_ns) {
  const auto isTooMuch = [&] {
    return sets_.reservedBytes() + queued_bytes_ + truthBytes() > options_.memory_limit_bytes;
  };
  const bool is_busy = queued_bytes_ > 0;
  // Poses older than all images that wait: theirs will hardly come.
  if (truthBytes() > 0 && isTooMuch())
    observer_->truth().forgetPosesBefore(sets_.oldest().value_or(newest_ns));
  handOverComplete(isTooMuch() && !is_busy ? 0 : options_.memory_limit_bytes / 2, newest_ns);
  while (sets_.reservedBytes() > 0 && isTooMuch()) {
    const bool is_newest = is_busy && sets_.find(newest_ns) != nullptr;
    const std::int64_t stamp = is_newest ? newest_ns : *sets_.oldest();
    const std::optional<std::int64_t> pose = poses_.of(stamp);
    const bool is_complete = pose && hasAllImages(*sets_.find(stamp), *pose);
    close(stamp, pose, is_complete ? Reason::kWhole : Reason::kMemory);
  }
  while (truthBytes() > 0 && isTooMuch())
    observer_->truth().take(observer_->truth().oldest());  // whose images may never come
}

// The oldest of the sets to which only what they are localised by is missing, until the others take
// `most_bytes`: they are compared without.
void Evaluation::State::handOverComplete(std::size_t most_bytes, std::int64_t newest_ns) {
  if (!observer_ || sets_.reservedBytes() <= most_bytes) return;
  const auto bytesAt = [&](std::int64_t stamp) {
    std::size_t bytes = 0;
    for (const Arrival& arrival : sets_.find(stamp)->streams) bytes += bytesOf(arrival.rgb);
    return bytes;
  };
  std::vector<std::pair<std::int64_t, std::size_t>> complete;  // stamps, with their bytes
  std::size_t bytes = 0;
  for (const std::int64_t stamp : sets_.openStamps()) {
    const std::optional<std::int64_t> pose = poses_.of(stamp);
    if (stamp == newest_ns || !pose || !hasAllImages(*sets_.find(stamp), *pose)) continue;
    complete.emplace_back(stamp, bytesAt(stamp));
    bytes += complete.back().second;
  }
  for (std::size_t i = 0; i < complete.size() && bytes > most_bytes; ++i) {
    const auto [stamp, bytes_of_it] = complete[i];
    bytes -= bytes_of_it;
    close(stamp, poses_.of(stamp), Reason::kWhole);
  }
}

void Evaluation::State::addLost(std::size_t stream, std::size_t images, std::int64_t stamp_ns) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (is_finished_) return;
  counts_.streams.at(stream).lost += images;
  report({"lost", std::nullopt, stamp_ns, options_.streams[stream],
          "by their sequence numbers " + std::to_string(images) +
              " images before this one are missing (lost, or left out by a throttle)"});
}

void Evaluation::State::note(std::size_t stream, std::int64_t stamp_ns, const ImageTraits& traits) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (is_finished_) return;
  std::vector<std::string> notes = grey_.add(stream, stamp_ns, traits.is_grey);
  if (traits.is_lossy && ++counts_.streams.at(stream).lossy == 1)
    notes.push_back(options_.streams[stream] +
                    ": images are compressed with loss (JPEG): differences contain what that changed");
  for (const std::string& line : notes) {
    if (callbacks_.note) callbacks_.note(line);
  }
}

void Evaluation::State::add(std::size_t stream, const CaptureRecord& capture) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (is_finished_) return;
  if (const auto told = poses_.told(capture.stamp_ns); told.value_or(capture.pose) != capture.pose)
    report(
        {"two_numbers", capture.pose, capture.stamp_ns, options_.streams.at(stream),
         "an earlier capture of this stamp tells pose " + std::to_string(*told) + "; the last one counts"});
  learn(capture);
  const std::int64_t pose = poses_.known(capture.stamp_ns).value_or(capture.pose);
  const bool is_first =
      record_files_->add(options_.streams.at(stream), capture, !isAskedFor(stream, capture.stamp_ns, pose));
  if (!capture.utc && !capture.utc_text.empty())
    report(
        {kUnusable, capture.pose, capture.stamp_ns, options_.streams[stream],
         "utc is \"" + capture.utc_text + "\", so that nobody can tell whether its sun was set meanwhile"});
  if (places_.isBroken(options_.streams[stream], capture)) separate(capture.stamp_ns);
  if (is_first) nameOtherSuns(stream, suns_.add(options_.streams[stream], capture));
  closeIfWhole(capture.stamp_ns);
}

void Evaluation::State::add(const PlaceRecord& place) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (is_finished_) return;
  if (!std::isfinite(place.x_m + place.y_m + place.z_m + place.yaw_deg)) {
    report({kUnusable, std::nullopt, place.stamp_ns, "pose",
            "position and orientation must be finite, the orientation a quaternion of length 1; left out of "
            "path.csv"});
    return;
  }
  record_files_->add(place);
}

bool Evaluation::State::hasAllImages(const StampSet& set, std::int64_t pose) const {
  const std::vector<char> is_needed = neededStreams(set.stamp_ns, pose);
  for (std::size_t s = 0; s < is_needed.size(); ++s) {
    if (is_needed[s] && !set.streams[s].has_come) return false;
  }
  return true;
}

bool Evaluation::State::isWhole(const StampSet& set, std::int64_t pose) const {
  return hasAllImages(set, pose) &&
         (!observer_ || observer_->isReady(set.stamp_ns, neededStreams(set.stamp_ns, pose)));
}

void Evaluation::State::closeIfWhole(std::int64_t stamp_ns) {
  const StampSet* set = sets_.find(stamp_ns);
  if (set == nullptr) return;
  const std::optional<std::int64_t> pose = poses_.of(stamp_ns);
  if (!pose) return;
  if (options_.poses.holds(*pose)) {
    if (isWhole(*set, *pose)) close(stamp_ns, pose, Reason::kWhole);
    return;
  }
  const StampSet unwanted = sets_.take(stamp_ns);
  for (std::size_t s = 0; s < unwanted.streams.size(); ++s) {
    if (unwanted.streams[s].has_come) turnAway(s, stamp_ns, *pose);
  }
  complete(*pose);
}

// Counts and names a pair that cannot be compared.
bool Evaluation::State::canCompare(const StampSet& set, std::size_t pair, std::optional<std::int64_t> pose,
                                   Reason reason) {
  const std::size_t ia = pair_streams_[pair].first;
  const std::size_t ib = pair_streams_[pair].second;
  const Arrival& a = set.streams[ia];
  const Arrival& b = set.streams[ib];
  const std::string where = options_.pairs[pair].name();
  PairCounts& counts = counts_.pairs[pair];
  if (!a.has_come || !b.has_come) {
    const std::string& absent = options_.streams[a.has_come ? ib : ia];
    const bool is_dropped = reason == Reason::kMemory;
    ++(is_dropped ? counts.dropped : counts.missing_partner);
    report({is_dropped ? "dropped" : "missing_partner", pose, set.stamp_ns, where,
            "no image of " + absent + (is_dropped ? " before memory_limit was reached" : "")});
    return false;
  }
  if (a.rgb.empty() || b.rgb.empty()) {
    ++counts.undecodable;
    const Arrival& bad = a.rgb.empty() ? a : b;
    report({"undecodable", pose, set.stamp_ns, where,
            "image of " + options_.streams[a.rgb.empty() ? ia : ib] + ": " + bad.fault});
    return false;
  }
  if (a.rgb.size() != b.rgb.size()) {
    ++counts.size_mismatch;
    const auto size = [](const cv::Mat& image) {
      return std::to_string(image.cols) + "x" + std::to_string(image.rows);
    };
    report({"size_mismatch", pose, set.stamp_ns, where, size(a.rgb) + " against " + size(b.rgb)});
    return false;
  }
  if (isLeftOut(set.stamp_ns, pose, pair)) return false;
  if (!pose) {
    ++counts.unplaced;
    report({"unplaced", pose, set.stamp_ns, where,
            options_.frame_rate > 0.0 ? "its stamp lies before stamp_start"
            : thinnedPair(options_) ? kNoCapture + std::string(", as every of a pair needs, or a frame_rate")
                                    : kNoCapture});
    return false;
  }
  return true;
}

// Whether it is to be evaluated. Two stamps may round to one pose. The earlier one counts, in whatever order
// they come; the later one is counted and named. Numbers by order differ, and keep no pose that a capture may
// tell from another stamp: leaveOutUnplaced() sees to them.
bool Evaluation::State::takes(std::int64_t stamp_ns, std::int64_t pose, std::size_t pair) {
  if (poses_.isByOrder()) return !isHeld(stamp_ns, pose, pair);
  const auto held = held_.find({pose, pair});
  const auto [taken, is_first] = taken_.emplace(std::make_pair(pose, pair), stamp_ns);
  if (!is_first) {
    ++counts_.pairs[pair].duplicate;
    report(
        {"duplicate", pose, std::max(stamp_ns, taken->second), options_.pairs[pair].name(), kEarlierCounts});
    if (stamp_ns > taken->second) return false;
    if (held == held_.end() || held->second != taken->second) withdraw(taken->second, pair);
    taken->second = stamp_ns;
  }
  return !isHeld(stamp_ns, pose, pair);
}

// What an earlier run evaluated of a later stamp of this pose, by a rate, once there is something in its
// place.
void Evaluation::State::replaceHeld(std::int64_t pose, std::size_t pair) {
  const auto held = held_.find({pose, pair});
  if (held == held_.end() || !poses_.hasRate()) return;
  withdraw(held->second, pair);
  held_.erase(held);
}

// What is being evaluated still is left out when it is done; the file loses the rows at the end.
void Evaluation::State::withdraw(std::int64_t stamp_ns, std::size_t pair) {
  const auto found = std::find_if(records_.begin(), records_.end(), [&](const PairRecord& record) {
    return record.stamp_ns == stamp_ns && record.pair == pair;
  });
  if (found == records_.end()) return;
  PairCounts& counts = counts_.pairs[pair];
  --(isOfEarlierRun(*found) ? counts.resumed : counts.evaluated);
  records_.erase(found);
  withdrawVerified(stamp_ns, pair);
}

void Evaluation::State::close(std::int64_t stamp_ns, std::optional<std::int64_t> pose, Reason reason) {
  const StampSet set = sets_.take(stamp_ns);
  for (std::size_t s = 0; s < set.streams.size(); ++s) {
    if (reason == Reason::kMemory && !set.streams[s].rgb.empty()) ++counts_.streams[s].dropped;
  }
  Work work;
  work.stamp_ns = stamp_ns;
  for (std::size_t p = 0; p < options_.pairs.size(); ++p) {
    if (pose && !isWanted(p, *pose)) continue;
    const bool is_held = pose && isHeld(stamp_ns, *pose, p);
    if (is_held ? !hasBoth(set, pair_streams_[p]) : !canCompare(set, p, pose, reason)) continue;
    if (takes(stamp_ns, *pose, p)) work.pairs.push_back(p);
  }
  if (!pose) return;
  work.pose = *pose;
  work.is_by_order = poses_.isByOrder();
  work.pictures = keptPictures(set, *pose, !work.pairs.empty());
  work.is_drawn = drawn_ && isSample(*pose);
  claimDrawn(work);
  observeSet(set, work);
  if (work.pairs.empty() && work.pictures.empty()) {
    complete(*pose);
    return;
  }
  handOver(std::move(work), set);
}

void Evaluation::State::handOver(Work work, const StampSet& set) {
  for (const Arrival& arrival : set.streams) {
    work.images.push_back(arrival.rgb);
    work.bytes += bytesOf(arrival.rgb);
  }
  queued_bytes_ += work.bytes;
  const auto shared = std::make_shared<const Work>(std::move(work));
  under_way_.emplace(shared->stamp_ns, shared);
  queue_.add([this, shared] { evaluate(*shared); });
}

void Evaluation::State::complete(std::int64_t pose) {
  poses_.isByOrder() ? completed_.addNumber(pose) : completed_.add(pose);
  if (callbacks_.progress) callbacks_.progress(completed_.passed());
}

Counts Evaluation::State::counts() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  Counts counts = counts_;
  for (std::size_t s = 0; s < counts.streams.size(); ++s)
    counts.streams[s].only_stamp_ns = sets_.onlyStamp(s);
  counts.completed_poses = completed_.size();
  counts.waiting_images = sets_.waitingImages();
  counts.passed_poses = completed_.passed();
  counts.unexpected_poses = completed_.unexpected();
  counts.queued_poses = under_way_.size();
  counts.bytes = sets_.reservedBytes() + queued_bytes_ + truthBytes();
  if (const auto oldest = sets_.oldest()) {
    const StampSet& set = *sets_.find(*oldest);
    for (std::size_t s = 0; s < set.streams.size(); ++s) {
      if (!set.streams[s].has_come) counts.awaited_streams.push_back(s);
    }
    const std::vector<char> all(set.streams.size(), 1);
    counts.awaits_truth = observer_ && counts.awaited_streams.empty() && !observer_->isReady(*oldest, all);
  }
  return counts;
}

bool Evaluation::State::isComplete() const {
  queue_.rethrow();
  const std::lock_guard<std::mutex> lock(mutex_);
  return completed_.isWhole();
}

}  // namespace sunlit::evaluate
