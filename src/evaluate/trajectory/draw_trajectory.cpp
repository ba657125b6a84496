#include "sunlit/evaluate/trajectory/draw_trajectory.h"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <fstream>
#include <iterator>
#include <map>
#include <opencv2/imgproc.hpp>
#include <sstream>
#include <stdexcept>

#include "sunlit/image/files.h"
#include "sunlit/quantity/utf8.h"

namespace sunlit::evaluate {
namespace {

constexpr int kWidth = 1200;  // px
constexpr int kHeight = 1000;
const cv::Rect kPlan(70, 50, 1000, 620);
const cv::Rect kPlot(70, 750, 1000, 190);
const cv::Rect kBar(1100, 50, 20, 620);
const cv::Scalar kInk(40, 40, 40), kFaint(215, 215, 215), kTruth(130, 130, 130), kJoin(190, 190, 190);
// Points are drawn to 1/16 px.
constexpr int kShift = 4;
constexpr double kSubpixels = 1 << kShift;

/// Where metres lie on the sheet.
struct Axes {
  cv::Rect frame;
  double x_min, y_min;  ///< m, at the frame's lower left corner
  double px_per_x, px_per_y;

  cv::Point2d at(double x, double y) const {
    return {frame.x + (x - x_min) * px_per_x, frame.y + frame.height - (y - y_min) * px_per_y};
  }
};

cv::Point subpixels(const cv::Point2d& point) {
  return {cvRound(point.x * kSubpixels), cvRound(point.y * kSubpixels)};
}

class Sheet {
 public:
  Sheet() : picture_(kWidth, kHeight), mat_(kHeight, kWidth, CV_8UC3, picture_.data.data()) {
    mat_.setTo(cv::Scalar::all(255));
  }

  void line(const cv::Point2d& from, const cv::Point2d& to, const cv::Scalar& ink, int width = 1) {
    cv::line(mat_, subpixels(from), subpixels(to), ink, width, cv::LINE_AA, kShift);
  }
  void dot(const cv::Point2d& at, const cv::Scalar& ink) {
    cv::circle(mat_, subpixels(at), cvRound(2.0 * kSubpixels), ink, cv::FILLED, cv::LINE_AA, kShift);
  }
  void frame(const cv::Rect& rect) { cv::rectangle(mat_, rect, kInk); }
  void fill(const cv::Rect& rect, const cv::Scalar& ink) { cv::rectangle(mat_, rect, ink, cv::FILLED); }

  /// Its lower left corner at `at`, or its right end with `ends`.
  void text(const std::string& text, cv::Point at, bool ends = false) {
    constexpr double kScale = 0.45;
    if (ends) at.x -= cv::getTextSize(text, cv::FONT_HERSHEY_SIMPLEX, kScale, 1, nullptr).width;
    cv::putText(mat_, text, at, cv::FONT_HERSHEY_SIMPLEX, kScale, kInk, 1, cv::LINE_AA);
  }

  /// Half as strong as it is, within `axes`.
  void under(const Axes& axes, const MapPicture& map) {
    const cv::Mat picture(map.picture.height, map.picture.width, CV_8UC3,
                          const_cast<std::uint8_t*>(map.picture.data.data()));
    const double across = axes.px_per_x * (map.x_max - map.x_min) / picture.cols;
    const double down = axes.px_per_y * (map.y_max - map.y_min) / picture.rows;
    const cv::Point2d corner = axes.at(map.x_min, map.y_max) - cv::Point2d(axes.frame.tl());
    // From the middle of a pixel to the middle of another.
    const cv::Matx23d sheet_from_map(across, 0, corner.x + 0.5 * across - 0.5, 0, down,
                                     corner.y + 0.5 * down - 0.5);
    cv::Mat laid;
    cv::warpAffine(picture, laid, sheet_from_map, axes.frame.size(), cv::INTER_LINEAR, cv::BORDER_CONSTANT,
                   cv::Scalar::all(255));
    laid.convertTo(mat_(axes.frame), CV_8UC3, 0.5, 127.5);
  }

