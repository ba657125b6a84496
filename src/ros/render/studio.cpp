#include "ros/render/studio.h"

#include <ros/console.h>

#include <algorithm>
#include <cmath>

#include "sunlit/quantity/frames.h"
#include "sunlit/ros/world_search.h"
#include "sunlit/scene/load.h"

namespace sunlit::ros_interface {

namespace {

std::shared_ptr<const scene::Scene> loadScene(const RenderNodeOptions& options) {
  auto scene =
      std::make_shared<scene::Scene>(scene::load(options.world, worldSearchPath(options.model_path)));
  for (const std::string& warning : scene->warnings)
    ROS_WARN("%s: %s", options.world.c_str(), warning.c_str());
  ROS_INFO("World %s: %zu triangles, %zu textures", options.world.c_str(), scene->triangleCount(),
           scene->textures.size());
  return scene;
}

/// The highest point of the scene.
double topOf(const scene::Scene& scene) {
  float top = -1e9f;
  for (const scene::Mesh& mesh : scene.meshes) {
    for (const Eigen::Vector3f& position : mesh.positions) top = std::max(top, position.z());
  }
  return static_cast<double>(top);
}

}  // namespace

Studio::Studio(const RenderNodeOptions& options)
    : options_(options.renderOptions()),
      exposure_(options.exposure),
      world_(stopwatch_.measure("load", "world", [&] { return light::World(loadScene(options)); })),
      atmosphere_(
          stopwatch_.measure("load", "atmosphere", [&] { return sky::Atmosphere(options.atmosphere); })),
      renderer_(stopwatch_.measure("load", "renderer",
                                   [&] { return std::make_unique<render::Renderer>(world_, options_); })) {
  image::validate(exposure_);
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
  const image::LinearImage light = from_above.light(noon);
  return image::develop(light, image::chooseEv100(light, image::ExposureOptions{}));
}

void Studio::look(const Eigen::Isometry3d& map_from_camera) {
  stopwatch_.measure("geometry", "pose", [&] { renderer_->look(map_from_camera * linkFromOptical()); });
}

void Studio::lookAhead(const Eigen::Isometry3d& map_from_camera) {
  stopwatch_.measure("geometry", "ahead", [&] { renderer_->lookAhead(map_from_camera * linkFromOptical()); });
}

Developed Studio::photograph(const sky::Daylight& daylight, const std::string& what) {
  const image::LinearImage light =
      stopwatch_.measure("light", what, [&] { return renderer_->light(daylight); });
  return stopwatch_.measure("develop", what, [&] {
    const double ev100 = image::chooseEv100(light, exposure_);
    return Developed{image::develop(light, ev100), ev100};
  });
}

image::DepthImage Studio::depth() {
  return stopwatch_.measure("depth", "pose", [&] { return renderer_->depth(); });
}

}  // namespace sunlit::ros_interface
