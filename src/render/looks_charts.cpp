#include "render/looks_charts.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <optional>

namespace sunlit::render {
namespace {

/// About 4°.
constexpr float kFlat = 0.9975f;

using Corners = std::array<Eigen::Vector3f, 3>;

Corners cornersOf(const scene::Mesh& mesh, std::uint32_t triangle) {
  const auto& v = mesh.triangles[triangle];
  return {mesh.positions[v[0]], mesh.positions[v[1]], mesh.positions[v[2]]};
}

/// Twice its area long.
Eigen::Vector3f crossOf(const Corners& c) {
  return (c[1] - c[0]).cross(c[2] - c[0]);
}

/// The corner of `other` across the one edge that it shares with `one`.
std::optional<Eigen::Vector3f> across(const Corners& one, const Corners& other) {
  std::optional<Eigen::Vector3f> apart;
  int shared = 0;
  for (const Eigen::Vector3f& corner : other) {
    if (std::find(one.begin(), one.end(), corner) != one.end())
      ++shared;
    else
      apart = corner;
  }
  return shared == 2 ? apart : std::nullopt;
}

bool makePair(const Corners& one, const Corners& other) {
  const std::optional<Eigen::Vector3f> tip = across(one, other);
  if (!tip) return false;
  const Eigen::Vector3f n = crossOf(one).normalized(), m = crossOf(other).normalized();
  if (n.dot(m) < kFlat) return false;
  // Beyond an edge, and not on top of the triangle.
  for (std::size_t k = 0; k < 3; ++k) {
    const Eigen::Vector3f edge = one[(k + 1) % 3] - one[k];
    const bool is_shared = std::find(other.begin(), other.end(), one[k]) != other.end() &&
                           std::find(other.begin(), other.end(), one[(k + 1) % 3]) != other.end();
    if (is_shared) return n.dot(edge.cross(*tip - one[k])) < 0.0f;
  }
  return false;
}

/// Lays the chart's plane along the longest edge of its first triangle.
void lay(const std::vector<Corners>& triangles, Chart* chart) {
  Eigen::Vector3f normal = Eigen::Vector3f::Zero();
  for (const Corners& c : triangles) normal += crossOf(c);
  normal.normalize();
  const Corners& first = triangles[0];
  Eigen::Vector3f longest = Eigen::Vector3f::Zero();
  for (std::size_t k = 0; k < 3; ++k) {
    const Eigen::Vector3f edge = first[(k + 1) % 3] - first[k];
    if (triangles.size() == 2) {  // not the diagonal
      const auto& other = triangles[1];
      if (std::find(other.begin(), other.end(), first[k]) != other.end() &&
          std::find(other.begin(), other.end(), first[(k + 1) % 3]) != other.end())
        continue;
    }
    if (edge.squaredNorm() > longest.squaredNorm()) longest = edge;
  }
  chart->right = (longest - normal * normal.dot(longest)).normalized();
  chart->up = normal.cross(chart->right);
  chart->origin = first[0];
  Eigen::Array2f low = Eigen::Array2f::Zero(), high = Eigen::Array2f::Zero();
  for (const Corners& c : triangles) {
    for (const Eigen::Vector3f& corner : c) {
      low = low.min(chart->on(corner));
      high = high.max(chart->on(corner));
    }
  }
  chart->origin += low[0] * chart->right + low[1] * chart->up;
  chart->extent_m = (high - low).max(1e-6f);
}

bool isUniform(const scene::Mesh& mesh) {
  return std::all_of(mesh.triangles.begin(), mesh.triangles.end(), [&](const auto& v) {
    return (mesh.colors[v[0]] == mesh.colors[v[1]]).all() && (mesh.colors[v[0]] == mesh.colors[v[2]]).all();
  });
}

}  // namespace

bool canBePainted(const scene::Material& material) {
  return material.alpha_mode == scene::AlphaMode::kOpaque && material.glass == 0.0f;
}

Look lookOf(const scene::Mesh& mesh, const scene::Material& material) {
  const bool colored = std::any_of(mesh.colors.begin(), mesh.colors.end(),
                                   [](const Eigen::Array3f& color) { return (color != 1.0f).any(); });
  const bool detailed = material.detail.contrast > 0.0f;
  if (!colored && !detailed) return Look::kAsItIs;
  if (!detailed && isUniform(mesh)) return Look::kTinted;
  return canBePainted(material) ? Look::kPainted : Look::kTinted;
}

std::vector<Chart> chartsOf(const scene::Scene& scene) {
  std::vector<Chart> charts;
  for (std::uint32_t m = 0; m < scene.meshes.size(); ++m) {
    const scene::Mesh& mesh = scene.meshes[m];
    if (lookOf(mesh, scene.materials[static_cast<std::size_t>(mesh.material)]) != Look::kPainted) continue;
    for (std::uint32_t t = 0; t < mesh.triangles.size(); t += charts.back().count) {
      Chart chart;
      chart.mesh = m;
      chart.triangle = t;
      std::vector<Corners> triangles = {cornersOf(mesh, t)};
      if (t + 1 < mesh.triangles.size() && makePair(triangles[0], cornersOf(mesh, t + 1))) {
        triangles.push_back(cornersOf(mesh, t + 1));
        chart.count = 2;
      }
      lay(triangles, &chart);
      charts.push_back(chart);
    }
  }
  return charts;
}

namespace {

Eigen::Array2i outer(const Chart& chart) {
  return chart.size + 2 * chart.gutter();
}

/// By height in steps, so that neighbours on a shelf are neighbours in the world as well.
std::vector<Chart*> inOrder(std::vector<Chart>* charts) {
  std::vector<std::pair<int, Chart*>> keyed;
  for (Chart& chart : *charts) {
    const double height = static_cast<double>(outer(chart)[1]);
    keyed.emplace_back(static_cast<int>(std::ceil(std::log(height) / std::log(1.15))), &chart);
  }
  std::stable_sort(keyed.begin(), keyed.end(),
                   [](const auto& a, const auto& b) { return a.first > b.first; });
  std::vector<Chart*> order;
  for (const auto& [step, chart] : keyed) order.push_back(chart);
  return order;
}

int widthFor(const std::vector<Chart>& charts) {
  double area = 0.0;
  int widest = 1;
  for (const Chart& chart : charts) {
    area += static_cast<double>(outer(chart)[0]) * outer(chart)[1];
    widest = std::max(widest, outer(chart)[0]);
  }
  int width = 64;
  while (width < BakedLooks::kLongestSide && (width < widest || width < 1.1 * std::sqrt(area))) width *= 2;
  return width;
}

}  // namespace

std::vector<Eigen::Array2i> packed(std::vector<Chart>* charts) {
  const int width = widthFor(*charts);
  std::vector<Eigen::Array2i> pages;
  const std::vector<Chart*> order = inOrder(charts);
  for (std::size_t begin = 0; begin < order.size();) {
    int across = 0, height = 0;
    std::size_t end = begin;
    for (; end < order.size() && across + outer(*order[end])[0] <= width; ++end) {
      order[end]->x = across;
      across += outer(*order[end])[0];
      height = std::max(height, outer(*order[end])[1]);
    }
    if (pages.empty() || pages.back()[1] + height > BakedLooks::kLongestSide) pages.emplace_back(width, 0);
    for (std::size_t i = begin; i < end; ++i) {
      Chart& chart = *order[i];
      chart.page = static_cast<int>(pages.size()) - 1;
      chart.y = pages.back()[1];
      const int to_the_right = i + 1 < end ? order[i + 1]->x : width;
      chart.room = {to_the_right - chart.x, height};
    }
    pages.back()[1] += height;
    begin = end;
  }
  return pages;
}

}  // namespace sunlit::render
