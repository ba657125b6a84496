/// A scene's textures on the GL side.
#pragma once

#include <vector>

#include "render/gl_functions.h"
#include "sunlit/scene/scene.h"

namespace sunlit::render {

class Textures {
 public:
  /// Uploads every texture with all mipmaps, sampled trilinearly, repeating. `lod_bias` in levels.
  Textures(const scene::Scene& scene, double lod_bias);
  ~Textures();
  Textures(const Textures&) = delete;
  Textures& operator=(const Textures&) = delete;

  /// Texture `index` of the scene, or plain white for Material::kNoTexture, goes to texture unit 0.
  void bind(int index) const;

 private:
  void upload(const scene::Scene& scene);
  std::vector<GLuint> names_;  ///< the last one is white
};

}  // namespace sunlit::render
