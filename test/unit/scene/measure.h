/// Simple facts about scenes, for tests.
#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <string>

#include "sunlit/scene/scene.h"

namespace sunlit::scene {

inline Eigen::AlignedBox3f boundsOf(const Mesh& mesh) {
  Eigen::AlignedBox3f box;
  for (const auto& triangle : mesh.triangles) {
    for (const std::uint32_t corner : triangle) box.extend(mesh.positions[corner]);
  }
  return box;
}

inline Eigen::AlignedBox3f boundsOf(const Scene& scene) {
  Eigen::AlignedBox3f box;
  for (const Mesh& mesh : scene.meshes) box.extend(boundsOf(mesh));
  return box;
}

inline Eigen::Vector3d faceVector(const Mesh& mesh, const std::array<std::uint32_t, 3>& triangle) {
  const Eigen::Vector3d a = mesh.positions[triangle[0]].cast<double>();
  const Eigen::Vector3d b = mesh.positions[triangle[1]].cast<double>();
  const Eigen::Vector3d c = mesh.positions[triangle[2]].cast<double>();
  return 0.5 * (b - a).cross(c - a);
}

inline double areaOf(const Mesh& mesh) {
  double area = 0.0;
  for (const auto& triangle : mesh.triangles) area += faceVector(mesh, triangle).norm();
  return area;
}

/// By the divergence theorem; of a closed surface whose faces look outwards, above zero.
inline double volumeOf(const Mesh& mesh) {
  double volume = 0.0;
  for (const auto& triangle : mesh.triangles) {
    volume += mesh.positions[triangle[0]].cast<double>().dot(faceVector(mesh, triangle)) / 3.0;
  }
  return volume;
}

struct Hit {
  double z;
  const Mesh* mesh;
};

/// The surface of `scene` at the height nearest to `z` straight above or below (x, y).
inline std::optional<Hit> nearestOnVertical(const Scene& scene, const Eigen::Vector3d& point) {
  std::optional<Hit> nearest;
  for (const Mesh& mesh : scene.meshes) {
    for (const auto& triangle : mesh.triangles) {
      const Eigen::Vector3d a = mesh.positions[triangle[0]].cast<double>() - point;
      const Eigen::Vector3d b = mesh.positions[triangle[1]].cast<double>() - point;
      const Eigen::Vector3d c = mesh.positions[triangle[2]].cast<double>() - point;
      const double u = b.x() * c.y() - b.y() * c.x();
      const double v = c.x() * a.y() - c.y() * a.x();
      const double w = a.x() * b.y() - a.y() * b.x();
      const bool inside = (u >= 0 && v >= 0 && w >= 0) || (u <= 0 && v <= 0 && w <= 0);
      if (!inside || u + v + w == 0.0) continue;
      const double height = (u * a.z() + v * b.z() + w * c.z()) / (u + v + w);
      if (!nearest || std::abs(height) < std::abs(nearest->z - point.z()))
        nearest = Hit{point.z() + height, &mesh};
    }
  }
  return nearest;
}

}  // namespace sunlit::scene
