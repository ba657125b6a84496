/// What a run leaves behind for the report: map and time sheet.
#pragma once

#include <string>

#include "ros/render/path_source.h"
#include "ros/render/studio.h"

namespace sunlit::ros_interface {

/// Files in one folder. Everything here throws std::runtime_error naming the file that cannot be written.
class RunFiles {
 public:
  /// Makes the folder where it is missing, and makes sure that it can be written to.
  explicit RunFiles(const std::string& folder);

  /// map.png, north up, and map.yaml, which says what ground it shows: x_min, x_max, y_min, y_max in m.
  void writeMap(const image::Rgb8Image& map, const MapExtent& extent) const;
  /// timing.csv: stage,what,count,seconds.
  void writeTiming(const Stopwatch& stopwatch) const;

 private:
  std::string folder_;
};

/// The ground around a path, with a margin.
MapExtent extentOf(const PathSource& path);

}  // namespace sunlit::ros_interface
