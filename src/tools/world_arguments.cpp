#include "tools/world_arguments.h"

namespace sunlit::tools {

void addWorld(studio::CommandLine* line, studio::WorldOptions* options) {
  line->group("World");
  line->add("--world race_track|FILE",
            {"world", &options->name, "", {}, "built in, or a .world .sdf .dae .gltf .glb .obj"});
  line->add("--model-path DIR",
            {"model_path", &options->model_path, "", {}, "where model:// is looked for; may be repeated"});
}

void addBounced(studio::CommandLine* line, studio::BakeOptions* options) {
  line->add("--bounced", {"enabled",
                          choiceOf(&options->enabled, {"off", "on"}),
                          "",
                          {},
                          "light that surfaces hide and pass on; off: each sees the whole sky"});
  line->add("--cache DIR",
            studio::explainedAs(fieldOf(fieldsOf(*options), "cache_dir"),
                                "where that is kept for the next time; without it SUNLIT_CACHE_DIR, "
                                "or sunlit in XDG_CACHE_HOME, or ~/.cache/sunlit"));
}

}  // namespace sunlit::tools
