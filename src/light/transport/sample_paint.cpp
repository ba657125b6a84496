#include "light/transport/sample_paint.h"

#include <algorithm>
#include <cmath>

#include "light/transport/reflectances.h"

namespace sunlit::light {
namespace {

/// Visits the leaves below a cell with their corners' barycentric coordinates in the triangle.
template <typename Visit>
void visitLeaves(const LightMesh& mesh, std::uint32_t at, const Eigen::Matrix3f& corners,
                 const Visit& visit) {
  const LightMesh::Cell& cell = mesh.cells[at];
  if (!cell.inner()) {
    visit(cell, corners);
    return;
  }
  const auto k = static_cast<Eigen::Index>(cell.corner[1]);
  const Eigen::Vector3f from = corners.col(k), to = corners.col((k + 1) % 3), apex = corners.col((k + 2) % 3);
  const Eigen::Vector3f middle = 0.5f * (from + to);
  Eigen::Matrix3f child;
  child << from, middle, apex;
  visitLeaves(mesh, cell.child(), child, visit);
  child << middle, to, apex;
  visitLeaves(mesh, cell.child() + 1, child, visit);
}

void findNearest(SceneSamples* samples) {
  const LightMesh& mesh = samples->mesh;
  samples->nearest_sample.resize(mesh.nodeCount());
  for (std::size_t n = 0; n < mesh.nodeCount(); ++n) {
    const auto first = mesh.shares.begin() + mesh.first_share[n];
    const auto end = mesh.shares.begin() + mesh.first_share[n + 1];
    samples->nearest_sample[n] =
        std::max_element(first, end, [](const LightMesh::Share& a, const LightMesh::Share& b) {
          return a.weight < b.weight;
        })->sample;
  }
}

}  // namespace

void paintSamples(const Geometry& geometry, SceneSamples* samples) {
  const LightMesh& mesh = samples->mesh;
  findNearest(samples);
  const Reflectances reflectances(geometry);
  samples->paints.assign(samples->receivers.size(), Paint());
  samples->emissions.assign(samples->receivers.size(), Eigen::Array3f::Zero());
  std::vector<float> areas(samples->receivers.size(), 0.0f);
  for (std::uint32_t t = 0; t < mesh.roots.size(); ++t) {
    const auto& c = geometry.triangles[t];
    const Eigen::Vector3f a = geometry.positions[c[0]];
    const float whole = (geometry.positions[c[1]] - a).cross(geometry.positions[c[2]] - a).norm();
    for (std::uint32_t root : mesh.roots[t]) {
      if (!LightMesh::isCell(root)) continue;
      visitLeaves(mesh, root, Eigen::Matrix3f::Identity(),
                  [&](const LightMesh::Cell& cell, const Eigen::Matrix3f& corners) {
                    const Paint paint = reflectances.at(t, corners.rowwise().mean());
                    const Eigen::Array3f emission = reflectances.emission(t, corners.rowwise().mean());
                    const float area = whole * std::abs(corners.determinant());
                    for (std::uint32_t node : cell.corner) {
                      const std::uint32_t sample = samples->nearest_sample[node];
                      samples->paints[sample].add(area, paint);
                      samples->emissions[sample] += area * emission;
                      areas[sample] += area;
                    }
                  });
    }
  }
  for (std::size_t i = 0; i < areas.size(); ++i) {
    if (areas[i] <= 0.0f) continue;
    samples->paints[i].divide(areas[i]);
    samples->emissions[i] /= areas[i];
  }
}

}  // namespace sunlit::light
