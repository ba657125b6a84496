#include "scene/outline.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <boost/polygon/polygon.hpp>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>

namespace sunlit::scene {
namespace {

namespace polygon = boost::polygon;
using polygon::operators::operator^=;
using Point = polygon::point_data<int>;
using Polygon = polygon::polygon_with_holes_data<int>;
using Set = polygon::polygon_set_data<int>;

Eigen::Vector2d metres(const Point& point) {
  return kOutlineGrid_m * Eigen::Vector2d(point.x(), point.y());
}

int onGrid(double value_m) {
  return static_cast<int>(
      std::lround(std::clamp(value_m, -static_cast<double>(kFarthest_m), static_cast<double>(kFarthest_m)) /
                  kOutlineGrid_m));
}

/// What lies between an edge and a line below all.
Set below(const Point& a, const Point& b, int bottom) {
  const std::vector<Point> corners = {a, b, Point(b.x(), bottom), Point(a.x(), bottom)};
  polygon::polygon_data<int> quad;
  quad.set(corners.begin(), corners.end());
  Set set;
  set.insert(quad);
  return set;
}

/// What is within an odd number of them: a point that is below an odd number of their edges.
Set enclosed(const std::vector<Outline>& outlines) {
  std::vector<std::vector<Point>> loops;
  int bottom = 0;
  for (const Outline& outline : outlines) {
    std::vector<Point> points;
    for (const Eigen::Vector2d& point : outline) {
      points.emplace_back(onGrid(point.x()), onGrid(point.y()));
      bottom = std::min(bottom, points.back().y());
    }
    loops.push_back(std::move(points));
  }
  std::vector<Set> sets(1);
  for (const std::vector<Point>& loop : loops) {
    for (std::size_t i = 0; i < loop.size(); ++i)
      sets.push_back(below(loop[i], loop[(i + 1) % loop.size()], bottom - 1));
  }
  while (sets.size() > 1) {  // by halves, so that large sets meet large ones alone
    for (std::size_t i = 0; 2 * i + 1 < sets.size(); ++i) {
      sets[2 * i] ^= sets[2 * i + 1];
      sets[i] = sets[2 * i];
    }
    if (sets.size() % 2 == 1) sets[sets.size() / 2] = sets.back();
    sets.resize((sets.size() + 1) / 2);
  }
  return sets[0];
}

std::uint32_t addCorner(Mesh& mesh, const Eigen::Vector3d& position, const Eigen::Vector3d& normal,
                        const Eigen::Vector2d& coordinate) {
  mesh.positions.push_back(position.cast<float>());
  mesh.normals.push_back(normal.cast<float>());
  mesh.texture_coordinates.push_back(coordinate.cast<float>());
  return static_cast<std::uint32_t>(mesh.positions.size() - 1);
}

/// A convex polygon, counter-clockwise seen from above, at the height z, seen from above or below.
void addFlat(Mesh& mesh, const std::vector<Eigen::Vector2d>& corners, double z, bool upwards) {
  const Eigen::Vector3d normal(0.0, 0.0, upwards ? 1.0 : -1.0);
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  for (const Eigen::Vector2d& corner : corners) addCorner(mesh, {corner.x(), corner.y(), z}, normal, corner);
  for (std::uint32_t i = 2; i < corners.size(); ++i) {
    if (upwards) {
      mesh.triangles.push_back({first, first + i - 1, first + i});
    } else {
      mesh.triangles.push_back({first, first + i, first + i - 1});
    }
  }
}

double signedArea(const std::vector<Eigen::Vector2d>& corners) {
  double twice = 0.0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Eigen::Vector2d& a = corners[i];
    const Eigen::Vector2d& b = corners[(i + 1) % corners.size()];
    twice += a.x() * b.y() - b.x() * a.y();
  }
  return 0.5 * twice;
}

/// Whether the way from a by b to c is straight, or no way at all.
bool isStraight(const Point& a, const Point& b, const Point& c) {
  const auto difference = [](int to, int from) { return std::int64_t{to} - from; };
  // Up to 2^32 each, so that the products need more than 63 bits.
  return static_cast<long double>(difference(b.x(), a.x())) * difference(c.y(), b.y()) ==
         static_cast<long double>(difference(b.y(), a.y())) * difference(c.x(), b.x());
}

/// Only where it turns: Boost ends loops where they begin, and cuts off corners of no size.
template <typename Loop>
std::vector<Eigen::Vector2d> cornersOf(const Loop& loop) {
  std::vector<Point> points(loop.begin(), loop.end());
  for (std::size_t i = 0; i < points.size();) {
    const Point& before = points[(i + points.size() - 1) % points.size()];
    const Point& after = points[(i + 1) % points.size()];
    if (points.size() < 3) break;
    if (isStraight(before, points[i], after)) {
      points.erase(points.begin() + static_cast<std::ptrdiff_t>(i));
      i = 0;
    } else {
      ++i;
    }
  }
  std::vector<Eigen::Vector2d> corners;
  for (const Point& point : points) corners.push_back(metres(point));
  return corners;
}

/// The walls along a loop; what it bounds is to its left.
void addWalls(Mesh& mesh, const std::vector<Eigen::Vector2d>& loop, double height) {
  double along = 0.0;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const Eigen::Vector2d& a = loop[i];
    const Eigen::Vector2d& b = loop[(i + 1) % loop.size()];
    const double length = (b - a).norm();
    const Eigen::Vector3d normal((b - a).y() / length, -(b - a).x() / length, 0.0);
    const std::uint32_t low_a = addCorner(mesh, {a.x(), a.y(), 0.0}, normal, {along, 0.0});
    const std::uint32_t low_b = addCorner(mesh, {b.x(), b.y(), 0.0}, normal, {along + length, 0.0});
    const std::uint32_t high_b = addCorner(mesh, {b.x(), b.y(), height}, normal, {along + length, -height});
    const std::uint32_t high_a = addCorner(mesh, {a.x(), a.y(), height}, normal, {along, -height});
    mesh.triangles.push_back({low_a, low_b, high_b});
    mesh.triangles.push_back({low_a, high_b, high_a});
    along += length;
  }
}

}  // namespace

Mesh extruded(const std::vector<Outline>& outlines, double height) {
  Mesh mesh;
  const Set inside = enclosed(outlines);
  std::vector<polygon::polygon_data<int>> pieces;
  inside.get_trapezoids(pieces);
  for (const auto& piece : pieces) {
    std::vector<Eigen::Vector2d> corners = cornersOf(piece);
    if (signedArea(corners) < 0.0) std::reverse(corners.begin(), corners.end());
    addFlat(mesh, corners, height, true);
    addFlat(mesh, corners, 0.0, false);
  }
  std::vector<Polygon> shapes;
  inside.get(shapes);
  for (const Polygon& shape : shapes) {
    std::vector<Eigen::Vector2d> outer = cornersOf(shape);
    if (signedArea(outer) < 0.0) std::reverse(outer.begin(), outer.end());
    addWalls(mesh, outer, height);
    for (auto hole = shape.begin_holes(); hole != shape.end_holes(); ++hole) {
      std::vector<Eigen::Vector2d> inner = cornersOf(*hole);
      if (signedArea(inner) > 0.0) std::reverse(inner.begin(), inner.end());
      addWalls(mesh, inner, height);
    }
  }
  return mesh;
}

}  // namespace sunlit::scene
