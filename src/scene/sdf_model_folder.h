/// Which file of a model's folder is meant.
#pragma once

#include <string>

namespace sunlit::scene {

/// `place` itself if it is no folder; else the SDF file that its model.config (or manifest.xml, the old name)
/// gives for the newest version up to 1.9, or else the nearest one, or else the URDF that it gives; else its
/// model.sdf. Empty if there is none.
std::string modelFileOf(const std::string& place);

}  // namespace sunlit::scene
