#include "sunlit/evaluate/verify/verify.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>

#include "evaluate/features/detector_pool.h"
#include "evaluate/verify/near_points.h"
#include "sunlit/evaluate/differences/feature_difference.h"
#include "sunlit/evaluate/picture.h"

namespace sunlit::evaluate {
namespace {

constexpr double kUndefined = std::numeric_limits<double>::quiet_NaN();

double shareOf(std::size_t part, std::size_t whole, double of_nothing) {
  return whole == 0 ? of_nothing : static_cast<double>(part) / static_cast<double>(whole);
}

Eigen::Vector2d placeOf(const cv::KeyPoint& key_point) {
  return {key_point.pt.x, key_point.pt.y};
}

/// The points of one picture, and where they are in the other.
struct PointsOf {
  MaybePoints all;
  MaybePoints common;  ///< of all, those in the common part
  MaybePoints mapped;  ///< these in the other picture
  std::size_t common_count = 0;

  PointsOf(const Features& features, const PointMap& map) {
    for (const cv::KeyPoint& key_point : features.key_points) {
      const Eigen::Vector2d place = placeOf(key_point);
      all.emplace_back(place);
      mapped.push_back(map(place));
      common.push_back(mapped.back() ? all.back() : std::nullopt);
      if (mapped.back()) ++common_count;
    }
  }
};

struct Match {
  std::size_t a;
  std::size_t b;
};

/// Whose nearest is whose. A single descriptor is the nearest of all, though it has no second beside it.
std::vector<Match> mutualMatches(const BothWays& nearest, const FeatureCounts& counts) {
  const auto bestOf = [](const std::vector<Neighbours>& neighbours, std::size_t i) {
    return neighbours.empty() ? std::size_t{0} : static_cast<std::size_t>(neighbours[i].best);
  };
  std::vector<Match> matches;
  for (std::size_t i = 0; i < counts.a && counts.b > 0; ++i) {
    const std::size_t there = bestOf(nearest.from_a, i);
    if (bestOf(nearest.from_b, there) == i) matches.push_back({i, there});
  }
  return matches;
}

/// How far off matches are, in b.
class Errors {
 public:
  Errors(const PointsOf& a, const PointsOf& b) : a_(a), b_(b) {}
  /// False for what is not in the common part.
  bool isWithin(const Match& match, double distance_px) const {
    const auto& mapped = a_.mapped[match.a];
    return mapped && (*mapped - *b_.all[match.b]).squaredNorm() <= distance_px * distance_px;
  }

