/// The light of one sky at the nodes of a bake.
#pragma once

#include <memory>
#include <vector>

#include "light/bake/samples/node_lights.h"
#include "light/bake/samples/transport_data.h"
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

/// Finds sun and moon in rooms, and the light of lamps, at once, and leaves all else to what it returns,
/// which may be called by many threads. Parallel; the same bits for any number of threads. Keeps `data`.
FindLight relight(std::shared_ptr<const TransportData> data, const Conditions& conditions);

}  // namespace sunlit::light
