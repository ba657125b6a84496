/// The light of one sky at every node.
#pragma once

#include <vector>

#include "light/transport/transport_data.h"
#include "sunlit/light/illumination.h"
#include "sunlit/sky/daylight.h"

namespace sunlit::light {

/// At each node, with these shares of the light of BakedLamps' sets; none beyond `lamp_shares`. Parallel; the
/// same bits for any number of threads.
std::vector<NodeLight> relight(const TransportData& data, const sky::Daylight& day,
                               const std::vector<float>& lamp_shares);

}  // namespace sunlit::light
