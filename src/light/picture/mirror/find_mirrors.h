/// What the surfaces of a tile mirror of the sky.
#pragma once

#include "light/bake/samples/transport_data.h"
#include "sunlit/light/surfaces.h"
#include "sunlit/scene/scene.h"

namespace sunlit::light {

/// Sets Tile::mirrors, and Surface::mirror of those surfaces of `tile` whose Surface::light is known: where
/// they look, and how much of the sky there `data` has open.
void findMirrors(const TransportData& data, const scene::Scene& scene, int picture_width, Tile* tile);

}  // namespace sunlit::light
