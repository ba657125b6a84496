#include "scene/sdf_shapes.h"

#include <cmath>
#include <ignition/math/Vector2.hh>
#include <ignition/math/Vector3.hh>
#include <stdexcept>
#include <vector>

#include "scene/outline.h"
#include "scene/ribbon.h"
#include "scene/sdf_library.h"
#include "scene/sdf_pose.h"
#include "sunlit/quantity/range.h"

namespace sunlit::scene {
namespace {

double positive(sdf::Element& element, const char* key, const std::string& name) {
  const auto value = element.Get<double>(key);
  if (std::isfinite(value) && value > 0.0) return value;
  throw std::runtime_error(refusal(name + ": its " + key, textOf(value), "above 0 m"));
}

template <typename Point, typename Use>
void forEachPoint(sdf::Element& element, const Use& use) {
  for (sdf::ElementPtr point = firstIn(element, "point"); point; point = point->GetNextElement("point"))
    use(point->Get<Point>());
}

}  // namespace

std::optional<Mesh> polylineOf(sdf::Element& geometry, const std::string& name) {
  std::vector<Outline> outlines;
  double height = 0.0;
  for (sdf::ElementPtr one = firstIn(geometry, "polyline"); one; one = one->GetNextElement("polyline")) {
    if (outlines.empty()) height = positive(*one, "height", name);
    Outline outline;
    forEachPoint<ignition::math::Vector2d>(
        *one, [&](const ignition::math::Vector2d& point) { outline.emplace_back(point.X(), point.Y()); });
    outlines.push_back(std::move(outline));
  }
  if (outlines.empty()) return std::nullopt;
  return extruded(outlines, height);
}

Mesh roadOf(sdf::Element& road, const std::string& name) {
  std::vector<Eigen::Vector3d> points;
  forEachPoint<ignition::math::Vector3d>(
      road, [&](const ignition::math::Vector3d& point) { points.push_back(toEigen(point)); });
  return makeRibbon(points, positive(road, "width", name));
}

}  // namespace sunlit::scene
