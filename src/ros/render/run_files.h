/// What a run leaves behind: what it was made from, and map and time sheet for the report.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "ros/render/path_source.h"
#include "sunlit/studio/studio.h"

namespace sunlit::ros_interface {

/// What all pictures of a run are made from, as texts that differ wherever the contents do.
struct RunInputs {
  std::string world, path;
  std::string camera;  ///< as cameraPrint() has it
  std::string robot;   ///< as RobotPlaces::print() has it; empty: there is none
};
/// Of a camera with its lens, or of a pair: a calibration may change while its file's name stays.
std::string cameraPrint(const render::RenderOptions& left, const std::optional<image::RightCamera>& right);

/// Files in one folder. Everything here throws std::runtime_error naming the file that cannot be written.
class RunFiles {
 public:
  /// Makes the folder where it is missing, and makes sure that it can be written to, but changes nothing in
  /// it: it may hold a run that this one will not be allowed to go on with. `goes_on`: with a run that was
  /// broken off, whose times count too; so does a run into a folder that holds values of the evaluator.
  RunFiles(const std::string& folder, bool goes_on);

  bool goesOn() const { return goes_on_; }
  /// inputs.yaml. A run that goes on with another must have its inputs and studio::pictureMaker(): else
  /// throws std::runtime_error saying what differs. The file is new afterwards in either case, which tells
  /// whoever waits for it that they were compared.
  void keepInputs(const RunInputs& inputs) const;
  /// rasterizer.yaml: what draws, see render::Renderer::rasterizer().
  void keepRasterizer(const std::string& rasterizer) const;
  /// ground.yaml: `ground_albedo`, of the land around the world.
  void keepGround(double albedo) const;
  /// map.png, north up, and map.yaml, which says what ground it shows: x_min, x_max, y_min, y_max in m.
  void writeMap(const image::Rgb8Image& map, const studio::MapExtent& extent) const;
  /// Whether the run that this one goes on with has left both.
  bool hasMap() const;
  /// timing.csv: stage,what,count,seconds; with the times of the run that this one goes on with.
  void writeTiming(const studio::Stopwatch& stopwatch) const;

 private:
  std::string folder_;
  bool goes_on_;
  std::vector<studio::Stopwatch::Entry> earlier_;
};

/// The ground around a path, with a margin.
studio::MapExtent extentOf(const PathSource& path);

}  // namespace sunlit::ros_interface
