#include "render/screen_triangle.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "sunlit/quantity/whole.h"

namespace sunlit::render {
namespace {

/// Cuts off the part of `polygon` where `inside` is negative.
template <typename Inside>
void clip(const Inside& inside, std::vector<Eigen::Vector3f>* polygon) {
  thread_local std::vector<Eigen::Vector3f> cut;
  cut.clear();
  for (std::size_t i = 0; i < polygon->size(); ++i) {
    const Eigen::Vector3f& here = (*polygon)[i];
    const Eigen::Vector3f& next = (*polygon)[(i + 1) % polygon->size()];
    const float a = inside(here), b = inside(next);
    if (a >= 0.0f) cut.push_back(here);
    // From the inner to the outer end, so that both triangles on an edge get the same point.
    if (a >= 0.0f && b < 0.0f) cut.push_back(here + (next - here) * (a / (a - b)));
    if (a < 0.0f && b >= 0.0f) cut.push_back(next + (here - next) * (b / (b - a)));
  }
  polygon->swap(cut);
}

std::int32_t toSteps(float samples) {
  return floorOf(samples * ScreenTriangle::kSteps + 0.5f);
}

/// ⌊a / kSteps⌋ and ⌈a / kSteps⌉.
int floorSteps(std::int32_t a) {
  return a >> 8;
}
int ceilSteps(std::int32_t a) {
  return (a + ScreenTriangle::kSteps - 1) >> 8;
}
static_assert(ScreenTriangle::kSteps == 1 << 8, "shifted by");

}  // namespace

ScreenProjection::ScreenProjection(const View& view)
    : columns_(view.camera.width * view.supersampling),
      rows_(view.camera.height * view.supersampling),
      near_m_(static_cast<float>(view.near_m)),
      far_m_(static_cast<float>(view.far_m)),
      eye_(view.eye()),
      eye_high_(eye_.cast<float>()),
      eye_low_((eye_ - eye_high_.cast<double>()).cast<float>()) {
  const double s = view.supersampling;
  const image::PinholeCamera& c = view.camera;
  Eigen::Matrix3d screen_from_optical = Eigen::Matrix3d::Identity();
  screen_from_optical(0, 0) = s * c.fx;
  screen_from_optical(1, 1) = s * c.fy;
  screen_from_optical(0, 2) = s * (c.cx + 0.5) - 0.5;
  screen_from_optical(1, 2) = s * (c.cy + 0.5) - 0.5;
  screen_from_map_ = (screen_from_optical * view.map_from_optical.linear().transpose()).cast<float>();
  ray_ = view.ray(view.pixelOfSample(0), view.pixelOfSample(0));
  ray_per_column_ = view.ray(view.pixelOfSample(1), view.pixelOfSample(0)) - ray_;
  ray_per_row_ = view.ray(view.pixelOfSample(0), view.pixelOfSample(1)) - ray_;
}

Eigen::Vector3f ScreenProjection::toScreen(const Eigen::Vector3f& position) const {
  return screen_from_map_ * ((position - eye_high_) - eye_low_);
}

Linear ScreenProjection::alongRays(const Eigen::Vector3d& vector) const {
  return {vector.dot(ray_), vector.dot(ray_per_column_), vector.dot(ray_per_row_)};
}

void ScreenProjection::append(const Batch& batch, ScreenTriangles* out) const {
  const light::Geometry& geometry = batch.geometry;
  const bool masked = isMasked(batch.material);
  const float right = static_cast<float>(columns_ - 1), bottom = static_cast<float>(rows_ - 1);
  for (std::uint32_t t = batch.first; t < batch.first + batch.count; ++t) {
    std::array<Eigen::Vector3f, 3> corners;
    for (std::size_t i = 0; i < 3; ++i) corners[i] = toScreen(geometry.positions[geometry.triangles[t][i]]);
    const auto all = [&](auto outside) { return std::all_of(corners.begin(), corners.end(), outside); };
    if (all([&](const auto& p) { return p.z() < near_m_; }) ||
        all([&](const auto& p) { return p.z() > far_m_; }))
      continue;
    if (all([&](const auto& p) { return p.x() < 0.0f; }) ||
        all([&](const auto& p) { return p.y() < 0.0f; }) ||
        all([&](const auto& p) { return p.x() > right * p.z(); }) ||
        all([&](const auto& p) { return p.y() > bottom * p.z(); }))
      continue;
    const scene::Plane& plane = geometry.planes[t];
    const Eigen::Vector3d normal = plane.normal.cast<double>();
    const double distance = plane.offset - normal.dot(eye_);  // > 0: the eye is behind it
    if (distance == 0.0 || (!batch.material.double_sided && distance > 0.0)) continue;
    ScreenTriangle triangle;
    triangle.number = batch.first_number + t + 1;
    triangle.nearness = alongRays(normal / distance);
    const std::size_t before = out->triangles.size();
    const bool whole = std::all_of(corners.begin(), corners.end(), [&](const Eigen::Vector3f& p) {
      const float beyond = ScreenTriangle::kReach * p.z();
      return p.z() >= near_m_ && p.x() >= -beyond && p.y() >= -beyond && p.x() <= right * p.z() + beyond &&
             p.y() <= bottom * p.z() + beyond;
    });
    if (!whole) {
      appendClipped(corners, triangle, &out->triangles);
    } else if (placeCorners(corners, &triangle)) {
      out->triangles.push_back(triangle);
    }
    if (!masked || out->triangles.size() == before) continue;
    out->masks.push_back(maskPlanes(batch, t));
    for (std::size_t i = before; i < out->triangles.size(); ++i)
      out->triangles[i].mask = static_cast<std::int32_t>(out->masks.size()) - 1;
  }
}

void ScreenProjection::appendClipped(const std::array<Eigen::Vector3f, 3>& corners,
                                     const ScreenTriangle& common,
                                     std::vector<ScreenTriangle>* triangles) const {
  Polygon polygon(corners.begin(), corners.end());
  clip([&](const Eigen::Vector3f& p) { return p.z() - near_m_; }, &polygon);
  const float right = static_cast<float>(columns_ - 1) + ScreenTriangle::kReach,
              bottom = static_cast<float>(rows_ - 1) + ScreenTriangle::kReach;
  clip([&](const Eigen::Vector3f& p) { return right * p.z() - p.x(); }, &polygon);
  clip([&](const Eigen::Vector3f& p) { return p.x() + ScreenTriangle::kReach * p.z(); }, &polygon);
  clip([&](const Eigen::Vector3f& p) { return bottom * p.z() - p.y(); }, &polygon);
  clip([&](const Eigen::Vector3f& p) { return p.y() + ScreenTriangle::kReach * p.z(); }, &polygon);
  for (std::size_t i = 1; i + 1 < polygon.size(); ++i) {
    ScreenTriangle triangle = common;
    if (placeCorners({polygon[0], polygon[i], polygon[i + 1]}, &triangle)) triangles->push_back(triangle);
  }
}

/// False if it covers no sample.
bool ScreenProjection::placeCorners(const std::array<Eigen::Vector3f, 3>& corners,
                                    ScreenTriangle* triangle) const {
  std::array<float, 3> nearness;
  for (std::size_t i = 0; i < 3; ++i) {
    nearness[i] = 1.0f / corners[i].z();
    triangle->x[i] = toSteps(corners[i].x() * nearness[i]);
    triangle->y[i] = toSteps(corners[i].y() * nearness[i]);
  }
  const auto [x_least, x_greatest] = std::minmax_element(triangle->x.begin(), triangle->x.end());
  const auto [y_least, y_greatest] = std::minmax_element(triangle->y.begin(), triangle->y.end());
  triangle->left = std::max(ceilSteps(*x_least), 0);
  triangle->right = std::min(floorSteps(*x_greatest), columns_ - 1);
  triangle->top = std::max(ceilSteps(*y_least), 0);
  triangle->bottom = std::min(floorSteps(*y_greatest), rows_ - 1);
  if (triangle->left > triangle->right || triangle->top > triangle->bottom) return false;
  const auto along = [&](std::size_t i) {
    return static_cast<std::int64_t>(triangle->x[i]) - triangle->x[0];
  };
  const auto down = [&](std::size_t i) { return static_cast<std::int64_t>(triangle->y[i]) - triangle->y[0]; };
  const std::int64_t area = along(1) * down(2) - along(2) * down(1);
  if (area == 0) return false;
  if (area < 0) {
    std::swap(triangle->x[1], triangle->x[2]);
    std::swap(triangle->y[1], triangle->y[2]);
  }
  // Rounded corners let a sample lie a little beside the triangle, where its plane, seen from the side, may
  // be anywhere.
  triangle->nearness_least = std::min({nearness[0], nearness[1], nearness[2]});
  triangle->nearness_greatest = std::max({nearness[0], nearness[1], nearness[2]});
  return true;
}

MaskPlanes ScreenProjection::maskPlanes(const Batch& batch, std::uint32_t t) const {
  const light::Geometry& geometry = batch.geometry;
  const auto& vertices = geometry.triangles[t];
  const auto corner = [&](std::size_t i) { return geometry.positions[vertices[i]].cast<double>(); };
  const auto coordinate = [&](std::size_t i) {
    return geometry.texture_coordinates[vertices[i]].cast<double>();
  };
  const Eigen::Vector3d a = corner(0), ab = corner(1) - a, ac = corner(2) - a;
  const Eigen::Vector3d cross = ab.cross(ac);
  // Of a point p, the shares of b and c are (p − a) · towards_b and (p − a) · towards_c.
  const Eigen::Vector3d towards_b = ac.cross(cross) / cross.squaredNorm();
  const Eigen::Vector3d towards_c = cross.cross(ab) / cross.squaredNorm();
  const Eigen::Vector2d at_a = coordinate(0), along_b = coordinate(1) - at_a, along_c = coordinate(2) - at_a;
  const Eigen::Vector3d u = along_b.x() * towards_b + along_c.x() * towards_c;
  const Eigen::Vector3d v = along_b.y() * towards_b + along_c.y() * towards_c;
  return {batch.texture, static_cast<float>(at_a.x() + u.dot(eye_ - a)),
          static_cast<float>(at_a.y() + v.dot(eye_ - a)), alongRays(u), alongRays(v)};
}

}  // namespace sunlit::render
