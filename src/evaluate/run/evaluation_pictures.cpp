// Which images of a run are kept.
#include "evaluate/run/evaluation_state.h"

namespace sunlit::evaluate {
namespace {

constexpr std::int64_t kSampleStride = 200;  // of a path of unknown length

}  // namespace

bool Evaluation::State::isSample(std::int64_t pose) const {
  return options_.poses.size() > 0 ? sampled_.count(pose) != 0 : pose % kSampleStride == 0;
}

std::vector<std::size_t> Evaluation::State::keptPictures(const StampSet& set, std::int64_t pose,
                                                         bool is_evaluated) {
  std::vector<std::size_t> kept;
  if (!pictures_ || (options_.images == KeptImages::kSamples && !isSample(pose))) return kept;
  const bool is_of_two = !places_.fault(set.stamp_ns).empty();
  for (std::size_t s = 0; s < set.streams.size(); ++s) {
    const bool is_left_out = suns_.isOther(options_.streams[s], set.stamp_ns) || (is_of_two && !is_evaluated);
    if (set.streams[s].rgb.empty() || is_left_out) continue;
    if (pictures_->claim(options_.streams[s], pose, set.stamp_ns, is_evaluated)) kept.push_back(s);
  }
  return kept;
}

// Of one whose set was closed before it came, as it is once it has all that is compared.
void Evaluation::State::keepLate(std::size_t stream, std::int64_t stamp_ns, std::int64_t pose,
                                 const cv::Mat& rgb) {
  if (!options_.poses.holds(pose)) return;
  StampSet set;
  set.stamp_ns = stamp_ns;
  set.streams.resize(options_.streams.size());
  set.streams[stream].rgb = rgb;
  Work work;
  work.stamp_ns = stamp_ns;
  work.pose = pose;
  work.observed.assign(set.streams.size(), 0);
  work.pictures = keptPictures(set, pose, false);
  if (!work.pictures.empty()) handOver(std::move(work), set);
}

void Evaluation::State::writePictures(const Work& work) {
  for (const std::size_t s : work.pictures) {
    const std::shared_lock<std::shared_mutex> writing(writing_);
    if (is_broken_off_) return;
    pictures_->write(options_.streams[s], work.pose, work.stamp_ns, work.images[s]);
  }
}

}  // namespace sunlit::evaluate
