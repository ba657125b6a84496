/// Where it does not rain.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "sunlit/scene/scene.h"
#include "sunlit/scene/shape.h"

namespace sunlit::scene {

class TopHeights;

/// Of rain that falls straight down, past what is cut out or blends: what lies more than a decimetre or two
/// below the topmost surface, by cells of 0.25 m (worlds above 1 km: 1/4096 of their length), is sheltered.
/// Immutable.
class Shelter {
 public:
  /// Takes tenths of a second.
  Shelter(const Shape& shape, const std::vector<Material>& materials);
  ~Shelter();

  bool open(const Eigen::Vector3d& place) const;

 private:
  std::unique_ptr<const TopHeights> tops_;
};

}  // namespace sunlit::scene
