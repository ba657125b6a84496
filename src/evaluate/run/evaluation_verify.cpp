// What a run tells of which matches are right: its values, rows and pictures. The images of a pose are taken
// from one place, so each point stays where it is.
#include <algorithm>
#include <set>

#include "evaluate/run/evaluation_state.h"
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
  values.verified[matched.pair][detector] = verify(features, maps, options_.comparer.ratio_test);
  if (work.is_drawn)
    values.drawn[matched.pair][detector] = drawVerified(images, features, maps, options_.comparer.ratio_test);
}

std::string Evaluation::State::drawnName(std::size_t pair, std::size_t detector) const {
  return options_.pairs[pair].name() + "/" + verified_layout_.differences[detector];
}

void Evaluation::State::claimDrawn(const Work& work) {
  if (!work.is_drawn) return;
  for (const std::size_t pair : work.pairs) {
    for (std::size_t d = 0; d < verified_layout_.differences.size(); ++d)
      drawn_->claim(drawnName(pair, d), work.pose, work.stamp_ns, true);
  }
}

void Evaluation::State::writeDrawn(const Work& work, const Values& values) {
  for (std::size_t i = 0; i < values.drawn.size(); ++i) {
    for (std::size_t d = 0; d < values.drawn[i].size(); ++d) {
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
  if (found != verified_.end()) verified_.erase(found);
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
    for (auto& record : records) record.pose = poses_.settled(record.stamp_ns, record.pose);
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
