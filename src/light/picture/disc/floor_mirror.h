/// Polished floors as the way by which light of a disc comes to what stands above them.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "light/picture/disc/disc_way.h"
#include "light/shading/vertex.h"
#include "sunlit/light/visibility.h"

namespace sunlit::light {

/// Rays go down to the disc's picture in a level floor, and on from there to the disc. What is not a polished
/// floor stops them.
class FloorMirror : public DiscWay {
 public:
  /// Keeps a reference.
  explicit FloorMirror(const Visibility& visibility)
      : visibility_(visibility), vertices_(visibility.fixedGeometry(), visibility.movingGeometry()) {}

  void stopped(const Rays& rays, std::uint8_t* stopped) const override;

  /// The polished floor that one ray meets first, if it does.
  std::optional<Vertex> floorAlong(const Eigen::Vector3f& origin, const Eigen::Vector3f& down) const;

  /// What a level mirror makes of a direction, both ways.
  static Eigen::Vector3f mirrored(const Eigen::Vector3f& direction) {
    return {direction.x(), direction.y(), -direction.z()};
  }

 private:
  const Visibility& visibility_;
  SceneVertices vertices_;
};

}  // namespace sunlit::light
