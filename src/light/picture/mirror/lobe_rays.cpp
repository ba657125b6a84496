#include "light/picture/mirror/lobe_rays.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "light/patches/random.h"
#include "light/shading/ggx.h"
#include "light/shading/schlick.h"

namespace sunlit::light {
namespace {

/// A point of the unit square. Each pixel of a block has a cell of its own, and each of its samples a part of
/// that, so that what one pixel's rays meet lies together.
Eigen::Vector2f pointOf(std::uint32_t pixel, int picture_width, std::uint32_t sample, std::uint32_t samples) {
  const auto width = static_cast<std::uint32_t>(picture_width);
  constexpr std::uint32_t kAcross = kLobePixels;
  const std::uint32_t column = pixel % width % kAcross, row = pixel / width % kAcross;
  // Neighbours get cells far apart: any two by two of them see all of the lobe, roughly.
  constexpr std::uint32_t kOrder[kAcross] = {0, 2, 1, 3};
  const float along = (static_cast<float>(sample) + uniform(pixel, 2 * sample)) / static_cast<float>(samples);
  const float across = uniform(pixel, 2 * sample + 1);
  return {(static_cast<float>(kOrder[(column + 2 * (row % 2)) % kAcross]) + along) / kAcross,
          (static_cast<float>(kOrder[row]) + across) / kAcross};
}

}  // namespace

LobeRay lobeRay(const Surface& surface, const Eigen::Vector3f& to_eye, int picture_width,
                std::uint32_t sample) {
  const Eigen::Vector3f& normal = surface.shading_normal;
  const float n_v = std::clamp(normal.dot(to_eye), 1e-3f, 1.0f);
  Eigen::Vector3f along = normal.dot(to_eye) * normal - to_eye;
  const float length = along.norm();
  along = length > 1e-4f ? Eigen::Vector3f(along / length) : normal.unitOrthogonal();
  const Eigen::Vector3f eye(-std::sqrt(1.0f - n_v * n_v), 0.0f, n_v);
  const Eigen::Vector2f point = pointOf(surface.pixel, picture_width, sample, surface.samples);
  const float radius = std::sqrt(point.x()), turn = 2.0f * kPiFloat * point.y();
  const auto facets = Ggx<float>::ofRoughness(surface.roughness);
  const Eigen::Vector3f half = facets.visibleNormal(eye, {radius * std::cos(turn), radius * std::sin(turn)});
  const float v_h = std::clamp(eye.dot(half), 0.0f, 1.0f);
  const Eigen::Vector3f to = 2.0f * v_h * half - eye;
  const Eigen::Vector3f towards = to.x() * along + to.y() * normal.cross(along) + to.z() * normal;
  if (!(to.z() > 1e-4f)) return {towards.normalized(), 0.0f};
  const float fresnel = kDielectricF0 + (1.0f - kDielectricF0) * schlick(v_h);
  return {towards.normalized(), fresnel * facets.shadowing(to.z(), n_v)};
}

}  // namespace sunlit::light
