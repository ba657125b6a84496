#include "scene/back_to_back.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <utility>

#include "scene/mesh_vertices.h"

namespace sunlit::scene {
namespace {

using Corners = std::array<std::array<float, 3>, 3>;

/// A triangle of a file.
struct Face {
  std::uint64_t place;  ///< a hash of its corners, whatever their order
  bool turned;          ///< by how many swaps they were sorted: odd
  std::size_t part, triangle;

  bool operator<(const Face& other) const { return place < other.place; }
};

std::uint64_t hashOf(const Corners& corners) {
  std::uint64_t hash = 0xCBF29CE484222325;
  for (const auto& corner : corners) {
    for (const float number : corner) {
      std::uint32_t bits = 0;
      std::memcpy(&bits, &number, sizeof(bits));
      hash = (hash ^ bits) * 0x9E3779B97F4A7C15;
      hash ^= hash >> 29;
    }
  }
  return hash;
}

Face faceOf(const std::vector<std::array<float, 3>>& positions,
            const std::array<std::uint32_t, 3>& triangle) {
  Corners corners{positions[triangle[0]], positions[triangle[1]], positions[triangle[2]]};
  bool turned = false;
  for (const auto& [a, b] : {std::pair{0, 1}, {1, 2}, {0, 1}}) {
    if (!(corners[b] < corners[a])) continue;
    std::swap(corners[a], corners[b]);
    turned = !turned;
  }
  return {hashOf(corners), turned, 0, 0};
}

std::vector<Face> facesOf(const std::vector<MeshPart>& parts) {
  std::vector<Face> faces;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    std::vector<std::array<float, 3>> positions;
    for (const Eigen::Vector3f& position : parts[i].mesh.positions) {
      const Eigen::Vector3f p = (parts[i].file_from_node * position.cast<double>()).cast<float>();
      positions.push_back({p.x() + 0.0f, p.y() + 0.0f, p.z() + 0.0f});  // no −0
    }
    for (std::size_t k = 0; k < parts[i].mesh.triangles.size(); ++k) {
      faces.push_back(faceOf(positions, parts[i].mesh.triangles[k]));
      faces.back().part = i;
      faces.back().triangle = k;
    }
  }
  return faces;
}

/// By part and triangle: whether another stands at its place and looks the other way.
std::vector<std::vector<bool>> twinsIn(const std::vector<MeshPart>& parts) {
  std::vector<std::vector<bool>> twins;
  for (const MeshPart& part : parts) twins.emplace_back(part.mesh.triangles.size(), false);
  std::vector<Face> faces = facesOf(parts);
  std::sort(faces.begin(), faces.end());
  for (auto begin = faces.begin(); begin != faces.end();) {
    const auto end = std::find_if(begin, faces.end(), [&](const Face& f) { return f.place != begin->place; });
    const auto turned = std::count_if(begin, end, [](const Face& face) { return face.turned; });
    const bool both = turned > 0 && turned < end - begin;
    for (; begin != end; ++begin) twins[begin->part][begin->triangle] = both;
  }
  return twins;
}

}  // namespace

void partBackToBack(std::vector<MeshPart>& parts, SceneBuilder& builder) {
  const std::vector<std::vector<bool>> twins = twinsIn(parts);
  const std::size_t count = parts.size();
  for (std::size_t i = 0; i < count; ++i) {
    if (std::find(twins[i].begin(), twins[i].end(), true) == twins[i].end()) continue;
    MeshPart of_twins = parts[i];
    of_twins.mesh.material = builder.oneSided(parts[i].mesh.material);
    of_twins.mesh.triangles.clear();
    std::vector<std::array<std::uint32_t, 3>> others;
    for (std::size_t k = 0; k < twins[i].size(); ++k)
      (twins[i][k] ? of_twins.mesh.triangles : others).push_back(parts[i].mesh.triangles[k]);
    if (others.empty()) {
      parts[i] = std::move(of_twins);
      continue;
    }
    keepUsed(of_twins.mesh);
    parts[i].mesh.triangles = std::move(others);
    parts.push_back(std::move(of_twins));
  }
}

}  // namespace sunlit::scene
