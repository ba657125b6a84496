#include "sunlit/light/world.h"

#include <gtest/gtest.h>

#include <functional>
#include <memory>
#include <set>

#include "paper_scene.h"
#include "sunlit/light/transport.h"
#include "sunlit/scene/weathering.h"

namespace sunlit::light {
namespace {

scene::Texture grey() {
  scene::Texture texture;
  texture.width = texture.height = 2;
  texture.rgba.own().assign(16, 128);
  return texture;
}

/// A scene, what moves in it, and how it is baked.
struct Contents {
  scene::Scene scene;
  std::vector<std::vector<scene::Mesh>> bodies;
  TransportOptions options;
  bool baked = false;

  Contents() {
    scene.materials = {paint(0.4f), paint(0.2f)};
    scene.materials[0].base_texture = 0;
    scene.textures = {grey()};
    addGround(&scene, 0, 2.0f);
    options.samples = 1000;
  }
  std::string print() const {
    World world(std::make_shared<const scene::Scene>(scene), bodies);
    if (baked) world.transport = Transport::bake(world.geometry, options);
    return fingerprint(world);
  }
};

scene::Mesh plate(float size) {
  scene::Scene scene;
  addPatch(&scene, 1, {0, 0, 0}, {size, 0, 0}, {0, size, 0});
  return scene.meshes[0];
}

TEST(Fingerprint, IsOfTheContentsAlone) {
  EXPECT_EQ(Contents().print(), Contents().print());
  Contents named;
  named.scene.name = "elsewhere";
  EXPECT_EQ(named.print(), Contents().print());
}

TEST(Fingerprint, IsKnownBeforeTheBake) {
  const Contents contents;
  Contents baked = contents;
  baked.baked = true;
  const World world(std::make_shared<const scene::Scene>(contents.scene));
  EXPECT_EQ(fingerprint(world, contents.options), baked.print());
  EXPECT_NE(fingerprint(world), baked.print());
}

TEST(Fingerprint, ChangesWithAllThatPicturesShow) {
  const std::vector<std::function<void(Contents&)>> changes = {
      [](Contents&) {},
      [](Contents& c) { c.scene.meshes[0].positions[0].z() += 0.01f; },
      [](Contents& c) { c.scene.materials[0].base_color = LinearRgb(0.4f, 0.4f, 0.41f); },
      [](Contents& c) { c.scene.materials[0].roughness = 0.5f; },
      [](Contents& c) { c.scene.lamps.emplace_back(); },
      [](Contents& c) { c.scene.lamps.emplace_back().range_m = 20.0f; },
      [](Contents& c) {
        c.scene.lamps.emplace_back().range_m = 20.0f;
        c.scene.lamps[0].ends_sharply = true;
      },
      [](Contents& c) { c.scene.lamps.emplace_back().group = "posts"; },
      [](Contents& c) { c.scene.materials[0].detail.contrast = 0.1f; },
      [](Contents& c) { c.scene.materials[0].detail.tint[2] = 0.9f; },
      [](Contents& c) { c.scene.textures[0].rgba.own()[5] = 129; },
      [](Contents& c) { c.scene.materials[0].normal_map.texture = 0; },
      [](Contents& c) { c.scene.materials[0].normal_scale = 0.5f; },
      [](Contents& c) { c.scene.materials[0].occlusion_map.texture = 0; },
      [](Contents& c) { c.scene.materials[0].lamp_group = "posts"; },
      [](Contents& c) {
        c.scene.meshes[0].tangents.assign(4, {0.0f, 1.0f, 0.0f, 1.0f});
      },
      [](Contents& c) { c.bodies = {{plate(1.0f)}}; },
      [](Contents& c) { c.bodies = {{plate(1.1f)}}; },
      [](Contents& c) {
        c.bodies = {{plate(1.0f)}};
        c.scene.materials[1].metalness = 1.0f;
      },
      [](Contents& c) { c.baked = true; },
      [](Contents& c) {
        c.baked = true;
        c.options.bounces = 1;
      },
  };
  std::set<std::string> prints;
  for (const auto& change : changes) {
    Contents contents;
    change(contents);
    prints.insert(contents.print());
  }
  EXPECT_EQ(prints.size(), changes.size());
}

TEST(Weathered, SharesTrianglesAndRaysButNotWhatLiesOnThem) {
  auto dry = std::make_unique<const World>(std::make_shared<const scene::Scene>(Contents().scene));
  scene::SurfaceState state;
  state.wet = 1.0;
  const World wet = weathered(*dry, state);
  EXPECT_EQ(wet.geometry->shape, dry->geometry->shape);
  EXPECT_EQ(&wet.visibility->fixedGeometry(), wet.geometry.get());
  EXPECT_NE(wet.geometry->weathering, nullptr);
  EXPECT_EQ(dry->visibility->fixedGeometry().weathering, nullptr);
  const auto met = [](const Visibility& visibility) {
    return visibility.firstSeen({0.3f, 0.2f, 5.0f}, {0.0f, 0.0f, -1.0f}, 0.1f);
  };
  const auto expected = met(*dry->visibility);
  ASSERT_TRUE(expected.has_value());
  dry.reset();
  EXPECT_EQ(met(*wet.visibility), expected);
}

}  // namespace
}  // namespace sunlit::light
