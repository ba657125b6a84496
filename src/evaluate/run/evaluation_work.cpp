// How what is whole is compared, and what was found is kept.
#include <tbb/parallel_invoke.h>

#include <exception>

#include "evaluate/run/evaluation_state.h"

namespace sunlit::evaluate {

void Evaluation::State::writePictures(const Work& work) {
  for (const std::size_t s : work.pictures) {
    const std::shared_lock<std::shared_mutex> writing(writing_);
    if (is_broken_off_) return;
    pictures_->write(options_.streams[s], work.pose, work.stamp_ns, work.images[s]);
  }
}

std::vector<ImagePair> Evaluation::State::imagePairs(const Work& work) const {
  std::vector<ImagePair> pairs;
  for (const std::size_t p : work.pairs) pairs.push_back(pair_streams_[p]);
  return pairs;
}

void Evaluation::State::evaluate(const Work& work) {
  try {
    stop_.check();
    evaluatePairs(work);
  } catch (const Stopped&) {  // finish() gives it up
  }
}

Evaluation::State::Values Evaluation::State::compare(const Work& work) const {
  const std::size_t detectors = verified_layout_.differences.size();
  Values values;
  values.verified.resize(work.pairs.size(), std::vector<Verified>(detectors));
  values.lost.resize(work.pairs.size(), std::vector<LostFeatures>(detectors));
  values.drawn.resize(work.pairs.size(), std::vector<cv::Mat>(detectors));
  MatchedVisit visit;
  if (isVerifying() || observer_) {
    visit = [&](const Matched& matched) {
      verifyMatched(work, matched, values);
      observeMatched(work, matched);
    };
  }
  values.differences = comparer_.compare(work.images, imagePairs(work), stop_, visit);
  return values;
}

// A pose's rows come after its pictures: whoever takes up a killed run does not ask for this pose again.
void Evaluation::State::evaluatePairs(const Work& work) {
  Values values;
  std::string fault;
  std::exception_ptr picture_fault;
  const auto compare_all = [&] {
    try {
      values = compare(work);
    } catch (const Stopped&) {  // keepAll() will see it
    } catch (const std::exception& error) {
      fault = error.what();
      values.differences.resize(work.pairs.size());
      values.verified.resize(work.pairs.size());
      values.lost.resize(work.pairs.size());
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
  const std::vector<PairRecord> kept = keepAll(work, values, fault);
  removeFallen();
  tell(work, kept);
}

std::vector<PairRecord> Evaluation::State::keepAll(const Work& work, const Values& values,
                                                   const std::string& fault) {
  const std::shared_lock<std::shared_mutex> writing(writing_);
  stop_.check();
  std::vector<PairRecord> kept;
  for (std::size_t i = 0; i < work.pairs.size(); ++i) {
    const PairRecord record{work.pose, work.stamp_ns, work.pairs[i], values.differences[i]};
    if (keep(record, {work.pose, work.stamp_ns, work.pairs[i], values.verified[i]}, values.lost[i], fault))
      kept.push_back(record);
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
  if (callbacks_.progress) callbacks_.progress(completed_.size());
}

// From here on the work is accounted for.
void Evaluation::State::settle(const Work& work) {
  markCompleted(work.pose);
  under_way_.erase(work.stamp_ns);
}

void Evaluation::State::giveUp(const Work& work) {
  for (const std::size_t p : work.pairs) {
    ++counts_.pairs[p].dropped;
    report({"dropped", work.pose, work.stamp_ns, options_.pairs[p].name(),
            "the run was broken off before it was compared"});
  }
  settle(work);
  queued_bytes_ -= work.bytes;
  if (callbacks_.progress) callbacks_.progress(completed_.size());
}

// False where there is nothing to keep: the comparison failed, or another stamp counts by now. The rows of
// frames.csv come last: without them, whoever takes up a killed run asks for the pair again.
bool Evaluation::State::keep(const PairRecord& record, const VerifiedRecord& verified,
                             const std::vector<LostFeatures>& lost, const std::string& fault) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (taken_.at({record.pose, record.pair}) != record.stamp_ns) return false;
  if (!fault.empty()) {
    ++counts_.pairs[record.pair].failed;
    report({"failed", record.pose, record.stamp_ns, options_.pairs[record.pair].name(), fault});
    return false;
  }
  if (isVerifying()) {
    if (!isSelfTested(record.pair)) {
      std::string bytes;
      for (std::size_t d = 0; d < lost.size(); ++d)
        bytes += lostRecordOf(record.stamp_ns, record.pair, d, lost[d]);
      lost_file_.append(bytes);
    }
    rankKept(verified);
    verified_file_.append(verifiedText(verified_layout_, verified));
    verified_.push_back(verified);
  }
  frames_file_.append(framesText(layout_, record));
  records_.push_back(record);
  ++counts_.pairs[record.pair].evaluated;
  return true;
}

}  // namespace sunlit::evaluate
