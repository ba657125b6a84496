#include "ros/tools/world_arguments.h"

#include "ros/tools/arguments.h"

namespace sunlit::tools {

const char* const kWorldHelp =
    R"(  --world race_track|FILE        built-in world (default), or .world .sdf .dae .gltf .glb .obj
  --model-path DIR               where model:// is looked for; may be repeated
)";

const char* const kBouncedHelp =
    R"(  --bounced on|off               light that surfaces hide and pass on; off: each sees the whole sky (default on)
  --cache DIR                    where that is kept for the next time (default ~/.cache/sunlit)
)";

bool takeWorld(const std::string& key, const std::string& value, WorldOptions* options) {
  if (key == "--world") {
    options->name = value;
  } else if (key == "--model-path") {
    options->model_folders.push_back(value);
  } else {
    return false;
  }
  return true;
}

bool takeBounced(const std::string& key, const std::string& value, WorldOptions* options) {
  if (key == "--bounced") {
    if (value != "on" && value != "off") reject(key, value, "on or off");
    options->bounced = value == "on";
  } else if (key == "--cache") {
    options->cache = value;
  } else {
    return false;
  }
  return true;
}

}  // namespace sunlit::tools
