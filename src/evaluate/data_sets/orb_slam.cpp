#include "evaluate/data_sets/layout.h"

namespace sunlit::evaluate {
namespace {

std::string matrixText(const std::string& key, int columns, const std::vector<double>& numbers) {
  const int rows = static_cast<int>(numbers.size()) / columns;
  return key + ": !!opencv-matrix\n  rows: " + std::to_string(rows) + "\n  cols: " + std::to_string(columns) +
         "\n  dt: d\n  data: [" + fixedTexts(numbers, ", ") + "]\n";
}

/// What the examples of EuRoC rectify with, which these pictures are already.
std::string rectificationOf(const std::string& side, const DataSetOptions& options, double right_m) {
  const image::PinholeCamera& c = options.camera;
  std::string text = side + ".height: " + std::to_string(c.height) + '\n' + side +
                     ".width: " + std::to_string(c.width) + '\n';
  text += matrixText(side + ".D", 5, {0, 0, 0, 0, 0});
  text += matrixText(side + ".K", 3, {c.fx, 0, c.cx, 0, c.fy, c.cy, 0, 0, 1});
  text += matrixText(side + ".R", 3, {1, 0, 0, 0, 1, 0, 0, 0, 1});
  return text + matrixText(side + ".P", 4, {c.fx, 0, c.cx, -right_m * c.fx, 0, c.fy, c.cy, 0, 0, 0, 1, 0});
}

}  // namespace

// The form of ORB-SLAM2 and of its successor before 1.0, which later versions still take. They ask of each
// number whether it has a point. Numbers of the extractor, of the map and of the viewer are those of their
// example TUM1.yaml; there bf is 40 at a focal length of 517 px, a baseline of 0.077 m.
TextFile orbSlamSettings(const DataSetOptions& options) {
  const image::PinholeCamera& camera = options.camera;
  constexpr double kBaselineOfDepth_m = 40.0 / 517.306408;
  const bool has_right = options.baseline_m > 0.0;
  const auto line = [](const std::string& key, double number) {
    return key + ": " + fixedText(number) + '\n';
  };
  std::string text = "%YAML:1.0\n# Settings for ORB-SLAM2 and ORB-SLAM3.\n\nCamera.type: \"PinHole\"\n";
  text += line("Camera.fx", camera.fx) + line("Camera.fy", camera.fy);
  text += line("Camera.cx", camera.cx) + line("Camera.cy", camera.cy);
  for (const std::string key : {"k1", "k2", "p1", "p2"}) text += line("Camera." + key, 0.0);
  text += "Camera.width: " + std::to_string(camera.width) + '\n';
  text += "Camera.height: " + std::to_string(camera.height) + '\n';
  text += line("Camera.fps", options.rate_hz);
  text += "# OpenCV reads pictures blue first.\nCamera.RGB: 0\n";
  text +=
      "# Of depth: a stereo camera's baseline times fx, beyond how many baselines points are far, steps in a "
      "metre.\n";
  text += line("Camera.bf", (has_right ? options.baseline_m : kBaselineOfDepth_m) * camera.fx) +
          line("ThDepth", 40.0);
  text += line("DepthMapFactor", options.depth_scale);
  text +=
      "\nORBextractor.nFeatures: 1000\n"
      "ORBextractor.scaleFactor: 1.2\n"
      "ORBextractor.nLevels: 8\n"
      "ORBextractor.iniThFAST: 20\n"
      "ORBextractor.minThFAST: 7\n"
      "\nViewer.KeyFrameSize: 0.05\n"
      "Viewer.KeyFrameLineWidth: 1.0\n"
      "Viewer.GraphLineWidth: 0.9\n"
      "Viewer.PointSize: 2.0\n"
      "Viewer.CameraSize: 0.08\n"
      "Viewer.CameraLineWidth: 3.0\n"
      "Viewer.ViewpointX: 0.0\n"
      "Viewer.ViewpointY: -0.7\n"
      "Viewer.ViewpointZ: -1.8\n"
      "Viewer.ViewpointF: 500.0\n";
  if (has_right)
    text +=
        '\n' + rectificationOf("LEFT", options, 0.0) + rectificationOf("RIGHT", options, options.baseline_m);
  return {"orb_slam.yaml", text};
}

}  // namespace sunlit::evaluate
