/// Textures made smaller for the distance.
#pragma once

#include "sunlit/scene/scene.h"

namespace sunlit::render {

/// Fills Texture::smaller of all textures that are colours of a scene's materials, with what every renderer
/// of `scene` would make of them: those of a texture's first material, in linear light, a cut-out's share
/// kept. The same bits for any number of threads.
void addSmallerSizes(scene::Scene* scene);

}  // namespace sunlit::render
