#include "sunlit/studio/studio.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "studio/camera.h"
#include "studio/tell.h"
#include "studio/top_down.h"
#include "sunlit/quantity/angle.h"
#include "sunlit/quantity/frames.h"
#include "sunlit/quantity/memory.h"

namespace sunlit::studio {

namespace {

/// "wet 1, snow 0.05 m".
std::string textOf(scene::SurfaceState state) {
  std::string text;
  for (const Field& row : fieldsOf(state)) {
    if (row.key != "ground_seed" && row.text() != "0")
      text +=
          (text.empty() ? "" : ", ") + row.key + " " + row.text() + (row.unit.empty() ? "" : " " + row.unit);
  }
  return text;
}

constexpr double kLeastMapSide = 0.01;  ///< of the longer one

/// To both sides.
void widen(double least_m, double* low, double* high) {
  const double missing_m = std::max(0.0, least_m - (*high - *low));
  *low -= 0.5 * missing_m;
  *high += 0.5 * missing_m;
}

/// Before anything that takes time. Throws std::invalid_argument.
const StudioOptions& checked(const StudioOptions& options) {
  for (const ChainOptions& chain : options.chains) validate(chain);
  render::validate(options.render);
  if (options.top_down) requireFields(*options.top_down);
  light::validate(options.bake.transport);
  light::validate(options.lamps);
  for (const scene::SurfaceState& state : options.surfaces) scene::validate(state);
  render::requireStarts(options.render.rasterizer);
  return options;
}

/// light::fingerprint() of a world that is still to be baked.
std::string printOf(const light::World& world, const BakeOptions& bake) {
  return bake.enabled ? light::fingerprint(world, bake.transport) : light::fingerprint(world);
}

/// What draws for the right camera: as for the left, but for the lens.
render::RenderOptions rightRender(const StudioOptions& options) {
  render::RenderOptions right = options.render;
  right.camera = options.right->calibration.camera;
  right.distortion = options.right->calibration.distortion;
  return right;
}

Eigen::Isometry3d mapFromRight(const Eigen::Isometry3d& map_from_camera, const StudioOptions& options) {
  return map_from_camera * linkFromOptical() * options.right->left_from_right;
}

/// The motion of what is fixed to a thing that moves, `away` from it in `map`.
Motion carried(const Motion& motion, const Eigen::Vector3d& away) {
  return {motion.velocity_m_s + motion.turning_rad_s.cross(away), motion.turning_rad_s};
}

/// For inMemory().
std::string pictureOf(const StudioOptions& options) {
  const image::PinholeCamera& camera = options.render.camera;
  return "a picture of " + std::to_string(camera.width) + "x" + std::to_string(camera.height) + " px";
}

}  // namespace

Studio::Studio(const StudioOptions& options, const std::optional<scene::Robot>& robot, const Reports& reports)
    : options_(checked(options)), camera_(std::make_unique<Camera>(options.render, options.chains)) {
  if (options.right) right_ = std::make_unique<Camera>(rightRender(options), options.chains);
  const light::World dry = stopwatch_.measure(
      "load", "world", [&] { return loadWorld(options.world, cacheFolder(), robot, reports); });
  requireGroups(dry, options.lamps, reports);
  if (options.top_down) {
    const Overlook overlook = overlooking(dry, *options.top_down, options.render);
    options_.render = overlook.render;
    map_from_top_down_ = overlook.map_from_camera;
    camera_ = std::make_unique<Camera>(options_.render, options.chains);
  }
  for (const scene::SurfaceState& state : options.surfaces) {
    light::World& world = worlds_.emplace_back(
        stopwatch_.measure("load", "surfaces", [&] { return light::weathered(dry, state); }));
    if (!scene::isDry(state)) tell(reports.note, "Surfaces " + textOf(state));
    if (reports.loaded && worlds_.size() == 1) reports.loaded(world, printOf(world, options.bake));
    world.transport =
        stopwatch_.measure("load", "transport", [&] { return bake(world, options.bake, reports); });
  }
  inMemory(pictureOf(options_), [&] {
    stopwatch_.measure("load", "renderer", [&] { camera_->enter(worlds_); });
    if (right_) stopwatch_.measure("load", "right", [&] { right_->enterBeside(*camera_); });
  });
}

Studio::~Studio() = default;

MapExtent widened(MapExtent extent) {
  const double least_m = kLeastMapSide * std::max(extent.x_max - extent.x_min, extent.y_max - extent.y_min);
  widen(least_m, &extent.x_min, &extent.x_max);
  widen(least_m, &extent.y_min, &extent.y_max);
  return extent;
}

image::Rgb8Image Studio::mapFromAbove(const MapExtent& extent, const sky::Daylight& daylight) const {
  constexpr double kLongSidePx = 1600.0;
  // From so many extents away rays are within 1.5° of parallel; of what is wider than a camera may be away,
  // less so. The longest focal length that a camera may have allows 625 extents.
  constexpr double kLeast = 20.0, kMost = 600.0, kFarthest_m = 1.9e6;
  const double east_m = extent.x_max - extent.x_min;
  const double north_m = extent.y_max - extent.y_min;
  const double longest_m = std::max(east_m, north_m);
  const double ground_m = world().ground_m;
  const Perch perch =
      perchOver(ground_m, heightsOf(world()),
                {std::min(kLeast * longest_m, kFarthest_m), std::min(kMost * longest_m, kFarthest_m)});
  const double px_per_m = kLongSidePx / longest_m;
  constexpr int kShortSidePx = static_cast<int>(kLeastMapSide * kLongSidePx);
  const int width = std::max(kShortSidePx, static_cast<int>(std::lround(east_m * px_per_m)));
  const int height = std::max(kShortSidePx, static_cast<int>(std::lround(north_m * px_per_m)));

  // From above one strip after another, each by a camera over its own middle: a whole map at once would take
  // a gigabyte.
  constexpr int kStripPx = 64;
  render::RenderOptions options = options_.render;
  options.distortion = image::Distortion();
  options.final_gather = 0;  // the whole world at a glance: its leaves are smaller than pixels
  const int strip = std::min(height, kStripPx);
  const double focal_px = px_per_m * perch.height_m;
  options.camera = {width, strip, focal_px, focal_px, 0.5 * (width - 1), 0.5 * (strip - 1)};
  options.near_m = perch.near_m;
  options.far_m = perch.far_m;
  const std::unique_ptr<render::Renderer> from_above = camera_->renderer(options);
  Eigen::Isometry3d map_from_optical = Eigen::Isometry3d::Identity();
  map_from_optical.linear() =
      Eigen::Vector3d(1.0, -1.0, -1.0).asDiagonal();  // right east, down south, forward down
  const light::Illumination light = illumination(daylight.withoutAir());
  image::LinearImage whole(width, height);
  for (int row = 0; row < height; row += strip) {
    const double from_north_m = (row + 0.5 * strip) / px_per_m;
    map_from_optical.translation() = Eigen::Vector3d(0.5 * (extent.x_min + extent.x_max),
                                                     extent.y_max - from_north_m, ground_m + perch.height_m);
    from_above->look(map_from_optical);
    const image::LinearImage part = from_above->light(light);
    const int rows = std::min(strip, height - row);
    std::copy_n(part.data.begin(), rows * width * 3, whole.at(0, row));
  }
  return image::develop(whole, image::chooseEv100(whole, image::ExposureOptions{}));
}

void Studio::lookByLeft(const Eigen::Isometry3d& map_from_camera, const render::BodyPlaces& map_from_links,
                        const Motion& motion) {
  inMemory(pictureOf(options_), [&] {
    stopwatch_.measure("geometry", "pose",
                       [&] { camera_->look(map_from_camera * linkFromOptical(), map_from_links, motion); });
  });
}

void Studio::look(const Eigen::Isometry3d& map_from_camera, const render::BodyPlaces& map_from_links,
                  const Motion& motion) {
  lookByLeft(map_from_camera, map_from_links, motion);
  if (right_) {
    stopwatch_.measure("geometry", "right", [&] {
      const Eigen::Isometry3d map_from_right = mapFromRight(map_from_camera, options_);
      right_->look(map_from_right, map_from_links,
                   carried(motion, map_from_right.translation() - map_from_camera.translation()));
    });
  }
}

void Studio::lookAhead(const Eigen::Isometry3d& map_from_camera, const render::BodyPlaces& map_from_links) {
  stopwatch_.measure("geometry", "ahead",
                     [&] { camera_->lookAhead(map_from_camera * linkFromOptical(), map_from_links); });
  if (right_) {
    stopwatch_.measure("geometry", "right ahead",
                       [&] { right_->lookAhead(mapFromRight(map_from_camera, options_), map_from_links); });
  }
}

light::Illumination Studio::illumination(const sky::Daylight& daylight, std::size_t state) const {
  return light::illumination(worlds_.at(state), options_.top_down ? daylight.withoutAir() : daylight,
                             options_.lamps);
}

Developed Studio::photograph(const light::Illumination& light, const image::PictureName& name,
                             const Setting& setting) {
  return inMemory(pictureOf(options_), [&] {
    return camera_->photograph({light, name, setting}, std::nullopt, &stopwatch_);
  });
}

double Studio::meter(const light::Illumination& light, const image::PictureName& name,
                     const Setting& setting) {
  return camera_->meter({light, name, setting}, &stopwatch_);
}

image::Rgb8Image Studio::photographRight(const light::Illumination& light, const image::PictureName& name,
                                         double ev100, const Setting& setting) {
  // No name of a condition has a space.
  const image::PictureName of_right{name.index, name.series + " right", name.drive};
  return right_->photograph({light, of_right, setting}, ev100, &stopwatch_).picture;
}

std::string Studio::rasterizer() const {
  return camera_->rasterizer();
}

image::DepthImage Studio::depth() {
  return stopwatch_.measure("depth", "pose", [&] { return camera_->depth(); });
}

namespace {

/// Whether something is above `eye`, but nothing is seen beneath, whichever of a few ways down it looks.
/// Within a block whose faces have two sides pictures are black, which is told by itself.
bool isUnderGround(const light::Visibility& world, const Eigen::Vector3d& eye) {
  constexpr int kWays = 3;
  constexpr float kAside = 0.1f, kRaised_m = 1e-3f;  // not through a seam, nor past what the eye lies on
  const Eigen::Vector3f from = eye.cast<float>();
  for (int i = 0; i < kWays; ++i) {
    const float turn = static_cast<float>(2.0 * kPi) * static_cast<float>(i) / kWays;
    const Eigen::Vector3f way(kAside * std::cos(turn), kAside * std::sin(turn), -1.0f);
    if (world.firstSeen(from + kRaised_m * Eigen::Vector3f::UnitZ(), way, 0.0f)) return false;
  }
  const Eigen::Vector3f up(kAside, 0.0f, 1.0f);
  std::uint8_t is_below = 0;
  world.occluded({&from.x(), &from.y(), &from.z(), &up.x(), &up.y(), &up.z(), 1}, &is_below);
  return is_below != 0;
}

}  // namespace

std::optional<ViewFault> Studio::viewFault() const {
  const auto reach = [&] { return reachOf(boundsOf(world())); };
  if (isUnderGround(*world().visibility, camera_->eye()))
    return ViewFault{"are under the ground, or where there is none",
                     "nothing of the world, " + reach() +
                         ", is seen beneath the camera, but something is above: it is under the ground, or "
                         "there is none"};
  if (camera_->seesAnything()) return std::nullopt;
  return ViewFault{"see nothing of the world",
                   "nothing of the world is in view, " + reach() +
                       "; surfaces with one side do not show the other, and nothing nearer "
                       "than 5 cm is drawn"};
}

}  // namespace sunlit::studio
