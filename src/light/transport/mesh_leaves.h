/// The cells of a LightMesh that light is interpolated within.
#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "light/transport/transport_data.h"

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
  const auto k = static_cast<Eigen::Index>(cell.corner[1]);
  const Eigen::Vector3f from = corners.col(k), to = corners.col((k + 1) % 3), apex = corners.col((k + 2) % 3);
  const Eigen::Vector3f middle = 0.5f * (from + to);
  Eigen::Matrix3f child;
  child << from, middle, apex;
  visitLeaves(mesh, cell.child(), child, visit);
  child << middle, to, apex;
  visitLeaves(mesh, cell.child() + 1, child, visit);
}

/// Visits the middles of the across² equal triangles that a triangle falls into, by its own barycentric
/// coordinates.
template <typename Visit>
void visitMiddles(int across, const Visit& visit) {
  const float step = 1.0f / static_cast<float>(across);
  for (int i = 0; i < across; ++i) {
    for (int j = 0; i + j < across; ++j) {
      const Eigen::Vector2f at(static_cast<float>(i), static_cast<float>(j));
      const auto see = [&](float shift) {
        const Eigen::Vector2f uv = step * (at + Eigen::Vector2f::Constant(shift));
        visit(Eigen::Vector3f(1.0f - uv.sum(), uv.x(), uv.y()));
      };
      see(1.0f / 3.0f);
      if (i + j + 1 < across) see(2.0f / 3.0f);
    }
  }
}

/// Visits points, evenly spread, of the part of a leaf that is nearest to its corner k, by barycentric
/// coordinates of the leaf: the middle of that part, or 2 across² points.
template <typename Visit>
void visitPart(std::size_t k, int across, const Visit& visit) {
  const auto corner = static_cast<Eigen::Index>(k);
  if (across == 1) {
    Eigen::Vector3f middle = Eigen::Vector3f::Constant(7.0f / 36.0f);  // of the part's area
    middle[corner] = 22.0f / 36.0f;
    return visit(middle);
  }
  // Corner, middle of an edge, middle of the leaf; and the same by the other edge.
  const Eigen::Vector3f own = Eigen::Vector3f::Unit(corner), middle = Eigen::Vector3f::Constant(1.0f / 3.0f);
  for (Eigen::Index side = 1; side <= 2; ++side) {
    const Eigen::Vector3f edge = 0.5f * (own + Eigen::Vector3f::Unit((corner + side) % 3));
    visitMiddles(across, [&](const Eigen::Vector3f& b) { visit(b[0] * own + b[1] * edge + b[2] * middle); });
  }
}

}  // namespace sunlit::light
