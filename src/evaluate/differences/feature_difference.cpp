#include "sunlit/evaluate/differences/feature_difference.h"

#include <cstdint>
#include <limits>
#include <utility>

namespace sunlit::evaluate {
namespace {

// Equations (7) and (8).
double differenceOf(double features, double matched) {
  const double total = features - matched;
  return total > 0.0 ? (total - matched) / total : std::numeric_limits<double>::quiet_NaN();
}

FeatureCounts countsOf(const Features& a, const Features& b) {
  return {static_cast<std::size_t>(a.descriptors.rows), static_cast<std::size_t>(b.descriptors.rows)};
}

}  // namespace

DifferenceValue featureDifference(const Features& a, const Features& b, int norm, const RatioTest& test) {
  return featureDifference(twoNearestBothWays(a.descriptors, b.descriptors, norm), countsOf(a, b), test);
}

DifferenceValue featureDifference(const BothWays& nearest, const FeatureCounts& counts,
                                  const RatioTest& test) {
  DifferenceValue result;
  result.features_a = static_cast<std::uint32_t>(counts.a);
  result.features_b = static_cast<std::uint32_t>(counts.b);
  for (std::size_t i = 0; i < nearest.from_a.size(); ++i) {
    const Neighbours& there = nearest.from_a[i];
    if (there.second_distance == 0.0F) ++result.zero_second;
    if (!passes(there, test)) continue;
    ++result.matches;
    if (nearest.from_b.empty()) continue;
    const Neighbours& back = nearest.from_b[static_cast<std::size_t>(there.best)];
    if (back.best == static_cast<int>(i) && passes(back, test)) ++result.matches_one_to_one;
  }
  for (const Neighbours& neighbours : nearest.from_b) {
    if (passes(neighbours, test)) ++result.matches_back;
  }
  const double features = static_cast<double>(result.features_a) + result.features_b;
  result.value = differenceOf(features, result.matches);
  result.symmetric = (result.value + differenceOf(features, result.matches_back)) / 2.0;
  result.one_to_one = differenceOf(features, result.matches_one_to_one);
  return result;
}

namespace {

class FeatureDifference : public Difference {
 public:
  explicit FeatureDifference(std::unique_ptr<Detector> detector) : detector_(std::move(detector)) {}
  std::unique_ptr<Difference> clone() const override {
    return std::make_unique<FeatureDifference>(detector_->clone());
  }
  std::vector<Field> fields() override { return detector_->fields(); }
  const Detector* detector() const override { return detector_.get(); }
  DifferenceValue between(const View& a, const View& b, const Matching& matching,
                          const StopToken&) const override {
    return featureDifference(matching.nearest, countsOf(a.features, b.features), matching.test);
  }

 private:
  std::unique_ptr<Detector> detector_;
};

}  // namespace

std::unique_ptr<Difference> makeFeatureDifference(std::unique_ptr<Detector> detector) {
  return std::make_unique<FeatureDifference>(std::move(detector));
}

}  // namespace sunlit::evaluate
