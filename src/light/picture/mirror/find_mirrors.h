/// What the surfaces of a tile mirror of the sky.
#pragma once

#include "light/bake/samples/transport_data.h"
#include "light/picture/outlook/outlook.h"
#include "sunlit/light/surfaces.h"
#include "sunlit/scene/scene.h"

namespace sunlit::light {

/// A tile of a picture that is `picture_width` px wide.
struct TileToMirror {
  const scene::Scene& scene;
  int picture_width;
  const Tile& tile;
};
/// Sets TileOutlooks::mirrors, and Outlook::mirror of those surfaces whose Outlook::light is known: where
/// they look, and how much of the sky there `data` has open.
void findMirrors(const TransportData& data, const TileToMirror& of, TileOutlooks* outlooks);

}  // namespace sunlit::light
