/// An SDF file as libsdformat reads it, with its complaints in one line.
#pragma once

#include <sdf/Root.hh>

#include "scene/scene_builder.h"
#include "scene/sdf_includes.h"

namespace sunlit::scene {

/// What becomes of <include>.
enum class SdfSharing {
  kShared,  ///< read once however often it is included, see SdfIncludes::instances(); what cannot be shared
            ///< is left to libsdformat alone
  kPlain,   ///< left to libsdformat, so that `root` holds all
};

/// Reads the file of `includes` into `root`; odd things in it become warnings of `builder`. Throws
/// std::runtime_error naming file and line of what cannot be read, and where a missing file was looked for.
void readSdf(SdfIncludes& includes, SdfSharing sharing, sdf::Root& root, SceneBuilder& builder);

}  // namespace sunlit::scene
