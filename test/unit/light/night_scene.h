// Worlds by night, and what their lamps give by way of surfaces.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "light/picture/bodies/lamps_on_places.h"
#include "light/shading/shading.h"
#include "paper_scene.h"
#include "sunlit/light/transport.h"

namespace sunlit::light {

inline const Eigen::Vector3f kUp = Eigen::Vector3f::UnitZ();
inline const LampOptions kOn = [] {
  LampOptions options;
  options.mode = LampMode::kOn;
  return options;
}();

inline scene::Lamp lampAt(const Eigen::Vector3f& position, float cd, const std::string& group = "lamps") {
  scene::Lamp lamp;
  lamp.name = "lamp";
  lamp.group = group;
  lamp.position = position;
  lamp.intensity = LinearRgb(cd, cd, cd);
  return lamp;
}

inline World baked(scene::Scene scene, const TransportOptions& options = {}) {
  World world = worldOf(std::move(scene));
  world.transport = Transport::bake(world.geometry, options);
  return world;
}

inline Surfaces onTriangles(const World& world, const std::vector<Looked>& points) {
  Surfaces surfaces = rowOf(points, *world.geometry->scene);
  for (Tile& tile : surfaces.tiles)
    for (Surface& surface : tile.surfaces)
      surface.triangle = triangleAt(*world.geometry, surface.position, surface.geometric_normal);
  return surfaces;
}

/// Illuminance by surfaces, lx: by way of others, and straight from those that shine.
inline std::vector<double> illuminances(const World& world, const std::vector<Looked>& points,
                                        const LampOptions& options = kOn) {
  const Illumination light = illumination(world, uniformDay(0.0f), options);
  std::vector<double> values;
  std::vector<LampBeam> beams;
  if (light.compact_sources)
    for (const CompactSource& source : *light.compact_sources) beams.emplace_back(source);
  std::vector<Eigen::Array3f> all;
  for (const TileOutlooks& tile : outlooksOf(onTriangles(world, points), world))
    for (const Outlook& outlook : tile.surfaces) all.push_back(irradianceAt(outlook.light, *light.nodes));
  std::vector<LitPlace> places;
  for (const Looked& point : points) places.push_back({point.position + 3e-4f * point.normal, point.normal});
  addLampLight({beams, *world.visibility}, places, &all);
  for (const Eigen::Array3f& lx : all) values.push_back(static_cast<double>(lx[1]));
  return values;
}

inline double illuminance(const World& world, const Eigen::Vector3f& position,
                          const Eigen::Vector3f& normal = kUp, const LampOptions& options = kOn) {
  return illuminances(world, {{position, normal, normal}}, options)[0];
}

inline std::vector<double> pictured(const World& world, const std::vector<Looked>& points) {
  return rowValues(onTriangles(world, points), world, illumination(world, uniformDay(0.0f), kOn));
}

inline std::vector<double> tracedWithLamps(const World& world, const std::vector<Looked>& points,
                                           int samples) {
  ReferenceOptions options;
  options.samples_per_pixel = samples;
  options.bounces = 64;
  options.lamps = burning(world.geometry->scene->lamps, kOn);
  const Surfaces surfaces = rowOf(points, *world.geometry->scene);
  return rowValues(traceReference(surfaces, world, {uniformDay(0.0f)}, options)[0].luminance);
}

/// Each within `worst`, all within 5 % on average and 3 % of bias.
inline void expectAlike(const std::vector<Looked>& points, const std::vector<double>& fast,
                        const std::vector<double>& slow, double worst) {
  double mean = 0.0, bias = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double error = fast[i] / slow[i] - 1.0;
    mean += std::abs(error) / static_cast<double>(points.size());
    bias += error / static_cast<double>(points.size());
    EXPECT_NEAR(error, 0.0, worst) << points[i].position.transpose();
  }
  EXPECT_LT(mean, 0.05);
  EXPECT_LT(std::abs(bias), 0.03);
}

}  // namespace sunlit::light
