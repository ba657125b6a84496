// A scene that is not sound is refused, by name.
#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <stdexcept>
#include <string>

#include "scene/triangle_budget.h"
#include "sunlit/scene/scene.h"
#include "support/message_of.h"

namespace sunlit::scene {
namespace {

Scene triangle() {
  Scene scene;
  scene.textures.push_back(Texture{"bricks", 1, 2, std::vector<std::uint8_t>(8, 255)});
  Material material;
  material.name = "wall";
  material.base_texture = 0;
  scene.materials.push_back(material);
  Mesh mesh;
  mesh.name = "house";
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  mesh.normals.assign(3, Eigen::Vector3f::UnitZ());
  mesh.texture_coordinates.assign(3, Eigen::Vector2f::Zero());
  mesh.colors.assign(3, Eigen::Array3f::Ones());
  mesh.triangles = {{0, 1, 2}};
  scene.meshes.push_back(mesh);
  return scene;
}

std::string errorAfter(const std::function<void(Scene&)>& change) {
  Scene scene = triangle();
  change(scene);
  return messageOf([&] { validate(scene); });
}

const float kNan = std::numeric_limits<float>::quiet_NaN();

TEST(Validate, AcceptsASoundScene) {
  EXPECT_EQ(errorAfter([](Scene&) {}), "");
  EXPECT_EQ(errorAfter([](Scene& scene) {
              scene.meshes[0].texture_coordinates.clear();
              scene.meshes[0].colors.clear();
            }),
            "");
}

// Counted, not made.
TEST(Validate, NoMoreThanASceneMayHoldIsAskedFor) {
  TriangleBudget budget;
  budget.take(kMostTriangles - 1, kMostVertices, "a");
  budget.take(1, 0, "b");
  EXPECT_EQ(messageOf<std::runtime_error>([&] { budget.take(1, 0, "w.sdf: mesh c"); }),
            "w.sdf: mesh c: the number of triangles up to here is 50000001, but must be from 0 to 50000000");
  TriangleBudget other;
  EXPECT_EQ(messageOf<std::runtime_error>([&] { other.take(1, kMostVertices + 1, "d"); }),
            "d: the number of vertices up to here is 150000001, but must be from 0 to 150000000");
}

TEST(Validate, NamesTheMesh) {
  EXPECT_EQ(errorAfter([](Scene& s) { s.meshes[0].material = 1; }), "mesh 'house': there is no material 1");
  EXPECT_EQ(errorAfter([](Scene& s) { s.meshes[0].triangles[0][2] = 3; }),
            "mesh 'house': triangle 0: there is no vertex 3");
  EXPECT_EQ(errorAfter([](Scene& s) { s.meshes[0].normals.pop_back(); }),
            "mesh 'house': it must have one normal a vertex");
  EXPECT_EQ(errorAfter([](Scene& s) { s.meshes[0].normals[1] *= 2.0f; }),
            "mesh 'house': vertex 1: normal is not of length 1");
  EXPECT_EQ(errorAfter([](Scene& s) { s.meshes[0].normals[1].x() = kNan; }),
            "mesh 'house': vertex 1: normal is not of length 1");
  EXPECT_EQ(errorAfter([](Scene& s) { s.meshes[0].positions[2].y() = kNan; }),
            "mesh 'house': vertex 2: position is not finite");
  // As of a map in metres north of the equator.
  EXPECT_EQ(
      errorAfter([](Scene& s) { s.meshes[0].positions[2].y() = 5.5e6f; }),
      "mesh 'house': vertex 2: position is farther than 100 km from the origin, where coordinates are a "
      "centimetre apart; move the world to its origin");
  EXPECT_EQ(errorAfter([](Scene& s) { s.meshes[0].colors[0][1] = 2.5f; }),
            "mesh 'house': vertex 0: colour is 2.5, but must be from 0 to 2");
  EXPECT_EQ(errorAfter([](Scene& s) { s.meshes[0].texture_coordinates.pop_back(); }),
            "mesh 'house': it must have one texture coordinate a vertex, or none");
  for (const auto& [wrong, told] : {std::pair(kNan, "nan"), {3e12f, "3e+12"}, {-1.1e6f, "-1100000"}}) {
    const float y = wrong;
    EXPECT_EQ(errorAfter([y](Scene& s) { s.meshes[0].texture_coordinates[1].y() = y; }),
              "mesh 'house': vertex 1: texture coordinate is " + std::string(told) +
                  ", but must be from -1000000 to 1000000");
  }
}

TEST(Validate, NamesTheMaterialKeyValueAndRange) {
  EXPECT_EQ(errorAfter([](Scene& s) { s.materials[0].roughness = 0.0f; }),
            "material 'wall': roughness is 0, but must be from 0.03 to 1");
  EXPECT_EQ(errorAfter([](Scene& s) { s.materials[0].transmission = 1.5f; }),
            "material 'wall': transmission is 1.5, but must be from 0 to 1");
  EXPECT_EQ(errorAfter([](Scene& s) { s.materials[0].base_color.value[2] = kNan; }),
            "material 'wall': base_color is nan, but must be from 0 to 1");
  EXPECT_EQ(errorAfter([](Scene& s) { s.materials[0].base_texture = 1; }),
            "material 'wall': there is no texture 1");
  EXPECT_EQ(errorAfter([](Scene& s) { s.materials[0].base_texture = -2; }),
            "material 'wall': there is no texture -2");
  EXPECT_EQ(errorAfter([](Scene& s) { s.materials[0].detail.finest_m = 9.0f; }),
            "material 'wall': detail must have 0 < finest_m < coarsest_m");
  EXPECT_EQ(errorAfter([](Scene& s) { s.materials[0].normal_map.texture = 1; }),
            "material 'wall': there is no texture 1");
  EXPECT_EQ(errorAfter([](Scene& s) { s.materials[0].roughness_map.channel = 4; }),
            "material 'wall': channel of a texture is 4, but must be from 0 to 3");
  EXPECT_EQ(errorAfter([](Scene& s) { s.materials[0].alpha = 1.5f; }),
            "material 'wall': alpha is 1.5, but must be from 0 to 1");
  EXPECT_EQ(errorAfter([](Scene& s) { s.materials[0].emission.value[0] = -1.0f; }),
            "material 'wall': emission is -1, but must be at least 0");
}

TEST(Validate, NamesTheTexture) {
  EXPECT_EQ(errorAfter([](Scene& s) { s.textures[0].height = 3; }),
            "texture 'bricks': it holds 8 bytes, not 12");
  EXPECT_EQ(errorAfter([](Scene& s) { s.textures[0].width = 0; }), "texture 'bricks': it has no pixels");
}

TEST(Validate, NamesTheLamp) {
  const auto withLamp = [](const std::function<void(Lamp&)>& change) {
    return errorAfter([&](Scene& scene) {
      Lamp lamp;
      lamp.name = "post";
      change(lamp);
      scene.lamps.push_back(lamp);
    });
  };
  EXPECT_EQ(withLamp([](Lamp&) {}), "");
  EXPECT_EQ(withLamp([](Lamp& l) { l.position.x() = kNan; }),
            "lamp 'post': position is not finite or farther than 100 km from the origin");
  EXPECT_EQ(withLamp([](Lamp& l) { l.direction *= 2.0f; }), "lamp 'post': direction is not of length 1");
  EXPECT_EQ(withLamp([](Lamp& l) { l.intensity = LinearRgb(1.0f, -1.0f, 1.0f); }),
            "lamp 'post': intensity is -1, but must be at least 0");
  EXPECT_EQ(withLamp([](Lamp& l) { l.quadratic = 0.0f; }),
            "lamp 'post': constant, linear and quadratic must not all be 0");
  EXPECT_EQ(withLamp([](Lamp& l) { l.range_m = 0.0f; }), "lamp 'post': range_m is 0, but must be above 0");
  EXPECT_EQ(withLamp([](Lamp& l) {
              l.outer_rad = 0.5f;
              l.inner_rad = 0.75f;
            }),
            "lamp 'post': inner_rad is 0.75, but must be from 0 to 0.5");
  EXPECT_EQ(withLamp([](Lamp& l) { l.radius_m = kNan; }),
            "lamp 'post': radius_m is nan, but must be from 0 to 10");
}

}  // namespace
}  // namespace sunlit::scene
