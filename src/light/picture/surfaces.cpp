#include "sunlit/light/surfaces.h"

namespace sunlit::light {

Eigen::Vector3f Surfaces::towards(float x, float y) const {
  if (bent) return (map_from_optical * bent->at(x, y)).normalized().cast<float>();
  return (pixel_origin + x * pixel_right + y * pixel_down).normalized();
}

}  // namespace sunlit::light
