/// In which order Assimp hands on the materials of a glTF file.
#pragma once

#include <cstddef>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace sunlit::scene {

/// Index in `root`, which is that of `file`, of each of Assimp's materials, whose names are `names`.
/// Assimp 5.2 reads a material when the first mesh wants it: as its scene's nodes come, children first.
/// Versions that keep the file's order are told by their names or number. Those behind the last of the file
/// have its number: the default material.
std::vector<std::size_t> materialsInFile(const nlohmann::json& root, const std::string& file,
                                         const std::vector<std::string>& names);

}  // namespace sunlit::scene
