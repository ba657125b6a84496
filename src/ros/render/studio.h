/// Scene, atmosphere and camera: everything that makes a picture, without anything that sends it.
#pragma once

#include <Eigen/Geometry>
#include <memory>
#include <string>

#include "ros/render/options.h"
#include "ros/render/stopwatch.h"
#include "sunlit/image/exposure.h"
#include "sunlit/render/renderer.h"
#include "sunlit/scene/scene.h"
#include "sunlit/sky/atmosphere.h"

namespace sunlit::ros_interface {

/// A developed image and the exposure value that it was developed with.
struct Developed {
  image::Rgb8Image picture;
  double ev100 = 0.0;
};

/// Ground that a map shows, m in `map`.
struct MapExtent {
  double x_min = 0.0;
  double x_max = 0.0;
  double y_min = 0.0;
  double y_max = 0.0;
};

/// Construct, use and destroy on one thread: it holds the OpenGL context. Times its stages.
class Studio {
 public:
  /// Loads the world; its warnings go to the log. Throws what scene::load() throws.
  explicit Studio(const RenderNodeOptions& options);

  /// A picture from above, north up, close to orthographic, under a high sun. Replaces what look() looked at.
  image::Rgb8Image mapFromAbove(const MapExtent& extent);

  void look(const Eigen::Isometry3d& map_from_camera);
  /// Draws what look() will look at later. Another thread may photograph() meanwhile.
  void lookAhead(const Eigen::Isometry3d& map_from_camera);
  /// What look() looks at under `daylight`; `what` names it on the time sheet.
  Developed photograph(const sky::Daylight& daylight, const std::string& what);
  image::DepthImage depth();

  const sky::Atmosphere& atmosphere() const { return atmosphere_; }
  const image::PinholeCamera& camera() const { return options_.camera; }
  Stopwatch& stopwatch() { return stopwatch_; }

 private:
  Stopwatch stopwatch_;
  render::RenderOptions options_;
  image::ExposureOptions exposure_;
  light::World world_;
  sky::Atmosphere atmosphere_;
  std::unique_ptr<render::Renderer> renderer_;
};

}  // namespace sunlit::ros_interface
