#include "scene/sdf_terrain.h"

#include <cmath>
#include <stdexcept>
#include <utility>
#include <vector>

#include "scene/color.h"
#include "scene/missing_kinds.h"
#include "scene/sdf_mend.h"
#include "scene/sdf_pose.h"
#include "scene/terrain.h"
#include "sunlit/image/files.h"
#include "sunlit/image/texture_files.h"

namespace sunlit::scene {
namespace {

/// px of the one picture of several layers.
constexpr int kBakedSide = 2048;

constexpr const char* kLeftOut = "height maps are missing or cannot be read and were left out";

/// Gazebo's own flat one, which most height maps have, says nothing.
bool hasNormals(const std::string& picture) {
  const std::string flat = "flat_normal.png";
  const bool is_flat =
      picture.size() >= flat.size() && picture.compare(picture.size() - flat.size(), flat.size(), flat) == 0;
  return !picture.empty() && picture != kNoNormals && picture != "__default__" && !is_flat;
}

/// Those whose pictures are there.
std::vector<TerrainLayer> layersOf(const SdfHeightmap& source, SceneBuilder& builder,
                                   const ResourceFinder& finder) {
  std::vector<TerrainLayer> layers;
  for (std::uint64_t i = 0; i < source.TextureCount(); ++i) {
    const auto& texture = *source.TextureByIndex(i);
    Found found = finder.find(texture.Diffuse(), source.FilePath());
    if (!found.file) found = finder.findTexture(texture.Diffuse(), source.FilePath());
    if (!found.file) {
      builder.warn(kMissingTextures, texture.Diffuse() + " of a height map of " + source.FilePath());
      continue;
    }
    try {
      image::requireContent(*found.file);
    } catch (const image::ContentMissing& error) {
      builder.warn(kMissingTextures, error.what());
      continue;
    }
    TerrainLayer layer;
    layer.file = *found.file;
    if (std::isfinite(texture.Size()) && texture.Size() > 0.0) layer.tile_m = texture.Size();
    if (i > 0 && i <= source.BlendCount()) {
      layer.min_height = source.BlendByIndex(i - 1)->MinHeight();
      layer.fade_m = source.BlendByIndex(i - 1)->FadeDistance();
    }
    layers.push_back(std::move(layer));
    if (hasNormals(texture.Normal()) && finder.find(texture.Normal(), source.FilePath()).file)
      builder.warn(kNotRendered, "a height map of " + source.FilePath() + ": its normal map " +
                                     texture.Normal() + ": without it");
  }
  return layers;
}

/// With the texture coordinates that the layers need.
Mesh covered(const TerrainGrid& grid, const std::vector<TerrainLayer>& layers, int own_material,
             SceneBuilder& builder) {
  Mesh mesh = makeTerrain(grid, layers.size() == 1 ? layers[0].tile_m : 0.0);
  mesh.material = own_material;
  if (layers.empty()) return mesh;
  Material material;
  material.name = "terrain";
  material.base_color = LinearRgb(1.0f, 1.0f, 1.0f);
  if (layers.size() == 1) {
    material.base_texture = builder.textureFromFile(layers[0].file);
  } else {
    std::string name = "layers of a terrain:";
    for (const TerrainLayer& layer : layers) name += " " + layer.file;
    const std::string png = image::encodePng(bakedLayers(grid, layers, kBakedSide));
    material.base_texture =
        builder.textureFromBytes(name + " " + std::to_string(builder.meshCount()), {png.begin(), png.end()});
  }
  mesh.material = builder.addMaterial(material, AlphaRule::kDeclared);
  return mesh;
}

}  // namespace

std::optional<Mesh> terrainOf(const SdfHeightmap& source, const TerrainUse& use, SceneBuilder& builder,
                              const ResourceFinder& finder) {
  const std::string place = source.FilePath() + ": visual " + use.visual;
  try {
    const Found found = finder.find(source.Uri(), source.FilePath());
    if (!found.file) {
      throw std::runtime_error(place + ": there is no height map " + source.Uri() + "; " +
                               placesTried(found) + (finder.missing() == Missing::kStop ? kDrawTheRest : ""));
    }
    const image::GreyPicture grey = image::readGreyWithin(kMostTerrainVertices, *found.file);
    const image::Picture<float, 1>& values = grey.values;
    TerrainGrid grid;
    grid.width = values.width;
    grid.depth = values.height;
    grid.heights = terrainHeights(values, source.Size().Z());
    grid.size = {source.Size().X(), source.Size().Y()};
    if (grid.width < 2 || grid.depth < 2 || !(grid.size.minCoeff() > 0.0))
      throw std::runtime_error(place + ": its height map has no area");
    if (grey.filled > 0)
      builder.warn("height maps have pixels without a height, the lowest of the others stands for them",
                   use.visual + ", " + std::to_string(grey.filled) + " of " + *found.file);
    if (source.Size() ==
        ignition::math::Vector3d::One)  // which Gazebo takes for the size of a DEM's own land
      builder.warn("height maps without a <size> are taken as 1 × 1 × 1 m, elevation models need one, too",
                   use.visual);
    if (source.Sampling() > 1)
      builder.warn(
          "height maps ask for a <sampling> that adds nothing to them, they have a vertex for each pixel",
          use.visual);
    Mesh mesh = covered(grid, layersOf(source, builder, finder), use.material, builder);
    const Eigen::Vector3f position = toEigen(source.Position()).cast<float>();
    for (Eigen::Vector3f& vertex : mesh.positions) vertex += position;
    return mesh;
  } catch (const image::ContentMissing& error) {
    leaveOut(kLeftOut, error, finder, builder);
    return std::nullopt;
  } catch (const std::runtime_error& error) {
    if (finder.missing() == Missing::kStop) throw;
    builder.warn(kLeftOut, error.what());
    return std::nullopt;
  }
}

}  // namespace sunlit::scene
