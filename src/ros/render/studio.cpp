#include "ros/render/studio.h"

#include <ros/console.h>
#include <ros/time.h>

#include <algorithm>
#include <cmath>

#include "sunlit/quantity/frames.h"
#include "sunlit/ros/world_search.h"
#include "sunlit/scene/load.h"

namespace sunlit::ros_interface {

namespace {

light::World makeWorld(const RenderNodeOptions& options, const std::optional<scene::Robot>& robot) {
  auto scene =
      std::make_shared<scene::Scene>(scene::load(options.world, worldSearchPath(options.model_path)));
  for (const std::string& warning : scene->warnings)
    ROS_WARN("%s: %s", options.world.c_str(), warning.c_str());
  ROS_INFO("World %s: %zu triangles, %zu textures", options.world.c_str(), scene->triangleCount(),
           scene->textures.size());
  std::vector<std::vector<scene::Mesh>> meshes_of_links;
  if (robot) meshes_of_links = scene::addLooks(*robot, scene.get());
  return light::World(std::move(scene), meshes_of_links);
}

/// Says every few seconds how far a bake is.
class BakeLog {
 public:
  void operator()(double share, double seconds_left) {
    constexpr double kPause_s = 3.0;
    const ros::WallTime now = ros::WallTime::now();
    if ((now - last_).toSec() < kPause_s) return;
    last_ = now;
    ROS_INFO("Baking sky light and bounced light: %.0f %%, %.0f s left", 100.0 * share, seconds_left);
  }

 private:
  ros::WallTime last_ = ros::WallTime::now();
};

std::shared_ptr<const light::Transport> makeTransport(const BakeOptions& options, const light::World& world) {
  if (!options.enabled) return nullptr;
  const std::string folder = options.cache_dir.empty() ? light::Transport::usualFolder() : options.cache_dir;
  const light::BakeCache cache(folder, static_cast<std::uintmax_t>(1e9 * options.cache_limit_gb));
  auto transport = light::Transport::cached(world.geometry, options.transport, cache, BakeLog(),
                                            [](const std::string& line) { ROS_WARN("%s", line.c_str()); });
  ROS_INFO("Sky light and bounced light at %zu samples, kept in %s", transport->sampleCount(),
           folder.c_str());
  return transport;
}

/// The highest point of the scene.
double topOf(const scene::Scene& scene) {
  float top = -1e9f;
  for (const scene::Mesh& mesh : scene.meshes) {
    for (const Eigen::Vector3f& position : mesh.positions) top = std::max(top, position.z());
  }
  return static_cast<double>(top);
}

/// Before anything that takes time. Throws std::invalid_argument.
render::RenderOptions checked(const RenderNodeOptions& options) {
  image::validate(options.exposure);
  image::validate(options.noise);
  sky::validate(options.atmosphere);
  const render::RenderOptions render = options.renderOptions();
  render::validate(render);
  return render;
}

}  // namespace

Studio::Studio(const RenderNodeOptions& options)
    : options_(checked(options)),
      exposure_(options.exposure),
      noise_(options.noise),
      robot_(loadRobot(options.robot, options.model_path)),
      world_(stopwatch_.measure("load", "world", [&] { return makeWorld(options, robot_); })),
      atmosphere_(
          stopwatch_.measure("load", "atmosphere", [&] { return sky::Atmosphere(options.atmosphere); })) {
  world_.transport =
      stopwatch_.measure("load", "transport", [&] { return makeTransport(options.bake, world_); });
  renderer_ = stopwatch_.measure("load", "renderer",
                                 [&] { return std::make_unique<render::Renderer>(world_, options_); });
}

image::Rgb8Image Studio::mapFromAbove(const MapExtent& extent) {
  constexpr double kLongSidePx = 1600.0;
  // From so many extents away rays are within 1.5° of parallel.
  constexpr double kDistance = 20.0;
  const double east_m = extent.x_max - extent.x_min;
  const double north_m = extent.y_max - extent.y_min;
  const double longest_m = std::max(east_m, north_m);
  const double distance_m = kDistance * longest_m;

  render::RenderOptions options = options_;
  options.final_gather = 0;  // the whole world at a glance: its leaves are smaller than pixels
  const double px_per_m = kLongSidePx / longest_m;
  const int width = std::max(16, static_cast<int>(std::lround(east_m * px_per_m)));
  const int height = std::max(16, static_cast<int>(std::lround(north_m * px_per_m)));
  const double focal_px = px_per_m * distance_m;
  options.camera = {width, height, focal_px, focal_px, 0.5 * (width - 1), 0.5 * (height - 1)};
  options.near_m = 0.5 * distance_m;
  options.far_m = 2.0 * distance_m;

  Eigen::Isometry3d map_from_optical = Eigen::Isometry3d::Identity();
  map_from_optical.linear() =
      Eigen::Vector3d(1.0, -1.0, -1.0).asDiagonal();  // right east, down south, forward down
  map_from_optical.translation() =
      Eigen::Vector3d(0.5 * (extent.x_min + extent.x_max), 0.5 * (extent.y_min + extent.y_max),
                      topOf(*world_.geometry->scene) + distance_m);
  render::Renderer from_above(world_, options);
  from_above.look(map_from_optical);
  const sky::Daylight noon =
      atmosphere_.daylight({Direction(Azimuth::degrees(160.0), Angle::degrees(55.0)), 1.0});
  const image::LinearImage light = from_above.light(illumination(noon));
  return image::develop(light, image::chooseEv100(light, image::ExposureOptions{}));
}

std::string Studio::fingerprint() const {
  return light::fingerprint(world_);
}

void Studio::look(const Eigen::Isometry3d& map_from_camera, const render::BodyPlaces& map_from_links) {
  stopwatch_.measure("geometry", "pose",
                     [&] { renderer_->look(map_from_camera * linkFromOptical(), map_from_links); });
}

void Studio::lookAhead(const Eigen::Isometry3d& map_from_camera, const render::BodyPlaces& map_from_links) {
  stopwatch_.measure("geometry", "ahead",
                     [&] { renderer_->lookAhead(map_from_camera * linkFromOptical(), map_from_links); });
}

light::Illumination Studio::illumination(const sky::Daylight& daylight) const {
  return light::illumination(world_, daylight);
}

Developed Studio::photograph(const light::Illumination& light, const image::PictureName& name) {
  image::LinearImage luminance =
      stopwatch_.measure("light", name.series, [&] { return renderer_->light(light); });
  return stopwatch_.measure("develop", name.series, [&] {
    const double ev100 = image::chooseEv100(luminance, exposure_);
    if (noise_.enabled) image::addSensorNoise(ev100, noise_, name, &luminance);
    return Developed{image::develop(luminance, ev100), ev100};
  });
}

image::DepthImage Studio::depth() {
  return stopwatch_.measure("depth", "pose", [&] { return renderer_->depth(); });
}

}  // namespace sunlit::ros_interface