  image::Rgb8Image take() { return std::move(picture_); }

 private:
  image::Rgb8Image picture_;
  cv::Mat mat_;  ///< red first, over picture_
};

/// 256 colours from no error to the largest; red first.
std::vector<cv::Scalar> colours() {
  cv::Mat ramp(1, 256, CV_8UC1), coloured;
  for (int i = 0; i < 256; ++i) ramp.at<std::uint8_t>(0, i) = static_cast<std::uint8_t>(i);
  cv::applyColorMap(ramp, coloured, cv::COLORMAP_JET);
  std::vector<cv::Scalar> result;
  for (int i = 0; i < 256; ++i) {
    const auto& bgr = coloured.at<cv::Vec3b>(0, i);
    result.emplace_back(bgr[2], bgr[1], bgr[0]);
  }
  return result;
}

/// The roundest of 1, 2 and 5 times a power of ten of which about `wanted` fill `length`.
double stepOf(double length, int wanted) {
  const double step = std::pow(10.0, std::floor(std::log10(length / wanted)));
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (length / (factor * step) <= wanted) return factor * step;
  }
  return 10.0 * step;
}

/// Lines across `axes` with their numbers, in both directions.
void drawGrid(const Axes& axes, int wanted_x, int wanted_y, Sheet* sheet) {
  const double x_length = axes.frame.width / axes.px_per_x, y_length = axes.frame.height / axes.px_per_y;
  const double x_step = stepOf(x_length, wanted_x), y_step = stepOf(y_length, wanted_y);
  const cv::Rect& frame = axes.frame;
  const auto multiples = [](double from, double length, double step) {
    std::vector<double> values;
    const double first = std::ceil(from / step);
    for (int k = 0; (first + k) * step <= from + length && k < 100; ++k)
      values.push_back((first + k) * step + 0.0);
    return values;
  };
  for (const double x : multiples(axes.x_min, x_length, x_step)) {
    const cv::Point2d foot = axes.at(x, axes.y_min);
    sheet->line(foot, {foot.x, static_cast<double>(frame.y)}, kFaint);
    sheet->text(textOf(x), {cvRound(foot.x) - 8, frame.y + frame.height + 18});
  }
  for (const double y : multiples(axes.y_min, y_length, y_step)) {
    const cv::Point2d foot = axes.at(axes.x_min, y);
    sheet->line(foot, {static_cast<double>(frame.x + frame.width), foot.y}, kFaint);
    sheet->text(textOf(y), {frame.x - 6, cvRound(foot.y) + 5}, true);
  }
  sheet->frame(frame);
}

/// With all of both trajectories within, and one scale in both directions.
Axes planOf(const Trajectory& truth, const Trajectory& estimate) {
  Eigen::AlignedBox2d box;
  for (const Trajectory* trajectory : {&truth, &estimate}) {
    for (const StampedPose& pose : *trajectory) box.extend(pose.position.head<2>());
  }
  constexpr double kMargin = 1.08, kLeast_m = 1e-3;
  const Eigen::Vector2d size = kMargin * box.sizes().cwiseMax(kLeast_m);
  const double scale = std::min(kPlan.width / size.x(), kPlan.height / size.y());
  return {kPlan, box.center().x() - 0.5 * kPlan.width / scale, box.center().y() - 0.5 * kPlan.height / scale,
          scale, scale};
}

struct Errors {
  explicit Errors(const TrajectoryEvaluation& evaluation)
      : matched(evaluation.matched),
        each(evaluation.absolute.translation_m),
        largest(*std::max_element(each.begin(), each.end())) {}

  const cv::Scalar& colour(std::size_t i) const {
    return palette[largest > 0.0 ? static_cast<std::size_t>(255.0 * each[i] / largest) : 0];
  }

