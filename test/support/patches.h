/// Flat pieces that test scenes are made of.
#pragma once

#include <Eigen/Geometry>
#include <string>

#include "sunlit/scene/scene.h"

namespace sunlit::test {

/// The parallelogram origin + s·a + t·b, s and t in [0, 1], with a × b in front. Texture coordinates (s, t).
inline void addPatch(scene::Scene* scene, int material, const Eigen::Vector3f& origin,
                     const Eigen::Vector3f& a, const Eigen::Vector3f& b) {
  scene::Mesh mesh;
  mesh.name = "patch " + std::to_string(scene->meshes.size());
  mesh.material = material;
  mesh.positions = {origin, origin + a, origin + a + b, origin + b};
  mesh.normals.assign(4, a.cross(b).normalized());
  mesh.texture_coordinates = {{0.0f, 0.0f}, {1.0f, 0.0f}, {1.0f, 1.0f}, {0.0f, 1.0f}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  scene->meshes.push_back(mesh);
}

/// Level ground at z = 0, `half` m to each side of the origin.
inline void addGround(scene::Scene* scene, int material, float half) {
  addPatch(scene, material, {-half, -half, 0.0f}, {2.0f * half, 0.0f, 0.0f}, {0.0f, 2.0f * half, 0.0f});
}

/// The sides of the box from `low` to `low` + `size`, seen from outside.
inline void addBlock(scene::Scene* scene, int material, const Eigen::Vector3f& low,
                     const Eigen::Vector3f& size) {
  const Eigen::Vector3f x(size.x(), 0, 0), y(0, size.y(), 0), z(0, 0, size.z());
  addPatch(scene, material, low + z, x, y);
  addPatch(scene, material, low, y, x);
  addPatch(scene, material, low, x, z);
  addPatch(scene, material, low + y, z, x);
  addPatch(scene, material, low, z, y);
  addPatch(scene, material, low + x, y, z);
}

}  // namespace sunlit::test
