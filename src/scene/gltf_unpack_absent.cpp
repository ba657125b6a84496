/// In the place of what unpacks views, where the build has no meshoptimizer for it.
#include "scene/gltf_unpack.h"

namespace sunlit::scene {

bool unpacks() {
  return false;
}

bool unpackViews(nlohmann::json&, GltfBuffers&) {
  return false;
}

}  // namespace sunlit::scene
