/// Warnings that tell why there may be nothing to see.
#pragma once

namespace sunlit::scene {

constexpr const char* kMissingModels = "models are missing and were left out";
constexpr const char* kMissingMeshes = "meshes are missing and were left out";

}  // namespace sunlit::scene
