#include "sunlit/evaluate/differences/comparer.h"

#include <tbb/parallel_for.h>

#include "evaluate/features/detector_pool.h"

namespace sunlit::evaluate {
namespace {

// One task per element, taken in order: the dearest first, so that the last ones to finish are short.
template <typename Body>
void forEachTask(std::size_t count, const Body& body) {
  tbb::parallel_for(
      tbb::blocked_range<std::size_t>(0, count, 1),
      [&](const tbb::blocked_range<std::size_t>& range) {
        for (std::size_t i = range.begin(); i < range.end(); ++i) body(i);
      },
      tbb::simple_partitioner());
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

}  // namespace

std::vector<Field> decidingFieldsOf(ComparerOptions& options) {
  return rowsOf(options, options.differences);
}

std::vector<Field> fieldsOf(ComparerOptions& options) {
  return rowsOf(options, options.known.names());
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
    asked_.push_back(
        {&difference, detector == nullptr ? nullptr : std::make_unique<DetectorPool>(*detector)});
  }
}

Comparer::~Comparer() = default;

std::vector<std::vector<DifferenceValue>> Comparer::compare(const std::vector<cv::Mat>& rgb_images,
                                                            const std::vector<ImagePair>& pairs,
                                                            const std::atomic<bool>* is_broken_off) const {
  const auto isOver = [&] { return is_broken_off != nullptr && is_broken_off->load(); };
  std::vector<char> is_used(rgb_images.size(), 0);
  for (const ImagePair& pair : pairs) is_used.at(pair.first) = is_used.at(pair.second) = 1;

  std::vector<Picture> pictures(rgb_images.size());
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    if (is_used[i]) pictures[i] = makePicture(rgb_images[i]);
  }

  std::vector<std::vector<Features>> features(asked_.size(), std::vector<Features>(pictures.size()));
  forEachTask(asked_.size() * pictures.size(), [&](std::size_t task) {
    if (isOver()) return;
    const std::size_t d = task / pictures.size();
    const std::size_t i = task % pictures.size();
    if (is_used[i] && asked_[d].detectors != nullptr)
      features[d][i] = asked_[d].detectors->detect(pictures[i].grey);
  });

  if (isOver()) return {};
  std::vector<std::vector<DifferenceValue>> values(pairs.size(), std::vector<DifferenceValue>(asked_.size()));
  forEachTask(asked_.size() * pairs.size(), [&](std::size_t task) {
    if (isOver()) return;
    const std::size_t d = task / pairs.size();
    const std::size_t p = task % pairs.size();
    const auto view = [&](std::size_t i) { return View{pictures[i], features[d][i]}; };
    values[p][d] =
        asked_[d].difference->between(view(pairs[p].first), view(pairs[p].second), options_.ratio_test);
  });
  return values;
}

}  // namespace sunlit::evaluate
