#include "light/picture/bodies/body_shade.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "light/patches/angles.h"
#include "sunlit/quantity/angle.h"

namespace sunlit::light {
namespace {

constexpr int kRays = 32;
/// One in so many is cast first; the others only where one of those met a body.
constexpr std::size_t kFirst = 4;
/// Bodies that hide less than this of a surface's light are passed over; up to twice as much their shade
/// fades in.
constexpr float kNegligible = 0.01f;

/// Points of a Fibonacci spiral in the unit square: the first evenly from 0 to 1, the second a turn.
struct Spiral {
  std::array<float, kRays> height, right, up;
  Spiral() {
    for (std::size_t i = 0; i < kRays; ++i) {
      height[i] = (static_cast<float>(i) + 0.5f) / kRays;
      right[i] = static_cast<float>(std::cos(kGoldenAngle * static_cast<double>(i)));
      up[i] = static_cast<float>(std::sin(kGoldenAngle * static_cast<double>(i)));
    }
  }
};

const Spiral& spiral() {
  static const Spiral points;
  return points;
}

/// Two unit vectors that are normal to `n` and each other, continuous but at −z (Duff et al., "Building an
/// Orthonormal Basis, Revisited", JCGT 6(1), 2017).
std::array<Eigen::Vector3f, 2> across(const Eigen::Vector3f& n) {
  const float sign = std::copysign(1.0f, n.z());
  const float a = -1.0f / (sign + n.z());
  const float b = n.x() * n.y() * a;
  return {Eigen::Vector3f(1.0f + sign * n.x() * n.x() * a, sign * b, -sign * n.x()),
          Eigen::Vector3f(b, sign + n.y() * n.y() * a, -n.y())};
}

}  // namespace

struct BodyShade::RayList {
  std::vector<float> ox, oy, oz, dx, dy, dz;
  std::vector<float> weight;  ///< share of the surface's light that comes along the ray
  std::vector<std::uint32_t> surface;
  void clear() {
    for (auto* list : {&ox, &oy, &oz, &dx, &dy, &dz, &weight}) list->clear();
    surface.clear();
  }
};

BodyShade::BodyShade(const Bodies& bodies, const Geometry& placed, const Visibility& visibility)
    : bodies_(bodies), visibility_(visibility), first_triangle_(visibility.fixedTriangles()) {
  Eigen::AlignedBox3f box;
  for (const scene::Chunk& chunk : placed.chunks) box.extend(chunk.box);
  if (box.isEmpty()) return;
  centre_ = box.center();
  for (const Eigen::Vector3f& position : placed.positions)
    radius_m_ = std::max(radius_m_, (position - centre_).norm());
  for (std::size_t body = 0; body < bodies.count(); ++body) {
    const Eigen::AlignedBox3f own = bodies.boxOf(body, placed);
    if (own.isEmpty()) continue;
    const float radius = 0.5f * own.diagonal().norm();
    // The mean shadow of a convex body is a quarter of its surface (Cauchy).
    spheres_.push_back(
        {own.center(), radius, std::min(0.25f * bodies.surfaceOf(body), kPiFloat * radius * radius)});
  }
}

/// From the form factor of a small area at a distance: area · cosine / (π distance²).
float BodyShade::nearness(const Surface& surface) const {
  float hidden = 0.0f;
  for (const Sphere& sphere : spheres_) {
    const Eigen::Vector3f towards = sphere.centre - surface.position;
    const float distance = towards.norm();
    if (distance <= sphere.radius_m) return 1.0f;
    // The cosine is that of a point half way between its middle and the side most in front.
    const float cosine = surface.shading_normal.dot(towards) / distance;
    const float sine = sphere.radius_m / distance;
    const float in_front = std::min(cosine + 0.5f * sine, 1.0f);
    if (in_front > 0.0f) hidden += sphere.shown_m2 * in_front / (kPiFloat * distance * distance);
  }
  return std::clamp(hidden / kNegligible - 1.0f, 0.0f, 1.0f);
}

void BodyShade::appendRays(const Tile& tile, std::uint32_t index, bool first, RayList* rays) const {
  const Surface& surface = tile.surfaces[index];
  Eigen::Vector3f axis = centre_ - surface.position;
  const float distance = axis.norm();
  const bool inside = distance <= radius_m_;
  // Inside the sphere all over the hemisphere, as many as light comes; outside only towards the sphere.
  axis = inside ? surface.shading_normal : Eigen::Vector3f(axis / distance);
  const float sine = inside ? 1.0f : radius_m_ / distance;
  const float depth = inside ? 1.0f : 1.0f - std::sqrt(1.0f - sine * sine);  // of the cap
  const auto [right, up] = across(axis);
  for (std::size_t i = 0; i < kRays; ++i) {
    if ((i % kFirst == 0) != first) continue;
    const float cosine = inside ? std::sqrt(1.0f - spiral().height[i]) : 1.0f - depth * spiral().height[i];
    const float radius = std::sqrt(std::max(1.0f - cosine * cosine, 0.0f));
    const Eigen::Vector3f direction =
        cosine * axis + radius * (spiral().right[i] * right + spiral().up[i] * up);
    // Solid angle of the cap, 2π depth, in equal parts; light comes by the cosine over π.
    const float weight = inside ? 1.0f / kRays : 2.0f * depth / kRays * surface.shading_normal.dot(direction);
    if (!(weight > 0.0f) || surface.geometric_normal.dot(direction) <= 0.0f) continue;
    rays->ox.push_back(tile.origin_x[surface.first_sample]);
    rays->oy.push_back(tile.origin_y[surface.first_sample]);
    rays->oz.push_back(tile.origin_z[surface.first_sample]);
    rays->dx.push_back(direction.x());
    rays->dy.push_back(direction.y());
    rays->dz.push_back(direction.z());
    rays->weight.push_back(weight);
    rays->surface.push_back(index);
  }
}

void BodyShade::cast(const RayList& rays, std::vector<float>* hidden) const {
  thread_local std::vector<std::uint8_t> blocked;
  blocked.assign(rays.surface.size(), 0);
  visibility_.occludedByMoving({rays.ox.data(), rays.oy.data(), rays.oz.data(), rays.dx.data(),
                                rays.dy.data(), rays.dz.data(), rays.surface.size()},
                               blocked.data());
  for (std::size_t i = 0; i < rays.surface.size(); ++i) {
    if (blocked[i]) (*hidden)[rays.surface[i]] += rays.weight[i];
  }
}

void BodyShade::apply(const Tile& tile, TileOutlooks* outlooks) const {
  thread_local RayList rays;
  thread_local std::vector<float> hidden, near;
  hidden.assign(tile.surfaces.size(), 0.0f);
  near.assign(tile.surfaces.size(), 0.0f);
  rays.clear();
  for (std::uint32_t i = 0; i < tile.surfaces.size(); ++i) {
    const Surface& surface = tile.surfaces[i];
    outlooks->surfaces[i].body =
        surface.triangle >= first_triangle_
            ? static_cast<std::int32_t>(bodies_.bodyOf(surface.triangle - first_triangle_))
            : Outlook::kNoBody;
    near[i] = nearness(surface);
    if (near[i] > 0.0f) appendRays(tile, i, true, &rays);
  }
  cast(rays, &hidden);
  rays.clear();
  for (std::uint32_t i = 0; i < hidden.size(); ++i) {
    if (hidden[i] > 0.0f) appendRays(tile, i, false, &rays);
  }
  cast(rays, &hidden);
  for (std::size_t i = 0; i < hidden.size(); ++i)
    outlooks->surfaces[i].unhidden = std::max(1.0f - near[i] * hidden[i], 0.0f);
}

}  // namespace sunlit::light
