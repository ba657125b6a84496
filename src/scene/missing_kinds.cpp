#include "scene/missing_kinds.h"

#include <stdexcept>

namespace sunlit::scene {

void leaveOut(const std::string& kind, const image::ContentMissing& file, const ResourceFinder& finder,
              SceneBuilder& builder) {
  if (finder.missing() == Missing::kStop) throw std::runtime_error(std::string(file.what()) + kDrawTheRest);
  builder.warn(kind, file.what());
}

}  // namespace sunlit::scene
