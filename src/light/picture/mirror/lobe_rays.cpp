#include "light/picture/mirror/lobe_rays.h"

#include <algorithm>
#include <cmath>

#include "light/shading/ggx.h"
#include "light/shading/mirror_lobe.h"
#include "light/shading/schlick.h"
#include "light/shading/shading.h"
#include "sunlit/quantity/photometry.h"
#include "sunlit/quantity/random.h"

namespace sunlit::light {
namespace {

constexpr std::uint32_t kMostBlocks = 4;
constexpr float kLeastRise = 1e-4f;  ///< above the surface: lower ones are none
constexpr float kPart = 0.8f;        ///< of the lobe's half width, that blocks may be high

}  // namespace

LobePixels lobePixels(const Surfaces& surfaces) {
  const auto x = static_cast<float>(surfaces.width / 2), y = static_cast<float>(surfaces.height / 2);
  return {static_cast<std::uint32_t>(surfaces.width),
          (surfaces.towards(x, y) - surfaces.towards(x - 1.0f, y)).norm()};
}

LobeReach lobeReach(float roughness, const LobePixels& pixels) {
  const float fit = kPart * roughness * roughness / (pixels.rad * static_cast<float>(kLobePixels));
  std::uint32_t down = kMostBlocks;
  while (down > 1 && static_cast<float>(down) > fit) down /= 2;
  return {std::max(down / 2, 1u), down};
}

std::uint32_t lobeRays(const Surface& surface, const LobePixels& pixels) {
  if (!fillsLobe(surface) || lobeReach(surface.roughness, pixels).down == 1) return surface.samples;
  return std::min(surface.samples, 2u);
}

namespace {

/// A point of the unit square. Each pixel of a block has a cell of its own, and of that each of its rays and
/// of the blocks about that share theirs another part.
Eigen::Vector2f pointOf(const Surface& surface, const LobePixels& pixels, std::uint32_t ray) {
  const std::uint32_t pixel = surface.pixel, rays = lobeRays(surface, pixels);
  const LobeReach reach = lobeReach(surface.roughness, pixels);
  constexpr std::uint32_t kAcross = kLobePixels;
  const std::uint32_t x = pixel % pixels.width, y = pixel / pixels.width;
  // Neighbours get cells far apart: any two by two of them see all of the lobe, roughly.
  constexpr std::uint32_t kOrder[kAcross] = {0, 2, 1, 3};
  const std::uint32_t block_x = x / kAcross, block_y = y / kAcross;
  // So many blocks of one row see all of it, too.
  const std::uint32_t column = kOrder[(x + 2 * (y % 2)) % kAcross], row = kOrder[(y + block_x) % kAcross];
  const std::uint32_t part = ray + rays * (block_x % reach.across);
  const std::uint32_t other = block_y % reach.down;
  const auto within = [](std::uint32_t cell, std::uint32_t of, std::uint32_t cells, float random) {
    return (static_cast<float>(cell) + (static_cast<float>(of) + random) / static_cast<float>(cells)) /
           kAcross;
  };
  return {within(column, part, rays * reach.across, uniform(pixel, 2 * ray)),
          within(row, other, reach.down, uniform(pixel, 2 * ray + 1))};
}

/// In the frame of MirrorFrame: as if it were never below the surface.
Eigen::Vector3f eyeOver(const Eigen::Vector3f& normal, const Eigen::Vector3f& to_eye) {
  const float n_v = std::clamp(normal.dot(to_eye), 1e-3f, 1.0f);
  return {-std::sqrt(1.0f - n_v * n_v), 0.0f, n_v};
}

struct Cosines {
  float n_v, n_l, v_h;
};

/// LobeRay::weight.
float weightOf(const Surface& surface, const Ggx<float>& facets, const Cosines& of) {
  const float f0 = normalReflectance(LinearRgb(surface.albedo).luminance(), surface.metalness);
  const float fresnel = f0 + (1.0f - f0) * schlick(of.v_h);
  return fresnel * facets.shadowing(of.n_l, of.n_v);
}

}  // namespace

LobeRay lobeRay(const Surface& surface, const Eigen::Vector3f& to_eye, const LobePixels& pixels,
                std::uint32_t ray) {
  const Eigen::Vector3f& normal = surface.shading_normal;
  if (!fillsLobe(surface)) return {mirrored(to_eye, normal), 1.0f};
  const Eigen::Vector3f eye = eyeOver(normal, to_eye);
  const float n_v = eye.z();
  const Eigen::Vector2f point = pointOf(surface, pixels, ray);
  const float radius = std::sqrt(point.x()), turn = 2.0f * kPiFloat * point.y();
  const auto facets = Ggx<float>::ofRoughness(surface.roughness);
  const Eigen::Vector3f half = facets.visibleNormal(eye, {radius * std::cos(turn), radius * std::sin(turn)});
  const float v_h = std::clamp(eye.dot(half), 0.0f, 1.0f);
  const Eigen::Vector3f to = 2.0f * v_h * half - eye;
  const Eigen::Vector3f towards = MirrorFrame(normal, to_eye).inMap(to);
  if (!(to.z() > kLeastRise)) return {towards.normalized(), 0.0f};
  return {towards.normalized(), weightOf(surface, facets, {n_v, to.z(), v_h})};
}

LobeAt lobeAt(const Surface& surface, const Eigen::Vector3f& to_eye, const Eigen::Vector3f& towards) {
  const MirrorFrame frame(surface.shading_normal, to_eye);
  const Eigen::Vector3f eye = eyeOver(surface.shading_normal, to_eye);
  const float n_v = eye.z(), n_l = surface.shading_normal.dot(towards);
  if (!(n_l > kLeastRise)) return {0.0f, 0.0f};
  const Eigen::Vector3f half =
      (eye + Eigen::Vector3f(towards.dot(frame.along), towards.dot(frame.left), n_l)).normalized();
  const auto facets = Ggx<float>::ofRoughness(surface.roughness);
  const float n_h = std::clamp(half.z(), 0.0f, 1.0f);
  const float density = facets.distribution(n_h) / (4.0f * n_v * (1.0f + facets.lambda(n_v)));
  return {density, density * weightOf(surface, facets, {n_v, n_l, std::clamp(eye.dot(half), 0.0f, 1.0f)})};
}

}  // namespace sunlit::light
