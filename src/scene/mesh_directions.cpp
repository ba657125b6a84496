#include "scene/mesh_directions.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <vector>

namespace sunlit::scene {

Eigen::Vector3d faceVector(const Mesh& mesh, const std::array<std::uint32_t, 3>& triangle) {
  const Eigen::Vector3d a = mesh.positions[triangle[0]].cast<double>();
  const Eigen::Vector3d b = mesh.positions[triangle[1]].cast<double>();
  const Eigen::Vector3d c = mesh.positions[triangle[2]].cast<double>();
  return (b - a).cross(c - a);
}

void turnTangents(const Eigen::Matrix3d& linear, Mesh& mesh) {
  const float hand = linear.determinant() < 0.0 ? -1.0f : 1.0f;
  bool broken = false;
  for (Eigen::Vector4f& tangent : mesh.tangents) {
    tangent.head<3>() = (linear * tangent.head<3>().cast<double>()).normalized().cast<float>();
    tangent.w() *= hand;
    broken |= !(std::abs(tangent.head<3>().norm() - 1.0f) < 1e-3f);
  }
  if (broken) mesh.tangents.clear();
}

void repairNormals(Mesh& mesh) {
  mesh.normals.resize(mesh.positions.size(), Eigen::Vector3f::Zero());
  const auto broken = [](const Eigen::Vector3f& normal) {
    return !(normal.norm() > 1e-6f) || !normal.allFinite();
  };
  std::vector<Eigen::Vector3d> sums;
  if (std::any_of(mesh.normals.begin(), mesh.normals.end(), broken)) {
    sums.assign(mesh.positions.size(), Eigen::Vector3d::Zero());
    for (const auto& triangle : mesh.triangles) {
      for (const std::uint32_t corner : triangle) sums[corner] += faceVector(mesh, triangle);
    }
  }
  for (std::size_t i = 0; i < mesh.normals.size(); ++i) {
    if (broken(mesh.normals[i])) {
      const Eigen::Vector3d mean =
          sums[i].norm() > 0.0 ? sums[i].normalized() : Eigen::Vector3d(0.0, 0.0, 1.0);
      mesh.normals[i] = mean.cast<float>();
    }
    mesh.normals[i].normalize();
  }
}

}  // namespace sunlit::scene
