/// Command line options that say which world, shared by all tools; and how light spreads in it, shared by
/// those that light it.
#pragma once

#include <string>
#include <vector>

#include "sunlit/scene/load.h"

namespace sunlit::tools {

struct WorldOptions {
  std::string name = scene::kRaceTrack;    ///< as scene::load() takes it
  std::vector<std::string> model_folders;  ///< searched first
  bool bounced = true;  ///< surfaces hide the sky from each other and pass light on; false: an open sky
  std::string cache;    ///< folder for what that takes; empty: light::Transport::usualFolder()
};

/// Help for what takeWorld() and takeBounced() take.
extern const char* const kWorldHelp;
extern const char* const kBouncedHelp;

/// Takes --world and --model-path. Both say false for an option that is none of theirs, and throw as reject()
/// does.
bool takeWorld(const std::string& key, const std::string& value, WorldOptions* options);
/// Takes --bounced and --cache.
bool takeBounced(const std::string& key, const std::string& value, WorldOptions* options);

}  // namespace sunlit::tools
