#include "scene/mesh_vertices.h"

#include <cstdint>
#include <utility>
#include <vector>

namespace sunlit::scene {
namespace {

template <typename Value>
void take(const std::vector<std::uint32_t>& vertices, std::vector<Value>& values) {
  if (values.empty()) return;
  std::vector<Value> taken;
  taken.reserve(vertices.size());
  for (const std::uint32_t vertex : vertices) taken.push_back(values[vertex]);
  values = std::move(taken);
}

/// Makes these vertices, in this order, all that the mesh has; its triangles are left to the caller.
void take(const std::vector<std::uint32_t>& vertices, Mesh& mesh) {
  take(vertices, mesh.positions);
  take(vertices, mesh.normals);
  take(vertices, mesh.texture_coordinates);
  for (auto& more : mesh.more_texture_coordinates) take(vertices, more);
  take(vertices, mesh.tangents);
  take(vertices, mesh.colors);
}

}  // namespace

void keepUsed(Mesh& mesh) {
  std::vector<bool> used(mesh.positions.size(), false);
  for (const auto& triangle : mesh.triangles) {
    for (const std::uint32_t corner : triangle) used[corner] = true;
  }
  std::vector<std::uint32_t> vertices, places(used.size());
  for (std::uint32_t i = 0; i < used.size(); ++i) {
    places[i] = static_cast<std::uint32_t>(vertices.size());
    if (used[i]) vertices.push_back(i);
  }
  if (vertices.size() == used.size()) return;
  for (auto& triangle : mesh.triangles) {
    for (std::uint32_t& corner : triangle) corner = places[corner];
  }
  take(vertices, mesh);
}

void partTriangles(Mesh& mesh) {
  std::vector<std::uint32_t> vertices;
  vertices.reserve(3 * mesh.triangles.size());
  for (auto& triangle : mesh.triangles) {
    for (std::uint32_t& corner : triangle) {
      vertices.push_back(corner);
      corner = static_cast<std::uint32_t>(vertices.size() - 1);
    }
  }
  take(vertices, mesh);
}

}  // namespace sunlit::scene
