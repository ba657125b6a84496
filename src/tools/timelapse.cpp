// A day as one camera sees it.
#include <chrono>
#include <cmath>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <memory>
#include <string>

#include "sunlit/image/files.h"
#include "sunlit/image/picture_series.h"
#include "sunlit/quantity/duration.h"
#include "sunlit/studio/command_line.h"
#include "sunlit/studio/sky.h"
#include "sunlit/studio/studio.h"
#include "tools/blind_poses.h"
#include "tools/frame_folder.h"
#include "tools/place_arguments.h"
#include "tools/terminal.h"
#include "tools/timelapse_options.h"

namespace sunlit::tools {
namespace {

/// "04:30" of any hour.
std::string clockTime(double hour) {
  const long minutes = std::lround(hour * 60.0);
  const long of_day = (minutes % 1440 + 1440) % 1440;
  char text[16];
  std::snprintf(text, sizeof text, "%02ld:%02ld", of_day / 60, of_day % 60);
  return text;
}

struct Sun {
  double elevation_deg = 0.0;  ///< apparent
  double lux = 0.0;            ///< with the whole sky, on level ground
};

std::string captionOf(Caption caption, double hour, const Sun& sun) {
  if (caption == Caption::kHour) return clockTime(hour);
  char text[80];
  std::snprintf(text, sizeof text,
                sun.lux < 100.0 ? "%s  sun %+.1f deg  %.2g lx" : "%s  sun %+.1f deg  %.0f lx",
                clockTime(hour).c_str(), sun.elevation_deg, sun.lux);
  return text;
}

/// Made only once a frame is missing: loading takes longer than looking whether all frames are there.
class Camera {
 public:
  explicit Camera(const TimelapseOptions& options)
      : options_(options),
        studio_(options.view.studio, std::nullopt, onTerminal()),
        sky_(skyOver(studio_, options.place)) {
    studio_.look(options.view.placeIn(studio_), {}, options.view.motion);
    warnIfBlind(studio_);
  }

  image::Rgb8Image take(int frame) {
    const double hour = options_.hourOf(frame);
    const studio::SkyBodies bodies = bodiesOf(options_.place, hour);
    const sky::Daylight day = sky_.daylight(bodies, weatherAt(options_.place, hour));
    studio::Developed developed = studio_.photograph(studio_.illumination(day), {frame, "timelapse"});
    const Sun sun{bodies.sun.apparent.elevation().deg(), day.groundIlluminance().luminance()};
    if (options_.caption != Caption::kNone) {
      const double height = options_.caption == Caption::kHour ? 1.0 / 18.0 : 1.0 / 24.0;
      image::writeInto(captionOf(options_.caption, hour, sun), height, &developed.picture);
    }
    std::printf("frame %d of %d: %s, sun %+.2f deg, moon %+.1f deg, %.0f %% lit%s, %.3g lx, EV100 %.2f",
                frame + 1, options_.frames, clockTime(hour).c_str(), sun.elevation_deg,
                bodies.moon->apparent.elevation().deg(), 50.0 * (1.0 + cos(bodies.moon->phase_angle)),
                textOfEclipse(bodies).c_str(), sun.lux, developed.ev100);
    return developed.picture;
  }

  std::string fingerprint() const { return light::fingerprint(studio_.world()); }

 private:
  const TimelapseOptions& options_;
  studio::Studio studio_;
  studio::Sky sky_;
};

void makeFrames(const TimelapseOptions& options, FrameFolder* folder) {
  using Clock = std::chrono::steady_clock;
  const image::PinholeCamera& camera = options.view.studio.render.camera;
  std::unique_ptr<Camera> photographer;
  std::vector<int> wanted;
  for (int i = 0; i < options.frames; ++i) {
    if (!folder->has(i, camera.width, camera.height)) wanted.push_back(i);
  }
  if (wanted.empty()) return;
  if (static_cast<int>(wanted.size()) < options.frames)
    std::printf("%d frames are there already\n", options.frames - static_cast<int>(wanted.size()));
  photographer = std::make_unique<Camera>(options);
  folder->begin(photographer->fingerprint());
  const Clock::time_point begin = Clock::now();
  for (std::size_t done = 0; done < wanted.size();) {
    folder->write(wanted[done], photographer->take(wanted[done]));
    ++done;
    const double spent_s = std::chrono::duration<double>(Clock::now() - begin).count();
    const double left_s = spent_s / static_cast<double>(done) * static_cast<double>(wanted.size() - done);
    std::printf("; %s left\n", textOfDuration(left_s).c_str());
    std::fflush(stdout);
  }
}

void makeTimelapse(const TimelapseOptions& options) {
  FrameFolder folder(options.output, options.recipe);
  image::removeUnfinished(options.output);
  for (const std::string& beside : {options.video, options.contact_sheet}) {
    if (!beside.empty()) image::removeUnfinishedOf(beside);
  }
  makeFrames(options, &folder);
  const image::PictureSeries frames{options.frames, [&](int frame) { return folder.read(frame); }};
  if (!options.video.empty()) image::writeFilm(options.video, options.frame_rate, frames);
  if (!options.contact_sheet.empty()) image::writeContactSheet(options.contact_sheet, options.sheet, frames);
  std::printf("%s: %d frames\n", options.output.c_str(), options.frames);
}

}  // namespace
}  // namespace sunlit::tools

int main(int argc, char** argv) {
  using namespace sunlit::tools;
  return sunlit::studio::runProgram({"timelapse", argc, argv}, parseTimelapseOptions, makeTimelapse);
}
