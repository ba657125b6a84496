#include "sunlit/evaluate/run/evaluation.h"

#include <algorithm>

#include "evaluate/run/evaluation_state.h"

namespace sunlit::evaluate {

std::vector<PairSpec> allPairs(const std::vector<std::string>& streams) {
  std::vector<PairSpec> pairs;
  for (std::size_t i = 0; i < streams.size(); ++i) {
    for (std::size_t j = i + 1; j < streams.size(); ++j) pairs.push_back({streams[i], streams[j], 1});
  }
  return pairs;
}

bool Outcome::isWhole() const {
  std::size_t evaluated = 0;
  for (const PairCounts& pair : counts.pairs) {
    if (pair.notEvaluated() > 0) return false;
    evaluated += pair.evaluated + pair.resumed;
  }
  const bool repeats = std::any_of(counts.streams.begin(), counts.streams.end(),
                                   [](const StreamCounts& stream) { return stream.isMostlyDuplicate(); });
  return absent_poses == 0 && not_mended == 0 && evaluated > 0 && !repeats;
}

Evaluation::Evaluation(const EvaluationOptions& options, EvaluationCallbacks callbacks)
    : state_(std::make_unique<State>(options, std::move(callbacks))) {}

Evaluation::~Evaluation() = default;

namespace {

Arrival arrivalOf(const cv::Mat& rgb) {
  Arrival arrival;
  if (rgb.empty() || rgb.type() != CV_8UC3) {
    arrival.fault = "not an image of three channels of 8 bit";
  } else {
    arrival.rgb = rgb;
  }
  return arrival;
}

}  // namespace

void Evaluation::addImage(std::size_t stream, std::int64_t stamp_ns, const cv::Mat& rgb,
                          const ImageTraits& traits) {
  state_->note(stream, stamp_ns, traits);
  state_->add(stream, stamp_ns, arrivalOf(rgb));
}

void Evaluation::addLost(std::size_t stream, std::size_t images, std::int64_t stamp_ns) {
  state_->addLost(stream, images, stamp_ns);
}

void Evaluation::addBadImage(std::size_t stream, std::int64_t stamp_ns, const std::string& fault) {
  Arrival arrival;
  arrival.fault = fault;
  state_->add(stream, stamp_ns, std::move(arrival));
}

void Evaluation::addCapture(std::size_t stream, const CaptureRecord& capture) {
  state_->add(stream, capture);
}

void Evaluation::addPlace(const PlaceRecord& place) {
  state_->add(place);
}

void Evaluation::addDepth(std::int64_t stamp_ns, const Told<cv::Mat>& depth) {
  state_->addDepth(stamp_ns, depth);
}

void Evaluation::addTruePose(std::int64_t stamp_ns, const Told<Eigen::Isometry3d>& map_from_optical) {
  state_->addTruePose(stamp_ns, map_from_optical);
}

void Evaluation::addCamera(std::size_t stream, std::int64_t stamp_ns, const Told<ViewCamera>& camera) {
  state_->addCamera(stream, stamp_ns, camera);
}

void Evaluation::addPoseProblem(std::int64_t stamp_ns, const std::string& kind, const std::string& reason) {
  state_->addPoseProblem(stamp_ns, kind, reason);
}

void Evaluation::compareMethods(const StopToken& stop) {
  state_->compareMethods(stop);
}

LocalisationOutcome Evaluation::localise(const LocaliseCallbacks& callbacks) {
  return state_->localise(callbacks);
}

const EvaluationOptions& Evaluation::options() const {
  return state_->options();
}

const StopToken& Evaluation::stopToken() const {
  return state_->stopToken();
}

Counts Evaluation::counts() const {
  return state_->counts();
}

bool Evaluation::isComplete() const {
  return state_->isComplete();
}

void Evaluation::waitForRoom(std::size_t queued_poses) const {
  state_->waitForRoom(queued_poses);
}

Outcome Evaluation::finish(const StopToken& broken_off) {
  return state_->finish(broken_off);
}

}  // namespace sunlit::evaluate
