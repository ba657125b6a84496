/// Height maps of SDF.
#pragma once

#include <optional>
#include <string>

#include "scene/resource_finder.h"
#include "scene/scene_builder.h"
#include "scene/sdf_heightmap.h"

namespace sunlit::scene {

struct TerrainUse {
  int material;        ///< where the height map has no texture
  std::string visual;  ///< its full name, for messages
};

/// The ground of a <heightmap>, in the frame of the world, from a picture that image::readGreyWithin()
/// reads; a GeoTIFF is read as a TIFF, so that its size is that of the file alone. With one <texture> that is
/// its material, with several they are baked into one picture of 2048² px; none: that of `use`. Where the
/// picture is missing or cannot be read, none and a warning, or std::runtime_error, as the finder says.
std::optional<Mesh> terrainOf(const SdfHeightmap& source, const TerrainUse& use, SceneBuilder& builder,
                              const ResourceFinder& finder);

}  // namespace sunlit::scene
