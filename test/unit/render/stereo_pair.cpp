// Both cameras of a calibrated pair see a point where OpenCV, which rectifies, has it: in one row, f B / z
// apart.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <map>
#include <opencv2/calib3d.hpp>

#include "sunlit/image/stereo.h"
#include "test_scenes.h"

namespace sunlit::test {
namespace {

image::Calibration euroc(const std::string& name) {
  return image::readCalibration(SUNLIT_SOURCE_DIR "/test/support/cameras/" + name + ".yaml");
}

constexpr double kWall_m = 5.0, kRadius_m = 0.2;  // 17 px
constexpr int kAcross = 6, kDown = 4;

/// Discs in a plane across the axis of the rectified pair, `rect_from_map` away from the origin, each of a
/// material of its own; so each is a circle in the rectified picture.
scene::Scene discs(const Eigen::Isometry3d& map_from_rect) {
  constexpr int kCorners = 64;
  scene::Scene scene;
  for (int i = 0; i < kAcross * kDown; ++i) {
    const Eigen::Vector3d middle(0.9 * (i % kAcross) - 2.2, 0.9 * (i / kAcross) - 1.4, kWall_m);
    scene::Mesh mesh;
    mesh.material = addMaterial(&scene, {0.5f, 0.5f, 0.5f});
    mesh.name = "disc " + std::to_string(i);
    for (std::uint32_t k = 0; k < kCorners; ++k) {
      const double turn = 2.0 * kPi * k / kCorners;
      const Eigen::Vector3d corner =
          middle + kRadius_m * Eigen::Vector3d(std::cos(turn), std::sin(turn), 0.0);
      mesh.positions.push_back((map_from_rect * corner).cast<float>());
      mesh.normals.push_back((map_from_rect.linear() * -Eigen::Vector3d::UnitZ()).cast<float>());
      if (k >= 2) mesh.triangles.push_back({0, k - 1, k});
    }
    scene.meshes.push_back(mesh);
  }
  return scene;
}

cv::Mat matOf(const double* numbers, int rows, int columns) {
  return cv::Mat(rows, columns, CV_64F, const_cast<double*>(numbers)).clone();
}

/// OpenCV's way from pixels of the camera to those of the rectified picture.
class Rectification {
 public:
  explicit Rectification(const image::Calibration& camera)
      : k_(cv::Matx33d(camera.camera.fx, 0, camera.camera.cx, 0, camera.camera.fy, camera.camera.cy, 0, 0,
                       1)),
        d_(camera.distortion.coefficients),
        r_(matOf(camera.rectification.data(), 3, 3)),
        p_(matOf(camera.projection.data(), 3, 4)) {}

  Eigen::Vector2d operator()(double x, double y) const {
    std::vector<cv::Vec2d> rectified;
    const cv::TermCriteria until(cv::TermCriteria::COUNT | cv::TermCriteria::EPS, 100, 1e-12);
    cv::undistortPoints(std::vector<cv::Vec2d>{{x, y}}, rectified, k_, d_, r_, p_, until);
    return {rectified[0][0], rectified[0][1]};
  }

 private:
  cv::Matx33d k_;
  std::vector<double> d_;
  cv::Mat r_, p_;
};

/// The middle of each disc in the rectified picture, by material: each pixel by what it covers there.
std::map<int, Eigen::Vector2d> middlesOf(const light::Surfaces& surfaces, const Rectification& rectified) {
  std::map<int, Eigen::Vector3d> sums;
  for (const light::Tile& tile : surfaces.tiles) {
    for (const light::Surface& surface : tile.surfaces) {
      const auto pixel = static_cast<int>(surface.pixel);
      const double x = pixel % surfaces.width, y = pixel / surfaces.width;
      const Eigen::Vector2d across = rectified(x + 0.5, y) - rectified(x - 0.5, y),
                            down = rectified(x, y + 0.5) - rectified(x, y - 0.5);
      const double area = across.x() * down.y() - across.y() * down.x();
      sums.emplace(surface.material, Eigen::Vector3d::Zero());
      sums[surface.material] += surface.samples * area * rectified(x, y).homogeneous();
    }
  }
  std::map<int, Eigen::Vector2d> middles;
  for (const auto& [material, sum] : sums) middles[material] = sum.head<2>() / sum.z();
  return middles;
}

std::map<int, Eigen::Vector2d> middlesSeenBy(const image::Calibration& camera,
                                             const std::shared_ptr<const scene::Scene>& scene,
                                             const Eigen::Isometry3d& map_from_optical) {
  render::RenderOptions options;
  options.camera = camera.camera;
  options.distortion = camera.distortion;
  options.supersampling = 4;
  render::Renderer renderer(scene, options);
  renderer.look(map_from_optical);
  return middlesOf(renderer.surfaces(), Rectification(camera));
}

// Samples a quarter of a pixel apart leave the middle of one of 24 discs known to 0.013 px or so
// (lens_pictures), the difference of two to 1.4 times that; the discs lie up to half the picture from its
// middle, where a pixel counted as one of the same size all over would be 0.1 px off.
TEST(StereoPair, SeesAWallFiveMetresAwayAtTheDisparityOfItsCalibration) {
  const image::Calibration left = euroc("euroc");
  const image::RightCamera right = image::calibratedRight(left, euroc("euroc_right"), "");
  Eigen::Matrix3d rect_from_left;
  rect_from_left << left.rectification[0], left.rectification[1], left.rectification[2],
      left.rectification[3], left.rectification[4], left.rectification[5], left.rectification[6],
      left.rectification[7], left.rectification[8];
  const Eigen::Isometry3d map_from_left = lookingAt({3.0, -2.0, 1.5}, {9.0, 1.0, 2.0});
  const Eigen::Isometry3d map_from_rect = map_from_left * Eigen::Isometry3d(rect_from_left.transpose());
  const auto scene = shared(discs(map_from_rect));
  const std::map<int, Eigen::Vector2d> at_left = middlesSeenBy(left, scene, map_from_left),
                                       at_right = middlesSeenBy(right.calibration, scene,
                                                                map_from_left * right.left_from_right);
  ASSERT_EQ(at_left.size(), std::size_t{kAcross * kDown});
  ASSERT_EQ(at_right.size(), at_left.size());
  const double expected_px = 47.90639384423901 / kWall_m;  // f B of ORB-SLAM's file
  double worst_x = 0.0, worst_y = 0.0;
  for (const auto& [material, place] : at_left) {
    const Eigen::Vector2d apart = place - at_right.at(material);
    worst_x = std::max(worst_x, std::abs(apart.x() - expected_px));
    worst_y = std::max(worst_y, std::abs(apart.y()));
  }
  EXPECT_LT(worst_x, 0.03);
  EXPECT_LT(worst_y, 0.03);
  std::printf("disparity %.3f px within %.4f px, rows within %.4f px\n", expected_px, worst_x, worst_y);
}

}  // namespace
}  // namespace sunlit::test
