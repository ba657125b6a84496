/// Scenes as pictures see them: with baked light.
#pragma once

#include <gtest/gtest.h>

#include "paper_scene.h"
#include "sunlit/light/illumination.h"
#include "sunlit/light/transport.h"

namespace sunlit::light {

inline World baked(scene::Scene scene, const TransportOptions& options = TransportOptions()) {
  World world = worldOf(std::move(scene));
  world.transport = Transport::bake(world.geometry, options);
  return world;
}

/// As a renderer gets them, cd/m².
inline image::LinearImage fastPicture(const World& world, const std::vector<Looked>& points,
                                      const sky::Daylight& day) {
  Surfaces surfaces = rowOf(points, *world.geometry->scene);
  for (Tile& tile : surfaces.tiles) {
    for (Surface& surface : tile.surfaces)
      surface.triangle = triangleAt(*world.geometry, surface.position, surface.geometric_normal);
  }
  const Outlooks outlooks = outlooksOf(surfaces, world);
  for (const TileOutlooks& tile : outlooks) {
    for (const Outlook& outlook : tile.surfaces) EXPECT_TRUE(outlook.light.known());
  }
  return pictureOf(surfaces, outlooks, world, illumination(world, day));
}
inline std::vector<double> fast(const World& world, const std::vector<Looked>& points,
                                const sky::Daylight& day) {
  return rowValues(fastPicture(world, points, day));
}

/// Relative, of some pixels.
struct Errors {
  double mean = 0.0, worst = 0.0, bias = 0.0;
};

inline Errors errors(const std::vector<double>& picture, const std::vector<double>& truth) {
  Errors result;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    const double error = picture[i] / truth[i] - 1.0;
    result.mean += std::abs(error) / static_cast<double>(truth.size());
    result.bias += error / static_cast<double>(truth.size());
    result.worst = std::max(result.worst, std::abs(error));
  }
  return result;
}

}  // namespace sunlit::light
