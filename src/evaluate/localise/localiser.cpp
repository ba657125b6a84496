#include "sunlit/evaluate/localise/localiser.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <opencv2/core.hpp>
#include <stdexcept>
#include <utility>

#include "evaluate/localise/place_index.h"
#include "sunlit/quantity/angle.h"

namespace sunlit::evaluate {
namespace {

/// A query's feature and what it is taken for.
struct Match {
  float distance = std::numeric_limits<float>::infinity();
  std::size_t frame = 0;
  std::size_t point = 0;  ///< of the frame
};

bool looksTheSameWay(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b) {
  return a.linear().col(2).dot(b.linear().col(2)) > std::cos(kSameWay_deg * kRadPerDeg);
}

double distanceBetween(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b) {
  return (a.translation() - b.translation()).norm();
}

/// Descriptors of two pictures may have been compacted in one only.
BothWays nearestOf(const cv::Mat& a, const cv::Mat& b, int norm) {
  if (a.empty() || b.empty() || a.type() == b.type()) return twoNearestBothWays(a, b, norm);
  cv::Mat floats_a, floats_b;
  a.convertTo(floats_a, CV_32F);
  b.convertTo(floats_b, CV_32F);
  return twoNearestBothWays(floats_a, floats_b, norm);
}

/// Of each feature of the query its match in one key frame; at infinity where it has none.
std::vector<Match> matchesWith(const KeyFrame& frame, const cv::Mat& query, int norm, const RatioTest& test) {
  const BothWays nearest = nearestOf(query, frame.descriptors, norm);
  std::vector<Match> matches(static_cast<std::size_t>(query.rows));
  if (nearest.from_b.empty()) return matches;
  for (std::size_t i = 0; i < nearest.from_a.size(); ++i) {
    const Neighbours& neighbours = nearest.from_a[i];
    const auto point = static_cast<std::size_t>(neighbours.best);
    if (!passes(neighbours, test) || nearest.from_b[point].best != static_cast<int>(i)) continue;
    matches[i].distance = neighbours.best_distance;
    matches[i].point = point;
  }
  return matches;
}

/// Descriptors of the kScouts features of the largest response, of equal ones those found first.
cv::Mat strongest(const std::vector<cv::KeyPoint>& key_points, const cv::Mat& descriptors) {
  std::vector<std::size_t> order(key_points.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t l, std::size_t r) {
    return key_points[l].response > key_points[r].response;
  });
  cv::Mat chosen;
  for (std::size_t i = 0; i < std::min(order.size(), kScouts); ++i)
    chosen.push_back(descriptors.row(static_cast<int>(order[i])));
  return chosen;
}

double angleBetweenDirections(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

}  // namespace

/// One to one: sighting i is of match i.
struct Localiser::Matches {
  std::vector<std::size_t> frames;
  std::vector<std::size_t> points;
  std::vector<std::size_t> features;
};

std::vector<Field> fieldsOf(LocaliserOptions& options) {
  return joined(
      {{{"retrieval",
         choiceOf(&options.retrieval, {"truth", "vlad", "all"}),
         "",
         {},
         "key frames that a query is matched with: the nearest by its true place that look the same way "
         "(within 90 deg); the nearest by VLAD of the detector's features; of all, those in which most of "
         "its 150 strongest features match"},
        {"retrieved", &options.retrieved, "", {1, 1e6}, "key frames at most"}},
       fieldsOf(options.ratio_test),
       fieldsOf(options.pose)});
}

std::string wordOf(LocalisationStatus status) {
  switch (status) {
    case LocalisationStatus::kLocalised:
      return "localised";
    case LocalisationStatus::kNoFeatures:
      return "no_features";
    case LocalisationStatus::kNotRetrieved:
      return "not_retrieved";
    case LocalisationStatus::kTooFewMatches:
      return "too_few_matches";
    case LocalisationStatus::kNoPose:
      break;
  }
  return "no_pose";
}

Localiser::Localiser(const DescriptorSpace& space, const LocaliserOptions& options)
    : space_(space), options_(options) {
  requireFields(options);
}

Localiser::~Localiser() = default;

void Localiser::add(KeyFrame frame) {
  frames_.push_back(std::move(frame));
}

void Localiser::finish() {
  if (options_.retrieval == Retrieval::kVlad) index_ = std::make_unique<PlaceIndex>(space_, frames_);
}

std::vector<std::size_t> Localiser::retrieve(const LocalisationQuery& query,
                                             const cv::Mat& descriptors) const {
  if (options_.retrieval == Retrieval::kTruth) return nearestByTruth(query.map_from_optical);
  if (options_.retrieval == Retrieval::kAll) return mostMatched(query, descriptors);
  if (!index_) throw std::logic_error("Localiser::finish() was not called");
  return index_->nearest(descriptors, static_cast<std::size_t>(options_.retrieved));
}

std::vector<std::size_t> Localiser::nearestByTruth(const Eigen::Isometry3d& map_from_optical) const {
  std::vector<std::size_t> found;
  for (std::size_t i = 0; i < frames_.size(); ++i) {
    if (looksTheSameWay(map_from_optical, frames_[i].map_from_optical)) found.push_back(i);
  }
  const auto distance = [&](std::size_t i) {
    return distanceBetween(map_from_optical, frames_[i].map_from_optical);
  };
  std::stable_sort(found.begin(), found.end(),
                   [&](std::size_t l, std::size_t r) { return distance(l) < distance(r); });
  found.resize(std::min(found.size(), static_cast<std::size_t>(options_.retrieved)));
  return found;
}

std::vector<std::size_t> Localiser::mostMatched(const LocalisationQuery& query,
                                                const cv::Mat& descriptors) const {
  std::vector<std::size_t> found(frames_.size());
  std::iota(found.begin(), found.end(), std::size_t{0});
  const auto wanted = static_cast<std::size_t>(options_.retrieved);
  if (found.size() <= wanted) return found;
  const cv::Mat scouts = strongest(query.features.key_points, descriptors);
  std::vector<std::size_t> votes(frames_.size());
  tbb::parallel_for(std::size_t{0}, frames_.size(), [&](std::size_t i) {
    const std::vector<Match> matches = matchesWith(frames_[i], scouts, space_.norm, options_.ratio_test);
    votes[i] = static_cast<std::size_t>(std::count_if(
        matches.begin(), matches.end(), [](const Match& match) { return !std::isinf(match.distance); }));
  });
  std::stable_sort(found.begin(), found.end(),
                   [&](std::size_t l, std::size_t r) { return votes[l] > votes[r]; });
  found.resize(wanted);
  return found;
}

Localiser::Matches Localiser::match(const cv::Mat& descriptors,
                                    const std::vector<std::size_t>& retrieved) const {
  std::vector<std::vector<Match>> by_frame(retrieved.size());
  tbb::parallel_for(std::size_t{0}, retrieved.size(), [&](std::size_t f) {
    by_frame[f] = matchesWith(frames_[retrieved[f]], descriptors, space_.norm, options_.ratio_test);
  });
  Matches matches;
  for (std::size_t i = 0; i < static_cast<std::size_t>(descriptors.rows); ++i) {
    Match best;
    for (std::size_t f = 0; f < by_frame.size(); ++f) {
      if (!(by_frame[f][i].distance < best.distance)) continue;
      best = by_frame[f][i];
      best.frame = retrieved[f];
    }
    if (std::isinf(best.distance)) continue;
    matches.features.push_back(i);
    matches.frames.push_back(best.frame);
    matches.points.push_back(best.point);
  }
  return matches;
}

LocalisedQuery Localiser::localise(const LocalisationQuery& query) const {
  LocalisedQuery result;
  judge(query, result);
  result.status = LocalisationStatus::kNoFeatures;
  if (query.features.key_points.empty()) return result;
  const cv::Mat descriptors = compactDescriptors(query.features.descriptors);
  const std::vector<std::size_t> retrieved = retrieve(query, descriptors);
  result.retrieved = retrieved.size();
  result.status = LocalisationStatus::kNotRetrieved;
  if (retrieved.empty()) return result;
  const Matches matches = match(descriptors, retrieved);
  result.matches = matches.features.size();
  result.status = LocalisationStatus::kTooFewMatches;
  if (result.matches < static_cast<std::size_t>(options_.pose.min_inliers)) return result;
  std::vector<Sighting> sightings;
  for (std::size_t m = 0; m < result.matches; ++m) {
    const cv::Point2f& pixel = query.features.key_points[matches.features[m]].pt;
    sightings.push_back({frames_[matches.frames[m]].points[matches.points[m]], {pixel.x, pixel.y}});
  }
  result.status = LocalisationStatus::kNoPose;
  const auto estimate = estimatePose(sightings, query.camera, options_.pose);
  if (!estimate) return result;
  result.status = LocalisationStatus::kLocalised;
  result.estimate = *estimate;
  std::vector<std::size_t> votes(frames_.size(), 0);
  for (const std::size_t m : estimate->inliers) ++votes[matches.frames[m]];
  result.key_frame = static_cast<std::size_t>(std::max_element(votes.begin(), votes.end()) - votes.begin());
  judge(query, result);
  return result;
}

void Localiser::judge(const LocalisationQuery& query, LocalisedQuery& result) const {
  const Eigen::Isometry3d& truth = query.map_from_optical;
  const KeyFrame* reference = nullptr;
  double nearest = std::numeric_limits<double>::infinity();
  for (const KeyFrame& frame : frames_) {
    const double distance = distanceBetween(truth, frame.map_from_optical);
    if (distance < kLeastBaseline_m * (1.0 - kLengthRounding)) continue;
    if (distance >= nearest * (1.0 - kLengthRounding)) continue;
    reference = &frame;
    nearest = distance;
  }
  result.has_baseline = reference != nullptr;
  if (result.status != LocalisationStatus::kLocalised) return;
  const Eigen::Isometry3d& estimate = result.estimate.map_from_optical;
  result.error_m = distanceBetween(truth, estimate);
  result.error_deg = angleBetween(truth, estimate) / kRadPerDeg;
  if (reference == nullptr) return;
  const Eigen::Vector3d from = reference->map_from_optical.translation();
  const double direction =
      angleBetweenDirections(truth.translation() - from, estimate.translation() - from) / kRadPerDeg;
  result.relative_deg = std::max(result.error_deg, direction);
}

}  // namespace sunlit::evaluate
