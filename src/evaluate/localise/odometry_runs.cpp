#include "sunlit/evaluate/localise/odometry_runs.h"

#include <tbb/parallel_for.h>

#include "evaluate/features/detector_pool.h"
#include "evaluate/files/files.h"
#include "evaluate/localise/each_detector.h"
#include "sunlit/image/files.h"

namespace sunlit::evaluate {

struct OdometryRuns::PerDetector {
  PerDetector(const Detector& detector, const LocalisationOptions& options)
      : pool(detector, options.cache), odometry(detector.space(), options.localiser) {}
  DetectorPool pool;
  Odometry odometry;
};

OdometryRuns::OdometryRuns(const LocalisationOptions& options) : options_(options) {
  requireFields(options_);
  for (const std::string& name : options_.detectors) {
    detectors_.push_back(std::make_unique<PerDetector>(detectorOf(options_, name), options_));
  }
}

OdometryRuns::~OdometryRuns() = default;

FollowedViews OdometryRuns::follow(const std::vector<PosedView>& views) {
  std::vector<std::vector<Features>> features(detectors_.size(), std::vector<Features>(views.size()));
  FollowedViews followed;
  followed.faults = forEachDetector(views, options_.detectors, [&](std::size_t v, std::size_t d) {
    features[d][v] = detectors_[d]->pool.detect(views[v].picture);
  });
  followed.poses.resize(detectors_.size());
  tbb::parallel_for(std::size_t{0}, detectors_.size(), [&](std::size_t d) {
    for (std::size_t i = 0; i < views.size(); ++i)
      followed.poses[d].push_back(detectors_[d]->odometry.follow(views[i], features[d][i]));
  });
  return followed;
}

const Odometry& OdometryRuns::at(std::size_t detector) const {
  return detectors_.at(detector)->odometry;
}

void writeOdometry(const std::string& path, const std::vector<OdometryRow>& rows) {
  std::string text = "stream,detector,n,lost,key_frames,length_m,rpe_10m_m,rpe_10m_deg,end_error_m\n";
  for (const OdometryRow& row : rows) {
    text += csvField(row.stream) + "," + row.detector + "," + std::to_string(row.n) + "," +
            std::to_string(row.lost) + "," + std::to_string(row.key_frames);
    for (const double number : {row.length_m, row.rpe_10m_m, row.rpe_10m_deg, row.end_error_m})
      text += "," + formatNumber(number);
    text += "\n";
  }
  image::writeFileAtomically(path, text);
}

}  // namespace sunlit::evaluate
