/// Everything that the cameras of one scene share.
#pragma once

#include <memory>

#include "sunlit/light/geometry.h"
#include "sunlit/light/visibility.h"

namespace sunlit::light {

class Transport;

/// Cheap to copy.
struct World {
  /// Flattens `scene` and builds its ray structure; bakes nothing.
  explicit World(std::shared_ptr<const scene::Scene> scene);

  std::shared_ptr<const Geometry> geometry;
  std::shared_ptr<const Visibility> visibility;
  std::shared_ptr<const Transport> transport;  ///< of sky and bounced light; null: an open sky is assumed
};

}  // namespace sunlit::light
