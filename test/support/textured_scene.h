/// Textured planes and what a camera sees of them, exactly: a scene whose every pixel and depth is known.
#pragma once

#include <cmath>
#include <limits>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "sunlit/evaluate/posed_view.h"

namespace sunlit::evaluate {

/// A rectangle with its corner at `corner`, spanned by `across` and `down`, m, that reflects blobs.
struct TexturedRectangle {
  Eigen::Vector3d corner, across, down;
  unsigned seed;
};

/// Grey blobs of 1 to 7 % of its width, smooth, so that a picture may look at it from near and far.
inline cv::Mat blobs(unsigned seed) {
  constexpr int kSide = 800;
  cv::RNG random(seed);
  cv::Mat texture(kSide, kSide, CV_8UC1, cv::Scalar(128));
  for (int i = 0; i < 900; ++i) {
    const cv::Point centre(random.uniform(0, kSide), random.uniform(0, kSide));
    cv::circle(texture, centre, random.uniform(4, 28), cv::Scalar(random.uniform(0, 256)), -1);
  }
  cv::GaussianBlur(texture, texture, cv::Size(0, 0), 2.0);
  return texture;
}

inline double textureAt(const cv::Mat& texture, double x, double y) {
  const int left = std::min(static_cast<int>(x), texture.cols - 2);
  const int top = std::min(static_cast<int>(y), texture.rows - 2);
  const double right = x - left, below = y - top;
  const auto at = [&](int dx, int dy) { return texture.at<uchar>(top + dy, left + dx); };
  return (1 - below) * ((1 - right) * at(0, 0) + right * at(1, 0)) +
         below * ((1 - right) * at(0, 1) + right * at(1, 1));
}

class TexturedScene {
 public:
  explicit TexturedScene(std::vector<TexturedRectangle> rectangles) : rectangles_(std::move(rectangles)) {
    for (const TexturedRectangle& rectangle : rectangles_) textures_.push_back(blobs(rectangle.seed));
  }

  /// By one ray through the centre of each pixel, by its lens; black, and NaN in depth, where nothing is.
  PosedView seenFrom(const Eigen::Isometry3d& map_from_optical, const ViewCamera& camera) const {
    PosedView view;
    view.camera = camera;
    view.map_from_optical = map_from_optical;
    view.depth =
        cv::Mat(camera.height, camera.width, CV_32FC1, cv::Scalar(std::numeric_limits<float>::quiet_NaN()));
    cv::Mat rgb(camera.height, camera.width, CV_8UC3, cv::Scalar::all(0));
    for (int y = 0; y < camera.height; ++y) {
      for (int x = 0; x < camera.width; ++x) look(&view, &rgb, x, y);
    }
    view.picture = makePicture(rgb);
    return view;
  }

 private:
  void look(PosedView* view, cv::Mat* rgb, int x, int y) const {
    const Eigen::Vector3d origin = view->map_from_optical.translation();
    const auto optical_ray = view->camera.unproject({x, y});
    if (!optical_ray) return;
    const Eigen::Vector3d ray = view->map_from_optical.linear() * *optical_ray;
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < rectangles_.size(); ++i) {
      const TexturedRectangle& r = rectangles_[i];
      Eigen::Matrix3d basis;
      basis << r.across, r.down, -ray;
      const Eigen::Vector3d hit = basis.inverse() * (origin - r.corner);  // share across, share down, depth
      if (!(hit.z() > 0.0 && hit.z() < nearest) || hit.x() < 0 || hit.x() > 1 || hit.y() < 0 || hit.y() > 1)
        continue;
      nearest = hit.z();
      const double grey =
          textureAt(textures_[i], hit.x() * (textures_[i].cols - 1), hit.y() * (textures_[i].rows - 1));
      rgb->at<cv::Vec3b>(y, x) = cv::Vec3b::all(cv::saturate_cast<uchar>(grey));
      view->depth.at<float>(y, x) = static_cast<float>(nearest);
    }
  }

  std::vector<TexturedRectangle> rectangles_;
  std::vector<cv::Mat> textures_;
};

/// A camera at `place` that looks along +x of `map`, z up, turned to its left.
inline Eigen::Isometry3d lookingAlongX(const Eigen::Vector3d& place, double yaw_rad = 0.0) {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.translation() = place;
  Eigen::Matrix3d link_from_optical;
  link_from_optical << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  pose.linear() = Eigen::AngleAxisd(yaw_rad, Eigen::Vector3d::UnitZ()).toRotationMatrix() * link_from_optical;
  return pose;
}

/// A corridor 6 m wide and 4 m high with an end wall 12 m ahead of the origin, along +x.
inline TexturedScene corridor() {
  return TexturedScene({{{12, 3, 3}, {0, -6, 0}, {0, 0, -4}, 1},     // end
                        {{-4, 3, 3}, {16, 0, 0}, {0, 0, -4}, 2},     // left
                        {{12, -3, 3}, {-16, 0, 0}, {0, 0, -4}, 3},   // right
                        {{12, 3, -1}, {0, -6, 0}, {-16, 0, 0}, 4},   // floor
                        {{4, 1, 1}, {0, -1.5, 0}, {0, 0, -2}, 5}});  // a board that stands in the way
}

}  // namespace sunlit::evaluate
