/// Scene, atmosphere and camera: everything that makes a picture, without anything that sends it.
#pragma once

#include <Eigen/Geometry>
#include <memory>
#include <optional>
#include <string>

#include "ros/render/options.h"
#include "ros/render/stopwatch.h"
#include "sunlit/image/exposure.h"
#include "sunlit/image/sensor_noise.h"
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

/// One thread at a time may use it, except where a function says otherwise. Times its stages.
class Studio {
 public:
  /// Loads world and robot; their warnings go to the log. Throws what scene::load() and loadRobot() throw,
  /// and before that std::invalid_argument for options out of range.
  explicit Studio(const RenderNodeOptions& options);

  /// A picture from above, north up, close to orthographic, under a high sun. Replaces what look() looked at.
  image::Rgb8Image mapFromAbove(const MapExtent& extent);

  /// `map_from_links`: of the robot; empty: it is not there.
  void look(const Eigen::Isometry3d& map_from_camera, const render::BodyPlaces& map_from_links);
  /// Draws what look() will look at later. Another thread may photograph() meanwhile.
  void lookAhead(const Eigen::Isometry3d& map_from_camera, const render::BodyPlaces& map_from_links);
  /// What does not depend on the camera.
  light::Illumination illumination(const sky::Daylight& daylight) const;
  /// What look() looks at under `light`; the picture's series names it on the time sheet too.
  Developed photograph(const light::Illumination& light, const image::PictureName& name);
  image::DepthImage depth();

  /// As light::fingerprint(), of its world.
  std::string fingerprint() const;
  /// None if the options name none.
  const std::optional<scene::Robot>& robot() const { return robot_; }
  const sky::Atmosphere& atmosphere() const { return atmosphere_; }
  const image::PinholeCamera& camera() const { return options_.camera; }
  Stopwatch& stopwatch() { return stopwatch_; }

 private:
  Stopwatch stopwatch_;
  render::RenderOptions options_;
  image::ExposureOptions exposure_;
  image::NoiseOptions noise_;
  std::optional<scene::Robot> robot_;
  light::World world_;
  sky::Atmosphere atmosphere_;
  std::unique_ptr<render::Renderer> renderer_;
};

}  // namespace sunlit::ros_interface
