#include "scene/back_to_back.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <optional>
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

/// Adds those of `mesh`, the part of this index, to `faces`.
void addFaces(const Mesh& mesh, const Eigen::Affine3d& file_from_mesh, std::size_t part,
              std::vector<Face>& faces) {
  std::vector<std::array<float, 3>> positions;
  for (const Eigen::Vector3f& position : mesh.positions) {
    const Eigen::Vector3f p = (file_from_mesh * position.cast<double>()).cast<float>();
    positions.push_back({p.x() + 0.0f, p.y() + 0.0f, p.z() + 0.0f});  // no −0
  }
  for (std::size_t k = 0; k < mesh.triangles.size(); ++k) {
    faces.push_back(faceOf(positions, mesh.triangles[k]));
    faces.back().part = part;
    faces.back().triangle = k;
  }
}

/// By part and triangle: whether another stands at its place and looks the other way.
std::vector<std::vector<bool>> twinsIn(const std::vector<MeshPart>& parts) {
  std::vector<std::vector<bool>> twins;
  for (const MeshPart& part : parts) twins.emplace_back(part.mesh.triangles.size(), false);
  std::vector<Face> faces;
  for (std::size_t i = 0; i < parts.size(); ++i) addFaces(parts[i].mesh, parts[i].file_from_node, i, faces);
  std::sort(faces.begin(), faces.end());
  for (auto begin = faces.begin(); begin != faces.end();) {
    const auto end = std::find_if(begin, faces.end(), [&](const Face& f) { return f.place != begin->place; });
    const auto turned = std::count_if(begin, end, [](const Face& face) { return face.turned; });
    const bool both = turned > 0 && turned < end - begin;
    for (; begin != end; ++begin) twins[begin->part][begin->triangle] = both;
  }
  return twins;
}

template <typename Value>
bool areEqual(const std::vector<Value>& values, std::uint32_t a, std::uint32_t b) {
  return values.empty() || (values[a] == values[b]).all();
}

bool areEqual(const std::vector<Eigen::Vector2f>& values, std::uint32_t a, std::uint32_t b) {
  return values.empty() || values[a] == values[b];
}

/// Whether the sheet looks the same with these vertices in front and the others behind.
bool looksAlike(const Mesh& mesh, std::uint32_t a, std::uint32_t b, bool textured) {
  // 2.6°, as both sides are smoothed apart. Either way about: a normal is turned to the side that is seen.
  constexpr float kAligned = 0.999f;
  if (!(std::abs(mesh.normals[a].dot(mesh.normals[b])) > kAligned) || !areEqual(mesh.colors, a, b))
    return false;
  if (!textured) return true;
  return mesh.tangents.empty() && areEqual(mesh.texture_coordinates, a, b) &&
         std::all_of(mesh.more_texture_coordinates.begin(), mesh.more_texture_coordinates.end(),
                     [&](const auto& coordinates) { return areEqual(coordinates, a, b); });
}

bool looksAlike(const Mesh& mesh, const Face& front, const Face& back, bool textured) {
  const std::array<std::uint32_t, 3>& others = mesh.triangles[back.triangle];
  for (const std::uint32_t a : mesh.triangles[front.triangle]) {
    const auto b = std::find_if(others.begin(), others.end(), [&](std::uint32_t other) {
      return mesh.positions[other] == mesh.positions[a];
    });
    if (b == others.end() || !looksAlike(mesh, a, *b, textured)) return false;
  }
  return true;
}

/// By triangle: the other of its pair, if it is of one.
std::vector<std::optional<std::size_t>> pairsIn(const Mesh& mesh, bool textured) {
  std::vector<std::optional<std::size_t>> others(mesh.triangles.size());
  std::vector<Face> faces;
  addFaces(mesh, Eigen::Affine3d::Identity(), 0, faces);
  std::stable_sort(faces.begin(), faces.end());
  for (auto face = faces.begin(); face != faces.end(); ++face) {
    for (auto other = face + 1; other != faces.end() && other->place == face->place; ++other) {
      if (others[face->triangle]) break;
      if (others[other->triangle] || other->turned == face->turned ||
          !looksAlike(mesh, *face, *other, textured))
        continue;
      others[face->triangle] = other->triangle;
      others[other->triangle] = face->triangle;
    }
  }
  return others;
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

Mesh pairsFrom(Mesh& mesh, bool textured) {
  const std::vector<std::optional<std::size_t>> others = pairsIn(mesh, textured);
  std::vector<std::array<std::uint32_t, 3>> fronts, backs, lone;
  for (std::size_t k = 0; k < others.size(); ++k) {
    if (!others[k]) lone.push_back(mesh.triangles[k]);
    if (!others[k] || *others[k] < k) continue;
    fronts.push_back(mesh.triangles[k]);
    backs.push_back(mesh.triangles[*others[k]]);
  }
  Mesh pairs;
  if (fronts.empty()) return pairs;
  pairs = mesh;
  pairs.triangles = std::move(fronts);
  pairs.triangles.insert(pairs.triangles.end(), backs.begin(), backs.end());
  keepUsed(pairs);
  mesh.triangles = std::move(lone);
  keepUsed(mesh);
  return pairs;
}

}  // namespace sunlit::scene
