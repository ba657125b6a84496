// What a run tells of which matches are right: its values, rows and pictures. The images of a pose are taken
// from one place, so each point stays where it is.
#include <algorithm>
#include <filesystem>
#include <set>

#include "evaluate/run/evaluation_state.h"
#include "sunlit/evaluate/files/stream_name.h"
#include "sunlit/evaluate/verify/draw_verified.h"

namespace sunlit::evaluate {

void Evaluation::State::verifyMatched(const Work& work, const Matched& matched, Values& values) const {
  const std::vector<std::string>& detectors = verified_layout_.differences;
  const auto found = std::find(detectors.begin(), detectors.end(), layout_.differences[matched.difference]);
  if (found == detectors.end()) return;
  const auto detector = static_cast<std::size_t>(found - detectors.begin());
  const auto& [stream_a, stream_b] = pair_streams_[work.pairs[matched.pair]];
  const ImagesToVerify images{work.images[stream_a], work.images[stream_b]};
  const PointMaps maps = identityMaps({images.rgb_a.cols, images.rgb_a.rows});
  const FeaturePair features{matched.a, matched.b, matched.nearest};
  const RatioTest& test = options_.comparer.ratio_test;
  Verified& verified = values.verified[matched.pair][detector];
  verified = verify(features, maps, test);
  const std::size_t pair = work.pairs[matched.pair];
  if (isSelfTested(pair)) return;
  const std::vector<AcceptedMatch> accepted = acceptedMatches(features, maps, test);
  values.lost[matched.pair][detector] =
      lostFeatures(features, accepted, maps, {images.rgb_a.cols, images.rgb_a.rows});
  if (isToBeDrawn(work, pair, detector, verified))
    values.drawn[matched.pair][detector] = drawVerified(images, features, accepted);
}

bool Evaluation::State::isSelfTested(std::size_t pair) const {
  return isSelfTest(options_.pairs[pair].a, options_.pairs[pair].b);
}

// Whatever is among the extremes at the end is among them as it comes.
bool Evaluation::State::isToBeDrawn(const Work& work, std::size_t pair, std::size_t detector,
                                    const Verified& verified) const {
  if (!drawn_ || work.is_drawn) return work.is_drawn;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    const ExtremePoses& so_far = extremes_[pair * verified_layout_.differences.size() + detector];
    if (!so_far.takes(rightMatches(verified), work.stamp_ns)) return false;
  }
  drawn_->claim(drawnName(pair, detector), work.pose, work.stamp_ns, true);
  return true;
}

ExtremePoses& Evaluation::State::extremes(std::size_t pair, std::size_t detector) {
  return extremes_[pair * verified_layout_.differences.size() + detector];
}

void Evaluation::State::rankAll() {
  extremes_.assign(options_.pairs.size() * verified_layout_.differences.size(), {});
  for (const VerifiedRecord& record : verified_) {
    for (std::size_t d = 0; d < record.values.size(); ++d)
      extremes(record.pair, d).add(rightMatches(record.values[d]), record.stamp_ns, record.pose);
  }
}

// Under mutex_, where no file is removed: another may be being written for long.
void Evaluation::State::rankKept(const VerifiedRecord& verified) {
  for (std::size_t d = 0; drawn_ && d < verified.values.size(); ++d) {
    ExtremePoses& ranked = extremes(verified.pair, d);
    std::set<std::int64_t> before = ranked.poses();
    before.insert(verified.pose);
    ranked.add(rightMatches(verified.values[d]), verified.stamp_ns, verified.pose);
    for (const std::int64_t pose : before) {
      if (!ranked.has(pose) && !isSample(pose)) fallen_.emplace_back(drawnName(verified.pair, d), pose);
    }
  }
}

void Evaluation::State::removeFallen() {
  std::vector<std::pair<std::string, std::int64_t>> fallen;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    fallen.swap(fallen_);
  }
  for (const auto& [name, pose] : fallen) drawn_->remove(name, pose);
}

// Without what a killed run left; says which are not there.
void Evaluation::State::keepFinalDrawn() {
  if (!drawn_) return;
  rankAll();
  std::size_t absent = 0;
  std::set<std::pair<std::int64_t, std::size_t>> verified;  // poses and pairs
  for (const VerifiedRecord& record : verified_) verified.emplace(record.pose, record.pair);
  for (std::size_t p = 0; p < options_.pairs.size(); ++p) {
    for (std::size_t d = 0; !isSelfTested(p) && d < verified_layout_.differences.size(); ++d) {
      const std::vector<std::int64_t> drawn = drawn_->posesOf(drawnName(p, d));
      const ExtremePoses& ranked = extremes(p, d);
      for (const std::int64_t pose : drawn) {
        const bool is_sample = isSample(pose) && verified.count({pose, p}) != 0;
        if (!ranked.has(pose) && !is_sample) drawn_->remove(drawnName(p, d), pose);
      }
      for (const std::int64_t pose : ranked.poses())
        absent += std::count(drawn.begin(), drawn.end(), pose) == 0;
    }
  }
  if (absent > 0 && callbacks_.note)
    callbacks_.note(
        "matches: " + std::to_string(absent) +
        " of the pictures with the fewest or the most right matches are not drawn here, since other "
        "folders or versions evaluated them");
}

