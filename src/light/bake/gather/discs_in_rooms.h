/// Sun and moon by way of the surfaces that they really light.
#pragma once

#include <vector>

#include "light/bake/gather/sent_light.h"
#include "light/bake/gather/through_cloud.h"
#include "light/bake/samples/transport_data.h"
#include "sunlit/light/visibility.h"
#include "sunlit/sky/daylight.h"

namespace sunlit::light {

/// What surfaces pass on of them in BakedRooms, illuminance of each room's sample, lx: by rays from the
/// surfaces that are seen there to the discs, and from surface to surface until it changes little. It starts
/// from what the patches of the sky tell, and where no room is, that stays. Of rooms in BakedRooms::glossy
/// without what comes straight from discs by way of polished floors, which pictures add: see GlintNodes.
/// Empty: neither shines by more than leastDisc_lx(), or no room is to be followed. Parallel; the same bits
/// for any number of threads.
std::vector<Arrived> discsInRooms(const TransportData& data, const sky::Daylight& day,
                                  const Visibility& visibility, const DiscsThroughCloud& through);

}  // namespace sunlit::light
