/// A world and a camera in it, from geometry to the developed picture, without anything that sends it.
#pragma once

#include <Eigen/Geometry>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "sunlit/image/sensor_noise.h"
#include "sunlit/image/stereo.h"
#include "sunlit/light/lamps.h"
#include "sunlit/quantity/frames.h"
#include "sunlit/quantity/motion.h"
#include "sunlit/render/renderer.h"
#include "sunlit/scene/weathering.h"
#include "sunlit/studio/chain.h"
#include "sunlit/studio/stopwatch.h"
#include "sunlit/studio/world.h"

namespace sunlit::studio {

/// Ground that is seen from straight above, north up.
struct TopDown {
  double x = 0.0, y = 0.0;  ///< of its middle, m in `map`
  double extent_m = 1.0;
};

inline std::vector<Field> fieldsOf(TopDown& ground) {
  return {{"x", &ground.x, "m", kPoseRange_m, ""},
          {"y", &ground.y, "m", kPoseRange_m, ""},
          {"extent", &ground.extent_m, "m", Range::above(0, 2e5), "from west to east"}};
}

/// Of a camera that looks straight down, north up: x forward, z up.
inline Eigen::Matrix3d topDownAxes() {
  return (Eigen::Matrix3d() << 0, -1, 0, 0, 0, 1, -1, 0, 0).finished();
}

struct StudioOptions {
  WorldOptions world;
  BakeOptions bake;
  render::RenderOptions render;
  light::LampOptions lamps;
  /// States of the world's surfaces that pictures are taken in, one at least.
  std::vector<scene::SurfaceState> surfaces = {{}};
  /// What they are taken with, one at least.
  std::vector<ChainOptions> chains = {{}};
  std::optional<image::RightCamera> right = {};  ///< beside the camera of `render`, which is the left one
  /// Set: `render` has a lens by which this ground is seen, whatever the height of the world, and no air lies
  /// before it.
  std::optional<TopDown> top_down = {};
};

/// What pictures alone do not tell from fog or night.
struct ViewFault {
  const char* poses;   ///< what all poses like it do: "see nothing of the world"
  std::string reason;  ///< "nothing of the world is in view, which reaches from …"
};

/// In what, and with what, a picture is taken.
struct Setting {
  std::size_t state = 0;  ///< number of StudioOptions::surfaces
  std::size_t chain = 0;  ///< number of StudioOptions::chains
  /// EV100 that a picture is exposed with which by itself would have this one; unset: that.
  std::function<double(double metered_ev100)> adapted = {};
};

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
/// `extent`, or more to both sides where it is narrower than a map can be, a hundredth of its length.
MapExtent widened(MapExtent extent);

class Camera;

/// One thread at a time may use it, except where a function says otherwise. Times its stages.
class Studio {
 public:
  /// Loads the world, with the `robot` in it if there is one, and bakes its light, once for each state of its
  /// surfaces. Throws what loadWorld() and bake() throw, and before that std::invalid_argument for options
  /// out of range and std::runtime_error for a rasterizer that cannot start; and requireGroups().
  explicit Studio(const StudioOptions& options, const std::optional<scene::Robot>& robot = std::nullopt,
                  const Reports& reports = {});
  ~Studio();
  Studio(const Studio&) = delete;
  Studio& operator=(const Studio&) = delete;

  /// Where the camera of StudioOptions::top_down stands, from where it sees that ground; unset without it.
  const std::optional<Eigen::Isometry3d>& mapFromTopDown() const { return map_from_top_down_; }

  /// A picture from above of what is widened(), north up, of that extent at the level of the ground; close to
  /// orthographic up to 100 km, and from within 1900 km whatever the extent; without the air before it.
  /// Leaves alone what look() looked at.
  image::Rgb8Image mapFromAbove(const MapExtent& extent, const sky::Daylight& daylight) const;

  /// `map_from_camera`: of its link, x forward, z up. `map_from_links`: of the robot; empty: it is not there.
  /// `motion`: of the camera, and the robot with it.
  void look(const Eigen::Isometry3d& map_from_camera, const render::BodyPlaces& map_from_links = {},
            const Motion& motion = {});
  /// The same for the left camera, or the only one: all but photographRight() then speaks of that.
  void lookByLeft(const Eigen::Isometry3d& map_from_camera, const render::BodyPlaces& map_from_links = {},
                  const Motion& motion = {});
  /// Draws what look() will look at later. Another thread may photograph() meanwhile.
  void lookAhead(const Eigen::Isometry3d& map_from_camera, const render::BodyPlaces& map_from_links = {});
  /// What does not depend on the camera, but that one of top_down sees no air.
  light::Illumination illumination(const sky::Daylight& daylight, std::size_t state = 0) const;
  /// What look() looks at under `light`, which is of the same state: rows see one after another while the
  /// camera moves, the lens takes light away and strews some, the sensor counts what it gets. The picture's
  /// series names it on the time sheet too.
  Developed photograph(const light::Illumination& light, const image::PictureName& name,
                       const Setting& setting = {});
  /// EV100 that photograph() would develop with by itself.
  double meter(const light::Illumination& light, const image::PictureName& name, const Setting& setting = {});
  /// What the right camera sees, where there is one: exposed like the left one's picture of that name and
  /// setting, with grain of its own. Of the pose of look().
  image::Rgb8Image photographRight(const light::Illumination& light, const image::PictureName& name,
                                   double ev100, const Setting& setting = {});
  /// At the moment of look(), all rows at once.
  image::DepthImage depth();
  /// What is amiss with what look() looks at: it is from under the ground, or nothing of the world is in it,
  /// not even what blends, which has no depth. Unset: nothing.
  std::optional<ViewFault> viewFault() const;

  const light::World& world() const { return worlds_.front(); }
  /// One a state.
  const std::vector<light::World>& worlds() const { return worlds_; }
  /// Where what takes long to make is kept for the next time.
  std::string cacheFolder() const { return cacheOf(options_.bake).folder; }
  /// As render::Renderer::rasterizer().
  std::string rasterizer() const;
  const image::PinholeCamera& camera() const { return options_.render.camera; }
  Stopwatch& stopwatch() { return stopwatch_; }

  bool hasRight() const { return right_ != nullptr; }

 private:
  Stopwatch stopwatch_;
  StudioOptions options_;
  std::unique_ptr<Camera> camera_;
  std::unique_ptr<Camera> right_;  // null: there is none
  std::vector<light::World> worlds_;
  std::optional<Eigen::Isometry3d> map_from_top_down_;
};

}  // namespace sunlit::studio
