#include "ros/render/run_files.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include "sunlit/image/content_hash.h"
#include "sunlit/image/files.h"
#include "sunlit/quantity/range.h"
#include "sunlit/quantity/yaml_text.h"
#include "sunlit/studio/picture_maker.h"

namespace sunlit::ros_interface {

namespace {

std::string inputsText(const RunInputs& inputs) {
  return "sunlit: '" + studio::pictureMaker() + "'\nworld: '" + inputs.world + "'\npath: '" + inputs.path +
         "'\ncamera: '" + inputs.camera + "'\nrobot: '" + inputs.robot + "'\n";
}

/// The first line of `text` that `other` does not have in its place; empty if it has all.
std::string differingLine(const std::string& text, const std::string& other) {
  std::istringstream lines(text), other_lines(other);
  for (std::string line, other_line; std::getline(lines, line);)
    if (!std::getline(other_lines, other_line) || line != other_line) return line;
  return {};
}

/// Whether an evaluator has left values in the folder, which are not to be mixed with those of another world,
/// however few they are.
bool holdsValues(const std::string& folder) {
  std::ifstream frames(folder + "/frames.csv");
  std::string heading, row;
  return std::getline(frames, heading) && std::getline(frames, row);
}

void requireWritable(const std::string& folder) {
  const std::string probe = folder + "/.writable";
  image::writeFileAtomically(probe, {});
  std::error_code gone;  // another node may have looked too, just now
  std::filesystem::remove(probe, gone);
}

}  // namespace

std::string cameraPrint(const render::RenderOptions& left, const std::optional<image::RightCamera>& right) {
  image::ContentHash print;
  const auto add = [&print](const image::PinholeCamera& camera, const image::Distortion& distortion) {
    print.add(camera.width);
    print.add(camera.height);
    for (const double number : {camera.fx, camera.fy, camera.cx, camera.cy}) print.add(number);
    print.add(distortion.model);
    print.add(distortion.coefficients);
  };
  add(left.camera, left.distortion);
  if (right) {
    add(right->calibration.camera, right->calibration.distortion);
    const Eigen::Matrix4d placed = right->left_from_right.matrix();
    for (Eigen::Index i = 0; i < placed.size(); ++i) print.add(placed(i));
  }
  return print.text();
}

RunFiles::RunFiles(const std::string& folder, bool goes_on)
    : folder_(folder), goes_on_(goes_on || holdsValues(folder)) {
  image::makeFolder(folder_);
  requireWritable(folder_);
  if (goes_on_) earlier_ = studio::readTimeSheet(folder_ + "/timing.csv");
}

void RunFiles::keepInputs(const RunInputs& inputs) const {
  const std::string path = folder_ + "/inputs.yaml", now = inputsText(inputs);
  if (!goes_on_) return image::writeFileAtomically(path, now);
  std::ifstream file(path);
  const std::string then{std::istreambuf_iterator<char>(file), {}};
  const std::string differs = differingLine(now, then);
  if (differs.empty()) return image::writeFileAtomically(path, then);
  if (then.empty())
    throw std::runtime_error(path + ": is not there, so that nobody knows what the run in this folder was " +
                             "made from; choose another output folder");
  const bool is_of_another_version = differs.rfind("sunlit: ", 0) == 0;
  throw std::runtime_error(
      path + ": the run in this folder was made from something else: now \"" + differs +
      "\" is no line of this file; choose another output folder, or what it was begun with" +
      (is_of_another_version ? " (its results stay good: `rosrun sunlit report` draws their report again)"
                             : ""));
}

void RunFiles::keepRasterizer(const std::string& rasterizer) const {
  image::writeFileAtomically(folder_ + "/rasterizer.yaml", "rasterizer: " + yamlQuoted(rasterizer) + "\n");
}

void RunFiles::keepGround(double albedo) const {
  const std::string path = folder_ + "/ground.yaml", now = "ground_albedo: " + textOf(albedo) + "\n";
  std::ifstream file(path);
  const std::string then{std::istreambuf_iterator<char>(file), {}};
  if (goes_on_ && !then.empty() && then != now) {
    throw std::runtime_error(path + ": the run that was broken off in this folder has " +
                             then.substr(0, then.find('\n')) + ", and now it is " + textOf(albedo) +
                             "; choose another output folder, or atmosphere/ground_albedo as it was");
  }
  image::writeFileAtomically(path, now);
}

void RunFiles::writeMap(const image::Rgb8Image& map, const studio::MapExtent& extent) const {
  image::writePng(folder_ + "/map.png", map);
  image::writeFileAtomically(folder_ + "/map.yaml", "x_min: " + textOf(extent.x_min) +
                                                        "\nx_max: " + textOf(extent.x_max) +
                                                        "\ny_min: " + textOf(extent.y_min) +
                                                        "\ny_max: " + textOf(extent.y_max) + "\n");
}

bool RunFiles::hasMap() const {
  return goes_on_ && std::filesystem::exists(folder_ + "/map.png") &&
         std::filesystem::exists(folder_ + "/map.yaml");
}

void RunFiles::writeTiming(const studio::Stopwatch& stopwatch) const {
  studio::Stopwatch whole;
  whole.add(earlier_);
  whole.add(stopwatch.entries());
  std::ostringstream out;
  studio::writeTimeSheet(whole.entries(), out);
  image::writeFileAtomically(folder_ + "/timing.csv", out.str());
}

studio::MapExtent extentOf(const PathSource& path) {
  constexpr double kMarginM = 40.0;
  const Eigen::Vector3d begin = path.mapFromCamera(path.first()).translation();
  studio::MapExtent extent{begin.x(), begin.x(), begin.y(), begin.y()};
  for (int index = path.first(); index < path.end(); ++index) {
    const Eigen::Vector3d at = path.mapFromCamera(index).translation();
    extent.x_min = std::min(extent.x_min, at.x());
    extent.x_max = std::max(extent.x_max, at.x());
    extent.y_min = std::min(extent.y_min, at.y());
    extent.y_max = std::max(extent.y_max, at.y());
  }
  return studio::widened(
      {extent.x_min - kMarginM, extent.x_max + kMarginM, extent.y_min - kMarginM, extent.y_max + kMarginM});
}

}  // namespace sunlit::ros_interface
