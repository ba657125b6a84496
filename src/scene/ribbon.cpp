#include "scene/ribbon.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>

namespace sunlit::scene {
namespace {

/// To the left of a direction in the plane, of length 1.
Eigen::Vector2d leftOf(const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
  const Eigen::Vector2d along = (to - from).head<2>().normalized();
  return {-along.y(), along.x()};
}

/// Half the width, left of point i: along the bisector of the bend, and longer by its cosine.
Eigen::Vector2d leftEdge(const std::vector<Eigen::Vector3d>& points, std::size_t i, double half_width) {
  constexpr double kLeastCosine = 0.5;  // of half the turn
  const Eigen::Vector2d before = i > 0 ? leftOf(points[i - 1], points[i]) : leftOf(points[0], points[1]);
  const Eigen::Vector2d after = i + 1 < points.size() ? leftOf(points[i], points[i + 1]) : before;
  const Eigen::Vector2d sum = before + after;
  if (sum.norm() < 1e-9) return half_width * before;  // straight back
  const Eigen::Vector2d middle = sum.normalized();
  return half_width / std::max(kLeastCosine, middle.dot(after)) * middle;
}

}  // namespace

Mesh makeRibbon(const std::vector<Eigen::Vector3d>& points, double width) {
  Mesh mesh;
  std::vector<Eigen::Vector3d> line;
  for (const Eigen::Vector3d& point : points) {
    if (line.empty() || (point - line.back()).head<2>().norm() > 0.0) line.push_back(point);
  }
  if (line.size() < 2) return mesh;
  double along = 0.0;
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (i > 0) along += (line[i] - line[i - 1]).norm();
    const Eigen::Vector2d left = leftEdge(line, i, 0.5 * width);
    for (const double side : {1.0, -1.0}) {
      const Eigen::Vector3d edge = line[i] + side * Eigen::Vector3d(left.x(), left.y(), 0.0);
      mesh.positions.push_back(edge.cast<float>());
      mesh.texture_coordinates.emplace_back(side > 0.0 ? 0.0f : 1.0f, static_cast<float>(along / width));
    }
    if (i == 0) continue;
    const auto k = static_cast<std::uint32_t>(2 * (i - 1));  // left, right, next left, next right
    mesh.triangles.push_back({k, k + 1, k + 3});
    mesh.triangles.push_back({k, k + 3, k + 2});
  }
  return mesh;  // SceneBuilder makes the normals
}

}  // namespace sunlit::scene
