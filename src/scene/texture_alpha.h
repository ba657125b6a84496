/// What alpha of textures stands for.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "sunlit/scene/scene.h"

namespace sunlit::scene {

/// A texture whose alpha is below one half in more than this share of its texels is a cut-out. Formats
/// without an alpha mode carry the channel by accident often enough (smooth edges, unused channels) for a
/// stray texel not to count.
constexpr double kTransparentShare = 0.01;

/// What alpha of a texture stands for, where its file does not say.
enum class AlphaMeans { kNothing, kCutOut, kVeil, kAccident };
inline AlphaMeans meaningOf(const Texture& texture) {
  const std::size_t texels = texture.rgba.size() / 4;
  std::size_t transparent = 0;
  std::uint8_t most = 0;
  for (std::size_t i = 0; i < texels; ++i) {
    const std::uint8_t alpha = texture.rgba[4 * i + 3];
    transparent += alpha < 128 ? 1 : 0;
    most = std::max(most, alpha);
  }
  if (!(static_cast<double>(transparent) > kTransparentShare * static_cast<double>(texels)))
    return AlphaMeans::kNothing;
  // Nobody paints what is nowhere to be seen: tinted glass, or an unused channel.
  if (most < 128) return most > 0 ? AlphaMeans::kVeil : AlphaMeans::kAccident;
  return AlphaMeans::kCutOut;
}

}  // namespace sunlit::scene
