#include "sunlit/light/bodies.h"

#include <stdexcept>
#include <string>

namespace sunlit::light {
namespace {

Geometry geometryOf(std::shared_ptr<const scene::Scene> scene,
                    const std::vector<std::vector<scene::Mesh>>& meshes_of_bodies) {
  scene::Scene meshes_only;
  for (const auto& meshes : meshes_of_bodies)
    meshes_only.meshes.insert(meshes_only.meshes.end(), meshes.begin(), meshes.end());
  return Geometry(std::move(scene), std::make_shared<const scene::Shape>(meshes_only));
}

std::vector<std::uint32_t> firstVertices(const std::vector<std::vector<scene::Mesh>>& meshes_of_bodies) {
  std::vector<std::uint32_t> first;
  std::uint32_t count = 0;
  for (const auto& meshes : meshes_of_bodies) {
    first.push_back(count);
    for (const scene::Mesh& mesh : meshes) count += static_cast<std::uint32_t>(mesh.positions.size());
  }
  first.push_back(count);
  return first;
}

/// The plane that the corners of triangle `t` lie in; `before` turned by `rotation` where rounding has left
/// it no area.
scene::Plane placedPlane(const scene::Shape& shape, std::size_t t, const Eigen::Vector3f& before,
                         const Eigen::Matrix3d& rotation) {
  const auto& corners = shape.triangles[t];
  const Eigen::Vector3f& a = shape.positions[corners[0]];
  if (const auto plane = scene::planeThrough(a, shape.positions[corners[1]], shape.positions[corners[2]]))
    return *plane;
  scene::Plane plane;
  plane.normal = (rotation * before.cast<double>()).cast<float>().normalized();
  plane.offset = plane.normal.cast<double>().dot(a.cast<double>());
  return plane;
}

}  // namespace

Bodies::Bodies(std::shared_ptr<const scene::Scene> scene,
               const std::vector<std::vector<scene::Mesh>>& meshes_of_bodies)
    : at_home_(geometryOf(std::move(scene), meshes_of_bodies)),
      first_vertices_(firstVertices(meshes_of_bodies)) {
  for (std::size_t body = 0; body < count(); ++body)
    body_of_vertex_.resize(first_vertices_[body + 1], static_cast<std::uint32_t>(body));
  surfaces_m2_.assign(count(), 0.0f);
  for (std::uint32_t t = 0; t < at_home_.triangles.size(); ++t) {
    const auto& corners = at_home_.triangles[t];
    const Eigen::Vector3f& a = at_home_.positions[corners[0]];
    const Eigen::Vector3f b = at_home_.positions[corners[1]] - a, c = at_home_.positions[corners[2]] - a;
    surfaces_m2_[bodyOf(t)] += 0.5f * b.cross(c).norm();
  }
}

Eigen::AlignedBox3f Bodies::boxOf(std::size_t body, const Geometry& placed) const {
  Eigen::AlignedBox3f box;
  for (std::uint32_t i = first_vertices_[body]; i < first_vertices_[body + 1]; ++i)
    box.extend(placed.positions[i]);
  return box;
}

std::shared_ptr<const Geometry> Bodies::placed(const std::vector<Eigen::Isometry3d>& map_from_body) const {
  if (map_from_body.size() != count()) {
    throw std::invalid_argument("map_from_body holds " + std::to_string(map_from_body.size()) +
                                " transforms, but there are " + std::to_string(count()) + " bodies");
  }
  auto shape = std::make_shared<scene::Shape>(*at_home_.shape);
  shape->makeRoomBehind();
  for (std::size_t body = 0; body < count(); ++body) {
    const Eigen::Isometry3d& place = map_from_body[body];
    if (!place.matrix().allFinite())
      throw std::invalid_argument("map_from_body[" + std::to_string(body) + "] is not finite");
    for (std::uint32_t i = first_vertices_[body]; i < first_vertices_[body + 1]; ++i) {
      shape->positions[i] = (place * at_home_.positions[i].cast<double>()).cast<float>();
      shape->normals[i] = (place.linear() * at_home_.normals[i].cast<double>()).cast<float>();
      if (shape->tangents.empty()) continue;
      shape->tangents[i].head<3>() =
          (place.linear() * at_home_.tangents[i].head<3>().cast<double>()).cast<float>();
    }
  }
  for (std::size_t t = 0; t < shape->triangles.size(); ++t) {
    const Eigen::Isometry3d& place = map_from_body[bodyOf(static_cast<std::uint32_t>(t))];
    shape->planes[t] = placedPlane(*shape, t, at_home_.planes[t].normal, place.linear());
  }
  for (scene::Chunk& chunk : shape->chunks) {
    chunk.box.setEmpty();
    for (std::uint32_t t = chunk.first; t < chunk.first + chunk.count; ++t) {
      for (const std::uint32_t vertex : shape->triangles[t]) chunk.box.extend(shape->positions[vertex]);
    }
  }
  return std::make_shared<const Geometry>(at_home_.scene, std::move(shape));
}

}  // namespace sunlit::light
