/// Whether the images of a stamp were taken from one place.
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <map>
#include <optional>
#include <string>

#include "evaluate/run/recent.h"

namespace sunlit::evaluate {

/// Two poses of one stamp are of one place where they differ by no more than either. Pictures of one pose are
/// compared point by point: what is 5 m away moves by about a pixel of our usual camera (640 px, 60°) for
/// either of these, a third of the 3 px within which a match counts as right. Poses that are sent twice
/// differ by rounding alone, those of two drives along one road by far more.
constexpr double kSamePlace_m = 0.01;
constexpr double kSamePlace_deg = 0.1;

/// The poses that came of each stamp. Two recordings of which stamps coincide have one each, and their images
/// are of different places: nobody can tell which is whose.
class OnePlace {
 public:
  /// True where this pose is the first that is of another place than the stamp's first pose. Where no image
  /// has come, that is remembered as Recent does.
  bool isBroken(std::int64_t stamp_ns, const Eigen::Isometry3d& map_from_optical);
  /// An image of this stamp came.
  void noteImage(std::int64_t stamp_ns);
  /// How far apart the poses of the stamp are, in words; empty where they are of one place.
  std::string fault(std::int64_t stamp_ns) const;

 private:
  std::map<std::int64_t, std::optional<Eigen::Isometry3d>> first_;  // of images; empty: none has come
  Recent<Eigen::Isometry3d> waiting_;                               // for an image
  std::map<std::int64_t, std::string> faults_;
};

}  // namespace sunlit::evaluate
