// What shines above a black floor, and what it gives.
#pragma once

#include <cmath>
#include <utility>
#include <vector>

#include "light/picture/lamps/lit_rows.h"
#include "paper_scene.h"

namespace sunlit::light {

/// A square panel that shines down, 10,000 cd/m², above a black floor.
inline scene::Scene panelAboveFloor(float side, float height) {
  scene::Scene scene;
  scene.materials = {paint(0.0f), paint(0.0f, 10000.0f)};
  scene.materials[1].double_sided = false;
  addGround(&scene, 0, 40.0f);
  addPatch(&scene, 1, {-side / 2, -side / 2, height}, {0.0f, side, 0.0f}, {side, 0.0f, 0.0f});
  return scene;
}

/// A closed ball of 24 × 12 facets that shine outwards, `height` above a black floor.
inline scene::Scene ballAboveFloor(float radius, float height) {
  constexpr int kAround = 24, kDown = 12;
  scene::Scene scene = panelAboveFloor(0.1f, height);
  scene.meshes.pop_back();
  const auto at = [&](int i, int j) {
    const float down = static_cast<float>(j) * static_cast<float>(kPi) / kDown;
    const float around = static_cast<float>(i) * 2.0f * static_cast<float>(kPi) / kAround;
    return Eigen::Vector3f(radius * std::sin(down) * std::cos(around),
                           radius * std::sin(down) * std::sin(around), height + radius * std::cos(down));
  };
  scene::Mesh ball;
  ball.name = "ball";
  ball.material = 1;
  const auto face = [&](const Eigen::Vector3f& a, const Eigen::Vector3f& b, const Eigen::Vector3f& c) {
    const auto first = static_cast<std::uint32_t>(ball.positions.size());
    ball.positions.insert(ball.positions.end(), {a, b, c});
    ball.normals.insert(ball.normals.end(), 3, (b - a).cross(c - a).normalized());
    ball.texture_coordinates.insert(ball.texture_coordinates.end(), 3, Eigen::Vector2f::Zero());
    ball.triangles.push_back({first, first + 1, first + 2});
  };
  for (int i = 0; i < kAround; ++i) {
    for (int j = 0; j < kDown; ++j) {
      if (j + 1 < kDown) face(at(i, j), at(i, j + 1), at(i + 1, j + 1));
      if (j > 0) face(at(i, j), at(i + 1, j + 1), at(i + 1, j));
    }
  }
  scene.meshes.push_back(std::move(ball));
  return scene;
}

/// A white surface that is no more than matt.
inline Surface mattSurface(const Eigen::Vector3f& position, const Eigen::Vector3f& normal) {
  Surface surface;
  surface.position = position;
  surface.geometric_normal = surface.shading_normal = surface.to_eye = normal;
  surface.albedo = Eigen::Array3f::Ones();
  return surface;
}
/// What such surfaces reflect of a source that nothing hides, cd/m².
inline std::vector<double> reflectedBy(const LampBeam& beam, const Tile& tile) {
  scene::Scene scene;
  scene.materials = {paint(1.0f)};
  scene.materials[0].dielectric = LinearRgb(0.0f, 0.0f, 0.0f);
  scene.materials[0].dielectric_grazing = 0.0f;
  LitRows rows;
  rows.set(tile, scene);
  std::vector<float> shares(rows.stride()), least_lx(rows.stride(), 0.0f);
  beam.shares(rows.positions(), shares.data());
  LitRows::Reflected reflected;
  rows.reflect(beam, {shares.data(), least_lx.data()}, &reflected);
  const auto green = reflected.values.begin() + static_cast<std::ptrdiff_t>(rows.stride());
  return {green, green + static_cast<std::ptrdiff_t>(tile.surfaces.size())};
}

/// Illuminance, lx, of level ground at `place` by a patch of 1 cd/m² that shines down: the sum over its
/// parts.
inline double byPatch(const Eigen::Vector3d& corner, const Eigen::Vector3d& u, const Eigen::Vector3d& v,
                      const Eigen::Vector3d& place) {
  constexpr int kParts = 60;
  const Eigen::Vector3d area = u.cross(v) / (kParts * kParts);
  double sum = 0.0;
  for (int i = 0; i < kParts; ++i) {
    for (int k = 0; k < kParts; ++k) {
      const Eigen::Vector3d way = corner + (i + 0.5) / kParts * u + (k + 0.5) / kParts * v - place;
      const double before = -way.dot(area) / way.norm(), up = way.z() / way.norm();
      sum += std::max(before, 0.0) * up / way.squaredNorm();
    }
  }
  return sum;
}

}  // namespace sunlit::light
