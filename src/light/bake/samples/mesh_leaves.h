/// The cells of a LightMesh that light is interpolated within.
#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "light/bake/samples/transport_data.h"

namespace sunlit::light {

/// Visits the leaves below the cell `at`, whose corners have the barycentric coordinates `corners` in the
/// triangle: visit(leaf, corners of it).
template <typename Visit>
void visitLeaves(const LightMesh& mesh, std::uint32_t at, const Eigen::Matrix3f& corners,
                 const Visit& visit) {
  const LightMesh::Cell& cell = mesh.cells[at];
  if (!cell.inner()) {
    visit(cell, corners);
    return;
  }
  const auto k = static_cast<Eigen::Index>(cell.edge());
  const Eigen::Vector3f from = corners.col(k), to = corners.col((k + 1) % 3), apex = corners.col((k + 2) % 3);
  const Eigen::Vector3f point = cell.point(from, to);
  Eigen::Matrix3f child;
  child << from, point, apex;
  visitLeaves(mesh, cell.child(), child, visit);
  child << point, to, apex;
  visitLeaves(mesh, cell.child() + 1, child, visit);
}

}  // namespace sunlit::light
