/// The light of one sky at every node.
#pragma once

#include <vector>

#include "light/bake/samples/transport_data.h"
#include "sunlit/light/illumination.h"
#include "sunlit/light/visibility.h"
#include "sunlit/sky/daylight.h"

namespace sunlit::light {

struct Conditions {
  const sky::Daylight& day;
  const std::vector<float>& lamp_shares;  ///< of the light of BakedLamps' sets; none beyond them
  /// Of the scene: finds where sun and moon shine into BakedRooms. Null: they are taken as part of the
  /// patches of the sky there too.
  const Visibility* visibility;
};

/// At each node. Parallel; the same bits for any number of threads.
std::vector<NodeLight> relight(const TransportData& data, const Conditions& conditions);

}  // namespace sunlit::light
