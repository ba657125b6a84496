/// What alpha of textures stands for.
#pragma once

#include "sunlit/scene/scene.h"

namespace sunlit::scene {

/// A texture whose alpha is below one half in more than this share of its texels is a cut-out. Formats
/// without an alpha mode carry the channel by accident often enough (smooth edges, unused channels) for a
/// stray texel not to count.
constexpr double kTransparentShare = 0.01;

/// What alpha of a texture stands for, where its file does not say.
enum class AlphaMeans {
  kNothing,
  kCutOut,   ///< of something on a blank ground
  kPainted,  ///< as a cut-out, but what it would hide is painted as well
  kVeil,     ///< below one half all over
  kAccident  ///< 0 all over
};
AlphaMeans meaningOf(const Texture& texture);

}  // namespace sunlit::scene
