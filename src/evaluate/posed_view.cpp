#include "sunlit/evaluate/posed_view.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace sunlit::evaluate {
namespace {

constexpr double kAlike = 0.02;  // of the larger inverse depth
constexpr double kBend = 0.1;    // of the difference of two neighbours

/// 1/z of pixels; 0 where nothing is seen, and outside.
class InverseDepth {
 public:
  explicit InverseDepth(const cv::Mat& depth) : depth_(depth) {}

  double at(int x, int y) const {
    if (x < 0 || y < 0 || x >= depth_.cols || y >= depth_.rows) return 0.0;
    const double z = depth_.at<float>(y, x);
    return std::isfinite(z) && z > 0.0 ? 1.0 / z : 0.0;
  }
  /// Whether the pixel and its neighbour, so many steps on, show one surface.
  bool areJoined(int x, int y, int right, int down) const {
    const double here = at(x, y);
    const double there = at(x + right, y + down);
    if (here == 0.0 || there == 0.0) return false;
    const double step = there - here;
    if (std::abs(step) <= kAlike * std::max(here, there)) return true;
    const double before = at(x - right, y - down);
    const double behind = at(x + 2 * right, y + 2 * down);
    const double bend = kBend * std::abs(step);
    return (before != 0.0 && std::abs(here - before - step) <= bend) ||
           (behind != 0.0 && std::abs(behind - there - step) <= bend);
  }

 private:
  const cv::Mat& depth_;
};

std::string sizeOf(int width, int height) {
  return std::to_string(width) + "x" + std::to_string(height) + " px";
}

void requireSize(const char* what, const cv::Mat& pixels, const image::PinholeCamera& camera) {
  if (pixels.cols == camera.width && pixels.rows == camera.height) return;
  throw std::invalid_argument(std::string(what) + " is " + sizeOf(pixels.cols, pixels.rows) +
                              ", but must be " + sizeOf(camera.width, camera.height) + " as its camera");
}

}  // namespace

void requireWhole(const PosedView& view) {
  requireSize("the picture", view.picture.grey, view.camera);
  if (view.depth.empty()) return;
  requireSize("depth", view.depth, view.camera);
  if (view.depth.type() != CV_32FC1) throw std::invalid_argument("depth must be of 32-bit floats");
}

std::optional<double> depthAt(const cv::Mat& depth, const Eigen::Vector2d& pixel) {
  if (!(pixel.x() >= -0.5 && pixel.x() < depth.cols - 0.5)) return std::nullopt;
  if (!(pixel.y() >= -0.5 && pixel.y() < depth.rows - 0.5)) return std::nullopt;
  const InverseDepth inverse(depth);
  const int x = static_cast<int>(std::floor(pixel.x()));
  const int y = static_cast<int>(std::floor(pixel.y()));
  const double right = pixel.x() - x;
  const double down = pixel.y() - y;
  if (inverse.areJoined(x, y, 1, 0) && inverse.areJoined(x, y + 1, 1, 0) && inverse.areJoined(x, y, 0, 1) &&
      inverse.areJoined(x + 1, y, 0, 1)) {
    const double above = (1.0 - right) * inverse.at(x, y) + right * inverse.at(x + 1, y);
    const double below = (1.0 - right) * inverse.at(x, y + 1) + right * inverse.at(x + 1, y + 1);
    return 1.0 / ((1.0 - down) * above + down * below);
  }
  const double nearest = inverse.at(static_cast<int>(std::floor(pixel.x() + 0.5)),
                                    static_cast<int>(std::floor(pixel.y() + 0.5)));
  if (nearest == 0.0) return std::nullopt;
  return 1.0 / nearest;
}

std::optional<Eigen::Vector3d> pointAt(const PosedView& view, const Eigen::Vector2d& pixel) {
  const auto depth = depthAt(view.depth, pixel);
  const auto ray = view.camera.unproject(pixel);
  if (!depth || !ray) return std::nullopt;
  return view.map_from_optical * (*depth * *ray);
}

}  // namespace sunlit::evaluate
