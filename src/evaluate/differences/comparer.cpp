#include "sunlit/evaluate/differences/comparer.h"

#include <tbb/parallel_for.h>

#include <algorithm>

#include <exception>
#include <mutex>

#include "evaluate/features/detector_pool.h"

namespace sunlit::evaluate {
namespace {

// One task per element, taken in order: the dearest first, so that the last ones to finish are short. What a
// task throws is thrown at the end, the first of it: thrown out of the loop, it would cancel the loops within
// other tasks too, which then go on with half their results.
template <typename Body>
void forEachTask(std::size_t count, const Body& body) {
  std::mutex mutex;
  std::exception_ptr fault;
  const auto runTask = [&](std::size_t i) {
    try {
      body(i);
    } catch (...) {
      const std::lock_guard<std::mutex> lock(mutex);
      if (!fault) fault = std::current_exception();
    }
  };
  tbb::parallel_for(
      tbb::blocked_range<std::size_t>(0, count, 1),
      [&](const tbb::blocked_range<std::size_t>& range) {
        for (std::size_t i = range.begin(); i < range.end(); ++i) runTask(i);
      },
      tbb::simple_partitioner());
  if (fault) std::rethrow_exception(fault);
}

std::vector<Field> rowsOf(ComparerOptions& options, const std::vector<std::string>& names) {
  return joined({{{"differences",
                   someOf(options.known, &options.differences),
                   "",
                   {},
                   "by name; surf only where it was built in"}},
                 fieldsOf(options.ratio_test),
                 options.known.fieldsOf(names)});
}

BothWays nearestOf(const Difference& difference, const View& a, const View& b, const StopToken& stop) {
  if (difference.detector() == nullptr) return {};
  return twoNearestBothWays(a.features.descriptors, b.features.descriptors, difference.detector()->norm(),
                            stop);
}

}  // namespace

std::vector<Field> decidingFieldsOf(ComparerOptions& options) {
  return rowsOf(options, options.differences);
}

std::vector<Field> fieldsOf(ComparerOptions& options) {
  return rowsOf(options, options.known.names());
}

std::vector<std::string> usualDetectors(const ComparerOptions& options) {
  std::vector<std::string> names;
  for (const char* name : {"sift", "orb"}) {
    const std::vector<std::string>& compared = options.differences;
    if (std::count(compared.begin(), compared.end(), name) > 0) names.emplace_back(name);
  }
  return names;
}

const Detector* firstDetectorOf(const ComparerOptions& options) {
  for (const std::string& name : options.differences) {
    if (const Detector* detector = options.known.at(name).detector()) return detector;
  }
  return nullptr;
}

Comparer::Comparer(const ComparerOptions& options) : options_(options) {
  requireFields(options_);
  for (const std::string& name : options_.differences) {
    const Difference& difference = options_.known.at(name);
    const Detector* detector = difference.detector();
    asked_.push_back({&difference, detector == nullptr
                                       ? nullptr
                                       : std::make_unique<DetectorPool>(*detector, options_.cache)});
  }
}

Comparer::~Comparer() = default;

std::vector<std::vector<DifferenceValue>> Comparer::compare(const std::vector<cv::Mat>& rgb_images,
                                                            const std::vector<ImagePair>& pairs,
                                                            const StopToken& stop,
                                                            const MatchedVisit& visit) const {
  std::vector<char> is_used(rgb_images.size(), 0);
  for (const ImagePair& pair : pairs) is_used.at(pair.first) = is_used.at(pair.second) = 1;

  std::vector<Picture> pictures(rgb_images.size());
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    if (is_used[i]) pictures[i] = makePicture(rgb_images[i]);
  }

  std::vector<std::vector<Features>> features(asked_.size(), std::vector<Features>(pictures.size()));
  forEachTask(asked_.size() * pictures.size(), [&](std::size_t task) {
    stop.check();
    const std::size_t d = task / pictures.size();
    const std::size_t i = task % pictures.size();
    if (is_used[i] && asked_[d].detectors != nullptr)
      features[d][i] = asked_[d].detectors->detect(pictures[i]);
  });

  std::vector<std::vector<DifferenceValue>> values(pairs.size(), std::vector<DifferenceValue>(asked_.size()));
  forEachTask(asked_.size() * pairs.size(), [&](std::size_t task) {
    stop.check();
    const std::size_t d = task / pairs.size();
    const std::size_t p = task % pairs.size();
    const View a{pictures[pairs[p].first], features[d][pairs[p].first]};
    const View b{pictures[pairs[p].second], features[d][pairs[p].second]};
    const BothWays nearest = nearestOf(*asked_[d].difference, a, b, stop);
    values[p][d] = asked_[d].difference->between(a, b, {nearest, options_.ratio_test}, stop);
    if (visit && asked_[d].detectors != nullptr) visit({p, d, a.features, b.features, nearest});
  });
  return values;
}

}  // namespace sunlit::evaluate
