#include "scene/primitives.h"

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <vector>

#include "sunlit/quantity/angle.h"
#include "sunlit/quantity/turn.h"

namespace sunlit::scene {
namespace {

/// Segments around a round solid: its outline departs from the circle by 0.2 % of the radius.
constexpr int kSegments = 48;
constexpr int kRings = kSegments / 2;

std::uint32_t addVertex(Mesh& mesh, const Eigen::Vector3d& position, const Eigen::Vector3d& normal,
                        const Eigen::Vector2d& coordinate) {
  mesh.positions.push_back(position.cast<float>());
  mesh.normals.push_back(normal.normalized().cast<float>());
  mesh.texture_coordinates.push_back(coordinate.cast<float>());
  return static_cast<std::uint32_t>(mesh.positions.size() - 1);
}

/// The rectangle centre ± half_u ± half_v, seen from the side where u × v points.
void addRectangle(Mesh& mesh, const Eigen::Vector3d& centre, const Eigen::Vector3d& half_u,
                  const Eigen::Vector3d& half_v) {
  const Eigen::Vector3d normal = half_u.cross(half_v);
  const std::uint32_t a = addVertex(mesh, centre - half_u - half_v, normal, {0.0, 1.0});
  const std::uint32_t b = addVertex(mesh, centre + half_u - half_v, normal, {1.0, 1.0});
  const std::uint32_t c = addVertex(mesh, centre + half_u + half_v, normal, {1.0, 0.0});
  const std::uint32_t d = addVertex(mesh, centre - half_u + half_v, normal, {0.0, 0.0});
  mesh.triangles.push_back({a, b, c});
  mesh.triangles.push_back({a, c, d});
}

/// One ring of a solid of revolution.
struct Ring {
  double radius, height;         ///< of its vertices, before scaling
  double normal_out, normal_up;  ///< their normal, before scaling
  double texture_u, texture_v;   ///< u after a whole turn
};

/// Unit vectors: from where rings begin, by way of what they go round their axis.
struct Turning {
  Eigen::Vector3d begin, quarter, axis;
};
const Turning kAroundZ{Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitY(), Eigen::Vector3d::UnitZ()};
// As Gazebo's meshes have them.
const Turning kCylinder{Eigen::Vector3d::UnitY(), Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitZ()};
const Turning kSphere{Eigen::Vector3d::UnitZ(), Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitY()};

/// A solid whose x, y and z are scaled by `scale` once it is turned.
struct Revolution {
  const Turning& turning;
  Eigen::Vector3d scale;
};

/// Joins `rings`, given from the axis' end down, all around.
void addRevolution(Mesh& mesh, const std::vector<Ring>& rings, const Revolution& of) {
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  const auto& [begin, quarter, axis] = of.turning;
  for (const Ring& ring : rings) {
    for (int i = 0; i <= kSegments; ++i) {
      const double turn = static_cast<double>(i) / kSegments;
      const Eigen::Vector3d out = std::cos(2.0 * kPi * turn) * begin + std::sin(2.0 * kPi * turn) * quarter;
      const Eigen::Vector3d position = ring.radius * out + ring.height * axis;
      const Eigen::Vector3d normal = ring.normal_out * out + ring.normal_up * axis;
      addVertex(mesh, position.cwiseProduct(of.scale), normal.cwiseQuotient(of.scale),
                {turn * ring.texture_u, ring.texture_v});
    }
  }
  const auto addTriangle = [&, clockwise = begin.cross(quarter).dot(axis) < 0.0](
                               std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    mesh.triangles.push_back(clockwise ? std::array{a, c, b} : std::array{a, b, c});
  };
  constexpr std::uint32_t kStride = kSegments + 1;
  for (std::uint32_t ring = 0; ring + 1 < rings.size(); ++ring) {
    for (std::uint32_t i = 0; i < kSegments; ++i) {
      const std::uint32_t upper = first + ring * kStride + i;
      const std::uint32_t lower = upper + kStride;
      if (rings[ring].radius > 0.0) addTriangle(upper, lower, upper + 1);
      if (rings[ring + 1].radius > 0.0) addTriangle(upper + 1, lower, lower + 1);
    }
  }
}

/// Rings of a unit sphere from polar angle `begin` to `end`, rad, lifted by `lift`.
void appendSphereRings(std::vector<Ring>& rings, double begin, double end, double lift) {
  const int steps = static_cast<int>(std::lround(kRings * (end - begin) / kPi));
  for (int i = 0; i <= steps; ++i) {
    const double polar = begin + (end - begin) * i / steps;
    const bool pole = std::abs(std::sin(polar)) < 1e-9;
    const double out = pole ? 0.0 : std::sin(polar);
    rings.push_back({out, std::cos(polar) + lift, out, std::cos(polar), 1.0, polar / kPi});
  }
}

}  // namespace

Mesh makeBox(const Eigen::Vector3d& size) {
  Mesh mesh;
  const Eigen::Vector3d half = 0.5 * size;
  const Eigen::Vector3d x(half.x(), 0, 0), y(0, half.y(), 0), z(0, 0, half.z());
  addRectangle(mesh, x, y, z);
  addRectangle(mesh, -x, -y, z);
  addRectangle(mesh, y, -x, z);
  addRectangle(mesh, -y, x, z);
  addRectangle(mesh, z, -y, x);
  addRectangle(mesh, -z, -y, -x);
  return mesh;
}

Mesh makeEllipsoid(const Eigen::Vector3d& radii) {
  Mesh mesh;
  std::vector<Ring> rings;
  appendSphereRings(rings, 0.0, kPi, 0.0);
  addRevolution(mesh, rings, {kSphere, radii});
  return mesh;
}

Mesh makeCylinder(double radius, double length) {
  Mesh mesh;
  const Revolution whole{kCylinder, {radius, radius, 0.5 * length}};
  addRevolution(mesh, {{0, 1, 0, 1, 0, 0}, {1, 1, 0, 1, 1, 1}}, whole);
  addRevolution(mesh, {{1, 1, 1, 0, 1, 1}, {1, -1, 1, 0, 1, 0}}, whole);
  addRevolution(mesh, {{1, -1, 0, -1, 1, 0}, {0, -1, 0, -1, 0, 0}}, whole);
  return mesh;
}

Mesh makeCone(double radius, double length) {
  Mesh mesh;
  const Revolution whole{kCylinder, {radius, radius, 0.5 * length}};
  addRevolution(mesh, {{0, 1, 2, 1, 1, 1}, {1, -1, 2, 1, 1, 0}}, whole);
  addRevolution(mesh, {{1, -1, 0, -1, 1, 0}, {0, -1, 0, -1, 0, 0}}, whole);
  return mesh;
}

Mesh makeCapsule(double radius, double length) {
  Mesh mesh;
  const double lift = 0.5 * length / radius;
  std::vector<Ring> rings;
  appendSphereRings(rings, 0.0, 0.5 * kPi, lift);
  appendSphereRings(rings, 0.5 * kPi, kPi, -lift);
  addRevolution(mesh, rings, {kAroundZ, Eigen::Vector3d::Constant(radius)});
  return mesh;
}

Mesh makePlane(const Eigen::Vector2d& size, const Eigen::Vector3d& normal) {
  Mesh mesh;
  const Eigen::Quaterniond turned = turnBetween(Eigen::Vector3d::UnitZ(), normal);
  addRectangle(mesh, Eigen::Vector3d::Zero(), turned * Eigen::Vector3d(0.5 * size.x(), 0, 0),
               turned * Eigen::Vector3d(0, 0.5 * size.y(), 0));
  return mesh;
}

}  // namespace sunlit::scene
