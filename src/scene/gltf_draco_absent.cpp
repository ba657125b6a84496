/// In the place of what unpacks Draco, where the build has none for it: then Assimp does, or says that it
/// cannot.
#include "scene/gltf_draco.h"

namespace sunlit::scene {

bool unpackDraco(nlohmann::json&, GltfBuffers&) {
  return false;
}

}  // namespace sunlit::scene
