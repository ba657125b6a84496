/// The light of one sky at every node.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "light/transport/transport_data.h"
#include "sunlit/sky/daylight.h"

namespace sunlit::light {

struct NodeLight {
  /// Illuminance of each node, lx: from the sky, and from sun, moon and sky by way of other surfaces. Without
  /// the direct light of sun and moon.
  std::vector<Eigen::Array3f> irradiance;
  /// Mean luminance of the surfaces that a node sees, cd/m².
  std::vector<Eigen::Array3f> surroundings;
};

/// Parallel; the same bits for any number of threads.
NodeLight relight(const TransportData& data, const sky::Daylight& day);

}  // namespace sunlit::light
