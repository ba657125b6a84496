// Data sets for other people's systems.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "sunlit/evaluate/data_sets/data_set.h"
#include "sunlit/image/files.h"
#include "sunlit/quantity/duration.h"
#include "sunlit/studio/command_line.h"
#include "sunlit/studio/sky.h"
#include "sunlit/studio/studio.h"
#include "tools/blind_poses.h"
#include "tools/export_dataset_options.h"
#include "tools/output_folder.h"
#include "tools/recipe.h"
#include "tools/terminal.h"

namespace sunlit::tools {
namespace {

using evaluate::DataSetFolder;
using evaluate::DataSetFormat;
using evaluate::DataSetFrame;
using evaluate::DepthRoom;

/// A data set of one hour in one format.
struct Part {
  DataSetFolder folder;
  std::string path;
  DataSetFormat format;
  int made = 0;         ///< pictures of this run
  DepthRoom room = {};  ///< of these
};

/// The data sets of one hour.
struct Hour {
  TimeOfDay when;
  std::vector<Part> parts;

  bool has(const DataSetFrame& frame) const {
    return std::all_of(parts.begin(), parts.end(), [&](const Part& part) { return part.folder.has(frame); });
  }
  void writeRight(const DataSetFrame& frame, const image::Rgb8Image& picture) {
    for (const Part& part : parts) {
      if (part.folder.hasRight()) part.folder.writeRight(frame, picture);
    }
  }
  void write(const DataSetFrame& frame, const image::Rgb8Image& picture, const image::DepthImage& depth) {
    for (Part& part : parts) {
      const DepthRoom room = part.folder.write(frame, picture, depth);
      ++part.made;
      part.room.seen += room.seen;
      part.room.without_room += room.without_room;
    }
  }
};

std::vector<Hour> hoursOf(const ExportOptions& options) {
  std::vector<Hour> hours;
  for (const TimeOfDay& when : options.hours) {
    hours.push_back({when, {}});
    for (const DataSetFormat format : options.formats) {
      const std::string path = options.folderOf(when, format);
      hours.back().parts.push_back({DataSetFolder(path, format, options.data_set), path, format});
    }
  }
  return hours;
}

/// Made only once a picture is missing: loading takes longer than looking whether all are there.
class Camera {
 public:
  explicit Camera(const ExportOptions& options)
      : options_(options),
        studio_(options.studio, std::nullopt, onTerminal()),
        sky_(skyOver(studio_, options.place)),
        lights_(options.hours.size()) {}

  /// Returns how many pictures it took: of those hours that do not have the frame.
  int take(const DataSetFrame& frame, const Motion& motion, std::vector<Hour>* hours) {
    studio_.look(frame.map_from_camera, {}, motion);
    blind_poses_.check(studio_, frame.number);
    const image::DepthImage depth = studio_.depth();
    int taken = 0;
    for (std::size_t i = 0; i < hours->size(); ++i) {
      Hour& hour = (*hours)[i];
      if (hour.has(frame)) continue;
      const image::PictureName name{frame.number, hour.when.name()};
      const light::Illumination& light = lightOf(i, frame);
      const studio::Developed developed = studio_.photograph(light, name);
      if (studio_.hasRight()) hour.writeRight(frame, studio_.photographRight(light, name, developed.ev100));
      hour.write(frame, developed.picture, depth);
      ++taken;
    }
    return taken;
  }

  std::string fingerprint() const { return light::fingerprint(studio_.world()); }
  const BlindPoses& blindPoses() const { return blind_poses_; }

 private:
  /// Of hour number `i`; only clouds that drift know how long after the first pose it is.
  const light::Illumination& lightOf(std::size_t i, const DataSetFrame& frame) {
    if (lights_[i] && !sky::moves(options_.place.weather)) return *lights_[i];
    const double hour = options_.hours[i].hour();
    sky::Weather weather = weatherAt(options_.place, hour);
    weather.clock_s += static_cast<double>(frame.number) / options_.rate_hz;
    lights_[i] = studio_.illumination(sky_.daylight(bodiesOf(options_.place, hour), weather));
    return *lights_[i];
  }

  const ExportOptions& options_;
  studio::Studio studio_;
  studio::Sky sky_;
  std::vector<std::optional<light::Illumination>> lights_;  ///< of each hour, once it was needed
  BlindPoses blind_poses_;
};

/// Numbers of those frames that an hour lacks.
std::vector<std::size_t> missingFrames(const ExportOptions& options, const std::vector<Hour>& hours) {
  std::vector<std::size_t> missing;
  for (std::size_t i = 0; i < options.frames.size(); ++i) {
    const bool is_there = std::all_of(hours.begin(), hours.end(),
                                      [&](const Hour& hour) { return hour.has(options.frames[i]); });
    if (!is_there) missing.push_back(i);
  }
  return missing;
}

void makePictures(const ExportOptions& options, const FolderRecipe& recipe, std::vector<Hour>* hours) {
  using Clock = std::chrono::steady_clock;
  const std::vector<std::size_t> wanted = missingFrames(options, *hours);
  if (wanted.size() < options.frames.size())
    std::printf("%zu poses are there already\n", options.frames.size() - wanted.size());
  if (wanted.empty()) return;
  const auto camera = std::make_unique<Camera>(options);
  recipe.note(camera->fingerprint());  // not before the world was found to be one
  const Clock::time_point begin = Clock::now();
  for (std::size_t done = 0; done < wanted.size();) {
    const DataSetFrame& frame = options.frames[wanted[done]];
    const int taken = camera->take(frame, options.motions[wanted[done]], hours);
    ++done;
    const double spent_s = std::chrono::duration<double>(Clock::now() - begin).count();
    const double left_s = spent_s / static_cast<double>(done) * static_cast<double>(wanted.size() - done);
    std::printf("pose %zu of %zu: number %lld of the path, %d picture%s; %s left\n", done, wanted.size(),
                static_cast<long long>(frame.number), taken, taken == 1 ? "" : "s",
                textOfDuration(left_s).c_str());
    std::fflush(stdout);
  }
  camera->blindPoses().tell();
}

/// What a person must know of a part before using it.
void tell(const Part& part, const ExportOptions& options) {
  std::printf("%s: %s, %zu pictures\n", part.path.c_str(),
              evaluate::dataSetFormatNames()[static_cast<std::size_t>(part.format)].c_str(),
              options.frames.size());
  if (part.room.without_room == 0) return;
  constexpr double kMostSteps = 65535.0;
  std::printf(
      "  depth: %.1f %% of the pixels that see something have 0, since it is too far or too near: 16 bit "
      "hold %.3g m to %.5g m at --depth-scale %g (told of %d pictures made now)\n",
      100.0 * static_cast<double>(part.room.without_room) / static_cast<double>(part.room.seen),
      1.0 / options.data_set.depth_scale, kMostSteps / options.data_set.depth_scale,
      options.data_set.depth_scale, part.made);
}

void exportDataSets(const ExportOptions& options) {
  const FolderRecipe recipe(options.output, "export_dataset", options.recipe);
  recipe.requireNoStranger(anythingIn(options.output));
  image::removeUnfinished(options.output);
  std::vector<Hour> hours = hoursOf(options);
  makePictures(options, recipe, &hours);
  for (const Hour& hour : hours) {
    for (const Part& part : hour.parts) {
      part.folder.finish(options.frames);
      tell(part, options);
    }
  }
}

}  // namespace
}  // namespace sunlit::tools

int main(int argc, char** argv) {
  using namespace sunlit::tools;
  return sunlit::studio::runProgram({"export_dataset", argc, argv}, parseExportOptions, exportDataSets);
}
