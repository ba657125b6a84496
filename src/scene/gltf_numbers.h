/// Numbers that the accessors of glTF files tell.
#pragma once

#include <cstddef>
#include <nlohmann/json.hpp>
#include <vector>

#include "scene/gltf_buffers.h"

namespace sunlit::scene {

/// The componentType of floats.
constexpr std::size_t kFloatComponent = 5126;

/// Whether the components of `accessor` are whole numbers of 8 or 16 bits.
bool tellsWholeNumbers(const nlohmann::json& accessor);

/// All numbers of `accessor`, whole ones of 8 or 16 bits as the floats that they stand for (glTF 2.0, section
/// 3.6.2.2); zeros, but for what a sparse one changes, where it has no view. Throws std::runtime_error where
/// they reach beyond their buffer or are of other types, and nlohmann::json::exception where what tells them
/// is missing.
std::vector<float> floatsOf(const nlohmann::json& root, const nlohmann::json& accessor, GltfBuffers& buffers);

}  // namespace sunlit::scene
