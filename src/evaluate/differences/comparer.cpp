#include "sunlit/evaluate/differences/comparer.h"

#include <tbb/parallel_for.h>

#include <algorithm>

#include "evaluate/features/detector_pool.h"
#include "sunlit/evaluate/differences/direct.h"

namespace sunlit::evaluate {
namespace {

double directValue(Difference difference, const DirectDifferences& values) {
  switch (difference) {
    case Difference::kBooleanRgb:
      return values.boolean_rgb;
    case Difference::kBooleanGrey:
      return values.boolean_grey;
    case Difference::kEuclideanRgb:
      return values.euclidean_rgb;
    default:
      return values.euclidean_grey;
  }
}

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

}  // namespace

Comparer::Comparer(const ComparerOptions& options)
    : options_(options), detectors_(std::make_unique<DetectorPool>(options.features)) {
  requireFields(options_);
}

Comparer::~Comparer() = default;

std::vector<std::vector<DifferenceValue>> Comparer::compare(const std::vector<cv::Mat>& rgb_images,
                                                            const std::vector<ImagePair>& pairs,
                                                            const std::atomic<bool>* is_broken_off) const {
  const auto isOver = [&] { return is_broken_off != nullptr && is_broken_off->load(); };
  const std::vector<Difference>& differences = options_.differences;
  std::vector<char> is_used(rgb_images.size(), 0);
  for (const ImagePair& pair : pairs) is_used.at(pair.first) = is_used.at(pair.second) = 1;

  std::vector<Picture> views(rgb_images.size());
  for (std::size_t i = 0; i < views.size(); ++i) {
    if (is_used[i]) views[i] = makePicture(rgb_images[i]);
  }

  std::vector<std::vector<Features>> features(differences.size(), std::vector<Features>(views.size()));
  forEachTask(differences.size() * views.size(), [&](std::size_t task) {
    if (isOver()) return;
    const std::size_t d = task / views.size();
    const std::size_t i = task % views.size();
    if (is_used[i] && usesFeatures(differences[d])) {
      features[d][i] = detectors_->detect(differences[d], views[i].grey);
    }
  });

  if (isOver()) return {};
  const bool is_any_direct = std::any_of(differences.begin(), differences.end(),
                                         [](Difference difference) { return !usesFeatures(difference); });
  std::vector<DirectDifferences> direct(pairs.size());
  if (is_any_direct) {
    forEachTask(pairs.size(), [&](std::size_t p) {
      direct[p] = directDifferences(views[pairs[p].first], views[pairs[p].second]);
    });
  }

  std::vector<std::vector<DifferenceValue>> values(pairs.size(),
                                                   std::vector<DifferenceValue>(differences.size()));
  forEachTask(differences.size() * pairs.size(), [&](std::size_t task) {
    if (isOver()) return;
    const std::size_t d = task / pairs.size();
    const std::size_t p = task % pairs.size();
    DifferenceValue& value = values[p][d];
    if (!usesFeatures(differences[d])) {
      value.value = value.symmetric = value.one_to_one = directValue(differences[d], direct[p]);
      return;
    }
    value = featureDifference(features[d][pairs[p].first], features[d][pairs[p].second],
                              normOf(differences[d], options_.features), options_.ratio_test);
  });
  return values;
}

}  // namespace sunlit::evaluate
