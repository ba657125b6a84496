#include "render/frustum.h"

#include <algorithm>

namespace sunlit::render {

Frustum::Frustum(const View& view) {
  const double left = -0.5, top = -0.5;
  const double right = view.camera.width - 0.5, bottom = view.camera.height - 0.5;
  const std::array<Eigen::Vector3d, 4> corners = {view.ray(left, top), view.ray(right, top),
                                                  view.ray(right, bottom), view.ray(left, bottom)};
  const Eigen::Vector3d eye = view.eye();
  for (std::size_t i = 0; i < 4; ++i) {
    const Eigen::Vector3d inwards = corners[i].cross(corners[(i + 1) % 4]).normalized();
    sides_[i] = {inwards, inwards.dot(eye)};
  }
  const Eigen::Vector3d forward = view.map_from_optical.linear().col(2);
  sides_[4] = {forward, forward.dot(eye) + view.near_m};
  sides_[5] = {-forward, -(forward.dot(eye) + view.far_m)};
}

bool Frustum::touches(const Eigen::AlignedBox3f& box) const {
  const Eigen::Vector3d centre = box.center().cast<double>();
  const Eigen::Vector3d half = 0.5 * box.sizes().cast<double>();
  return std::all_of(sides_.begin(), sides_.end(), [&](const HalfSpace& side) {
    // A millimetre against rounding, and half a step of the rasterizer's grid at any distance.
    const double reach = side.inwards.cwiseAbs().dot(half) + 1e-3;
    return side.inwards.dot(centre) + reach >= side.offset;
  });
}

}  // namespace sunlit::render
