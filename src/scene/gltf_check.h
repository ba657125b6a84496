/// glTF files that Assimp may be given.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace sunlit::scene {

/// Assimp 5.2 trusts that accessors lie within their views, sparse ones too, and that strips, skins and
/// levels of nodes are as large as they must be; where they are not, it reads or writes memory that is not
/// its own. It passes over places of nodes, factors and modes of materials that have not the form they must.
/// Throws std::runtime_error naming `file`, place, and what should be there. What else is of the wrong type
/// Assimp finds itself.
void requireReadableGltf(const nlohmann::json& root, const std::string& file);

}  // namespace sunlit::scene
