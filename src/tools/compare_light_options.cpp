#include "tools/compare_light_options.h"

#include <algorithm>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "sunlit/studio/command_line.h"
#include "tools/camera_arguments.h"
#include "tools/every_nth_pixel.h"
#include "tools/place_arguments.h"
#include "tools/world_arguments.h"

namespace sunlit::tools {

namespace {

SkyToCompare skyOf(const TypedBody& body, bool is_moon) {
  std::ostringstream name;
  name << (is_moon ? "moon_" : "sun_") << body.elevation_deg;
  SkyToCompare sky{name.str(), body.azimuth_deg, body.elevation_deg, std::nullopt};
  if (is_moon) sky.moon_phase_deg = body.phase_deg;
  return sky;
}

/// Pictures and tables know a sky by its name: by its azimuth too, where another has its elevation.
void add(SkyToCompare sky, std::vector<SkyToCompare>* skies) {
  const auto isThere = [&] {
    return std::any_of(skies->begin(), skies->end(),
                       [&](const SkyToCompare& other) { return other.name == sky.name; });
  };
  if (isThere()) {
    std::ostringstream azimuth;
    azimuth << sky.azimuth_deg;
    sky.name += "_at_" + azimuth.str();
  }
  if (isThere()) throw std::invalid_argument("two skies would both be called " + sky.name);
  skies->push_back(std::move(sky));
}

/// What is typed before it is known what it is for.
struct Words {
  TypedPose view;
  TypedBody body;
  CameraWords camera;
};

void addScene(studio::CommandLine* line, CompareLightOptions* options, Words* words) {
  const std::vector<Field> rows = fieldsOf(*options);
  line->group("What is compared");
  line->add("--out DIR", fieldOf(rows, "out"));
  line->add("--path FILE", fieldOf(rows, "path"));
  line->add("--views N", fieldOf(rows, "views"));
  line->add("--height M", fieldOf(fieldsOf(options->sampling), "camera_height"));
  line->add("--view X,Y,Z[,YAW[,PITCH]]", "a view instead of the path; may be repeated",
            fieldsOf(words->view))
      .then([=](const std::string&, const std::string&) {
        options->map_from_camera.push_back(mapFromCamera(words->view));
      })
      .withoutDefault();
  const std::vector<Field> body = fieldsOf(words->body);
  line->add("--sun AZIMUTH,ELEVATION",
            "may be repeated; without it suns at 60, 20, 4, -4 and -9, and a moon at 45 degrees",
            {fieldOf(body, "azimuth"), fieldOf(body, "elevation")})
      .then([=](const std::string&, const std::string&) { add(skyOf(words->body, false), &options->skies); })
      .withoutDefault();
  line->add("--moon AZIMUTH,ELEVATION,PHASE", "with the sun at -40 degrees; may be repeated", body)
      .then([=](const std::string&, const std::string&) { add(skyOf(words->body, true), &options->skies); })
      .withoutDefault();
  line->add("--every N", fieldOf(rows, "every"));
  const std::vector<Field> reference = fieldsOf(options->reference);
  line->add("--samples N", fieldOf(reference, "samples"));
  line->add("--bounces N", fieldOf(reference, "bounces"));
}

void requireThatAllCount(const studio::CommandLine& line, const CompareLightOptions& options) {
  if (!line.has("--out")) throw std::invalid_argument("--out DIR is missing; --help lists all options");
  for (const std::string of_path : {"--path", "--views", "--height"}) {
    if (line.has(of_path) && line.has("--view"))
      throw std::invalid_argument(of_path + " and --view are both given; one of them");
  }
  studio::requireWorld(options.world);
  if (!line.has("--path") && !line.has("--view") && options.world.name != scene::kRaceTrack)
    throw std::invalid_argument("--path FILE or --view is missing: only race_track has a path of its own");
}

}  // namespace

std::optional<CompareLightOptions> parseCompareLightOptions(const std::vector<std::string>& arguments) {
  CompareLightOptions options;
  Words words;
  studio::CommandLine line(
      "compare_light: how far the fast picture's light is from path-traced light. Needs no ROS master.",
      "compare_light --out DIR [options]");
  addScene(&line, &options, &words);
  addCamera(&line, &words.camera);
  addWorld(&line, &options.world);
  addBounced(&line, &options.bake);
  addLamps(&line, &options.lamps);
  addWeather(&line, &options.weather, &options.surfaces);
  if (!line.read(arguments)) return std::nullopt;
  requireWeather(line, options.weather, options.surfaces, {});
  requireThatAllCount(line, options);
  if (options.skies.empty()) {
    for (const TypedBody& sun : {TypedBody{170, 60}, {250, 20}, {285, 4}, {290, -4}, {295, -9}})
      options.skies.push_back(skyOf(sun, false));
    options.skies.push_back(skyOf({150, 45, 10}, true));
  }
  words.camera.requireSense(options.bake);
  options.render = words.camera.options();
  const int shorter_side = std::min(options.render.camera.width, options.render.camera.height);
  require("--every", options.every, {1.0, 1.0 * EveryNthPixel::largest(shorter_side)}, "px");
  render::validate(options.render);
  light::validate(options.reference);
  return options;
}

}  // namespace sunlit::tools
