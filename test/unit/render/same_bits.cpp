// The same bits whatever the number of threads, from run to run, and with or without culling.
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cstring>
#include <future>
#include <random>
#include <vector>

#include "sunlit/light/picture.h"
#include "sunlit/light/transport.h"
#include "sunlit/scene/weathering.h"
#include "test_scenes.h"

namespace sunlit::test {
namespace {

/// A few hundred boxes over some hundred metres, textured, cut out and detailed, with a sun low enough for
/// penumbrae.
scene::Scene town() {
  scene::Scene scene;
  std::minstd_rand random(1);
  const auto uniform = [&random] {
    return static_cast<float>(random()) / static_cast<float>(std::minstd_rand::max());
  };
  scene::Texture texture{"leaves", 64, 64, {}};
  for (int i = 0; i < 64 * 64; ++i) {
    for (int c = 0; c < 4; ++c) texture.rgba.own().push_back(static_cast<std::uint8_t>(255.0f * uniform()));
  }
  scene.textures.push_back(texture);
  const int plain = addMaterial(&scene, {0.4f, 0.3f, 0.2f});
  const int leaves = addMaterial(&scene, {0.8f, 0.9f, 0.8f});
  scene.materials[1].base_texture = 0;
  scene.materials[1].alpha_mode = scene::AlphaMode::kMask;
  const int rough = addMaterial(&scene, {0.3f, 0.3f, 0.3f});
  scene.materials[2].detail.contrast = 0.3f;
  scene.materials[2].roughness = 0.3f;
  addGround(&scene, rough, 300.0f);
  for (int i = 0; i < 300; ++i) {
    const Eigen::Vector3f low(300.0f * uniform() - 150.0f, 300.0f * uniform() - 150.0f, 0.0f);
    const Eigen::Vector3f size(1.0f + 5.0f * uniform(), 1.0f + 5.0f * uniform(), 1.0f + 9.0f * uniform());
    addBlock(&scene, i % 3 == 0 ? leaves : plain, low, size);
  }
  return scene;
}

const Eigen::Isometry3d kPose = lookingAt({-20.0, 30.0, 2.0}, {40.0, 10.0, 1.0});

std::vector<float> rendered(int threads) {
  tbb::global_control limit(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads));
  render::Renderer renderer(shared(town()), smallCamera(200, 150, 80.0));
  renderer.look(kPose);
  std::vector<float> values = renderer.light(daylightAt(100.0, 12.0)).data;
  const image::DepthImage depth = renderer.depth();
  values.insert(values.end(), depth.data.begin(), depth.data.end());
  return values;
}

/// Compares representations, so that NaN equals NaN.
bool sameBits(const std::vector<float>& a, const std::vector<float>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(float)) == 0;
}

TEST(Picture, HasTheSameBitsForAnyNumberOfThreads) {
  const std::vector<float> one = rendered(1);
  EXPECT_TRUE(sameBits(rendered(2), one));
  EXPECT_TRUE(sameBits(rendered(4), one));
  EXPECT_TRUE(sameBits(rendered(4), one)) << "in a second run";
}

TEST(Picture, DoesNotChangeWhenALookIsRepeatedAfterOthers) {
  render::Renderer renderer(shared(town()), smallCamera(200, 150, 80.0));
  const sky::Daylight day = daylightAt(100.0, 12.0);
  renderer.look(kPose);
  const std::vector<float> first = renderer.light(day).data;
  renderer.look(lookingAt({3.0, 3.0, 40.0}, {0.0, 0.0, 0.0}));
  renderer.light(day);
  renderer.look(kPose);
  EXPECT_TRUE(sameBits(renderer.light(day).data, first));
}

TEST(Picture, IsTheSameWhenItsPoseWasDrawnAhead) {
  const Eigen::Isometry3d other = lookingAt({3.0, 3.0, 40.0}, {0.0, 0.0, 0.0});
  const sky::Daylight day = daylightAt(100.0, 12.0);
  render::Renderer plain(shared(town()), smallCamera(200, 150, 80.0));
  plain.look(other);
  const std::vector<float> other_light = plain.light(day).data;
  const std::vector<float> other_depth = plain.depth().data;

  render::Renderer renderer(shared(town()), smallCamera(200, 150, 80.0));
  renderer.look(kPose);
  const std::vector<float> first = renderer.light(day).data;
  std::future<std::vector<float>> meanwhile =
      std::async(std::launch::async, [&] { return renderer.light(day).data; });
  renderer.lookAhead(other);
  EXPECT_TRUE(sameBits(meanwhile.get(), first)) << "lit while the next pose was drawn";
  EXPECT_TRUE(sameBits(renderer.light(day).data, first)) << "lit after the next pose was drawn";
  renderer.look(other);
  EXPECT_TRUE(sameBits(renderer.light(day).data, other_light));
  EXPECT_TRUE(sameBits(renderer.depth().data, other_depth));

  renderer.lookAhead(kPose);  // drawn ahead, but somewhere else is looked at
  renderer.look(other);
  EXPECT_TRUE(sameBits(renderer.light(day).data, other_light));
}

