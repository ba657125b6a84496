/// Lamps that are baked together: what each of them passes on is known as one sum.
#pragma once

#include <cstdint>
#include <vector>

#include "sunlit/light/lamps.h"
#include "sunlit/scene/scene.h"

namespace sunlit::light {

/// Of one group and one unit; where there are more than kMostLampSets of those, the last set holds the rest.
struct LampSet {
  std::vector<std::uint32_t> lamps;  ///< indices into Scene::lamps, ascending
};

/// In the order of their first lamps. A function of `lamps` alone.
std::vector<LampSet> lampSets(const std::vector<scene::Lamp>& lamps);

/// Those of its lamps that burn; with the usual options all do, as they are baked.
std::vector<scene::Lamp> lampsOf(const LampSet& set, const std::vector<scene::Lamp>& lamps,
                                 const LampOptions& options = {});

/// What to multiply the baked light of each of lampSets(lamps) by: 0 where none burns. Of a set of several
/// groups, of which some are switched off, the share of the intensity that burns.
std::vector<float> burningShares(const std::vector<scene::Lamp>& lamps, const LampOptions& options);

}  // namespace sunlit::light
