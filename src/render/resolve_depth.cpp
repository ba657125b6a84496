#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "render/resolve.h"

namespace sunlit::render {
namespace {

bool inReach(const Seen& seen, double depth) {
  return depth >= seen.view.near_m && depth <= seen.view.far_m;
}

/// Of all triangles that the pixel's samples see, the nearest one's depth at the centre; infinite if none
/// contains it.
double nearestThrough(const Seen& seen, int x, int y, const Eigen::Vector3d& ray) {
  const int size = seen.view.supersampling;
  double nearest = std::numeric_limits<double>::infinity();
  std::uint32_t last = 0;
  for (int row = y * size; row < (y + 1) * size; ++row) {
    for (int column = x * size; column < (x + 1) * size; ++column) {
      const Sample& sample = seen.sample(column, row);
      if (sample.sky() || sample.triangle == last) continue;
      last = sample.triangle;
      const double depth = planeDepth(seen, sample.triangle - 1, ray);
      if (inReach(seen, depth) && depth < nearest && passesThrough(seen, sample.triangle - 1, ray))
        nearest = depth;
    }
  }
  return nearest;
}

/// What all samples of a pixel see; none if they differ.
std::optional<std::uint32_t> sameTriangle(const Seen& seen, int x, int y) {
  const int size = seen.view.supersampling;
  const std::uint32_t first = seen.sample(x * size, y * size).triangle;
  for (int row = y * size; row < (y + 1) * size; ++row) {
    for (int column = x * size; column < (x + 1) * size; ++column) {
      if (seen.sample(column, row).triangle != first) return std::nullopt;
    }
  }
  return first;
}

float centreDepth(const Seen& seen, const light::Visibility& visibility, int x, int y) {
  constexpr float kNothing = std::numeric_limits<float>::quiet_NaN();
  const std::optional<std::uint32_t> same = sameTriangle(seen, x, y);
  if (same == 0u) return kNothing;
  const Eigen::Vector3d ray = seen.view.ray(x, y);
  // Between samples of one triangle lies that triangle.
  if (same) {
    const double depth = planeDepth(seen, *same - 1, ray);
    if (inReach(seen, depth)) return static_cast<float>(depth);
  }
  const double through = nearestThrough(seen, x, y, ray);
  if (std::isfinite(through)) return static_cast<float>(through);
  // The centre sees what no sample sees, as at the edges of small triangles: ask for it.
  const auto triangle = visibility.firstSeen(seen.view.eye().cast<float>(), ray.cast<float>(),
                                             static_cast<float>(seen.view.near_m));
  if (!triangle) return kNothing;
  const double depth = planeDepth(seen, *triangle, ray);
  return inReach(seen, depth) ? static_cast<float>(depth) : kNothing;
}

}  // namespace

double planeDepth(const Seen& seen, std::uint32_t triangle, const Eigen::Vector3d& ray) {
  const scene::Plane& plane = seen.plane(triangle);
  const Eigen::Vector3d normal = plane.normal.cast<double>();
  return (plane.offset - normal.dot(seen.view.eye())) / normal.dot(ray);
}

bool passesThrough(const Seen& seen, std::uint32_t triangle, const Eigen::Vector3d& ray) {
  const Eigen::Vector3d eye = seen.view.eye();
  std::array<Eigen::Vector3d, 3> corners;
  for (std::size_t i = 0; i < 3; ++i) corners[i] = seen.corner(triangle, i).cast<double>() - eye;
  int positive = 0, negative = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const double side = corners[i].cross(corners[(i + 1) % 3]).dot(ray);
    positive += side > 0.0 ? 1 : 0;
    negative += side < 0.0 ? 1 : 0;
  }
  return positive == 0 || negative == 0;
}

image::DepthImage resolveDepth(const Seen& seen, const light::Visibility& visibility) {
  image::DepthImage depth(seen.view.camera.width, seen.view.camera.height);
  tbb::parallel_for(0, depth.height, [&](int y) {
    for (int x = 0; x < depth.width; ++x) *depth.at(x, y) = centreDepth(seen, visibility, x, y);
  });
  return depth;
}

}  // namespace sunlit::render