  const MatchedPoses& matched;
  const std::vector<double>& each;
  double largest;
  std::vector<cv::Scalar> palette = colours();
};

void drawPlan(const Trajectory& truth, const Errors& errors, const MapPicture* map, Sheet* sheet) {
  const MatchedPoses& matched = errors.matched;
  const Axes axes = planOf(truth, matched.estimate);
  const auto at = [&](const StampedPose& pose) { return axes.at(pose.position.x(), pose.position.y()); };
  if (map != nullptr) sheet->under(axes, *map);
  drawGrid(axes, 10, 6, sheet);
  for (std::size_t i = 0; i < matched.truth.size(); ++i)
    sheet->line(at(matched.truth[i]), at(matched.estimate[i]), kJoin);
  for (std::size_t i = 1; i < truth.size(); ++i) sheet->line(at(truth[i - 1]), at(truth[i]), kTruth, 2);
  for (std::size_t i = 0; i < matched.truth.size(); ++i) {
    if (i > 0) sheet->line(at(matched.estimate[i - 1]), at(matched.estimate[i]), errors.colour(i), 2);
    sheet->dot(at(matched.estimate[i]), errors.colour(i));
  }
  sheet->text("seen from above, m; grey: truth; coloured: estimate, by its absolute error",
              {kPlan.x, kPlan.y - 12});
}

void drawBar(const Errors& errors, Sheet* sheet) {
  for (int y = 0; y < kBar.height; ++y) {
    const auto colour = static_cast<std::size_t>(255 - 255 * y / (kBar.height - 1));
    sheet->fill({kBar.x, kBar.y + y, kBar.width, 1}, errors.palette[colour]);
  }
  sheet->text(textOf(errors.largest, 3) + " m", {kBar.x - 5, kBar.y - 8});
  sheet->text("0", {kBar.x + 5, kBar.y + kBar.height + 18});
}

void drawPlot(const Errors& errors, Sheet* sheet) {
  const Trajectory& truth = errors.matched.truth;
  std::vector<double> path(1, 0.0);
  for (std::size_t i = 1; i < truth.size(); ++i)
    path.push_back(path.back() + (truth[i].position - truth[i - 1].position).norm());
  const auto above0 = [](double size) { return size > 0.0 ? size : 1.0; };
  const Axes axes{kPlot, 0.0, 0.0, kPlot.width / above0(path.back()),
                  kPlot.height / above0(1.05 * errors.largest)};
  drawGrid(axes, 10, 4, sheet);
  for (std::size_t i = 0; i < truth.size(); ++i) {
    const cv::Point2d at = axes.at(path[i], errors.each[i]);
    if (i > 0) sheet->line(axes.at(path[i - 1], errors.each[i - 1]), at, kTruth);
    sheet->dot(at, errors.colour(i));
  }
  sheet->text("absolute error, m, along the matched poses of the truth, m", {kPlot.x, kPlot.y - 12});
}

}  // namespace

MapPicture readMapPicture(const std::string& folder) {
  const std::string file = folder + "/map.yaml";
  std::ifstream read(file);
  if (!read) throw std::runtime_error(file + ": cannot be opened: " + std::strerror(errno));
  std::istringstream stream(utf8Of({std::istreambuf_iterator<char>(read), {}}, file));
  std::map<std::string, double> extent;
  std::string key;
  for (double value = 0.0; stream >> key >> value;) extent[key] = value;
  for (const char* needed : {"x_min:", "x_max:", "y_min:", "y_max:"}) {
    if (extent.count(needed) == 0) throw std::runtime_error(file + ": has no line \"" + needed + " METRES\"");
  }
  MapPicture map{image::readPng(folder + "/map.png"), extent["x_min:"], extent["x_max:"], extent["y_min:"],
                 extent["y_max:"]};
  if (!(map.x_min < map.x_max && map.y_min < map.y_max))
    throw std::runtime_error(file + ": x_min must be below x_max, and y_min below y_max");
  return map;
}

image::Rgb8Image drawTrajectory(const Trajectory& truth, const TrajectoryEvaluation& evaluation,
                                const MapPicture* map) {
  Sheet sheet;
  const Errors errors(evaluation);
  drawPlan(truth, errors, map, &sheet);
  drawBar(errors, &sheet);
  drawPlot(errors, &sheet);
  return sheet.take();
}

}  // namespace sunlit::evaluate
