/// All that shines on surfaces as lamps do.
#pragma once

#include <vector>

#include "light/lamps/lamp_beam.h"
#include "sunlit/light/illumination.h"

namespace sunlit::light {

/// Of all that lights straight but for sun and moon: lamps, surfaces that pass on their light, and compact
/// sources.
std::vector<LampBeam> beamsOf(const Illumination& light);

}  // namespace sunlit::light
