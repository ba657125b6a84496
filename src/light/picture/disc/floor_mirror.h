/// Polished floors as the way by which light of a disc comes to what stands above them.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "light/picture/disc/disc_way.h"
#include "light/shading/vertex.h"
#include "sunlit/light/visibility.h"

namespace sunlit::light {

/// Rays go down to the disc's picture in a level floor, whose facets lean and spread it, and on from there to
/// the disc itself. What is not a polished floor stops them.
class FloorMirror : public DiscWay {
 public:
  /// Of a disc about the unit vector `towards`, whose radius has the tangent `tan_radius`. Keeps a reference.
  FloorMirror(const Visibility& visibility, const Eigen::Vector3f& towards, float tan_radius)
      : visibility_(visibility),
        vertices_(visibility.fixedGeometry(), visibility.movingGeometry()),
        towards_(towards),
        tan_radius_(tan_radius) {}

  void stopped(const Rays& rays, std::uint8_t* stopped) const override;

  /// The polished floor that one ray meets first, if it does.
  std::optional<Vertex> floorAlong(const Eigen::Vector3f& origin, const Eigen::Vector3f& down) const;

  /// What a level mirror makes of a direction, both ways.
  static Eigen::Vector3f mirrored(const Eigen::Vector3f& direction) {
    return {direction.x(), direction.y(), -direction.z()};
  }

 private:
  Eigen::Vector3f onDisc(const Eigen::Vector3f& spread) const;

  const Visibility& visibility_;
  SceneVertices vertices_;
  Eigen::Vector3f towards_;
  float tan_radius_;
};

}  // namespace sunlit::light
