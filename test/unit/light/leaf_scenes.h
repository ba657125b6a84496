/// Leaves, and points of them to look at.
#pragma once

#include <random>
#include <vector>

#include "paper_scene.h"

namespace sunlit::light {

constexpr int kLeaf = 0, kBoard = 1;

/// A leaf's material, solid all over, and an opaque one.
inline scene::Scene leafScene() {
  scene::Texture solid;
  solid.name = "solid";
  solid.width = solid.height = 2;
  solid.rgba.own().assign(16, 255);
  return leafSceneOf(solid);
}

/// Over the origin, 2 m long and wide, 2 m up.
inline scene::Scene levelLeaf() {
  scene::Scene scene = leafScene();
  addPatch(&scene, kLeaf, {-1.0f, -1.0f, 2.0f}, {2.0f, 0.0f, 0.0f}, {0.0f, 2.0f, 0.0f});
  return scene;
}

/// Leaves at random in a ball over black ground, and points of theirs.
inline scene::Scene crown(std::vector<Looked>* points) {
  std::mt19937 random(3);
  const auto between = [&](float low, float high) {
    return low + (high - low) * static_cast<float>(random() >> 8) / 16777216.0f;
  };
  scene::Scene scene = leafScene();
  addGround(&scene, kBoard, 500.0f);
  for (int i = 0; i < 40; ++i) {
    const Eigen::Vector3f middle(between(-1.5f, 1.5f), between(-1.5f, 1.5f), between(2.5f, 5.5f));
    const Eigen::Vector3f a(Eigen::Vector3f(between(-1, 1), between(-1, 1), between(-1, 1)).normalized());
    const Eigen::Vector3f b(
        a.cross(Eigen::Vector3f(between(-1, 1), between(-1, 1), between(-1, 1))).normalized());
    addPatch(&scene, kLeaf, middle - 0.6f * (a + b), 1.2f * a, 1.2f * b);
    const Eigen::Vector3f normal = a.cross(b).normalized();
    for (int k = 0; k < 3; ++k)
      points->push_back(
          {middle + between(-0.5f, 0.5f) * a + between(-0.5f, 0.5f) * b, normal, normal, kLeaf});
  }
  return scene;
}

/// Sum of the differences of two rows of light, relative to that of the second.
inline double differenceOf(const std::vector<double>& fast, const std::vector<double>& slow) {
  double difference = 0.0, light = 0.0;
  for (std::size_t i = 0; i < fast.size(); ++i) {
    difference += std::abs(fast[i] - slow[i]);
    light += slow[i];
  }
  return difference / light;
}

/// A picture of one row whose surfaces know their triangles.
inline Surfaces onTriangles(const std::vector<Looked>& points, const World& world) {
  Surfaces surfaces = rowOf(points, *world.geometry->scene);
  for (Tile& tile : surfaces.tiles) {
    for (Surface& surface : tile.surfaces)
      surface.triangle =
          triangleAt(*world.geometry, points[surface.pixel].position, points[surface.pixel].normal);
  }
  return surfaces;
}

}  // namespace sunlit::light
