#include "scene/texture_alpha.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <tuple>

namespace sunlit::scene {
namespace {

/// Of hidden texels so many are of one colour where nobody painted them: paint programs leave them as they
/// were, but for a rim.
constexpr double kBlankShare = 0.9;
/// Nobody cuts out so much: a channel that was never meant.
constexpr double kMostHidden = 0.95;

using Colour = std::tuple<std::uint8_t, std::uint8_t, std::uint8_t>;

template <typename Take>
void forEachHidden(const Texture& texture, const Take& take) {
  for (std::size_t i = 0; i + 3 < texture.rgba.size(); i += 4)
    if (texture.rgba[i + 3] < 128) take(Colour(texture.rgba[i], texture.rgba[i + 1], texture.rgba[i + 2]));
}

/// How many hidden texels are of the colour that more than half of them have; few, where none has.
std::size_t countOfOneColour(const Texture& texture) {
  Colour candidate;  // by the majority vote of Boyer and Moore
  std::int64_t votes = 0;
  forEachHidden(texture, [&](const Colour& colour) {
    if (votes == 0) candidate = colour;
    votes += colour == candidate ? 1 : -1;
  });
  std::size_t count = 0;
  forEachHidden(texture, [&](const Colour& colour) { count += colour == candidate ? 1 : 0; });
  return count;
}

}  // namespace

AlphaMeans meaningOf(const Texture& texture) {
  const auto texels = static_cast<double>(texture.rgba.size() / 4);
  std::size_t hidden_texels = 0;
  forEachHidden(texture, [&](const Colour&) { ++hidden_texels; });
  const auto hidden = static_cast<double>(hidden_texels);
  if (!(hidden > kTransparentShare * texels)) return AlphaMeans::kNothing;
  if (hidden == texels) {
    // Nobody paints what is nowhere to be seen: tinted glass, or an unused channel.
    std::uint8_t most = 0;
    for (std::size_t i = 3; i < texture.rgba.size(); i += 4) most = std::max(most, texture.rgba[i]);
    return most > 0 ? AlphaMeans::kVeil : AlphaMeans::kAccident;
  }
  const bool is_blank = static_cast<double>(countOfOneColour(texture)) >= kBlankShare * hidden;
  return is_blank && hidden <= kMostHidden * texels ? AlphaMeans::kCutOut : AlphaMeans::kPainted;
}

}  // namespace sunlit::scene
