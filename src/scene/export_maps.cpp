#include "scene/export_maps.h"

#include <algorithm>

namespace sunlit::scene {
namespace {

constexpr int kGreen = 1, kBlue = 2;
/// The channel of a map that is left out.
constexpr int kDropped = -1;

/// The texel of `texture` at the place of texel (x, y) of a grid of `width` by `height`.
std::uint8_t at(const Texture& texture, int channel, const Eigen::Vector2i& texel,
                const Eigen::Vector2i& size) {
  const int x = static_cast<int>(static_cast<std::int64_t>(texel.x()) * texture.width / size.x());
  const int y = static_cast<int>(static_cast<std::int64_t>(texel.y()) * texture.height / size.y());
  return texture.rgba[4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(texture.width) +
                           static_cast<std::size_t>(x)) +
                      static_cast<std::size_t>(channel)];
}

}  // namespace

TextureUse PackedMaps::of(const Material& material, ExportLosses* losses) {
  const TextureUse& rough = material.roughness_map;
  TextureUse metal = material.metalness_map;
  if (!rough.given() && !metal.given()) return {};
  if (rough.given() && metal.given()) {
    if (rough.texture == metal.texture && rough.coordinates == metal.coordinates && rough.channel == kGreen &&
        metal.channel == kBlue)
      return rough;
    const Texture& a = scene_.textures[static_cast<std::size_t>(rough.texture)];
    const Texture& b = scene_.textures[static_cast<std::size_t>(metal.texture)];
    if (rough.coordinates != metal.coordinates || a.wrap_u != b.wrap_u || a.wrap_v != b.wrap_v) {
      losses->add(
          "materials take metalness at other coordinates than roughness: roughness counts alone, as of no "
          "metal",
          material.name);
      metal = {};
      metal.channel = kDropped;
    }
  }
  return packed(rough, metal);
}

TextureUse PackedMaps::packed(const TextureUse& rough, const TextureUse& metal) {
  const TextureUse& first = rough.given() ? rough : metal;
  const auto [place, is_new] = known_.insert({{rough.texture, rough.channel, metal.texture, metal.channel},
                                              static_cast<int>(scene_.textures.size() + textures_.size())});
  if (!is_new) return {place->second, first.coordinates, kGreen};
  Texture made;
  Eigen::Vector2i size(1, 1);
  for (const TextureUse& use : {rough, metal}) {
    if (!use.given()) continue;
    const Texture& source = scene_.textures[static_cast<std::size_t>(use.texture)];
    size = size.cwiseMax(Eigen::Vector2i(source.width, source.height));
    made.name += (made.name.empty() ? "" : " and ") + source.name;
  }
  const Texture& edges = scene_.textures[static_cast<std::size_t>(first.texture)];
  made.wrap_u = edges.wrap_u;
  made.wrap_v = edges.wrap_v;
  made.width = size.x();
  made.height = size.y();
  const auto unknown = static_cast<std::uint8_t>(metal.channel == kDropped ? 0 : 255);
  made.rgba.own().assign(4 * static_cast<std::size_t>(size.x()) * static_cast<std::size_t>(size.y()), 255);
  std::uint8_t* texel = made.rgba.own().data();
  for (int y = 0; y < size.y(); ++y) {
    for (int x = 0; x < size.x(); ++x, texel += 4) {
      texel[kBlue] = unknown;
      for (const auto& [use, channel] : {std::pair(rough, kGreen), std::pair(metal, kBlue)}) {
        if (use.given())
          texel[channel] =
              at(scene_.textures[static_cast<std::size_t>(use.texture)], use.channel, {x, y}, size);
      }
    }
  }
  textures_.push_back(std::move(made));
  return {place->second, first.coordinates, kGreen};
}

}  // namespace sunlit::scene
