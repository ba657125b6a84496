// A day as one camera sees it.
#include <chrono>
#include <cmath>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <memory>
#include <string>

#include "ros/tools/arguments.h"
#include "ros/tools/frame_folder.h"
#include "ros/tools/lit_world.h"
#include "ros/tools/pictures_of_day.h"
#include "ros/tools/sky_of_instant.h"
#include "ros/tools/timelapse_options.h"

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

std::string captionOf(Caption caption, double hour, const SkyMoment& sky) {
  if (caption == Caption::kHour) return clockTime(hour);
  const double lux = sky.day.groundIlluminance().luminance();
  char text[80];
  std::snprintf(text, sizeof text, lux < 100.0 ? "%s  sun %+.1f deg  %.2g lx" : "%s  sun %+.1f deg  %.0f lx",
                clockTime(hour).c_str(), sky.sun_elevation.deg(), lux);
  return text;
}

/// Made only once a frame is missing: loading takes longer than looking whether all frames are there.
class Camera {
 public:
  explicit Camera(const TimelapseOptions& options)
      : options_(options),
        world_(loadWorld(options.view.world)),
        sky_(options.place),
        renderer_(world_, options.view.render) {
    renderer_.look(options.view.map_from_optical);
  }

  image::Rgb8Image take(int frame) {
    const ViewOptions& view = options_.view;
    const double hour = options_.hourOf(frame);
    const SkyMoment sky = sky_.at(hour);
    image::LinearImage luminance = renderer_.light(light::illumination(world_, sky.day));
    const double ev100 = image::chooseEv100(luminance, view.exposure);
    if (view.noise.enabled) image::addSensorNoise(ev100, view.noise, {frame, "timelapse"}, &luminance);
    image::Rgb8Image picture = image::develop(luminance, ev100);
    if (options_.caption != Caption::kNone) {
      const double height = options_.caption == Caption::kHour ? 1.0 / 18.0 : 1.0 / 24.0;
      writeInto(captionOf(options_.caption, hour, sky), height, &picture);
    }
    std::printf("frame %d of %d: %s, sun %+.2f deg, moon %+.1f deg, %.0f %% lit, %.3g lx, EV100 %.2f",
                frame + 1, options_.frames, clockTime(hour).c_str(), sky.sun_elevation.deg(),
                sky.moon_elevation.deg(), 100.0 * sky.moon_illuminated_fraction,
                static_cast<double>(sky.day.groundIlluminance().luminance()), ev100);
    return picture;
  }

 private:
  const TimelapseOptions& options_;
  light::World world_;
  SkyOfInstant sky_;
  render::Renderer renderer_;
};

void makeFrames(const TimelapseOptions& options, FrameFolder* folder) {
  using Clock = std::chrono::steady_clock;
  const image::PinholeCamera& camera = options.view.render.camera;
  std::unique_ptr<Camera> photographer;
  std::vector<int> wanted;
  for (int i = 0; i < options.frames; ++i) {
    if (!folder->has(i, camera.width, camera.height)) wanted.push_back(i);
  }
  if (wanted.empty()) return;
  if (static_cast<int>(wanted.size()) < options.frames)
    std::printf("%d frames are there already\n", options.frames - static_cast<int>(wanted.size()));
  photographer = std::make_unique<Camera>(options);
  const Clock::time_point begin = Clock::now();
  for (std::size_t done = 0; done < wanted.size();) {
    folder->write(wanted[done], photographer->take(wanted[done]));
    ++done;
    const double spent_s = std::chrono::duration<double>(Clock::now() - begin).count();
    const double left_s = spent_s / static_cast<double>(done) * static_cast<double>(wanted.size() - done);
    std::printf("; %.0f s left\n", left_s);
    std::fflush(stdout);
  }
}

void makeTimelapse(const TimelapseOptions& options) {
  FrameFolder folder(options.output, options.recipe);
  makeFrames(options, &folder);
  const Frames frames{options.frames, [&](int frame) { return folder.read(frame); }};
  if (!options.video.empty()) writeVideo(options.video, options.frame_rate, frames);
  if (!options.contact_sheet.empty()) writeContactSheet(options.contact_sheet, options.sheet, frames);
  std::printf("%s: %d frames\n", options.output.c_str(), options.frames);
}

}  // namespace
}  // namespace sunlit::tools

int main(int argc, char** argv) {
  using namespace sunlit::tools;
  return runTool("timelapse", argc, argv, parseTimelapseOptions, printTimelapseHelp, makeTimelapse);
}
