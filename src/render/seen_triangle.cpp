#include "render/seen_triangle.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "render/texture_area.h"

namespace sunlit::render {
SeenTriangle::SeenTriangle(const Seen& seen, std::uint32_t number) {
  const light::Geometry& geometry = seen.of(number);
  const auto& vertices = geometry.triangles[number - seen.before(number)];
  const scene::Plane& plane = seen.plane(number);
  material_ = seen.material(number);
  const Eigen::Vector3d eye = seen.view.eye();
  number_ = number;
  from_behind_ = plane.normal.cast<double>().dot(eye) < plane.offset;
  normal_ = from_behind_ ? Eigen::Vector3f(-plane.normal) : plane.normal;
  const Eigen::Vector3f& a = geometry.positions[vertices[0]];
  corner_ = (a.cast<double>() - eye).cast<float>();
  const Eigen::Vector3f ab = geometry.positions[vertices[1]] - a, ac = geometry.positions[vertices[2]] - a;
  const Eigen::Vector3f cross = ab.cross(ac);
  const float scale = 1.0f / cross.squaredNorm();
  towards_b_ = ac.cross(cross) * scale;
  towards_c_ = cross.cross(ab) * scale;
  normal_a_ = geometry.normals[vertices[0]];
  normal_b_ = geometry.normals[vertices[1]];
  normal_c_ = geometry.normals[vertices[2]];
  flat_ = normal_a_ == normal_b_ && normal_a_ == normal_c_;
  if (flat_) flat_normal_ = normalFrom(normal_a_);
  const Eigen::Array3f base = seen.look(material_).base_color.value;
  color_a_ = base * geometry.colors[vertices[0]];
  color_b_ = base * geometry.colors[vertices[1]] - color_a_;
  color_c_ = base * geometry.colors[vertices[2]] - color_a_;
  texture_a_ = geometry.texture_coordinates[vertices[0]].array();
  texture_b_ = geometry.texture_coordinates[vertices[1]].array() - texture_a_;
  texture_c_ = geometry.texture_coordinates[vertices[2]].array() - texture_a_;
}

Eigen::Array3f SeenTriangle::albedo(const Seen& seen, const Eigen::Array2f& shares, const Footprint& step,
                                    bool small) const {
  const Eigen::Array3f color = color_a_ + shares[0] * color_b_ + shares[1] * color_c_;
  const TexturePyramid* const texture = seen.pyramids.of(material_);
  if (!texture) return color.max(0.0f).min(1.0f);
  const TexturePyramid& pyramid = *texture;
  const Eigen::Array2f at = texture_a_ + shares[0] * texture_b_ + shares[1] * texture_c_;
  const auto moved = [&](const Eigen::Vector3f& by) {
    return Eigen::Array2f(by.dot(towards_b_) * texture_b_ + by.dot(towards_c_) * texture_c_);
  };
  const TextureArea area({at, moved(step.right), moved(step.down)}, pyramid.size(), {seen.lod_bias, small});
  if (area.magnified()) return (color * pyramid.color(at, 0.0f)).max(0.0f).min(1.0f);
  Eigen::Array3f sum = Eigen::Array3f::Zero();
  for (int i = 0; i < area.taps(); ++i) sum += pyramid.color(area.tap(i), area.level());
  return (color * sum * (1.0f / static_cast<float>(area.taps()))).max(0.0f).min(1.0f);
}

SeenTriangle::CornerCoordinates SeenTriangle::coordinates(const Seen& seen, int set) const {
  const light::Geometry& geometry = seen.of(number_);
  const image::ArrayView<Eigen::Vector2f>* const of_vertices = geometry.coordinates(set);
  if (!of_vertices || of_vertices->empty()) return {};
  const auto& v = geometry.triangles[number_ - seen.before(number_)];
  const Eigen::Array2f a = (*of_vertices)[v[0]].array();
  return {true, a, (*of_vertices)[v[1]].array() - a, (*of_vertices)[v[2]].array() - a};
}

SurfaceMaps::Place SeenTriangle::placeOnMaps(const Seen& seen, const Eigen::Array2f& shares,
                                             const Footprint& step, bool small) const {
  SurfaceMaps::Place place{{}, step.right.norm(), {seen.lod_bias, small}};
  for (int set = 0; set < seen.maps.sets(material_); ++set) {
    const CornerCoordinates c = coordinates(seen, set);
    if (!c.known) {
      place.sets.emplace_back();
      continue;
    }
    const auto moved = [&](const Eigen::Vector3f& by) {
      return Eigen::Array2f(by.dot(towards_b_) * c.b + by.dot(towards_c_) * c.c);
    };
    place.sets.push_back(
        {true, {c.a + shares[0] * c.b + shares[1] * c.c, moved(step.right), moved(step.down)}});
  }
  return place;
}

Eigen::Vector3f SeenTriangle::tangent(const Seen& seen, const Eigen::Array2f& shares, float* hand) const {
  const light::Geometry& geometry = seen.of(number_);
  const auto& v = geometry.triangles[number_ - seen.before(number_)];
  if (!geometry.tangents.empty()) {
    const Eigen::Vector4f &a = geometry.tangents[v[0]], &b = geometry.tangents[v[1]],
                          &c = geometry.tangents[v[2]];
    *hand = a.w();
    const Eigen::Vector3f sum = ((1.0f - shares.sum()) * a + shares[0] * b + shares[1] * c).head<3>();
    if (*hand != 0.0f && sum.norm() > 1e-6f) return sum;
  }
  // Where u grows and v does not: along the edges to b and c by as much as undoes v.
  const CornerCoordinates t = coordinates(seen, seen.maps.normalCoordinates(material_));
  const float turned = t.b.x() * t.c.y() - t.c.x() * t.b.y();
  *hand = turned < 0.0f ? 1.0f : -1.0f;  // v grows downwards
  const Eigen::Vector3f ab = geometry.positions[v[1]] - geometry.positions[v[0]];
  const Eigen::Vector3f ac = geometry.positions[v[2]] - geometry.positions[v[0]];
  return (t.c.y() * ab - t.b.y() * ac) * (turned < 0.0f ? -1.0f : 1.0f);
}

float SeenTriangle::mapNormal(const Seen& seen, const Eigen::Array2f& shares, const Eigen::Vector3f& mapped,
                              Eigen::Vector3f* normal) const {
  float hand = 1.0f;
  const Eigen::Vector3f along = tangent(seen, shares, &hand);
  const Eigen::Vector3f right = (along - normal->dot(along) * *normal).normalized();
  if (!(right.norm() > 0.5f)) return 1.0f;  // coordinates without extent
  // Seen from behind, bumps are dents: all three turn about.
  const float side = from_behind_ ? -1.0f : 1.0f;
  const Eigen::Vector3f front = side * *normal;
  const Eigen::Vector3f top = hand * front.cross(right);
  Eigen::Vector3f turned = side * (mapped.x() * right + mapped.y() * top + mapped.z() * front);
  const float length = turned.norm();
  if (!(length > 1e-3f)) return 1.0f;
  turned /= length;
  constexpr float kLeast = 0.02f;  // cosine: what the triangle itself cannot face is not faced
  const float facing = turned.dot(normal_);
  if (facing < kLeast) turned = (turned + (kLeast - facing) * normal_).normalized();
  *normal = turned;
  return std::min(length, 1.0f);
}

}  // namespace sunlit::render
