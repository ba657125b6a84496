/// The sky as rough mirrors see it: a table by direction, as coarse as the patches that transport knows.
#pragma once

#include <Eigen/Core>
#include <Eigen/StdVector>
#include <array>
#include <cstdint>
#include <vector>

#include "light/transport/transport_data.h"
#include "sunlit/light/surfaces.h"
#include "sunlit/scene/scene.h"
#include "sunlit/sky/daylight.h"

namespace sunlit::light {

class MirrorSky {
 public:
  explicit MirrorSky(const sky::Daylight& day);

  /// Of a unit vector: its place in the table, an octahedral map of the sphere.
  static std::uint16_t placeOf(const Eigen::Vector3f& towards);
  /// cd/m², the fourth is padding.
  const Eigen::Array4f& luminance(std::uint16_t place) const { return table_[place]; }

 private:
  std::vector<Eigen::Array4f, Eigen::aligned_allocator<Eigen::Array4f>> table_;
};

/// Sets Surface::mirror of those surfaces of `tile` whose Surface::light is known: where they look, and how
/// much of the sky there `data` has open.
void findMirrorViews(const TransportData& data, const scene::Scene& scene, int picture_width, Tile* tile);

}  // namespace sunlit::light
