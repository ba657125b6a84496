// One picture of a world under a given sun.
#include <cmath>
#include <cstdio>
#include <exception>
#include <memory>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <stdexcept>

#include "ros/tools/snapshot_options.h"
#include "sunlit/scene/load.h"
#include "sunlit/sky/atmosphere.h"

namespace sunlit::tools {
namespace {

void write(const std::string& file, const cv::Mat& picture) {
  bool written = false;
  std::string reason;
  try {
    written = cv::imwrite(file, picture);
  } catch (const cv::Exception& error) {
    reason = ": " + error.err;
  }
  if (!written) throw std::runtime_error("cannot write " + file + reason);
}

void writePicture(const std::string& file, const image::Rgb8Image& picture) {
  cv::Mat bgr(picture.height, picture.width, CV_8UC3);
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) {
      const std::uint8_t* rgb = picture.at(x, y);
      bgr.at<cv::Vec3b>(y, x) = {rgb[2], rgb[1], rgb[0]};
    }
  }
  write(file, bgr);
}

bool endsWith(const std::string& text, const std::string& end) {
  return text.size() >= end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

void writeDepth(const std::string& file, image::DepthImage depth) {
  cv::Mat metres(depth.height, depth.width, CV_32FC1, depth.data.data());
  if (!endsWith(file, ".png")) {
    write(file, metres);
    return;
  }
  cv::Mat millimetres(depth.height, depth.width, CV_16UC1);
  for (int y = 0; y < depth.height; ++y) {
    for (int x = 0; x < depth.width; ++x) {
      const float mm = *depth.at(x, y) * 1000.0f;
      const bool fits = std::isfinite(mm) && mm < 65535.5f;
      millimetres.at<std::uint16_t>(y, x) = fits ? static_cast<std::uint16_t>(std::lround(mm)) : 0;
    }
  }
  write(file, millimetres);
}

void takeSnapshot(const SnapshotOptions& options) {
  const auto scene = std::make_shared<const scene::Scene>(
      scene::load(options.world, scene::SearchPath::withEnvironment(options.model_folders)));
  for (const std::string& warning : scene->warnings) std::fprintf(stderr, "warning: %s\n", warning.c_str());
  const sky::Atmosphere atmosphere{sky::AtmosphereOptions()};
  const sky::Daylight day =
      atmosphere.daylight({Direction(Azimuth(options.sun_azimuth), options.sun_elevation), 1.0});

  render::Renderer renderer(scene, options.render);
  renderer.look(options.map_from_optical);
  const image::LinearImage luminance = renderer.light(day);
  const double ev100 = image::chooseEv100(luminance, options.exposure);
  writePicture(options.output, image::develop(luminance, ev100));
  if (!options.depth_output.empty()) writeDepth(options.depth_output, renderer.depth());
  std::printf("%s: %zu triangles, EV100 %.2f, %.0f lx on level ground\n", options.output.c_str(),
              scene->triangleCount(), ev100, static_cast<double>(day.groundIlluminance().luminance()));
}

}  // namespace
}  // namespace sunlit::tools

int main(int argc, char** argv) {
  try {
    const auto options = sunlit::tools::parseSnapshotOptions({argv + 1, argv + argc});
    if (!options) {
      std::fputs(sunlit::tools::kSnapshotHelp, stdout);
      return 0;
    }
    sunlit::tools::takeSnapshot(*options);
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "snapshot: %s\n", error.what());
    return 1;
  }
}
