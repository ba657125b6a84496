/// Maps of roughness and metalness, as glTF wants them: in one texture.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "scene/export_losses.h"
#include "sunlit/scene/scene.h"

namespace sunlit::scene {

/// Roughness in green, metalness in blue.
class PackedMaps {
 public:
  explicit PackedMaps(const Scene& scene) : scene_(scene) {}

  /// Where a material finds both: in a texture of the scene that is so already, or in one of textures(),
  /// which are counted on from those of the scene. A metalness that takes other coordinates, or goes on
  /// otherwise beyond its edges, is added to `losses`. None where the material has neither.
  TextureUse of(const Material& material, ExportLosses* losses);
  const std::vector<Texture>& textures() const { return textures_; }

 private:
  TextureUse packed(const TextureUse& rough, const TextureUse& metal);

  const Scene& scene_;
  std::vector<Texture> textures_;
  std::map<std::vector<int>, int> known_;  ///< by textures and channels
};

}  // namespace sunlit::scene
