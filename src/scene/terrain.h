/// Height maps as ground.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "sunlit/image/images.h"
#include "sunlit/image/texture_files.h"
#include "sunlit/scene/scene.h"

namespace sunlit::scene {

/// vertices a side; two triangles a square make two million at most.
constexpr int kMostTerrainVertices = 1025;

/// Heights of a terrain, m, top row in the north, from `values` such as image::readGreyWithin() gives: shares
/// of `height` where all are from 0 to 1; else elevations, of which the lowest becomes 0 and the highest
/// `height`. One below 0 turns them over as Gazebo does (ImageHeightmap and Dem::FillHeightMap()): shares lie
/// that far below 1 m, whatever it is.
std::vector<float> terrainHeights(const image::Picture<float, 1>& values, double height);

/// The ground on a grid of `width` × `depth` vertices over size.x × size.y m around the origin, x to the
/// east, facing up. Texture coordinates: once over all from its north-western corner if `tile_m` is 0, else
/// repeated every `tile_m`. Throws std::invalid_argument for less than 2 × 2 vertices.
struct TerrainGrid {
  int width = 0, depth = 0;
  std::vector<float> heights;  ///< m, top row in the north
  Eigen::Vector2d size;        ///< m
};
Mesh makeTerrain(const TerrainGrid& grid, double tile_m);

/// One ground cover of a terrain: a picture repeated every `tile_m`, from `min_height` up, where it comes in
/// over `fade_m`; the lowest one is everywhere.
struct TerrainLayer {
  std::string file;
  double tile_m = 10.0;
  double min_height = 0.0, fade_m = 0.0;
};

/// All layers in one picture over the whole of `grid`, `side` px square, mixed as light is, each texel with
/// the mean of what its layer shows there. Throws std::runtime_error naming a layer that cannot be read.
image::Rgba8Image bakedLayers(const TerrainGrid& grid, const std::vector<TerrainLayer>& layers, int side);

}  // namespace sunlit::scene
