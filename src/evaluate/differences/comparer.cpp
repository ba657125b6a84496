#include "sunlit/evaluate/differences/comparer.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <utility>

#include "evaluate/features/detector_pool.h"

namespace sunlit::evaluate {
namespace {

// One task per element, taken in order: the dearest first, so that the last ones to finish are short. What
// each threw, but for Stopped, which is thrown at the end: thrown out of the loop, it would cancel the loops
// within other tasks too, which then go on with half their results.
template <typename Body>
std::vector<std::exception_ptr> faultsOfTasks(std::size_t count, const StopToken& stop, const Body& body) {
  std::vector<std::exception_ptr> faults(count);
  std::atomic<bool> is_stopped{false};
  const auto runTask = [&](std::size_t i) {
    try {
      stop.check();
      body(i);
    } catch (const Stopped&) {
      is_stopped = true;
    } catch (...) {
      faults[i] = std::current_exception();
    }
  };
  tbb::parallel_for(
      tbb::blocked_range<std::size_t>(0, count, 1),
      [&](const tbb::blocked_range<std::size_t>& range) {
        for (std::size_t i = range.begin(); i < range.end(); ++i) runTask(i);
      },
      tbb::simple_partitioner());
  if (is_stopped) throw Stopped();
  return faults;
}

std::vector<char> areUsed(std::size_t images, const std::vector<ImagePair>& pairs) {
  std::vector<char> are_used(images, 0);
  for (const ImagePair& pair : pairs) are_used.at(pair.first) = are_used.at(pair.second) = 1;
  return are_used;
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
                                                            const StopToken& stop) const {
  Compared compared = compareEach(rgb_images, pairs, stop, {});
  for (const std::exception_ptr& fault : compared.faults) {
    if (fault) std::rethrow_exception(fault);
  }
  return std::move(compared.values);
}

Comparer::Seen Comparer::look(const std::vector<cv::Mat>& rgb_images, const std::vector<ImagePair>& pairs,
                              const StopToken& stop, const CompareVisits& visits) const {
  const std::size_t images = rgb_images.size();
  const std::vector<char> are_used = areUsed(images, pairs);
  Seen seen;
  seen.pictures.resize(images);
  for (std::size_t i = 0; i < images; ++i) {
    if (are_used[i]) seen.pictures[i] = makePicture(rgb_images[i]);
  }
  seen.features.assign(asked_.size(), std::vector<Features>(images));
  const std::vector<std::exception_ptr> faults =
      faultsOfTasks(asked_.size() * images, stop, [&](std::size_t task) {
        const std::size_t d = task / images;
        const std::size_t i = task % images;
        if (!are_used[i] || asked_[d].detectors == nullptr) return;
        seen.features[d][i] = asked_[d].detectors->detect(seen.pictures[i]);
        if (visits.found) visits.found({i, d, seen.features[d][i]});
      });
  seen.faults.assign(asked_.size(), std::vector<std::exception_ptr>(images));
  for (std::size_t task = 0; task < faults.size(); ++task)
    seen.faults[task / images][task % images] = faults[task];
  return seen;
}

// Of the first difference that has any, of the first image of the pair.
std::exception_ptr Comparer::Seen::faultOf(const ImagePair& pair) const {
  for (const auto& of_images : faults) {
    for (const std::size_t image : {pair.first, pair.second}) {
      if (of_images[image]) return of_images[image];
    }
  }
  return nullptr;
}

Compared Comparer::compareEach(const std::vector<cv::Mat>& rgb_images, const std::vector<ImagePair>& pairs,
                               const StopToken& stop, const CompareVisits& visits) const {
  const std::size_t differences = asked_.size();
  const Seen seen = look(rgb_images, pairs, stop, visits);
  Compared compared;
  compared.values.assign(pairs.size(), std::vector<DifferenceValue>(differences));
  for (const ImagePair& pair : pairs) compared.faults.push_back(seen.faultOf(pair));
  const auto faults = faultsOfTasks(differences * pairs.size(), stop, [&](std::size_t task) {
    const std::size_t d = task / pairs.size();
    const std::size_t p = task % pairs.size();
    if (compared.faults[p]) return;
    const View a{seen.pictures[pairs[p].first], seen.features[d][pairs[p].first]};
    const View b{seen.pictures[pairs[p].second], seen.features[d][pairs[p].second]};
    const BothWays nearest = nearestOf(*asked_[d].difference, a, b, stop);
    compared.values[p][d] = asked_[d].difference->between(a, b, {nearest, options_.ratio_test}, stop);
    if (visits.matched && asked_[d].detectors != nullptr)
      visits.matched({p, d, a.features, b.features, nearest});
  });
  for (std::size_t task = faults.size(); task-- > 0;) {
    if (faults[task]) compared.faults[task % pairs.size()] = faults[task];
  }
  compared.image_faults = seen.faults;
  return compared;
}

}  // namespace sunlit::evaluate
