/// The light of one sky at every node.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "light/transport/transport_data.h"
#include "sunlit/light/illumination.h"
#include "sunlit/sky/daylight.h"

namespace sunlit::light {

struct NodeLight {
  /// Illuminance of each node, lx: from the sky, and from sun, moon and sky by way of other surfaces. Without
  /// the direct light of sun and moon.
  std::vector<Eigen::Array3f> irradiance;
  std::vector<Surroundings> surroundings;  ///< of each node
};

/// Parallel; the same bits for any number of threads.
NodeLight relight(const TransportData& data, const sky::Daylight& day);

}  // namespace sunlit::light
