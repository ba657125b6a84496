#include "sunlit/evaluate/verify/depth_maps.h"

#include <cmath>
#include <stdexcept>

namespace sunlit::evaluate {
namespace {

PointMap mapBetween(const PosedView& from, const PosedView& to) {
  const Eigen::Isometry3d to_from_map = to.map_from_optical.inverse();
  return [from, to, to_from_map](const Eigen::Vector2d& pixel) -> std::optional<Eigen::Vector2d> {
    const auto place = pointAt(from, pixel);
    if (!place) return std::nullopt;
    const Eigen::Vector3d seen = to_from_map * *place;
    if (!(seen.z() > 0.0)) return std::nullopt;
    const auto there = to.camera.project(seen);
    if (!there) return std::nullopt;
    const auto shown = depthAt(to.depth, *there);
    const double depth = to.camera.depthOf(seen);
    if (!shown || std::abs(*shown - depth) > kSameDepth * depth) return std::nullopt;
    return there;
  };
}

/// What the maps need of a view.
PosedView geometryOf(const PosedView& view) {
  requireWhole(view);
  if (view.depth.empty()) throw std::invalid_argument("a view has no depth, but both must have");
  return {{}, view.camera, view.map_from_optical, view.depth};
}

}  // namespace

PointMaps depthMaps(const PosedView& a, const PosedView& b) {
  const PosedView of_a = geometryOf(a);
  const PosedView of_b = geometryOf(b);
  return {mapBetween(of_a, of_b), mapBetween(of_b, of_a)};
}

}  // namespace sunlit::evaluate
