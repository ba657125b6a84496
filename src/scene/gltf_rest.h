/// What Assimp does not hand on of the shapes that glTF's nodes have at rest.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace sunlit::scene {

/// The nodes of `file` that are drawn otherwise than it says, each with what of it is not read.
std::vector<std::string> shapesNotRead(const nlohmann::json& root, const std::string& file);

}  // namespace sunlit::scene
