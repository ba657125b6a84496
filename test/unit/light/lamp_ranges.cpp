// How the light of lamps that have a range ends.
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <vector>

#include "built_in_world.h"
#include "lamp_scene.h"

namespace sunlit::light {
namespace {

constexpr double kRange_m = 20.0, kHeight_m = 5.0;

scene::Lamp rangedLamp() {
  scene::Lamp lamp = lampAt({0.0f, 0.0f, static_cast<float>(kHeight_m)});
  lamp.range_m = static_cast<float>(kRange_m);
  return lamp;
}

/// Places on the floor at these parts of the range from the lamp.
std::vector<Looked> floorAtParts(const std::vector<double>& parts) {
  std::vector<Looked> points;
  for (const double part : parts) {
    const double away_m = std::sqrt(part * part * kRange_m * kRange_m - kHeight_m * kHeight_m);
    points.push_back(floorAt(static_cast<float>(away_m)));
  }
  return points;
}

TEST(LampRanges, AreReachedByLightThatFadesAsInGltf) {
  const World world = floorWorld();
  const std::vector<double> parts = {0.3, 0.5, 0.8, 0.95, 0.99, 0.999, 1.001};
  const std::vector<Looked> points = floorAtParts(parts);
  scene::Lamp endless = rangedLamp();
  endless.range_m = scene::Lamp().range_m;
  const std::vector<double> seen = lit(world, {rangedLamp()}, points), full = lit(world, {endless}, points);
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const double expected = parts[i] < 1.0 ? 1.0 - std::pow(parts[i], 4.0) : 0.0;
    EXPECT_NEAR(seen[i] / full[i], expected, 1e-5) << parts[i];  // 1e-6 of the range, four times, in floats
  }
}

TEST(LampRanges, OfSdfAreEdges) {
  const World world = floorWorld();
  const std::vector<Looked> points = floorAtParts({0.5, 0.999, 1.001});
  scene::Lamp sharp = rangedLamp(), endless = sharp;
  sharp.ends_sharply = true;
  endless.range_m = scene::Lamp().range_m;
  const std::vector<double> seen = lit(world, {sharp}, points), full = lit(world, {endless}, points);
  EXPECT_EQ(seen[0], full[0]);
  EXPECT_EQ(seen[1], full[1]);
  EXPECT_EQ(seen[2], 0.0);
}

TEST(LampRanges, AreThoseOfTracedPaths) {
  const World world = floorWorld();
  const std::vector<Looked> points = floorAtParts({0.5, 0.8, 0.95});
  ReferenceOptions options;
  options.samples_per_pixel = 256;
  options.lamps = {rangedLamp()};
  options.bounces = 0;  // the floor is flat: there is nothing more
  const Surfaces surfaces = rowOf(points, *world.geometry->scene);
  const std::vector<double> slow =
      rowValues(traceReference(surfaces, world, {uniformDay(0.0f)}, options)[0].luminance);
  const std::vector<double> fast = lit(world, options.lamps, points);
  // A lobe that is widened by the lamp's ball.
  for (std::size_t i = 0; i < points.size(); ++i) EXPECT_NEAR(fast[i], slow[i], 0.02 * slow[i]);
}

TEST(LampRanges, OfTheBuiltInWorldAreNoEdges) {
  for (const scene::Lamp& lamp : builtInWorld().lamps) EXPECT_FALSE(lamp.ends_sharply) << lamp.name;
}

}  // namespace
}  // namespace sunlit::light
