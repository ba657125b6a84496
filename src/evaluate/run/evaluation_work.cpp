// How what is whole is compared, and what was found is kept.
#include <tbb/parallel_invoke.h>

#include <algorithm>
#include <exception>
#include <optional>
#include <utility>

#include "evaluate/run/evaluation_state.h"
#include "sunlit/quantity/memory.h"

namespace sunlit::evaluate {
namespace {

// In words; what is no std::exception goes on.
std::optional<std::string> faultOf(const std::exception_ptr& thrown) {
  if (!thrown) return std::nullopt;
  try {
    std::rethrow_exception(thrown);
  } catch (const std::exception& error) {
    return reasonInWords(error);
  }
}

}  // namespace

void Evaluation::State::waitForRoom(std::size_t queued_poses) const {
  queue_.waitForAtMost(queued_poses);
  queue_.rethrow();
}

void Evaluation::State::evaluate(const Work& work) {
  try {
    stop_.check();
    evaluatePairs(work);
  } catch (const Stopped&) {  // finish() gives it up
  }
}

Evaluation::State::Values Evaluation::State::noValues(const Work& work) const {
  const std::size_t detectors = verified_layout_.differences.size();
  Values values;
  values.differences.resize(work.pairs.size());
  values.verified.resize(work.pairs.size(), std::vector<Verified>(detectors));
  values.lost.resize(work.pairs.size(), std::vector<LostFeatures>(detectors));
  values.drawn.resize(work.pairs.size(), std::vector<cv::Mat>(detectors));
  values.faults.resize(work.pairs.size());
  values.is_featureless.assign(work.images.size(), std::vector<char>(layout_.differences.size()));
  return values;
}

Evaluation::State::Values Evaluation::State::compare(const Work& work) const {
  Values values = noValues(work);
  CompareVisits visits;
  visits.found = [&](const Found& found) {
    values.is_featureless[found.image][found.difference] = found.features.key_points.empty() ? 1 : 0;
    if (!isObserved(work, found.image, found.difference)) return;
    observer_->observe({found.image, work.pose, work.stamp_ns}, work.truth,
                       layout_.differences[found.difference], found.features);
  };
  if (isVerifying()) visits.matched = [&](const Matched& matched) { verifyMatched(work, matched, values); };
  std::vector<ImagePair> pairs;
  for (const std::size_t p : work.pairs) pairs.push_back(pair_streams_[p]);
  Compared compared = comparer_.compareEach(work.images, pairs, stop_, visits);
  values.differences = std::move(compared.values);
  for (std::size_t i = 0; i < work.pairs.size(); ++i) values.faults[i] = faultOf(compared.faults[i]);
  for (std::size_t d = 0; d < compared.image_faults.size(); ++d) {
    for (std::size_t s = 0; s < work.images.size(); ++s) {
      const auto fault = faultOf(compared.image_faults[d][s]);
      if (!fault || !isObserved(work, s, d)) continue;
      std::string& why = values.unobserved[s];
      why += (why.empty() ? "" : "; ") + layout_.differences[d] + ": " + *fault;
    }
  }
  return values;
}

// A pose's rows come after its pictures: whoever takes up a killed run does not ask for this pose again.
void Evaluation::State::evaluatePairs(const Work& work) {
  Values values = noValues(work);
  std::exception_ptr picture_fault;
  const auto compare_all = [&] {
    try {
      values = compare(work);
    } catch (const Stopped&) {  // keepAll() will see it
    } catch (const std::exception& error) {
      values.faults.assign(work.pairs.size(), reasonInWords(error));
    }
  };
  const auto write = [&] {
    try {
      writePictures(work);
    } catch (...) {  // thrown at once, it would cancel the loops of the detectors at work
      picture_fault = std::current_exception();
    }
  };
  tbb::parallel_invoke(write, compare_all);
  if (picture_fault) std::rethrow_exception(picture_fault);
  writeDrawn(work, values);
  const std::vector<PairRecord> kept = keepAll(work, values);
  removeFallen();
  tell(work, kept);
}

// What is wrong with a picture comes before the rows of its pairs: whoever takes up a killed run does not ask
// for them again.
std::vector<PairRecord> Evaluation::State::keepAll(const Work& work, const Values& values) {
  const std::shared_lock<std::shared_mutex> writing(writing_);
  stop_.check();
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    for (const auto& [stream, fault] : values.unobserved) reportUnlocalised(work, stream, fault);
    for (std::size_t s = 0; s < values.is_featureless.size(); ++s) {
      for (std::size_t d = 0; d < layout_.differences.size(); ++d) {
        if (!values.is_featureless[s][d]) continue;
        ++counts_.streams[s].no_features;  // compared and looked for all the same
        report({"no_features", work.pose, work.stamp_ns, options_.streams[s],
                layout_.differences[d] + " found nothing in it"});
      }
    }
  }
  std::vector<PairRecord> kept;
  for (std::size_t i = 0; i < work.pairs.size(); ++i) {
    if (auto record = keep(work, values, i)) kept.push_back(std::move(*record));
  }
  const std::lock_guard<std::mutex> lock(mutex_);
  settle(work);
  return kept;
}