 private:
  const PointsOf& a_;
  const PointsOf& b_;
};

std::size_t countWithin(double distance_px, const std::vector<Match>& matches, const Errors& errors) {
  return static_cast<std::size_t>(std::count_if(matches.begin(), matches.end(), [&](const Match& match) {
    return errors.isWithin(match, distance_px);
  }));
}

double repeatabilityOf(const PointsOf& a, const PointsOf& b) {
  if (a.common_count + b.common_count == 0) return kUndefined;
  const std::size_t of_a = countPartners(a.mapped, b.common, kCorrectWithin_px);
  const std::size_t of_b = countPartners(b.mapped, a.common, kCorrectWithin_px);
  return (shareOf(of_a, a.common_count, 0.0) + shareOf(of_b, b.common_count, 0.0)) / 2.0;
}

/// A match by its ratio of best to second best.
struct RankedMatch {
  double ratio;
  bool is_correct;
};

double averagePrecision(std::vector<RankedMatch> matches, std::size_t correspondences) {
  if (correspondences == 0) return kUndefined;
  std::sort(matches.begin(), matches.end(),
            [](const RankedMatch& l, const RankedMatch& r) { return l.ratio < r.ratio; });
  double area = 0.0;  // times the correspondences
  double correct = 0.0;
  for (std::size_t i = 0; i < matches.size();) {
    const double ratio = matches[i].ratio;
    double newly_correct = 0.0;
    for (; i < matches.size() && matches[i].ratio == ratio; ++i) newly_correct += matches[i].is_correct;
    correct += newly_correct;
    area += newly_correct * correct / static_cast<double>(i);
  }
  return area / static_cast<double>(correspondences);
}

double ratioOf(const Neighbours& neighbours) {
  return neighbours.second_distance > 0.0F
             ? static_cast<double>(neighbours.best_distance) / neighbours.second_distance
             : 1.0;
}

bool isRight(const std::vector<Neighbours>& from_a, std::size_t i, const Errors& errors) {
  return errors.isWithin({i, static_cast<std::size_t>(from_a[i].best)}, kCorrectWithin_px);
}

std::vector<AcceptedMatch> acceptedOf(const std::vector<Neighbours>& from_a, const Errors& errors,
                                      const RatioTest& test) {
  std::vector<AcceptedMatch> accepted;
  for (std::size_t i = 0; i < from_a.size(); ++i) {
    if (!passes(from_a[i], test)) continue;
    accepted.push_back(
        {i, static_cast<std::size_t>(from_a[i].best), from_a[i].best_distance, isRight(from_a, i, errors)});
  }
  return accepted;
}

/// Everything that goes by the ratio of best to second best.
void verifyRatioMatches(const std::vector<Neighbours>& from_a, const Errors& errors, const RatioTest& test,
                        Verified& verified) {
  std::vector<RankedMatch> ranked;
  for (std::size_t i = 0; i < from_a.size(); ++i)
    ranked.push_back({ratioOf(from_a[i]), isRight(from_a, i, errors)});
  const std::vector<AcceptedMatch> accepted = acceptedOf(from_a, errors, test);
  const auto correct = static_cast<std::size_t>(std::count_if(
      accepted.begin(), accepted.end(), [](const AcceptedMatch& match) { return match.is_right; }));
  verified.precision = shareOf(correct, accepted.size(), kUndefined);
  verified.recall = shareOf(correct, verified.correspondences, kUndefined);
  verified.average_precision = averagePrecision(std::move(ranked), verified.correspondences);
}

void requireWhole(const Features& features) {
  if (features.key_points.size() == static_cast<std::size_t>(features.descriptors.rows)) return;
  throw std::invalid_argument(std::to_string(features.key_points.size()) + " key points have " +
                              std::to_string(features.descriptors.rows) +
                              " descriptors, but must have one each");
}

}  // namespace

Verified verify(const FeaturePair& features, const PointMaps& maps, const RatioTest& test) {
  requireWhole(features.a);
  requireWhole(features.b);
  const FeatureCounts counts{features.a.key_points.size(), features.b.key_points.size()};
  const PointsOf a(features.a, maps.b_from_a);
  const PointsOf b(features.b, maps.a_from_b);
  const Errors errors(a, b);
  Verified verified;
  verified.common_a = a.common_count;
  verified.common_b = b.common_count;
  verified.difference = featureDifference(features.nearest, counts, test);
  const NearPoints near(b.all, kCorrectWithin_px);
  for (const auto& place : a.mapped) {
    if (place && near.hasAny(*place)) ++verified.correspondences;
  }
  const std::vector<Match> mutual = mutualMatches(features.nearest, counts);
  verified.mutual_matches = mutual.size();
  verified.repeatability = repeatabilityOf(a, b);
  verified.matching_score = shareOf(countWithin(kCorrectWithin_px, mutual, errors),
                                    std::min(counts.a, counts.b), counts.a + counts.b > 0 ? 0.0 : kUndefined);
  for (std::size_t step = 0; step < kAccuracySteps; ++step) {
    const std::size_t correct = countWithin(static_cast<double>(step + 1), mutual, errors);
    verified.matching_accuracy[step] = shareOf(correct, mutual.size(), 0.0);
  }
  verifyRatioMatches(features.nearest.from_a, errors, test, verified);
  return verified;
}

std::vector<AcceptedMatch> acceptedMatches(const FeaturePair& features, const PointMaps& maps,
                                           const RatioTest& test) {
  requireWhole(features.a);
  requireWhole(features.b);
  const PointsOf a(features.a, maps.b_from_a);
  const PointsOf b(features.b, maps.a_from_b);
  return acceptedOf(features.nearest.from_a, Errors(a, b), test);
}

std::vector<std::string> paperDetectors() {
  std::vector<std::string> names = paperDifferences();
  const std::vector<std::string>& types = detectorTypes();
  names.erase(std::remove_if(
                  names.begin(), names.end(),
                  [&](const std::string& name) { return std::count(types.begin(), types.end(), name) == 0; }),
              names.end());
  return names;
}

std::vector<Field> fieldsOf(VerifyOptions& options) {
  std::vector<std::string>* const names = &options.detectors;
  const Choices choices{detectorNames(), [names] { return *names; },
                        [names](const std::vector<std::string>& some) { *names = some; }};
  return joined(
      {{{"detectors", choices, "", {}, "names apart by commas, also behind a preprocessing: sift+clahe"}},
       fieldsOf(options.ratio_test),
       options.known.fieldsOf(detectorTypes()),
       under("preprocessing", options.preprocessings.fields())});
}

std::unique_ptr<Detector> detectorOf(const VerifyOptions& options, const std::string& name) {
  const DetectorKind kind = DetectorKind::named(name);
  std::unique_ptr<Detector> detector = options.known.at(kind.type).detector()->clone();
  if (kind.preprocessing.empty()) return detector;
  return preprocessed(std::move(detector), kind.preprocessing,
                      options.preprocessings.at(kind.preprocessing).clone());
}

std::vector<Verified> verifyImages(const ImagesToVerify& images, const PointMaps& maps,
                                   const VerifyOptions& options) {
  requireFields(options);
  std::vector<std::unique_ptr<Detector>> detectors;
  for (const std::string& name : options.detectors) detectors.push_back(detectorOf(options, name));
  const Picture pictures[] = {makePicture(images.rgb_a), makePicture(images.rgb_b)};
  std::vector<std::unique_ptr<DetectorPool>> pools;
  for (const auto& detector : detectors)
    pools.push_back(std::make_unique<DetectorPool>(*detector, options.cache));
  std::vector<std::array<Features, 2>> features(detectors.size());
  tbb::parallel_for(std::size_t{0}, 2 * detectors.size(), [&](std::size_t task) {
    features[task / 2][task % 2] = pools[task / 2]->detect(pictures[task % 2]);
  });
  std::vector<Verified> verified(detectors.size());
  tbb::parallel_for(std::size_t{0}, detectors.size(), [&](std::size_t d) {
    const Features& a = features[d][0];
    const Features& b = features[d][1];
    const BothWays nearest = twoNearestBothWays(a.descriptors, b.descriptors, detectors[d]->norm());
    verified[d] = verify({a, b, nearest}, maps, options.ratio_test);
  });
  return verified;
}

}  // namespace sunlit::evaluate
