// One pose, baked, drawn and lit anew again and again, has one hash a rasterizer: whatever the number of
// threads, and whichever of two suns comes first; and one in weather. SUNLIT_RUNS says how often (8);
// scripts/same_bits does it a hundred times, in several processes.
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cstdio>
#include <cstdlib>
#include <set>
#include <stdexcept>

#include "sunlit/image/content_hash.h"
#include "sunlit/light/transport.h"
#include "sunlit/render/rasterizer_kind.h"
#include "sunlit/scene/weathering.h"
#include "support/usual_air.h"
#include "test_scenes.h"

namespace sunlit::test {
namespace {

constexpr int kMostThreads = 8;

/// Blocks, one in another's shadow, with a polished one, on rough ground.
scene::Scene yard() {
  scene::Scene scene;
  const int stone = addMaterial(&scene, {0.4f, 0.35f, 0.3f});
  const int polished = addMaterial(&scene, {0.2f, 0.3f, 0.5f});
  scene.materials[1].roughness = 0.05f;
  addGround(&scene, stone, 60.0f);
  for (int i = 0; i < 12; ++i) {
    const auto along = static_cast<float>(i);
    addBlock(&scene, i % 4 == 0 ? polished : stone, {4.0f * along - 20.0f, 7.0f - along, 0.0f},
             {2.0f, 1.0f + 0.3f * along, 1.0f + 0.5f * along});
  }
  return scene;
}

/// What a run looks at: a world to be baked, and the light of two conditions.
struct Subject {
  light::World (*world)();
  sky::Daylight (*day)(int condition);
};

Subject clearAndDry() {
  return {[] { return light::World(shared(yard())); },
          [](int condition) { return daylightAt(100.0 + 120.0 * condition, condition == 0 ? 50.0 : 6.0); }};
}

/// Broken cloud on its way, ground fog, rain and soaked ground with puddles.
Subject stormyAndWet() {
  return {[] {
            scene::SurfaceState state;
            state.wet = 0.7;
            state.puddles = 0.3;
            return light::weathered(light::World(shared(yard())), state);
          },
          [](int condition) {
            sky::Weather weather;
            weather.cover_oktas = condition == 0 ? 4.0 : 6.0;
            weather.wind_m_per_s = 10.0;
            weather.clock_s = 1.7e9 + 333.0 * condition;
            weather.rain_mm_per_h = 10.0;
            weather.visibility_m = 300.0;
            weather.fog_top_m = 40.0;
            const Direction sun(Azimuth::degrees(100.0 + 120.0 * condition),
                                Angle::degrees(condition == 0 ? 50.0 : 6.0));
            return sky::usualAir().daylight({sun, 1.0}, {}, weather);
          }};
}

/// How one run differs from others.
struct Run {
  render::RasterizerKind rasterizer;
  int threads;
  bool second_first;
};

/// Depth and both pictures of a world baked by so many threads, the condition that comes first chosen.
std::string hashOfRun(const Subject& subject, const Run& run) {
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                  static_cast<std::size_t>(run.threads));
  light::World world = subject.world();
  light::TransportOptions coarse;
  coarse.samples = 1000;
  coarse.bounces = 1;
  world.transport = light::Transport::bake(world.geometry, coarse);
  render::RenderOptions options = smallCamera(128, 96, 80.0);
  options.rasterizer = run.rasterizer;
  render::Renderer renderer(world, options);
  renderer.look(lookingAt({-25.0, -20.0, 3.0}, {5.0, 2.0, 1.0}));
  std::vector<float> lit[2];
  for (const int turn : {0, 1}) {
    const int condition = run.second_first ? 1 - turn : turn;
    lit[condition] = renderer.light(light::illumination(world, subject.day(condition))).data;
  }
  image::ContentHash hash;
  for (const std::vector<float>& values : lit) hash.add(values);
  hash.add(renderer.depth().data);
  return hash.text();
}

int runs() {
  const char* asked = std::getenv("SUNLIT_RUNS");
  return asked != nullptr ? std::atoi(asked) : kMostThreads;
}

/// Says the hashes of all runs, each in a line of its own that begins with `name`.
void expectOneHash(const Subject& subject, render::RasterizerKind rasterizer, const std::string& name) {
  std::set<std::string> hashes;
  for (int run = 0; run < runs(); ++run)
    hashes.insert(
        hashOfRun(subject, {rasterizer, 1 + run % kMostThreads, (run / kMostThreads + run) % 2 == 1}));
  for (const std::string& hash : hashes) std::printf("%s: %s\n", name.c_str(), hash.c_str());
  EXPECT_EQ(hashes.size(), 1u) << name;
}

TEST(Picture, HasOneHashOfEachRasterizerForAnyThreadsAndOrder) {
  for (const render::RasterizerKind rasterizer : render::builtRasterizers()) {
    try {
      render::requireStarts(rasterizer);
    } catch (const std::runtime_error& error) {
      std::printf("%s: left out: %s\n", render::nameOf(rasterizer).c_str(), error.what());
      continue;
    }
    expectOneHash(clearAndDry(), rasterizer, render::nameOf(rasterizer));
  }
}

TEST(Picture, HasOneHashInWeatherForAnyThreadsAndOrder) {
  expectOneHash(stormyAndWet(), render::RasterizerKind::kBuiltin, "weather");
}

}  // namespace
}  // namespace sunlit::test
