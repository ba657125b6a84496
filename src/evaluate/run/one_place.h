/// Whether the images of a stamp were taken from one place, and each of them under one sky.
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>

#include "evaluate/run/recent.h"
#include "sunlit/evaluate/run/records.h"

namespace sunlit::evaluate {

/// The poses that came of each stamp. Two recordings of which stamps coincide have one each, and their images
/// are of different places: nobody can tell which is whose.
class OnePlace {
 public:
  /// True where this pose is the first that is of another place than the stamp's first pose. Where no image
  /// has come, that is remembered as Recent does.
  bool isBroken(std::int64_t stamp_ns, const Eigen::Isometry3d& map_from_optical);
  /// True where this capture is the first of its stamp that tells of another sky than its stream's first
  /// there: another civil time, or another illuminance by more than a thousandth.
  bool isBroken(const std::string& stream, const CaptureRecord& capture);
  /// An image of this stamp came.
  void noteImage(std::int64_t stamp_ns);
  /// How far apart the poses or skies of the stamp are, in words; empty where they are of one place.
  std::string fault(std::int64_t stamp_ns) const;

 private:
  struct Sky {
    std::string utc;
    double illuminance_lx;
  };
  std::map<std::int64_t, std::optional<Eigen::Isometry3d>> first_;  // of images; empty: none has come
  Recent<Eigen::Isometry3d> waiting_;                               // for an image
  std::map<std::pair<std::string, std::int64_t>, Sky> skies_;       // by stream and stamp
  std::map<std::int64_t, std::string> faults_;
};

}  // namespace sunlit::evaluate
