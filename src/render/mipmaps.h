/// Ever smaller versions of a texture, averaged in linear light.
#pragma once

#include <vector>

#include "sunlit/scene/scene.h"

namespace sunlit::render {

/// No mask: alpha is averaged like a colour.
constexpr float kNoCutoff = -1.0f;
/// No mask either, but what alpha leaves out is not there, and has no colour.
constexpr float kBlends = -2.0f;

/// Level 1 and smaller, down to 1×1. Colours are averaged in linear light, weighted by alpha if there is a
/// mask or it blends, so that what was cut out does not bleed in. With `cutoff` (0 … 1) each level's alpha is
/// scaled so that the mask lets as much through as level 0 does: without that, leaves and fences thin out
/// with distance.
std::vector<scene::TextureSize> smallerLevels(const scene::Texture& texture, float cutoff);

}  // namespace sunlit::render