// A record counts whose pair does; one that a killed run wrote twice counts once. A whole run has none left,
// and its sums stay.
void Evaluation::State::writeLostFeatures() {
  if (!isVerifying()) return;
  lost_file_.close();
  std::set<std::pair<std::int64_t, std::size_t>> counting;
  for (const VerifiedRecord& record : verified_) counting.emplace(record.stamp_ns, record.pair);
  std::vector<std::string> files = {file(kLostFile)};
  for (const std::string& folder : options_.merge) files.push_back(folder + "/" + kLostFile);
  const std::vector<LostSum> sums =
      sumsOfLost(files, verified_layout_, [&](std::int64_t stamp_ns, std::size_t pair) {
        return counting.count({stamp_ns, pair}) != 0;
      });
  const bool has_any =
      std::any_of(sums.begin(), sums.end(), [](const LostSum& sum) { return sum.poses > 0; });
  if (!has_any) return;
  if (!has_forgotten_) return writeLost(file("lost_features.csv"), verified_layout_, sums);
  if (callbacks_.note)
    callbacks_.note("lost_features.csv stays that of the run before: its single features are kept no more");
}

// Where a pair was verified, and the record of which of its features were lost is gone.
bool Evaluation::State::hasForgottenFeatures() const {
  const bool has_any = std::any_of(verified_.begin(), verified_.end(), [this](const VerifiedRecord& record) {
    return !isSelfTested(record.pair);
  });
  return isVerifying() && has_any && !verified_layout_.differences.empty() && !holdsLost(file(kLostFile));
}

std::string Evaluation::State::drawnName(std::size_t pair, std::size_t detector) const {
  return options_.pairs[pair].name() + "/" + verified_layout_.differences[detector];
}

void Evaluation::State::claimDrawn(const Work& work) {
  if (!work.is_drawn) return;
  for (const std::size_t pair : work.pairs) {
    for (std::size_t d = 0; !isSelfTested(pair) && d < verified_layout_.differences.size(); ++d)
      drawn_->claim(drawnName(pair, d), work.pose, work.stamp_ns, true);
  }
}

void Evaluation::State::writeDrawn(const Work& work, const Values& values) {
  for (std::size_t i = 0; i < values.drawn.size(); ++i) {
    for (std::size_t d = 0; !values.faults[i] && d < values.drawn[i].size(); ++d) {
      if (values.drawn[i][d].empty()) continue;
      const std::shared_lock<std::shared_mutex> writing(writing_);
      stop_.check();
      drawn_->write(drawnName(work.pairs[i], d), work.pose, work.stamp_ns, values.drawn[i][d]);
    }
  }
}

void Evaluation::State::withdrawVerified(std::int64_t stamp_ns, std::size_t pair) {
  const auto found = std::find_if(verified_.begin(), verified_.end(), [&](const VerifiedRecord& record) {
    return record.stamp_ns == stamp_ns && record.pair == pair;
  });
  if (found == verified_.end()) return;
  verified_.erase(found);
  rankAll();
}

// A pair counts where both files have it. What only one has, since the run was killed between them, leaves
// `frames`, or is not taken up; these lines are returned.
std::size_t Evaluation::State::takeUpVerified(const std::string& folder, std::vector<PairRecord>& frames) {
  if (!isVerifying()) return 0;
  LoadedVerified loaded = loadVerified(folder + "/verified.csv", verified_layout_);
  std::size_t dropped_lines = loaded.dropped_lines;
  using Key = std::pair<std::int64_t, std::size_t>;
  const auto keep_common = [&](auto& records, const std::set<Key>& others) {
    const auto is_alone = [&](const auto& record) {
      if (others.count({record.stamp_ns, record.pair}) != 0) return false;
      dropped_lines += record.values.size();
      return true;
    };
    records.erase(std::remove_if(records.begin(), records.end(), is_alone), records.end());
  };
  const auto keys_of = [](const auto& records) {
    std::set<Key> keys;
    for (const auto& record : records) keys.emplace(record.stamp_ns, record.pair);
    return keys;
  };
  keep_common(frames, keys_of(loaded.records));
  keep_common(loaded.records, keys_of(frames));
  std::move(loaded.records.begin(), loaded.records.end(), std::back_inserter(verified_));
  return dropped_lines;
}

void Evaluation::State::settleRecords() {
  const auto settle = [this](auto& records) {
    for (auto& record : records)
      record.pose = poses_.settled(record.stamp_ns, record.pose).value_or(record.pose);
    sortRecords(records);
  };
  settle(records_);
  settle(verified_);
}

// As while they grow, what frames.csv has must stand in the other.
void Evaluation::State::writeRecords() const {
  if (isVerifying()) writeVerifiedRecords(file("verified.csv"), verified_layout_, verified_);
  writeFrames(file("frames.csv"), layout_, records_);
}

}  // namespace sunlit::evaluate
