#include "ros/render/options.h"

#include <ros/console.h>
#include <ros/names.h>

#include <set>
#include <stdexcept>
#include <string>
#include <utility>

#include "ros/render/input_log.h"
#include "ros/render/option_names.h"
#include "sunlit/ros/node_rows.h"
#include "sunlit/scene/load.h"

namespace sunlit::ros_interface {

namespace {

const Range kCounts{0, 1e9};

/// The row of the renderer's option `key`, kept at `place`.
Field rendererRow(const char* key, Field::Place place) {
  render::RenderOptions options;
  Field row = fieldOf(fieldsOf(options), key);
  row.place = std::move(place);
  return row;
}

std::vector<Field> fieldsOf(PathSourceOptions& path) {
  return joined(
      {{{"file", &path.file, "", {}, "waypoints, m, in map: CSV (x,y,z) or TUM"},
        {"topic", &path.topic, "", {}, "or a nav_msgs/Path topic; neither: the path of race_track"}},
       fieldsOf(path.sampling),
       fieldsOf(path.selection),
       {path::speedRow(&path.speed_m_s)}});
}

Field rightCalibrationRow(std::string* file) {
  Field row = image::calibrationRow(file);
  row.key = "right/calibration";
  row.doc = "of a stereo camera's right one, by the same calibration";
  return row;
}

std::vector<Field> fieldsOf(CameraOptions& camera) {
  return {rendererRow("width", &camera.width),
          rendererRow("height", &camera.height),
          image::fieldOfViewRow(&camera.horizontal_fov),
          image::calibrationRow(&camera.calibration_file),
          rightCalibrationRow(&camera.right_calibration_file),
          image::baselineRow(&camera.baseline_m),
          rendererRow("supersampling", &camera.supersampling),
          rendererRow("rasterizer", choiceOf(&camera.rasterizer, render::rasterizerNames())),
          Field{"follow",
                choiceOf(&camera.follow_tf, {"path", "tf"}),
                "",
                {},
                "path, or the pose of follow_frame by TF"},
          Field{"follow_frame", &camera.follow_frame, "", {}, "x forward, y left, z up"}};
}

std::vector<Field> fieldsOf(WantedSubscribers& wanted) {
  const Range some{0, 1000};
  return {{"images", &wanted.images, "", some, "of camera/image_raw and camera/capture"},
          {"poses", &wanted.poses, "", some, "of camera/pose"},
          {"truth", &wanted.truth, "", some, "of camera_info and camera/depth/image_raw"},
          {"others", &wanted.others, "", some, "of these, camera/depth/camera_info and /tf"},
          {"left", &wanted.left, "", some, "of camera/left/image_raw and its camera_info"},
          {"right", &wanted.right, "", some, "of camera/right/image_raw and its camera_info"},
          {"of", &wanted.of, "", {}, "nodes that are counted; empty: whoever listens"}};
}

std::vector<Field> fieldsOf(PacingOptions& pacing) {
  return joined(
      {{{"frame_rate",
         &pacing.frame_rate,
         "Hz",
         {0.001, 1000},
         "pose k has the stamp start_stamp + k / frame_rate"},
        // A stamp of zero means "no stamp" to TF and to many tools.
        {"start_stamp",
         NumberOrWord{&pacing.start_stamp_s, "now"},
         "s",
         {0.001, 2147483647},
         "of pose 0; now: ROS time when it can be rendered"},
        {"wait_for",
         &pacing.wait_for,
         "",
         {},
         "progress topics (std_msgs/UInt32): poses that a reader is done with"},
        {"count_skipped",
         &pacing.counts_skipped,
         "",
         {},
         "whether wait_for counts what path/stride skips too"},
        {"max_ahead", &pacing.max_ahead, "", {1, 10000}, "poses ahead of the slowest of wait_for"},
        {"look_ahead",
         &pacing.looks_ahead,
         "",
         {},
         "the next pose is drawn while this one is lit: sooner done, with two poses in memory"}},
       under("subscribers", fieldsOf(pacing.subscribers)),
       {{"resume_at", &pacing.resume_at, "", kCounts, "poses since path/first that an earlier run has done"},
        {"autostart", &pacing.autostart, "", {}, "false: wait for the service ~start"},
        {"exit_when_done",
         &pacing.exit_when_done,
         "",
         {},
         "end with status 0 once all has reached its readers"},
        {"publish_clock", &pacing.publish_clock, "", {}, "this node is the time of all"},
        {"exact_sky",
         &pacing.exact_sky,
         "",
         {},
         "only skies of exactly a pose's stamp; with publish_clock it cannot be false"}}});
}

/// The air's rows, but that its height may be left to the site, and its ground to the world.
std::vector<Field> airFields(studio::SkyOptions* sky) {
  std::vector<Field> rows = fieldsOf(sky->air);
  for (Field& row : rows) {
    if (row.key == "observer_height") row.place = NumberOrWord{&sky->fixed_height_m, "auto"};
    if (row.key == "ground_albedo") row.place = NumberOrWord{&sky->fixed_ground_albedo, "auto"};
  }
  return rows;
}

/// Reads the camera's own file, if there is one; what is typed beside must be in it.
void readCalibration(const ParameterReader& parameters, CameraOptions* camera) {
  if (camera->calibration_file.empty()) return;
  camera->calibration = image::readCalibration(camera->calibration_file);
  for (const Field& row : fieldsOf(*camera)) {
    const bool counts = row.key == "width" || row.key == "height" || row.key == "horizontal_fov";
    if (!counts || !parameters.has("camera/" + row.key)) continue;
    const double typed = parameters.number("camera/" + row.key, 0.0);
    image::requireAgreement(*camera->calibration, camera->calibration_file,
                            {row.key, "parameter " + parameters.fullName("camera/" + row.key), typed});
  }
}

/// Makes the right camera, of its own file or by the baseline, where there is one.
void readRight(const ParameterReader& parameters, RenderNodeOptions* options) {
  CameraOptions& camera = options->camera;
  const std::string file = parameters.fullName("camera/right/calibration"),
                    baseline = parameters.fullName("camera/baseline");
  if (camera.right_calibration_file.empty()) {
    if (camera.baseline_m > 0.0)
      camera.right = image::idealRight(options->calibration(), camera.baseline_m,
                                       "parameter " + baseline + " asks for a right camera, but ");
    return;
  }
  if (camera.baseline_m > 0.0)
    throw std::invalid_argument("parameters " + file + " and " + baseline +
                                " are both given, but the file says how far away the right camera is");
  if (!camera.calibration)
    throw std::invalid_argument("parameter " + file + " is given, but " +
                                parameters.fullName("camera/calibration") +
                                " is not: the left camera is of the same calibration");
  camera.right =
      image::calibratedRight(*camera.calibration, image::readCalibration(camera.right_calibration_file),
                             camera.right_calibration_file + ": ");
}

/// What its rows alone do not tell.
void checkChain(const ParameterReader& parameters, const studio::ChainOptions& chain) {
  parameters.check("exposure", [&] { image::validate(chain.exposure); });
  parameters.check("vignetting", [&] { image::validate(chain.vignetting); });
}

void requireOnePath(const ParameterReader& parameters, const PathSourceOptions& path) {
  if (path.file.empty() || path.topic.empty()) return;
  throw std::invalid_argument("parameters " + parameters.fullName("path/file") + " and " +
                              parameters.fullName("path/topic") +
                              " are both given, but the path has one source");
}

void requireFrames(const ParameterReader& parameters, const RenderNodeOptions& options) {
  if (options.camera.follow_tf && options.frames.camera != CameraFrames().camera) {
    throw std::invalid_argument("parameter " + parameters.fullName("frames/camera") + " is given, but " +
                                parameters.fullName("camera/follow") + " is tf: the camera is at " +
                                parameters.fullName("camera/follow_frame"));
  }
  CameraFrames frames = options.cameraFrames();
  std::vector<Field> rows = under("frames", fieldsOf(frames));
  if (options.camera.follow_tf) rows[1].key = "camera/follow_frame";
  if (!options.camera.right) rows.pop_back();
  requireFrameNames(parameters, rows);
}

void requireBakeForGather(const ParameterReader& parameters, const RenderNodeOptions& options) {
  if (options.bake.enabled || options.final_gather == 0) return;
  throw std::invalid_argument("parameter " + parameters.fullName("transport/final_gather") + " is " +
                              std::to_string(options.final_gather) + ", but " +
                              parameters.fullName("transport/enabled") +
                              " is false: it looks closer where light is baked");
}

/// As far as can be told before the sun's node has said how high the site is.
void requireWeather(const sky::Weather& weather, const studio::SkyOptions& sky) {
  if (sky.fixed_height_m) return validate(weather, airOf(sky, *sky.fixed_height_m));
  validate(weather);
  try {
    validate(weather, airOf(sky, 0.0));
  } catch (const std::invalid_argument& error) {
    ROS_LOG(inputLevel(), ROSCONSOLE_DEFAULT_NAME,
            "At sea level %s. A site that is high enough has it; at another this node ends once the sun "
            "tells where it is",
            error.what());
  }
}

/// Makes whole names of the nodes that are counted, of which there must be enough.
void nameSubscribers(const ParameterReader& parameters, WantedSubscribers* wanted) {
  const std::string of = parameters.fullName("subscribers/of");
  for (std::string& node : wanted->of) {
    requireName(of, node, "node");
    node = ros::names::resolve(node, false);
  }
  if (wanted->of.empty()) return;
  const int named = static_cast<int>(std::set<std::string>(wanted->of.begin(), wanted->of.end()).size());
  for (const Field& row : fieldsOf(*wanted)) {
    const auto* const* size = std::get_if<int*>(&row.place);
    if (size == nullptr || **size <= named) continue;
    throw std::invalid_argument("parameter " + parameters.fullName("subscribers/" + row.key) + " is " +
                                std::to_string(**size) + ", but " + of + " names " + std::to_string(named) +
                                ", and only these are counted");
  }
}

/// The clock of this node stands still until the sky of the pose's very stamp is there.
void requireExactSky(const ParameterReader& parameters, PacingOptions* pacing) {
  if (!pacing->publish_clock) return;
  if (parameters.has("exact_sky") && !pacing->exact_sky) {
    throw std::invalid_argument("parameter " + parameters.fullName("exact_sky") + " is false, but " +
                                parameters.fullName("publish_clock") +
                                " is true, which waits for exactly that sky; leave exact_sky out");
  }
  pacing->exact_sky = true;
}

/// Throws for what only a run along a path can heed, where the camera follows TF instead.
void refuseWithoutPath(const ParameterReader& parameters, RenderNodeOptions options) {
  RenderNodeOptions usual;
  const auto rows = [](RenderNodeOptions& of) {
    PacingOptions& pacing = of.pacing;
    pacing.subscribers = {};  // these are waited for in any case, as the next two count in any case
    pacing.frame_rate = PacingOptions().frame_rate;
    pacing.autostart = true;
    return joined({under("path", fieldsOf(of.path)), fieldsOf(pacing)});
  };
  const std::vector<Field> given = rows(options), left_out = rows(usual);
  for (std::size_t i = 0; i < given.size(); ++i) {
    if (given[i].text() == left_out[i].text()) continue;
    throw std::invalid_argument("parameter " + parameters.fullName(given[i].key) + " is given, but " +
                                parameters.fullName("camera/follow") +
                                " is tf: only a camera on a path can heed it");
  }
}

/// Throws where readers of a right camera are waited for that is not there.
void refuseWithoutRight(const ParameterReader& parameters, const WantedSubscribers& wanted) {
  for (const auto& [key, count] : {std::pair("left", wanted.left), std::pair("right", wanted.right)}) {
    if (count == 0) continue;
    throw std::invalid_argument("parameter " + parameters.fullName(std::string("subscribers/") + key) +
                                " is " + std::to_string(count) + ", but there is no right camera: give " +
                                parameters.fullName("camera/baseline") + " or " +
                                parameters.fullName("camera/right/calibration"));
  }
}

}  // namespace

std::vector<Field> fieldsOf(CameraFrames& frames) {
  return {{"map", &frames.map, "", {}, "TF frame of world and path: x east, y north, z up"},
          {"camera", &frames.camera, "", {}, "TF frame of the camera on a path: x forward, y left, z up"},
          {"optical", &frames.optical, "", {}, "TF frame of images: z forward, x right, y down"},
          {"right_optical",
           &frames.right_optical,
           "",
           {},
           "TF frame of a stereo camera's right one; headers of its images name optical"}};
}

CameraFrames RenderNodeOptions::cameraFrames() const {
  CameraFrames cameras = frames;
  if (camera.follow_tf) cameras.camera = camera.follow_frame;
  return cameras;
}

image::Calibration RenderNodeOptions::calibration() const {
  if (camera.calibration) return *camera.calibration;
  return image::calibrationOf(
      image::PinholeCamera::fromFieldOfView(camera.width, camera.height, camera.horizontal_fov));
}

studio::StudioOptions RenderNodeOptions::studioOptions() const {
  studio::StudioOptions options;
  options.world = world;
  options.bake = bake;
  options.lamps = lamps;
  const image::Calibration calibrated = calibration();
  options.render.camera = calibrated.camera;
  options.render.distortion = calibrated.distortion;
  options.render.supersampling = camera.supersampling;
  options.render.rasterizer = camera.rasterizer;
  options.render.final_gather = final_gather;
  options.right = camera.right;
  return options;
}

std::vector<Field> fieldsOf(RenderNodeOptions& options) {
  return joined(
      {fieldsOf(options.world),
       under("path", fieldsOf(options.path)),
       under("camera", fieldsOf(options.camera)),
       under("robot", fieldsOf(options.robot)),
       fieldsOf(options.chain),
       fieldsOf(options.lamps),
       {{"night/enabled", &options.night, "", {}, "moon and stars too; false: the sun alone"}},
       under("atmosphere", airFields(&options.sky)),
       under("weather", joined({fieldsOf(options.weather), fieldsOf(options.surfaces)})),
       under("transport",
             joined({fieldsOf(options.bake), {rendererRow("final_gather", &options.final_gather)}})),
       fieldsOf(options.pacing),
       {{"sun_namespace",
         &options.sun_namespace,
         "",
         {},
         "where c/sun, c/moon and c/celestial are; empty: that of the node"},
        {"publish_tf", &options.publish_tf, "", {}, "map to camera_link to camera_optical_frame"},
        {"compressed",
         &options.compressed,
         "",
         {},
         "pictures in PNG, without loss, on camera/image_raw/compressed instead of camera/image_raw"}},
       under("frames", fieldsOf(options.frames)),
       {{"output_dir",
         &options.output_dir,
         "",
         {},
         "for map.png, map.yaml, timing.csv and what a resumed run goes by; empty: nowhere"},
        {"warn_of_inputs",
         &options.warns_of_inputs,
         "",
         {},
         "of what world, robot, path and weather have amiss; false: another renderer of the same does"},
        {"threads", &options.threads, "", {0, 1024}, "0: as many as there are cores"},
        diagnosticPeriodRow(&options.diagnostic_period_s)}});
}

RenderConditions readRenderConditions(const ParameterReader& parameters, const studio::SkyOptions& sky) {
  RenderConditions conditions;
  for (const Condition& named : readConditions(parameters)) {
    sky::Weather weather;
    scene::SurfaceState surfaces;
    studio::ChainOptions chain;
    named.parameters.read(under("weather", joined({fieldsOf(weather), fieldsOf(surfaces)})));
    named.parameters.check("weather", [&] { requireWeather(weather, sky); });
    named.parameters.read(fieldsOf(chain));
    checkChain(named.parameters, chain);
    conditions.chains.push_back(chain);
    named.parameters.rejectUnknown();
    const auto same = std::find(conditions.states.begin(), conditions.states.end(), surfaces);
    conditions.all.push_back({named, weather, static_cast<std::size_t>(same - conditions.states.begin())});
    if (same == conditions.states.end()) conditions.states.push_back(surfaces);
  }
  return conditions;
}

RenderNodeOptions readRenderNodeOptions(const ParameterReader& parameters) {
  RenderNodeOptions options;
  parameters.read(fieldsOf(options));
  nameFilesWholly(&options);
  studio::requireWorld(options.world);
  readCalibration(parameters, &options.camera);
  readRight(parameters, &options);
  readRobotForms(parameters, options.camera.follow_tf, &options.robot);
  options.sky.stars = options.night;
  options.sky.cache_dir = studio::cacheOf(options.bake).folder;
  checkChain(parameters, options.chain);
  requireFrames(parameters, options);
  requireOnePath(parameters, options.path);
  requireNames(parameters, options);
  requireBakeForGather(parameters, options);
  if (options.camera.follow_tf) refuseWithoutPath(parameters, options);
  if (!options.camera.right) refuseWithoutRight(parameters, options.pacing.subscribers);
  requireExactSky(parameters, &options.pacing);
  nameSubscribers(parameters, &options.pacing.subscribers);
  if (options.world.name != scene::kRaceTrack && options.path.file.empty() && options.path.topic.empty() &&
      !options.camera.follow_tf) {
    throw std::invalid_argument("parameter " + parameters.fullName("path/file") +
                                " is empty, but only the world " + scene::kRaceTrack +
                                " has a path of its own; give path/file or path/topic");
  }
  return options;
}

}  // namespace sunlit::ros_interface
