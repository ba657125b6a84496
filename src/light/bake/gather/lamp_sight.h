/// A look from a surface at a lamp.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <optional>

#include "light/bake/samples/bake_rays.h"
#include "light/bake/samples/probe.h"
#include "light/lamps/lamp_beam.h"
#include "sunlit/light/surfaces.h"
#include "sunlit/quantity/angle.h"
#include "sunlit/quantity/random.h"

namespace sunlit::light {

/// A point of a surface that a lamp may light.
struct LitPoint {
  Eigen::Vector3f position;
  Eigen::Vector3f face;    ///< unit normal of the side that is lit
  Eigen::Vector3f normal;  ///< that it is shaded by, of any length, on either side
  float through = 0.0f;    ///< Receiver::transmission

  /// Unit, on the lit side.
  Eigen::Vector3f shadingNormal() const {
    if (!(normal.squaredNorm() > 1e-6f)) return face;
    return (normal.dot(face) < 0.0f ? -1.0f : 1.0f) * normal.normalized();
  }
};

struct LampSight {
  BakeSight sight;
  Eigen::Array3f light;  ///< illuminance if nothing hides the lamp, lx
};

/// A point of the unit disc, by chance, but the same for equal places: which of a surface that shines a place
/// looks at, since some of it may be hidden from all.
inline Eigen::Vector2f anyOfDisc(const Eigen::Vector3f& place) {
  std::uint64_t key = 0;
  for (const float coordinate : place) {
    std::uint32_t bits = 0;
    std::memcpy(&bits, &coordinate, sizeof bits);
    key = scrambled(key ^ bits);
  }
  const float radius = std::sqrt(uniform(key, 0)), turn = 2.0f * kPiFloat * uniform(key, 1);
  return radius * Eigen::Vector2f(std::cos(turn), std::sin(turn));
}

/// None where the point turns away from the lamp.
inline std::optional<LampSight> lampSight(const LampBeam& lamp, const LitPoint& point) {
  Eigen::Vector3f way = lamp.ball() - point.position;
  const float distance_m = way.norm();
  if (lamp.isSurface()) way += lamp.aside(way / std::max(distance_m, 1e-6f), anyOfDisc(point.position));
  const bool before = point.face.dot(way) > 0.0f;
  if (!before && !(point.through > 0.0f)) return std::nullopt;
  const float cosine = lamp.isTube() ? point.shadingNormal().dot(lamp.towards(point.position))
                                     : point.shadingNormal().dot(way) / std::max(distance_m, 1e-6f);
  const float counts = countedCosine(cosine, point.through);
  if (!(counts > 0.0f)) return std::nullopt;
  const float clearance_m = rayClearance_m(point.position, distance_m);
  const float reach = 1.0f - (lamp.spared_m() + clearance_m) / std::max(distance_m, 1e-6f);
  const float off = before ? clearance_m : -clearance_m;
  return LampSight{{point.position + off * point.face, way, std::max(reach, 0.0f)},
                   counts * lamp.at(point.position)};
}

}  // namespace sunlit::light
