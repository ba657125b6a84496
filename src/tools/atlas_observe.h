/// Pictures of the path under all lights, and what is found in them.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <vector>

#include "sunlit/evaluate/atlas/atlas.h"
#include "sunlit/studio/studio.h"
#include "tools/atlas_folder.h"
#include "tools/atlas_options.h"
#include "tools/blind_poses.h"

namespace sunlit::tools {

/// The world with its lights. Making it takes longer than looking whether anything is missing.
class AtlasCamera {
 public:
  explicit AtlasCamera(const AtlasRunOptions& options);

  /// Draws each place of the pose once, that of the maps and then that of the queries where they have a drive
  /// of their own, and lights it by each of `conditions`, indices of AtlasRunOptions::conditions.
  std::vector<evaluate::AtlasView> look(const AtlasPose& pose, const std::vector<std::size_t>& conditions);
  /// condition,date,time,sun_azimuth_deg,sun_elevation_deg,illuminance_lx: of the sun as it is seen, and of
  /// level ground under the whole sky. In one step; a file that is there stays.
  void writeLights(const std::string& file) const;

  std::string fingerprint() const { return light::fingerprint(studio_.world()); }
  /// Of all that were looked from.
  const BlindPoses& blindPoses() const { return blind_poses_; }

 private:
  /// `place` is without a series: that is the light's.
  evaluate::AtlasView viewFrom(const Eigen::Isometry3d& map_from_camera, const image::PictureName& place,
                               const std::vector<std::size_t>& conditions);

  const AtlasRunOptions& options_;
  studio::Studio studio_;
  std::vector<light::Illumination> lights_;  ///< of each condition, as the lines
  std::vector<std::string> lines_;
  BlindPoses blind_poses_;
};

/// Called behind each pose.
using PoseDone = std::function<void()>;

/// Poses of `unit` that its growing file lacks in any light.
std::size_t posesMissing(const AtlasRunOptions& options, const ObserveUnit& unit);

/// Goes on where an earlier run broke off, and gives the file its name when it is whole. What is added does
/// not depend on where that was. Throws std::runtime_error where another process is at it.
void observeUnit(const AtlasRunOptions& options, const ObserveUnit& unit, AtlasCamera* camera,
                 const PoseDone& pose_done);

}  // namespace sunlit::tools
