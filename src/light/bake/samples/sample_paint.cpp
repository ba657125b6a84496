#include "light/bake/samples/sample_paint.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "light/bake/samples/mesh_leaves.h"
#include "light/shading/reflectances.h"

namespace sunlit::light {
namespace {

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
                    const float area = whole * std::abs(corners.determinant());
                    for (std::uint32_t node : cell.corner) {
                      const std::uint32_t sample = samples->nearest_sample[node];
                      samples->paints[sample].add(area, paint);
                      areas[sample] += area;
                    }
                  });
    }
  }
  for (std::size_t i = 0; i < areas.size(); ++i) {
    if (areas[i] > 0.0f) samples->paints[i].divide(areas[i]);
    areas[i] /= 6.0f;  // half of the cross product, and a third of each cell
  }
  samples->areas_m2 = std::move(areas);
}

}  // namespace sunlit::light
