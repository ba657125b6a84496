#include "sunlit/evaluate/atlas/atlas.h"

#include <tbb/parallel_for.h>

#include <map>
#include <opencv2/core.hpp>
#include <stdexcept>

#include "evaluate/features/detector_pool.h"

namespace sunlit::evaluate {
namespace {

constexpr std::int64_t kSecond_ns = 1000000000;

cv::Mat matOfDepth(image::DepthImage& depth) {
  return cv::Mat(depth.height, depth.width, CV_32FC1, depth.data.data());
}

/// As few bytes as both can be told by, since that is faster and gives the same distances.
struct DescriptorPair {
  cv::Mat a;
  cv::Mat b;
};
DescriptorPair compactBoth(const Features& a, const Features& b) {
  DescriptorPair compact{compactDescriptors(a.descriptors), compactDescriptors(b.descriptors)};
  if (compact.a.type() == compact.b.type()) return compact;
  return {a.descriptors, b.descriptors};
}

}  // namespace

std::string queryDriveOf(const std::string& condition) {
  return condition + "/query";
}

struct AtlasObserver::Method {
  Method(const std::string& called, const AtlasOptions& options)
      : name(called), detector(detectorOf(options.verify, called)), pool(*detector, options.verify.cache) {}
  std::string name;
  std::unique_ptr<Detector> detector;
  mutable DetectorPool pool;
};

AtlasObserver::AtlasObserver(const AtlasOptions& options) {
  requireFields(options.verify);
  for (const std::string& name : options.verify.detectors)
    methods_.push_back(std::make_unique<Method>(name, options));
}

AtlasObserver::~AtlasObserver() = default;

void AtlasObserver::observe(AtlasView view, ObservationFile* file) const {
  std::vector<PosedView> seen;
  for (AtlasView::Lit& lit : view.lit)
    seen.push_back(
        {makePicture(matOf(lit.picture)), view.camera, view.map_from_optical, matOfDepth(view.depth)});
  for (const PosedView& one : seen) requireWhole(one);
  const std::size_t methods = methods_.size();
  std::vector<Observation> found(seen.size() * methods);
  std::vector<char> is_known(found.size());
  for (std::size_t task = 0; task < found.size(); ++task) {
    is_known[task] =
        file->holds(view.lit[task / methods].condition, methods_[task % methods]->name, view.pose) ? 1 : 0;
  }
  tbb::parallel_for(std::size_t{0}, found.size(), [&](std::size_t task) {
    if (is_known[task]) return;
    const PosedView& one = seen[task / methods];
    Observation& observation = found[task];
    observation.camera = view.camera;
    observation.map_from_optical = view.map_from_optical;
    observation.features = methods_[task % methods]->pool.detect(one.picture);
    observation.points = pointsOf(one, observation.features);
    observation.ev100 = view.lit[task / methods].ev100;
  });
  for (std::size_t task = 0; task < found.size(); ++task) {
    if (is_known[task]) continue;
    file->add({view.lit[task / methods].condition, methods_[task % methods]->name, view.pose,
               view.pose * kSecond_ns},
              found[task]);
  }
}

std::set<std::pair<std::string, std::int64_t>> observedWhole(const ObservationFile& file,
                                                             std::size_t methods) {
  std::map<std::pair<std::string, std::int64_t>, std::set<std::string>> known;
  for (const ObservationKey& key : file.keys()) known[{key.stream, key.pose}].insert(key.detector);
  std::set<std::pair<std::string, std::int64_t>> whole;
  for (const auto& [picture, by] : known) {
    if (by.size() == methods) whole.insert(picture);
  }
  return whole;
}

AtlasMap::AtlasMap(const DriveIndex& observed, const AtlasOptions& options,
                   const AtlasCellKey& of_map_and_method)
    : observed_(observed),
      options_(options),
      key_(of_map_and_method),
      space_(detectorOf(options.verify, key_.method)->space()),
      drive_(observed.at(key_.map, key_.method)),
      map_(mapOf(observed, {key_.map}, {key_.method, space_, options.map_every_m, options.localiser})
               .localiser) {
  if (map_->frames().empty())
    throw std::runtime_error(key_.map + " by " + key_.method + " has no observations to make a map of");
}

double AtlasMap::bytesOfKeyFrame() const {
  double bytes = 0.0;
  for (const KeyFrame& frame : map_->frames()) bytes += static_cast<double>(bytesOf(frame));
  return bytes / static_cast<double>(map_->frames().size());
}

const ObservedDrive& AtlasMap::driveOf(const std::string& condition) const {
  const ObservedDrive& drive = observed_.at(condition, key_.method);
  if (drive.size() == drive_.size()) return drive;
  throw std::runtime_error(condition + " by " + key_.method + " has " + std::to_string(drive.size()) +
                           " poses, but " + key_.map + " " + std::to_string(drive_.size()));
}

void AtlasMap::compare(std::int64_t pose, const Observation& lit_as_query, AtlasRow* row) const {
  const Observation lit_as_map = drive_.at(pose).read();
  const DescriptorPair descriptors = compactBoth(lit_as_map.features, lit_as_query.features);
  const BothWays nearest = twoNearestBothWays(descriptors.a, descriptors.b, space_.norm);
  const Verified verified = verify({lit_as_map.features, lit_as_query.features, nearest},
                                   identityMaps({lit_as_query.camera.width, lit_as_query.camera.height}),
                                   options_.verify.ratio_test);
  row->difference = verified.difference.value;
  row->matching_score = verified.matching_score;
  row->precision = verified.precision;
}

AtlasRow AtlasMap::rowOf(std::int64_t pose, const std::string& query) const {
  const auto seenIn = [&](const std::string& condition) {
    const ObservedDrive& drive = driveOf(condition);
    const auto seen = drive.find(pose);
    if (seen == drive.end())
      throw std::runtime_error(condition + " by " + key_.method + " lacks pose " + std::to_string(pose));
    return seen->second.read();
  };
  const Observation beside = seenIn(query);
  const Observation driven = options_.has_query_drive ? seenIn(queryDriveOf(query)) : beside;
  const LocalisedQuery result = map_->localise({driven.features, driven.camera, driven.map_from_optical});
  AtlasRow row;
  row.pose = pose;
  row.status = result.status;
  row.error_m = result.error_m;
  row.error_deg = result.error_deg;
  row.inliers = result.estimate.inliers.size();
  row.ev100 = driven.ev100;
  compare(pose, beside, &row);
  return row;
}

std::vector<AtlasRow> AtlasMap::find(const std::string& query) const {
  std::vector<std::int64_t> poses;
  for (const auto& [pose, seen] : drive_) poses.push_back(pose);
  std::vector<AtlasRow> rows(poses.size());
  tbb::parallel_for(std::size_t{0}, poses.size(), [&](std::size_t i) { rows[i] = rowOf(poses[i], query); });
  return rows;
}

}  // namespace sunlit::evaluate
