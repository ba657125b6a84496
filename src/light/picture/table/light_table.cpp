#include "light/picture/table/light_table.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "light/shading/surface_reflection.h"

namespace sunlit::light {
namespace {

LightTable::AirPlace airPlace(float distance_m) {
  int node = 0;
  if (distance_m >= 1.0f) {
    int exponent = 0;
    const float mantissa = std::frexp(distance_m, &exponent);  // 0.5 … 1
    node = std::min(1 + 2 * (exponent - 1) + (mantissa >= 0.70710678f ? 1 : 0), kAirNodes - 2);
  }
  const float near = airDistance_m(node);
  return {node, std::min((distance_m - near) / (airDistance_m(node + 1) - near), 1.0f)};
}

LightTable::Rows rowsOf(const Surfaces& surfaces, const Tile& tile, const TileOutlooks& outlooks,
                        const scene::Scene& scene) {
  LightTable::Rows rows;
  rows.targets.reserve(tile.surfaces.size());
  rows.air.reserve(tile.surfaces.size());
  rows.ambient.reserve(tile.surfaces.size());
  const auto width = static_cast<std::uint32_t>(surfaces.width);
  // Of the tile's pixels. More than there are: some surfaces lie before others, or mirror others.
  std::array<std::uint32_t, Surfaces::kTileSize * Surfaces::kTileSize> samples{};
  const auto samplesOf = [&](const Surface& surface) -> std::uint32_t& {
    const std::uint32_t x = surface.pixel % width - static_cast<std::uint32_t>(tile.x);
    const std::uint32_t y = surface.pixel / width - static_cast<std::uint32_t>(tile.y);
    return samples[y * Surfaces::kTileSize + x];
  };
  for (const Surface& surface : tile.surfaces) samplesOf(surface) += surface.samples;
  const auto all = static_cast<std::uint32_t>(surfaces.samples_per_pixel);
  for (std::size_t i = 0; i < tile.surfaces.size(); ++i) {
    const Surface& surface = tile.surfaces[i];
    const scene::Material& material = scene.materials[static_cast<std::size_t>(surface.material)];
    rows.targets.push_back({surface.geometric_normal, surface.shading_normal, surface.clearance_m,
                            surface.first_sample, static_cast<std::uint16_t>(surface.pixel % width),
                            static_cast<std::uint16_t>(surface.pixel / width),
                            static_cast<std::uint16_t>(surface.samples), material.transmission > 0.0f,
                            material.alpha_mode == scene::AlphaMode::kMask,
                            outlooks.surfaces[i].gathered != Outlook::kNotGathered,
                            (surface.share < 1.0f).any() || samplesOf(surface) > all});
    rows.air.push_back(airPlace((surfaces.eye - surface.position).norm()));
    rows.air_nodes |= std::uint64_t{3} << rows.air.back().node;
    rows.ambient.push_back(ambientReflectance(reflectionOf(surface, material)));
  }
  return rows;
}

}  // namespace

float airDistance_m(int node) {
  if (node == 0) return 0.0f;
  const float octave = std::ldexp(1.0f, (node - 1) / 2);
  return node % 2 == 1 ? octave : octave * 1.41421356f;
}

LightTable::LightTable(const Surfaces& surfaces, const Outlooks& outlooks, const scene::Scene& scene)
    : tiles_(surfaces.tiles.size()) {
  tbb::parallel_for(std::size_t{0}, tiles_.size(), [&](std::size_t i) {
    tiles_[i] = rowsOf(surfaces, surfaces.tiles[i], outlooks[i], scene);
  });
}

}  // namespace sunlit::light
