#include "sunlit/light/reference.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <cmath>
#include <stdexcept>
#include <string>

#include "light/bake/samples/transport_data.h"
#include "light/geometry/corners.h"
#include "light/picture/fog/lamp_glow.h"
#include "light/picture/sky/open_air.h"
#include "light/picture/sky/sky_pixel.h"
#include "light/reference/paths.h"
#include "sunlit/light/transport.h"

namespace sunlit::light {
namespace {

struct Picture {
  const Surfaces& surfaces;
  const World& world;
  const PathScene& scene;
  const std::vector<sky::Daylight>& seen;  ///< from the eye
  OpenAir open_air;
};

/// Where a surface of the scene lies in its bake, if it has one.
LightPlace placeOf(const Surface& surface, const World& world) {
  const Geometry& geometry = *world.geometry;
  if (!world.transport || surface.triangle >= geometry.triangles.size()) return {};
  const bool front = geometry.planes[surface.triangle].normal.dot(surface.geometric_normal) > 0.0f;
  return lightPlace(world.transport->data().mesh, {surface.triangle, front},
                    Corners(geometry, surface.triangle).within(surface.position));
}

/// Adds one surface's light to its pixel, by halves.
using Halves = std::array<std::vector<image::LinearImage>, 2>;

void traceTile(const Picture& picture, const Tile& tile, Halves* halves) {
  const auto& [surfaces, world, scene, seen, open_air] = picture;
  Paths paths(scene);
  for (const Surface& surface : tile.surfaces) {
    // What is seen through stands before others, in the same samples.
    const float part = static_cast<float>(surface.samples) / static_cast<float>(surfaces.samples_per_pixel);
    const float open = open_air.before(placeOf(surface, world));
    const Eigen::Array3f share = part * surface.share, air_share = part * open * surface.air_share;
    const float distance = (surface.position - surfaces.eye).norm();
    const std::array<Radiances, 2> traced = paths.luminance(tile, surface);
    for (std::size_t day = 0; day < scene.days.size(); ++day) {
      const sky::AirColumn air = seen[day].airOver(-surface.to_eye, distance);
      for (std::size_t half = 0; half < 2; ++half) {
        float* data = (*halves)[half][day].data.data() + 3 * static_cast<std::size_t>(surface.pixel);
        Eigen::Map<Eigen::Array3f> pixel(data);
        pixel += share * traced[half][day] * air.transmittance + air_share * air.airlight;
      }
    }
  }
}

float luminanceAt(const image::LinearImage& image, std::size_t pixel) {
  return LinearRgb(Eigen::Array3f(Eigen::Map<const Eigen::Array3f>(image.data.data() + 3 * pixel)))
      .luminance();
}

Traced combined(const image::LinearImage& first, const image::LinearImage& second) {
  Traced traced{image::LinearImage(first.width, first.height),
                image::Picture<float, 1>(first.width, first.height)};
  for (std::size_t i = 0; i < first.data.size(); ++i) {
    traced.luminance.data[i] = 0.5f * (first.data[i] + second.data[i]);
  }
  for (std::size_t p = 0; p < traced.noise.data.size(); ++p) {
    traced.noise.data[p] = 0.5f * std::abs(luminanceAt(first, p) - luminanceAt(second, p));
  }
  return traced;
}

}  // namespace

void validate(const ReferenceOptions& options) {
  requireFields(options);
}

std::vector<Traced> traceReference(const Surfaces& surfaces, const World& world,
                                   const std::vector<sky::Daylight>& all_days,
                                   const ReferenceOptions& options) {
  validate(options);
  std::vector<sky::Daylight> days, seen;
  for (const sky::Daylight& day : all_days) {
    days.push_back(day.overGround(world.ground_m));
    seen.push_back(days.back().seenFrom(surfaces.eye));
  }
  const PathScene scene(world, days, options, surfaces.samples_per_pixel);
  Halves halves;
  for (auto& half : halves) half.assign(days.size(), image::LinearImage(surfaces.width, surfaces.height));
  std::vector<SkyPixel> skies;
  skies.reserve(days.size());
  std::vector<LampGlow> glows;  // like the air, what lies before surfaces is the picture's
  glows.reserve(days.size());
  for (const sky::Daylight& day : seen) {
    skies.emplace_back(surfaces, day);
    glows.emplace_back(&options.lamps, day.fog(), surfaces, *world.visibility);
  }
  const std::vector<float>* const node_open = world.transport ? world.transport->nodeOpen().get() : nullptr;
  const Picture picture{surfaces, world, scene, seen, OpenAir(surfaces, *world.visibility, node_open)};
  tbb::parallel_for(std::size_t{0}, surfaces.tiles.size(), [&](std::size_t i) {
    const Tile& tile = surfaces.tiles[i];
    for (auto& half : halves) {
      for (std::size_t day = 0; day < days.size(); ++day) {
        skies[day].addTo(tile, &half[day]);
        glows[day].addTo(tile, skies[day], &half[day]);
      }
    }
    traceTile(picture, tile, &halves);
  });
  std::vector<Traced> traced;
  for (std::size_t day = 0; day < days.size(); ++day) {
    traced.push_back(combined(halves[0][day], halves[1][day]));
  }
  return traced;
}

}  // namespace sunlit::light
