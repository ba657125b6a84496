/// Where bags keep what localisation needs, and how near in time it must lie.
#pragma once

#include <string>
#include <vector>

#include "sunlit/quantity/field.h"

namespace sunlit::ros_interface {

/// Which body the poses of a bag are of.
enum class PosesOf {
  kLink,    ///< x forward, y left, z up, as robots have it
  kOptical  ///< z forward, x right, y down, as TUM's data sets and COLMAP have it
};

/// What people may ask for, kept at `place`.
Field bodyRow(const std::string& key, PosesOf* place);

struct ViewTopics {
  std::string name_space = "/";  ///< <name_space>/<stream>/camera/image_raw, <name_space>/camera/pose, …
  /// Topics of bags that call them otherwise; empty: as sunlit does. A bag that holds `images` has that
  /// stream alone, without a name.
  std::string images, camera_info, depth, poses;
  PosesOf poses_of = PosesOf::kLink;
  /// What lies so near to an image's stamp belongs to it: depth and camera_info the nearest; a pose
  /// interpolated between one at most so long before and one at most so long behind. 0: of its stamp only.
  double stamp_tolerance_s = 0.0;
};

/// Rows "images", "camera_info", "depth", "poses", "poses_of", "stamp_tolerance".
std::vector<Field> fieldsOf(ViewTopics& topics);

}  // namespace sunlit::ros_interface
