/// Warnings that tell why there may be nothing to see.
#pragma once

#include <string>

#include "scene/resource_finder.h"
#include "scene/scene_builder.h"
#include "sunlit/image/files.h"

namespace sunlit::scene {

constexpr const char* kMissingModels = "models are missing and were left out";
constexpr const char* kMissingMeshes = "meshes are missing and were left out";

/// Counts a file that is there in name alone among `kind`, or throws std::runtime_error, as `finder` says.
void leaveOut(const std::string& kind, const image::ContentMissing& file, const ResourceFinder& finder,
              SceneBuilder& builder);

}  // namespace sunlit::scene
