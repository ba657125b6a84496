#include "scene/terrain.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <stdexcept>

#include "scene/color.h"

namespace sunlit::scene {
namespace {

float encoded(float linear) {
  return linear <= 0.0031308f ? 12.92f * linear : 1.055f * std::pow(linear, 1.0f / 2.4f) - 0.055f;
}

/// A layer as wide in px as its tile is in the baked picture, so that texels are means of what they cover.
struct Tile {
  image::Rgba8Image picture;
  Eigen::Vector2d texels_per_m;  ///< by axis: a tile is square, whatever its picture is
};

Tile tileOf(const TerrainLayer& layer, double texels_per_m) {
  constexpr double kLargest_px = 4096.0;
  const double side_px = std::clamp(layer.tile_m * texels_per_m, 1.0, kLargest_px);
  Tile tile;
  tile.picture = image::readRgbaWithin(static_cast<int>(std::lround(side_px)), layer.file).picture;
  tile.texels_per_m = Eigen::Vector2d(tile.picture.width, tile.picture.height) / layer.tile_m;
  return tile;
}

/// Bilinear; x and y in shares of the whole.
double heightAt(const TerrainGrid& grid, double x, double y) {
  const double column = std::clamp(x * (grid.width - 1), 0.0, grid.width - 1.0);
  const double row = std::clamp(y * (grid.depth - 1), 0.0, grid.depth - 1.0);
  const int i = std::min(static_cast<int>(column), grid.width - 2);
  const int j = std::min(static_cast<int>(row), grid.depth - 2);
  const auto at = [&](int di, int dj) {
    return static_cast<double>(
        grid.heights[static_cast<std::size_t>(j + dj) * static_cast<std::size_t>(grid.width) +
                     static_cast<std::size_t>(i + di)]);
  };
  const double u = column - i, v = row - j;
  return (1 - v) * ((1 - u) * at(0, 0) + u * at(1, 0)) + v * ((1 - u) * at(0, 1) + u * at(1, 1));
}

const std::uint8_t* texelAt(const Tile& tile, const Eigen::Vector2d& metres) {
  const auto wrapped = [](double texels, int size) {
    const int index = static_cast<int>(std::floor(texels)) % size;
    return index < 0 ? index + size : index;
  };
  const Eigen::Vector2d texels = metres.cwiseProduct(tile.texels_per_m);
  return tile.picture.at(wrapped(texels.x(), tile.picture.width), wrapped(texels.y(), tile.picture.height));
}

}  // namespace

std::vector<float> terrainHeights(const image::Picture<float, 1>& values, double height) {
  const auto [low, high] = std::minmax_element(values.data.begin(), values.data.end());
  const bool shares = *low >= 0.0f && *high <= 1.0f;
  const float base = shares ? 0.0f : *low;
  const float range = shares ? 1.0f : *high - *low;
  const float top = shares && height < 0.0 ? 1.0f : 0.0f;
  std::vector<float> heights;
  for (const float value : values.data)
    heights.push_back(top + (range > 0.0f ? static_cast<float>(height) * ((value - base) / range) : 0.0f));
  return heights;
}

Mesh makeTerrain(const TerrainGrid& grid, double tile_m) {
  if (grid.width < 2 || grid.depth < 2) throw std::invalid_argument("a terrain has less than 2 × 2 vertices");
  Mesh mesh;
  const auto width = static_cast<std::uint32_t>(grid.width);
  for (int j = 0; j < grid.depth; ++j) {
    for (int i = 0; i < grid.width; ++i) {
      const double u = static_cast<double>(i) / (grid.width - 1),
                   v = static_cast<double>(j) / (grid.depth - 1);
      const std::size_t index = mesh.positions.size();
      const Eigen::Vector3d position((u - 0.5) * grid.size.x(), (0.5 - v) * grid.size.y(),
                                     static_cast<double>(grid.heights[index]));
      mesh.positions.push_back(position.cast<float>());
      const Eigen::Vector2d metres(u * grid.size.x(), v * grid.size.y());
      mesh.texture_coordinates.push_back(
          (tile_m > 0.0 ? Eigen::Vector2d(metres / tile_m) : Eigen::Vector2d(u, v)).cast<float>());
      if (i == 0 || j == 0) continue;
      const auto k = static_cast<std::uint32_t>(index);
      mesh.triangles.push_back({k - width - 1, k - 1, k});
      mesh.triangles.push_back({k - width - 1, k, k - width});
    }
  }
  return mesh;  // SceneBuilder makes the normals
}

image::Rgba8Image bakedLayers(const TerrainGrid& grid, const std::vector<TerrainLayer>& layers, int side) {
  std::vector<Tile> tiles;
  for (const TerrainLayer& layer : layers) tiles.push_back(tileOf(layer, side / grid.size.x()));
  std::array<float, 256> linear{};
  for (std::size_t i = 0; i < linear.size(); ++i) linear[i] = linearFromSrgb(static_cast<float>(i) / 255.0f);
  image::Rgba8Image baked(side, side);
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) {
      const double u = (x + 0.5) / side, v = (y + 0.5) / side;
      const double height = heightAt(grid, u, v);
      const Eigen::Vector2d metres(u * grid.size.x(), v * grid.size.y());
      Eigen::Array3f color = Eigen::Array3f::Zero();
      for (std::size_t k = 0; k < layers.size(); ++k) {
        const double above = height - layers[k].min_height;
        const double faded = layers[k].fade_m > 0.0 ? above / layers[k].fade_m : above >= 0.0 ? 1.0 : 0.0;
        const float share = k == 0 ? 1.0f : static_cast<float>(std::clamp(faded, 0.0, 1.0));
        const std::uint8_t* texel = texelAt(tiles[k], metres);
        const Eigen::Array3f of_layer(linear[texel[0]], linear[texel[1]], linear[texel[2]]);
        color += share * (of_layer - color);
      }
      std::uint8_t* target = baked.at(x, y);
      for (int c = 0; c < 3; ++c)
        target[c] = static_cast<std::uint8_t>(std::lround(255.0f * encoded(color[c])));
      target[3] = 255;
    }
  }
  return baked;
}

}  // namespace sunlit::scene
