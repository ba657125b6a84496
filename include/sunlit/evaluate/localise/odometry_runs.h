/// Odometry by several detectors at once, and the file that tells of it.
#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "sunlit/evaluate/localise/localisation.h"
#include "sunlit/evaluate/localise/odometry.h"

namespace sunlit::evaluate {

/// Of each view: [detector][view]. One that a detector throws on is followed as one without features.
struct FollowedViews {
  std::vector<std::vector<Eigen::Isometry3d>> poses;
  DetectorFaults faults;
};

class OdometryRuns {
 public:
  /// Throws std::invalid_argument as Localisation does.
  explicit OdometryRuns(const LocalisationOptions& options);
  ~OdometryRuns();

  /// The next views, see Odometry::follow(). Runs in parallel, to the same bits.
  FollowedViews follow(const std::vector<PosedView>& views);
  const Odometry& at(std::size_t detector) const;

 private:
  struct PerDetector;
  LocalisationOptions options_;
  std::vector<std::unique_ptr<PerDetector>> detectors_;
};

/// One stream by one detector.
struct OdometryRow {
  static constexpr double kUndefined = std::numeric_limits<double>::quiet_NaN();
  std::string stream;  ///< of any characters
  std::string detector;
  std::size_t n = 0;
  std::size_t lost = 0;
  std::size_t key_frames = 0;
  double length_m = 0.0;          ///< of the true path
  double rpe_10m_m = kUndefined;  ///< root mean square of relative errors over 10 m; NaN below 20 m
  double rpe_10m_deg = kUndefined;
  double end_error_m = 0.0;
};

/// odometry.csv: stream,detector,n,lost,key_frames,length_m,rpe_10m_m,rpe_10m_deg,end_error_m; "nan" where
/// undefined. In one step.
void writeOdometry(const std::string& path, const std::vector<OdometryRow>& rows);

}  // namespace sunlit::evaluate
