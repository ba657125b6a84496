/// Odometry of recorded images, as a baseline: how far it drifts under each light.
#pragma once

#include "ros/evaluator/bag_localisation.h"

namespace sunlit::ros_interface {

/// Of each stream of options.odometry and each detector writes the estimate as a TUM file of camera_link
/// (odometry_NAME_DETECTOR.tum, beginning at the first true pose) beside the truth (truth_NAME.tum), and a
/// line of odometry.csv: stream,detector,n,lost,key_frames,length_m,rpe_10m_m,rpe_10m_deg,end_error_m, where
/// rpe are root mean squares over 10 m of the true path, without alignment; and prints them. Images without
/// camera, pose or depth are left out and named in localisation_problems.csv; those that a detector throws at
/// are named, and followed as if it found nothing there. The exit status of the program: 0, or 3 where images
/// were named. Throws std::runtime_error for a bag that cannot be read, and for a stream of which nothing is
/// left.
int odometryOfBags(const BagLocalisationOptions& options);

}  // namespace sunlit::ros_interface