// Outside of all locks: drawing what matched takes long.
void Evaluation::State::tell(const Work& work, const std::vector<PairRecord>& records) {
  for (const PairRecord& record : records) {
    const std::lock_guard<std::mutex> lock(callback_mutex_);
    const auto& [first, second] = pair_streams_[record.pair];
    if (callbacks_.pair_done) callbacks_.pair_done(record, work.images[first], work.images[second]);
  }
  const std::lock_guard<std::mutex> lock(mutex_);
  queued_bytes_ -= work.bytes;
  if (callbacks_.progress) callbacks_.progress(completed_.passed());
}

// From here on the work is accounted for.
void Evaluation::State::settle(const Work& work) {
  const std::optional<std::int64_t> pose = poses_.settled(work.stamp_ns, work.pose);
  if (poses_.isByOrder()) completed_.addNumber(work.pose);
  if (!poses_.isByOrder() && pose) completed_.add(*pose);
  const auto [first, last] = under_way_.equal_range(work.stamp_ns);
  const auto found = std::find_if(first, last, [&](const auto& item) { return item.second.get() == &work; });
  if (found != last) under_way_.erase(found);
}

void Evaluation::State::giveUp(const Work& work) {
  for (const std::size_t p : work.pairs) {
    ++counts_.pairs[p].dropped;
    report({"dropped", work.pose, work.stamp_ns, options_.pairs[p].name(),
            "the run was broken off before it was compared"});
  }
  settle(work);
  queued_bytes_ -= work.bytes;
  if (callbacks_.progress) callbacks_.progress(completed_.passed());
}

// The i-th pair of `work`. None where there is nothing to keep: the comparison failed, another stamp
// counts by now, or its images turned out to be of two places or suns. The rows of frames.csv come last:
// without them, whoever takes up a killed run asks for the pair again.
std::optional<PairRecord> Evaluation::State::keep(const Work& work, const Values& values, std::size_t i) {
  const PairRecord record{work.pose, work.stamp_ns, work.pairs[i], values.differences[i]};
  const std::lock_guard<std::mutex> lock(mutex_);
  if (!work.is_by_order && taken_.at({record.pose, record.pair}) != record.stamp_ns) return std::nullopt;
  if (isLeftOut(record.stamp_ns, record.pose, record.pair)) return std::nullopt;
  if (values.faults[i]) {
    ++counts_.pairs[record.pair].failed;
    report({"failed", record.pose, record.stamp_ns, options_.pairs[record.pair].name(), *values.faults[i]});
    return std::nullopt;
  }
  replaceHeld(record.pose, record.pair);
  if (isVerifying()) {
    if (!isSelfTested(record.pair)) {
      std::string bytes;
      for (std::size_t d = 0; d < values.lost[i].size(); ++d)
        bytes += lostRecordOf(record.stamp_ns, record.pair, d, values.lost[i][d]);
      lost_file_.append(bytes);
    }
    const VerifiedRecord verified{record.pose, record.stamp_ns, record.pair, values.verified[i]};
    rankKept(verified);
    verified_file_.append(verifiedText(verified_layout_, verified));
    verified_.push_back(verified);
  }
  frames_file_.append(framesText(layout_, record));
  records_.push_back(record);
  ++counts_.pairs[record.pair].evaluated;
  return record;
}

}  // namespace sunlit::evaluate
