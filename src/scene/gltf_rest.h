/// What Assimp does not hand on of the shapes that glTF's nodes have at rest.
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace sunlit::scene {

/// As many as the meshes that the scene of `root` shows have, each counted once. Throws std::exception where
/// the file does not say it as glTF does.
std::uint64_t trianglesOfScene(const nlohmann::json& root);

/// Whether any primitive of `root` is packed by Draco.
bool usesDraco(const nlohmann::json& root);

/// The scenes of `file` but the one that is shown, each by its name. Throws as trianglesOfScene().
std::vector<std::string> scenesNotShown(const nlohmann::json& root, const std::string& file);

/// The nodes and meshes of `file` that are drawn otherwise than it says, each with what of it is not read.
std::vector<std::string> shapesNotRead(const nlohmann::json& root, const std::string& file);

}  // namespace sunlit::scene
