#include "light/bake/gather/room_mirrors.h"

#include <algorithm>
#include <cmath>

#include "light/bake/samples/triangle_places.h"
#include "light/shading/ggx.h"
#include "light/shading/mirror_lobe.h"
#include "light/shading/polished_floor.h"
#include "light/shading/schlick.h"
#include "sunlit/light/surfaces.h"
#include "sunlit/quantity/angle.h"
#include "sunlit/quantity/photometry.h"

namespace sunlit::light {

bool mirrorsRays(const Paint& paint) {
  constexpr float kColour = 0.1f;  // that a metal's mirror may lose
  const float most = paint.albedo.maxCoeff(), least = paint.albedo.minCoeff();
  return paint.roughness < kPolished && paint.grazingReflectance() > 0.0f &&
         paint.metalness * (most - least) <= kColour * most;
}

MirroredRay mirroredRay(const Geometry& geometry, const Paint& paint, const LaneHit& hit,
                        const Eigen::Vector2f& facet) {
  const std::uint32_t triangle = hit.hits.triangle[hit.lane];
  const float u = hit.hits.u[hit.lane], v = hit.hits.v[hit.lane];
  const bool back = geometry.planes[triangle].normal.dot(hit.towards) > 0.0f;
  const Eigen::Vector3f normal = sideNormal(geometry, triangle, back ? 1 : 0);
  const Eigen::Vector3f position = placeOn(geometry, triangle, {1.0f - u - v, u, v});
  const float n_v = std::clamp(-normal.dot(hit.towards), 1e-3f, 1.0f);
  const Eigen::Vector3f eye(-std::sqrt(1.0f - n_v * n_v), 0.0f, n_v);
  const float radius = std::sqrt(facet.x()), turn = 2.0f * kPiFloat * facet.y();
  const auto facets = Ggx<float>::ofRoughness(std::max(paint.roughness, scene::Material::kSmoothest));
  const Eigen::Vector3f half = facets.visibleNormal(eye, {radius * std::cos(turn), radius * std::sin(turn)});
  const float v_h = std::clamp(eye.dot(half), 0.0f, 1.0f);
  const Eigen::Vector3f to = 2.0f * v_h * half - eye;
  MirroredRay ray{position + rayClearance_m(position, 0.0f) * normal,
                  MirrorFrame(normal, -hit.towards).inMap(to).normalized(), 0.0f};
  if (!(to.z() > 1e-4f)) return ray;  // below the surface: light that facets throw on others is not followed
  const float f0 = paint.normalReflectance();
  const float fresnel = f0 + (paint.grazingReflectance() - f0) * schlick(v_h);
  ray.share = std::min(fresnel * facets.shadowing(to.z(), n_v), kMostReflected);
  return ray;
}

}  // namespace sunlit::light
