#include "scene/race_track/shapes.h"

#include <cmath>

#include "sunlit/quantity/angle.h"

namespace sunlit::scene::race_track {
namespace {

std::uint32_t addVertex(Mesh& mesh, const Paint& paint, const Point& position, const Point& normal) {
  mesh.positions.push_back(position);
  mesh.normals.push_back(normal);
  mesh.colors.push_back(paint.color);
  mesh.texture_coordinates.emplace_back(0.0f, 0.0f);
  return static_cast<std::uint32_t>(mesh.positions.size()) - 1;
}

Point faceNormal(const Point& a, const Point& b, const Point& c) {
  const Point n = (b - a).cross(c - a);
  const float length = n.norm();
  return length > 1e-12f ? Point(n / length) : Point::UnitZ();
}

// A direction across `axis`, as near to `before` as there is: rings that follow each other are not twisted.
Point across(const Point& axis, const Point& before) {
  const Point u = before - axis.dot(before) * axis;
  return u.norm() > 1e-3f ? Point(u.normalized()) : Point(axis.unitOrthogonal());
}

}  // namespace

void addTriangle(Assembly& assembly, const Paint& paint, const std::array<Point, 3>& corners) {
  Mesh& mesh = assembly.mesh(paint.material, corners[0]);
  const Point normal = faceNormal(corners[0], corners[1], corners[2]);
  std::array<std::uint32_t, 3> triangle;
  for (int i = 0; i < 3; ++i) triangle[i] = addVertex(mesh, paint, corners[i], normal);
  mesh.triangles.push_back(triangle);
}

void addCard(Assembly& assembly, const Paint& paint, const Card& card) {
  Mesh& mesh = assembly.mesh(paint.material, card.corners[0]);
  const std::uint32_t first = static_cast<std::uint32_t>(mesh.positions.size());
  for (std::size_t i = 0; i < 4; ++i) addVertex(mesh, paint, card.corners[i], card.normals[i]);
  const Eigen::Vector2f& a = card.rect.top_left;
  const Eigen::Vector2f& b = card.rect.bottom_right;
  mesh.texture_coordinates[first] = {a.x(), b.y()};
  mesh.texture_coordinates[first + 1] = b;
  mesh.texture_coordinates[first + 2] = {b.x(), a.y()};
  mesh.texture_coordinates[first + 3] = a;
  mesh.triangles.push_back({first, first + 1, first + 2});
  mesh.triangles.push_back({first, first + 2, first + 3});
}

void addQuad(Assembly& assembly, const Paint& paint, const Corners& corners, const PictureRect& rect) {
  const Point diagonal = corners[2] - corners[0];
  const Point normal = faceNormal(Point::Zero(), diagonal, corners[3] - corners[1]);
  addCard(assembly, paint, {corners, rect, even(normal)});
}

void addBox(Assembly& assembly, const Paint& paint, const Frame& frame, const Point& size) {
  const float x = 0.5f * size.x();
  const float y = 0.5f * size.y();
  const float z = size.z();
  const Point p[8] = {{-x, -y, 0}, {x, -y, 0}, {x, y, 0}, {-x, y, 0},
                      {-x, -y, z}, {x, -y, z}, {x, y, z}, {-x, y, z}};
  constexpr int kFaces[6][4] = {{0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6},
                                {3, 0, 4, 7}, {4, 5, 6, 7}, {3, 2, 1, 0}};
  for (const auto& face : kFaces)
    addQuad(assembly, paint,
            {frame * p[face[0]], frame * p[face[1]], frame * p[face[2]], frame * p[face[3]]});
}

void addTube(Assembly& assembly, const Paint& paint, const std::vector<Ring>& rings, int sides) {
  Mesh& mesh = assembly.mesh(paint.material, rings.front().centre);
  const std::uint32_t first = static_cast<std::uint32_t>(mesh.positions.size());
  const std::uint32_t around = static_cast<std::uint32_t>(sides);
  Point u = Point::Zero();
  for (std::size_t i = 0; i < rings.size(); ++i) {
    const Point& before = rings[i > 0 ? i - 1 : 0].centre;
    const Point& after = rings[i + 1 < rings.size() ? i + 1 : i].centre;
    const Point axis = (after - before).normalized();
    u = across(axis, u);
    const Point v = axis.cross(u);
    for (int k = 0; k < sides; ++k) {
      const float angle = 2.0f * kPiFloat * static_cast<float>(k) / static_cast<float>(sides);
      const Point out = std::cos(angle) * u + std::sin(angle) * v;
      addVertex(mesh, paint, rings[i].centre + rings[i].radius * out, out.normalized());
    }
  }
  for (std::uint32_t i = 0; i + 1 < rings.size(); ++i) {
    for (std::uint32_t k = 0; k < around; ++k) {
      const std::uint32_t a = first + i * around + k;
      const std::uint32_t b = first + i * around + (k + 1) % around;
      mesh.triangles.push_back({a, b, b + around});
      mesh.triangles.push_back({a, b + around, a + around});
    }
  }
  const Point axis = (rings.back().centre - rings[rings.size() - 2].centre).normalized();
  const std::uint32_t last = first + static_cast<std::uint32_t>(rings.size() - 1) * around;
  const std::uint32_t cap = static_cast<std::uint32_t>(mesh.positions.size());
  for (std::uint32_t k = 0; k < around; ++k) addVertex(mesh, paint, Point(mesh.positions[last + k]), axis);
  for (std::uint32_t k = 1; k + 1 < around; ++k) mesh.triangles.push_back({cap, cap + k, cap + k + 1});
}

void addBar(Assembly& assembly, const Paint& paint, const Ring& from, const Ring& to) {
  addTube(assembly, paint, {from, to}, 6);
}

void addLump(Assembly& assembly, const Paint& paint, const Lump& lump) {
  constexpr int kRings = 5;
  constexpr int kSides = 7;
  std::array<std::array<Point, kSides>, kRings + 1> grid;
  for (int i = 0; i <= kRings; ++i) {
    for (int k = 0; k < kSides; ++k) {
      const float polar = kPiFloat * static_cast<float>(i) / kRings;
      const float angle = 2.0f * kPiFloat * static_cast<float>(k) / kSides;
      const Point out(std::sin(polar) * std::cos(angle), std::sin(polar) * std::sin(angle), std::cos(polar));
      const float bump = fractal(2.0f * out.x() + 3.0f * out.z(), 2.0f * out.y() - out.z(), 2, lump.seed);
      grid[i][k] = lump.centre + (1.0f + lump.roughness * bump) * out.cwiseProduct(lump.radii);
    }
  }
  for (int i = 0; i < kRings; ++i) {
    for (int k = 0; k < kSides; ++k) {
      const int l = (k + 1) % kSides;
      if (i + 1 < kRings) addTriangle(assembly, paint, {grid[i][k], grid[i + 1][k], grid[i + 1][l]});
      if (i > 0) addTriangle(assembly, paint, {grid[i][k], grid[i + 1][l], grid[i][l]});
    }
  }
}

Point sway(float spread, Random& random) {
  const float y = spread * random.bell();
  const float x = spread * random.bell();
  return {x, y, 0.0f};
}

Frame standing(const Point& place, float yaw) {
  Frame frame = Frame::Identity();
  frame.translate(place);
  frame.rotate(Eigen::AngleAxisf(yaw, Point::UnitZ()));
  return frame;
}

Frame shifted(const Frame& frame, const Point& offset) {
  Frame moved = frame;
  moved.translate(offset);
  return moved;
}

}  // namespace sunlit::scene::race_track
