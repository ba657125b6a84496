#include "render/seen_triangle.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstring>

#include "sunlit/quantity/whole.h"

namespace sunlit::render {
namespace {

/// log2 of a positive number by its exponent and a straight line between powers of two, within 0.09: a tenth
/// of a level of a texture does not show.
float roughLog2(float value) {
  std::uint32_t bits;
  std::memcpy(&bits, &value, sizeof(bits));
  return static_cast<float>(bits) * (1.0f / (1u << 23)) - 127.0f;
}

}  // namespace

SeenTriangle::SeenTriangle(const Seen& seen, std::uint32_t number) {
  const light::Geometry& geometry = seen.of(number);
  const auto& vertices = geometry.triangles[number - seen.before(number)];
  const light::Plane& plane = seen.plane(number);
  material_ = seen.material(number);
  const Eigen::Vector3d eye = seen.view.eye();
  const bool from_behind = plane.normal.cast<double>().dot(eye) < plane.offset;
  normal_ = from_behind ? Eigen::Vector3f(-plane.normal) : plane.normal;
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
  const Eigen::Array2f right = moved(step.right), down = moved(step.down);
  const float right_texels = (right * pyramid.size()).matrix().squaredNorm();
  const float down_texels = (down * pyramid.size()).matrix().squaredNorm();
  const Eigen::Array2f& longer = right_texels > down_texels ? right : down;
  // Also where it is not a number.
  constexpr float kMost = 1e12f;
  float most = std::max(right_texels, down_texels);
  if (!(most < kMost)) most = kMost;
  const float least = std::max(std::min(right_texels, down_texels), 1e-12f);
  // Several look-ups along the longer side of an area seen at a slant. Each reaches over two texels, so that
  // it covers its part of the area in a level whose texels are half as wide.
  const int taps = most < 2.25f * least ? 1 : most < 9.0f * least ? 2 : 4;
  const float part = taps == 1 ? 1.0f : taps == 2 ? 2.0f : 3.0f;
  float level = 0.5f * roughLog2(std::max(most, 1e-12f)) - part + seen.lod_bias;
  if (small) level = static_cast<float>(floorOf(level + 0.5f));
  if (level <= 0.0f && most < 1.0f) return (color * pyramid.color(at, 0.0f)).max(0.0f).min(1.0f);
  Eigen::Array3f sum = Eigen::Array3f::Zero();
  for (int i = 0; i < taps; ++i) {
    const float place = (static_cast<float>(i) + 0.5f) / static_cast<float>(taps) - 0.5f;
    sum += pyramid.color(most < kMost ? Eigen::Array2f(at + place * longer) : at, level);
  }
  return (color * sum * (1.0f / static_cast<float>(taps))).max(0.0f).min(1.0f);
}

}  // namespace sunlit::render
