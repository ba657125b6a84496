#include "tools/world_arguments.h"

namespace sunlit::tools {

void addWorld(studio::CommandLine* line, studio::WorldOptions* options) {
  line->group("World");
  const std::vector<Field> rows = fieldsOf(*options);
  line->add(
      "--world race_track|FILE",
      studio::explainedAs(fieldOf(rows, "world"), "built in, or a .world .sdf .urdf .dae .gltf .glb .obj"));
  line->add("--model-path DIR", studio::explainedAs(fieldOf(rows, "model_path"),
                                                    "where model:// is looked for; may be repeated"));
  line->add("--missing", fieldOf(rows, "missing"));
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

void addLamps(studio::CommandLine* line, light::LampOptions* options) {
  const std::vector<Field> rows = fieldsOf(*options);
  line->add("--lamps", fieldOf(rows, "lamps"));
  line->add("--lamps-dusk LX", fieldOf(rows, "lamps_dusk"));
  line->add("--lamps-off NAME", studio::explainedAs(fieldOf(rows, "lamps_off"),
                                                    "a group of lamps that stays dark: the name of a model, "
                                                    "link or file; may be repeated"));
  line->add("--lamps-colour LX", fieldOf(rows, "lamps_colour"));
}

}  // namespace sunlit::tools
