#include "light/picture/table/light_table.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include "light/shading/surface_reflection.h"

namespace sunlit::light {
namespace {

/// Nodes lie at powers of √2: the octave is the exponent of a float, its half is told by its mantissa.
LightTable::AirPlace airPlace(float distance_m) {
  constexpr int kMantissaBits = 23, kBias = 127;
  constexpr std::uint32_t kMantissa = (1u << kMantissaBits) - 1u;
  constexpr std::uint32_t kRootOfTwo = 0x3504f3u;  // 1.41421354, twice 0.70710677
  int node = 0;
  if (distance_m >= 1.0f) {
    std::uint32_t bits;
    std::memcpy(&bits, &distance_m, sizeof(bits));
    const int octave = static_cast<int>(bits >> kMantissaBits) - kBias;
    node = std::min(1 + 2 * octave + ((bits & kMantissa) >= kRootOfTwo ? 1 : 0), kAirNodes - 2);
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
  static const std::array<float, kAirNodes> distances_m = [] {
    std::array<float, kAirNodes> all{};
    for (int i = 1; i < kAirNodes; ++i) {
      const float octave = std::ldexp(1.0f, (i - 1) / 2);
      all[static_cast<std::size_t>(i)] = i % 2 == 1 ? octave : octave * 1.41421356f;
    }
    return all;
  }();
  return distances_m[static_cast<std::size_t>(node)];
}

LightTable::LightTable(const Surfaces& surfaces, const Outlooks& outlooks, const scene::Scene& scene)
    : tiles_(surfaces.tiles.size()) {
  tbb::parallel_for(std::size_t{0}, tiles_.size(), [&](std::size_t i) {
    tiles_[i] = rowsOf(surfaces, surfaces.tiles[i], outlooks[i], scene);
  });
}

}  // namespace sunlit::light
