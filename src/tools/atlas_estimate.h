/// What an atlas will take, told before it starts.
#pragma once

#include <cstddef>
#include <string>

#include "tools/atlas_folder.h"
#include "tools/atlas_observe.h"
#include "tools/atlas_options.h"

namespace sunlit::tools {

/// Measured at a few places of the path under a few of the lights, means of these; s of the wall clock on
/// this machine with all its processors.
struct AtlasCost {
  double draw_s = 0.0;           ///< a pose
  double picture_s = 0.0;        ///< a light of a pose: to light it, and to find features by all methods
  double query_s = 0.0;          ///< a query in a map, by all methods together
  double picture_bytes = 0.0;    ///< of observations, by all methods together
  double key_frame_bytes = 0.0;  ///< in memory, of the method that needs most

  AtlasCost& operator+=(const AtlasCost& other);
  AtlasCost& operator*=(double factor);
};

/// Takes a few pictures, of which nothing stays.
AtlasCost measureCost(const AtlasRunOptions& options, AtlasCamera* camera);

struct AtlasEstimate {
  double observe_s = 0.0;  ///< all of it, what is there too
  double compare_s = 0.0;
  double observations_bytes = 0.0;
  double cells_bytes = 0.0;
  double map_bytes = 0.0;  ///< of memory, while one map is looked into

  double bytes() const { return observations_bytes + cells_bytes; }
};

AtlasEstimate estimateOf(const AtlasRunOptions& options, const AtlasCost& cost);

/// Says it, and throws std::runtime_error naming both numbers where the disk has less room than what is not
/// there yet will take.
void tellAndRequireRoom(const AtlasRunOptions& options, const AtlasFolder& folder,
                        const AtlasEstimate& estimate);

}  // namespace sunlit::tools
