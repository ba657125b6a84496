#include "studio/top_down.h"

#include <algorithm>
#include <cmath>

namespace sunlit::studio {

namespace {

/// What is seen of the world from above at a place; its bottom where that is nothing.
double groundUnder(const light::World& world, const TopDown& ground, const Heights& heights) {
  const Eigen::Vector3d above(ground.x, ground.y, heights.top + 1.0);
  const auto seen = world.visibility->firstSeen(above.cast<float>(), -Eigen::Vector3f::UnitZ(), 0.0f);
  if (!seen) return heights.bottom;
  const scene::Plane& plane = world.geometry->planes[*seen];
  const Eigen::Vector3d normal = plane.normal.cast<double>();
  const double z = (plane.offset - normal.head<2>().dot(above.head<2>())) / normal.z();
  return std::clamp(z, heights.bottom, heights.top);  // of a plane that is nearly upright
}

}  // namespace

Heights heightsOf(const light::World& world) {
  const auto& positions = world.geometry->positions;
  if (positions.empty()) return {};
  const auto [low, high] =
      std::minmax_element(positions.begin(), positions.end(),
                          [](const Eigen::Vector3f& a, const Eigen::Vector3f& b) { return a.z() < b.z(); });
  return {static_cast<double>(low->z()), static_cast<double>(high->z())};
}

Perch perchOver(double ground_m, const Heights& heights, const Range& height_m) {
  const double near_m = 0.1 * height_m.low;
  const double above_m = std::min(heights.top - ground_m + height_m.low, height_m.high);
  return {above_m, near_m, above_m + ground_m - heights.bottom + near_m};
}

Overlook overlooking(const light::World& world, const TopDown& ground, const render::RenderOptions& render) {
  // The longest focal length that a camera may have allows 122 extents across 8192 px.
  constexpr double kLeast = 10.0, kMost = 100.0;
  const Heights heights = heightsOf(world);
  const double middle_m = groundUnder(world, ground, heights);
  const double extent_m = ground.extent_m;
  const Perch perch = perchOver(middle_m, heights, {kLeast * extent_m, kMost * extent_m});
  Overlook found{render, Eigen::Isometry3d::Identity()};
  found.render.camera =
      image::PinholeCamera::fromFieldOfView(render.camera.width, render.camera.height,
                                            Angle::radians(2.0 * std::atan(0.5 * extent_m / perch.height_m)));
  found.render.near_m = perch.near_m;
  found.render.far_m = perch.far_m;
  found.map_from_camera.linear() = topDownAxes();
  found.map_from_camera.translation() = Eigen::Vector3d(ground.x, ground.y, middle_m + perch.height_m);
  return found;
}

}  // namespace sunlit::studio
