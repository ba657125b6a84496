/// Attributes that glTF may write as whole numbers; Assimp takes their bytes for those of floats.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace sunlit::scene {

/// The address of a buffer that is nowhere but here.
constexpr const char* kFloats = "sunlit_floats.bin";

/// Gives positions, normals, tangents, texture coordinates and weights the floats that their whole numbers
/// stand for (glTF 2.0, sections 3.6.2.2 and 3.7.2.1, and KHR_mesh_quantization): their accessors in `root`,
/// the JSON of `file`, then refer to a further buffer by the address kFloats. Its bytes; empty where all were
/// floats. Throws std::runtime_error naming `file` where such numbers are not where it says, or sparse.
std::string useFloats(nlohmann::json& root, const std::string& file);

}  // namespace sunlit::scene
