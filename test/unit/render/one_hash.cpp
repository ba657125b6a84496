// One pose, baked, drawn and lit anew again and again, has one hash a rasterizer: whatever the number of
// threads, and whichever of two suns comes first. SUNLIT_RUNS says how often (8); scripts/same_bits does it a
// hundred times, in several processes.
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cstdio>
#include <cstdlib>
#include <set>
#include <stdexcept>

#include "sunlit/image/content_hash.h"
#include "sunlit/light/transport.h"
#include "sunlit/render/rasterizer_kind.h"
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

/// Depth and both pictures of a world baked by so many threads, the sun that comes first chosen.
std::string hashOfRun(render::RasterizerKind rasterizer, int threads, bool evening_first) {
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                  static_cast<std::size_t>(threads));
  light::World world(shared(yard()));
  light::TransportOptions coarse;
  coarse.samples = 1000;
  coarse.bounces = 1;
  world.transport = light::Transport::bake(world.geometry, coarse);
  render::RenderOptions options = smallCamera(128, 96, 80.0);
  options.rasterizer = rasterizer;
  render::Renderer renderer(world, options);
  renderer.look(lookingAt({-25.0, -20.0, 3.0}, {5.0, 2.0, 1.0}));
  std::vector<float> lit[2];
  for (const int turn : {0, 1}) {
    const int sun = evening_first ? 1 - turn : turn;
    lit[sun] =
        renderer.light(light::illumination(world, daylightAt(100.0 + 120.0 * sun, sun == 0 ? 50.0 : 6.0)))
            .data;
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

TEST(Picture, HasOneHashOfEachRasterizerForAnyThreadsAndOrder) {
  for (const render::RasterizerKind rasterizer : render::builtRasterizers()) {
    try {
      render::requireStarts(rasterizer);
    } catch (const std::runtime_error& error) {
      std::printf("%s: left out: %s\n", render::nameOf(rasterizer).c_str(), error.what());
      continue;
    }
    std::set<std::string> hashes;
    for (int run = 0; run < runs(); ++run)
      hashes.insert(hashOfRun(rasterizer, 1 + run % kMostThreads, (run / kMostThreads + run) % 2 == 1));
    for (const std::string& hash : hashes)
      std::printf("%s: %s\n", render::nameOf(rasterizer).c_str(), hash.c_str());
    EXPECT_EQ(hashes.size(), 1u) << render::nameOf(rasterizer);
  }
}

}  // namespace
}  // namespace sunlit::test