TEST(Picture, IsTheSameByFinalGatheringForAnyNumberOfThreadsAndWhateverWasSeenBefore) {
  light::World world(shared(town()));
  light::TransportOptions coarse;
  coarse.samples = 5000;
  coarse.bounces = 1;
  world.transport = light::Transport::bake(world.geometry, coarse);
  const light::Illumination light = light::illumination(world, daylightAt(100.0, 12.0));
  render::RenderOptions options = smallCamera(200, 150, 80.0);
  const auto picture = [&](render::Renderer* renderer) {
    renderer->look(kPose);
    return renderer->light(light).data;
  };
  render::Renderer baked(world, options);
  options.final_gather = 2;
  render::Renderer gathering(world, options);
  const std::vector<float> first = picture(&gathering);
  EXPECT_FALSE(sameBits(first, picture(&baked)));

  for (const double x : {-19.0, -18.0}) {  // most of what is seen there was seen before
    gathering.look(lookingAt({x, 30.0, 2.0}, {40.0, 10.0, 1.0}));
    gathering.light(light);
  }
  EXPECT_TRUE(sameBits(picture(&gathering), first));
  const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
  render::Renderer alone(world, options);
  EXPECT_TRUE(sameBits(picture(&alone), first));
}

/// A town, bare and in snow, in which light is baked coarsely.
std::vector<light::World> bareAndInSnow() {
  std::vector<light::World> states = {light::World(shared(town()))};
  scene::SurfaceState snow;
  snow.snow_m = 0.05;
  states.push_back(light::weathered(states.front(), snow));
  light::TransportOptions coarse;
  coarse.samples = 5000;
  coarse.bounces = 1;
  for (light::World& state : states) state.transport = light::Transport::bake(state.geometry, coarse);
  return states;
}

TEST(Picture, IsTheSameByFinalGatheringOfAStateAloneAndOfAllOnesCamerasAndStates) {
  const std::vector<light::World> states = bareAndInSnow();
  render::RenderOptions options = smallCamera(200, 150, 80.0);
  options.final_gather = 2;
  const auto picture = [&](render::Renderer* renderer, std::size_t state, std::size_t of_world) {
    renderer->look(kPose);
    return renderer->light(light::illumination(states[of_world], daylightAt(100.0, 12.0)), state).data;
  };
  render::Renderer all(states, options);
  render::Renderer beside(all, options, render::Renderer::States::kAll);
  all.look(lookingAt({-19.0, 30.0, 2.0}, {40.0, 10.0, 1.0}));
  for (const std::size_t state : {0u, 1u}) {
    render::Renderer alone(states[state], options);
    const std::vector<float> expected = picture(&alone, 0, state);
    EXPECT_TRUE(sameBits(picture(&beside, state, state), expected)) << state;
    EXPECT_TRUE(sameBits(picture(&all, state, state), expected)) << state;
  }
}

TEST(Picture, LooksCloserAtTheSkyOnceForAllStatesAndCameras) {
  const std::vector<light::World> states = bareAndInSnow();
  render::Renderer renderer(states, smallCamera(200, 150, 80.0));
  renderer.look(kPose);
  light::PreparedPicture picture;
  const auto castBy = [&](light::PicturePreparer* preparer, std::size_t state) {
    preparer->prepare({renderer.surfaces(state), states[state].visibility, {}}, &picture);
    return preparer->placesCast();
  };
  light::PicturePreparer bare(states[0], 2), in_snow(states[1], 2, &bare), right(states[0], 2, &in_snow);
  light::PicturePreparer otherwise(states[1], 1, &bare), alone(states[1], 2);
  const std::size_t places = castBy(&bare, 0);
  EXPECT_GT(places, 0u);
  EXPECT_EQ(castBy(&in_snow, 1), 0u);
  EXPECT_EQ(castBy(&right, 0), 0u);
  EXPECT_EQ(castBy(&otherwise, 1), places);  // by fewer rays
  EXPECT_EQ(castBy(&alone, 1), places);
}

TEST(Picture, IsTheSameWhereAnotherPreparesWhatIsSeen) {
  const light::World world(shared(town()));
  render::Renderer renderer(world, smallCamera(200, 150, 80.0));
  renderer.look(kPose);
  light::PicturePreparer preparer(world);
  light::PreparedPicture picture;
  preparer.prepare({renderer.surfaces(), world.visibility, {}}, &picture);
  for (const double elevation_deg : {12.0, -8.0}) {
    const sky::Daylight day = daylightAt(100.0, elevation_deg);
    EXPECT_TRUE(sameBits(picture.illuminate(day).data, renderer.light(day).data))
        << "sun at " << elevation_deg;
  }
}

TEST(Picture, IsTheSameFromTwoRenderersOfOneThread) {
  render::Renderer a(shared(town()), smallCamera(200, 150, 80.0));
  render::Renderer b(shared(town()), smallCamera(200, 150, 80.0));
  const sky::Daylight day = daylightAt(100.0, 12.0);
  a.look(kPose);
  b.look(lookingAt({3.0, 3.0, 40.0}, {0.0, 0.0, 0.0}));
  const std::vector<float> first = a.light(day).data;
  b.look(kPose);
  EXPECT_TRUE(sameBits(b.light(day).data, first));
}

}  // namespace
}  // namespace sunlit::test
