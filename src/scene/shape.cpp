#include "sunlit/scene/shape.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace sunlit::scene {
namespace {

/// A triangle on its way into the list, with the key that it is ordered by.
struct Placed {
  int material;
  int cell_x, cell_y;
  std::array<std::uint32_t, 3> vertices;
  Plane plane;

  bool sameChunk(const Placed& other) const {
    return material == other.material && cell_x == other.cell_x && cell_y == other.cell_y;
  }
};

template <typename T>
void append(const std::vector<T>& values, image::KeptArray<T>* all) {
  all->own().insert(all->own().end(), values.begin(), values.end());
}

template <typename T>
void fill(std::size_t count, const T& value, image::KeptArray<T>* all) {
  all->own().resize(count, value);
}

void appendVertices(const Mesh& mesh, Shape* shape) {
  const std::size_t before = shape->positions.size(), count = before + mesh.positions.size();
  append(mesh.positions, &shape->positions);
  for (const Eigen::Vector3f& normal : mesh.normals) {
    const float length = normal.norm();
    shape->normals.push_back(std::isfinite(length) && length > 1e-6f
                                 ? Eigen::Vector3f(normal / length)
                                 : Eigen::Vector3f(Eigen::Vector3f::Zero()));
  }
  fill<Eigen::Vector3f>(count, Eigen::Vector3f::Zero(), &shape->normals);
  append(mesh.texture_coordinates, &shape->texture_coordinates);
  fill<Eigen::Vector2f>(count, Eigen::Vector2f::Zero(), &shape->texture_coordinates);
  auto& more = shape->more_texture_coordinates;
  more.resize(std::max(more.size(), mesh.more_texture_coordinates.size()));
  for (std::size_t set = 0; set < more.size(); ++set) {
    fill<Eigen::Vector2f>(before, Eigen::Vector2f::Zero(), &more[set]);
    if (set < mesh.more_texture_coordinates.size()) append(mesh.more_texture_coordinates[set], &more[set]);
    fill<Eigen::Vector2f>(count, Eigen::Vector2f::Zero(), &more[set]);
  }
  if (!mesh.tangents.empty() || !shape->tangents.empty()) {
    fill<Eigen::Vector4f>(before, Eigen::Vector4f::Zero(), &shape->tangents);
    append(mesh.tangents, &shape->tangents);
    fill<Eigen::Vector4f>(count, Eigen::Vector4f::Zero(), &shape->tangents);
  }
  append(mesh.colors, &shape->colors);
  fill<Eigen::Array3f>(count, Eigen::Array3f::Ones(), &shape->colors);
}

Eigen::Vector3d centreOf(const Eigen::Vector3f& a, const Eigen::Vector3f& b, const Eigen::Vector3f& c) {
  return (a.cast<double>() + b.cast<double>() + c.cast<double>()) / 3.0;
}

/// False for a triangle without area.
bool place(const Shape& shape, Placed* triangle) {
  const Eigen::Vector3f& a = shape.positions[triangle->vertices[0]];
  const Eigen::Vector3f& b = shape.positions[triangle->vertices[1]];
  const Eigen::Vector3f& c = shape.positions[triangle->vertices[2]];
  const std::optional<Plane> plane = planeThrough(a, b, c);
  if (!plane) return false;
  triangle->plane = *plane;
  const Eigen::Vector3d centre = centreOf(a, b, c);
  triangle->cell_x = static_cast<int>(std::floor(centre.x() / Shape::kCellSize_m));
  triangle->cell_y = static_cast<int>(std::floor(centre.y() / Shape::kCellSize_m));
  return true;
}

void appendTriangle(const Placed& triangle, bool starts_chunk, Shape* shape) {
  if (starts_chunk) {
    Chunk chunk;
    chunk.material = triangle.material;
    chunk.first = static_cast<std::uint32_t>(shape->triangles.size());
    shape->chunks.push_back(chunk);
  }
  Chunk& chunk = shape->chunks.back();
  ++chunk.count;
  for (std::uint32_t vertex : triangle.vertices) chunk.box.extend(shape->positions[vertex]);
  shape->triangles.push_back(triangle.vertices);
  shape->planes.push_back(triangle.plane);
  shape->materials.push_back(triangle.material);
}

}  // namespace

std::optional<Plane> planeThrough(const Eigen::Vector3f& a, const Eigen::Vector3f& b,
                                  const Eigen::Vector3f& c) {
  const Eigen::Vector3d first = a.cast<double>();
  const Eigen::Vector3d cross = (b.cast<double>() - first).cross(c.cast<double>() - first);
  const double double_area = cross.norm();
  if (!(double_area > 1e-14)) return std::nullopt;
  Plane plane;
  plane.normal = (cross / double_area).cast<float>();
  plane.offset = plane.normal.cast<double>().dot(centreOf(a, b, c));
  return plane;
}

Shape::Shape(const Scene& scene) {
  std::vector<Placed> placed;
  placed.reserve(scene.triangleCount());
  for (const Mesh& mesh : scene.meshes) {
    const auto base = static_cast<std::uint32_t>(positions.size());
    appendVertices(mesh, this);
    for (const auto& t : mesh.triangles) {
      Placed triangle{mesh.material, 0, 0, {base + t[0], base + t[1], base + t[2]}, {}};
      if (place(*this, &triangle)) placed.push_back(triangle);
    }
  }
  std::stable_sort(placed.begin(), placed.end(), [](const Placed& a, const Placed& b) {
    if (a.material != b.material) return a.material < b.material;
    if (a.cell_x != b.cell_x) return a.cell_x < b.cell_x;
    return a.cell_y < b.cell_y;
  });
  triangles.own().reserve(placed.size());
  planes.own().reserve(placed.size());
  materials.own().reserve(placed.size());
  for (std::size_t i = 0; i < placed.size(); ++i) {
    appendTriangle(placed[i], i == 0 || !placed[i].sameChunk(placed[i - 1]), this);
  }
  makeRoomBehind();
}

FlatScene flattened(Scene scene) {
  FlatScene flat{{}, Shape(scene)};
  scene.meshes = std::vector<Mesh>();
  flat.scene = std::move(scene);
  return flat;
}

void Shape::makeRoomBehind() {
  positions.own().reserve(positions.size() + 1);
}

}  // namespace sunlit::scene
