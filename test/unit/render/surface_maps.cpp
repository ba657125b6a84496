// What textures beside the colour's make of a surface, against pencil and paper.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

#include "sunlit/quantity/angle.h"
#include "test_scenes.h"

namespace sunlit::test {
namespace {

using Texel = std::array<std::uint8_t, 4>;

scene::Texture textureOf(int width, int height, const std::function<Texel(int, int)>& texel) {
  scene::Texture texture{"made", width, height, {}};
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const Texel t = texel(x, y);
      texture.rgba.own().insert(texture.rgba.own().end(), t.begin(), t.end());
    }
  }
  return texture;
}

/// A square of 8 × 8 m about the origin, facing up, u to the east and v to the south, once over it.
struct Square {
  scene::Scene scene;
  scene::Material& material() { return scene.materials[0]; }

  explicit Square(double reach = 1.0, float z = 0.0f) {
    addMaterial(&scene, Eigen::Array3f(0.5f, 0.5f, 0.5f));
    scene::Mesh mesh;
    mesh.name = "square";
    mesh.positions = {{-4.0f, -4.0f, z}, {4.0f, -4.0f, z}, {4.0f, 4.0f, z}, {-4.0f, 4.0f, z}};
    mesh.normals.assign(4, Eigen::Vector3f::UnitZ());
    const auto r = static_cast<float>(reach);
    mesh.texture_coordinates = {{0.0f, r}, {r, r}, {r, 0.0f}, {0.0f, 0.0f}};
    mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
    scene.meshes.push_back(mesh);
  }
  int add(scene::Texture texture) {
    scene.textures.push_back(std::move(texture));
    return static_cast<int>(scene.textures.size()) - 1;
  }
};

/// From above, north up: its middle covers the middle of the square.
struct Seen {
  render::Renderer renderer;
  explicit Seen(const scene::Scene& scene, const Eigen::Vector3d& eye = {0.0, 0.0, 5.0})
      : renderer(shared(scene), smallCamera(64, 48, 40.0)) {
    renderer.look(lookingAt(eye, {0.0, 0.0, 0.0}));
  }
  /// Of the middle pixel, or one beside it.
  light::Surface surface(int right = 0, int down = 0) const {
    const auto pixel = static_cast<std::uint32_t>((24 + down) * 64 + 32 + right);
    for (const light::Tile& tile : renderer.surfaces().tiles) {
      for (const light::Surface& s : tile.surfaces) {
        if (s.pixel == pixel) return s;
      }
    }
    ADD_FAILURE() << "the middle sees nothing";
    return {};
  }
  Eigen::Array3f light(const sky::Daylight& day) const { return at(renderer.light(day), 32, 24); }
};

constexpr float kCode = 1.0f / 255.0f;

TEST(RoughnessAndMetalness, OfATextureAreThoseOfFactors) {
  const sky::Daylight day = daylightAt(180.0, 45.0);
  for (const int code : {0, 64, 255}) {
    Square textured, plain;
    const auto byte = static_cast<std::uint8_t>(code);
    const int texture = textured.add(textureOf(2, 2, [&](int, int) { return Texel{9, 128, byte, 255}; }));
    textured.material().metalness = 1.0f;
    textured.material().roughness_map = {texture, 0, 1};
    textured.material().metalness_map = {texture, 0, 2};
    plain.material().roughness = 128.0f * kCode;
    plain.material().metalness = static_cast<float>(code) * kCode;
    const Seen a(textured.scene), b(plain.scene);
    // 16 bits a texel: 1.5e-5.
    EXPECT_NEAR(a.surface().roughness, 128.0f * kCode, 3e-5f);
    EXPECT_NEAR(a.surface().metalness, static_cast<float>(code) * kCode, 3e-5f);
    EXPECT_LT((a.light(day) / b.light(day) - 1.0f).abs().maxCoeff(), 1e-3f) << code;
  }
}

TEST(DataTextures, AreAveragedAsNumbersNotAsColours) {
  // Columns of 0 and 1 far narrower than a pixel: their mean is 0.5. As display colours, 0.21 would be taken
  // for their mean's code 128.
  Square square(64.0);
  const int texture = square.add(textureOf(64, 64, [](int x, int) {
    return x % 2 == 0 ? Texel{0, 255, 255, 255} : Texel{0, 0, 0, 255};
  }));
  square.material().metalness = 1.0f;
  square.material().metalness_map = {texture, 0, 2};
  EXPECT_NEAR(Seen(square.scene).surface().metalness, 0.5f, 0.002f);
}

Texel normalTexel(const Eigen::Vector3f& normal) {
  const Eigen::Array3f codes = ((normal.array() + 1.0f) * 0.5f * 255.0f).round();
  return {static_cast<std::uint8_t>(codes[0]), static_cast<std::uint8_t>(codes[1]),
          static_cast<std::uint8_t>(codes[2]), 255};
}

/// A square whose map says the same everywhere.
Square tilted(const Eigen::Vector3f& normal) {
  Square square;
  square.material().normal_map.texture =
      square.add(textureOf(4, 4, [&](int, int) { return normalTexel(normal); }));
  return square;
}

// 8 bits: half a code of 2/255 in each of three, 0.007 together.
constexpr float kNormalCode = 0.008f;

TEST(NormalMap, OfThirtyDegreesShadesAsAPlaneOfThirtyDegrees) {
  const Eigen::Vector3f to_east(0.5f, 0.0f, std::sqrt(0.75f)), to_north(0.0f, 0.5f, std::sqrt(0.75f));
  const Seen east(tilted(to_east).scene), north(tilted(to_north).scene), flat(Square().scene);
  EXPECT_LT((east.surface().shading_normal - to_east).norm(), kNormalCode);
  EXPECT_LT((north.surface().shading_normal - to_north).norm(), kNormalCode);  // green points to the top
  EXPECT_EQ(east.surface().geometric_normal, Eigen::Vector3f::UnitZ());
  // Under a sun 30° high in the east, cos 30° instead of sin 30°: a matt surface is 1.73 times as bright in
  // the sun, in which the shade of all around takes no part: both suns' difference counts.
  const sky::Daylight day = daylightAt(90.0, 30.0);
  const Eigen::Array3f sun = day.sun().illuminance.value;
  const auto matt = [&](float n_l, float n_v) {
    const float v_h = std::cos(30.0f * static_cast<float>(kRadPerDeg));  // half of 60° between eye and sun
    const float fresnel = 0.04f + 0.96f * std::pow(1.0f - v_h, 5.0f);
    return (0.5f / kPiFloat * (1.0f - fresnel) + fresnel / kPiFloat * 0.5f / (n_l + n_v)) * n_l;
  };
  const float sky_flat = skyPart(day, Eigen::Vector3f::UnitZ(), Eigen::Array3f::Constant(0.5f))[1];
  const float sky_east = skyPart(day, to_east, Eigen::Array3f::Constant(0.5f))[1];
  // The rough lobe of the sky: a tenth of its Lambert part.
  EXPECT_NEAR(flat.light(day)[1], matt(0.5f, 1.0f) * sun[1] + sky_flat, 0.1f * sky_flat);
  EXPECT_NEAR(east.light(day)[1], matt(std::sqrt(0.75f), std::sqrt(0.75f)) * sun[1] + sky_east,
              0.1f * sky_east + kNormalCode * sun[1]);
}

TEST(NormalMap, FollowsTurnedAndMirroredCoordinates) {
  const Eigen::Vector3f right(0.5f, 0.0f, std::sqrt(0.75f));
  Square mirrored = tilted(right);
  for (Eigen::Vector2f& c : mirrored.scene.meshes[0].texture_coordinates) c.x() = 1.0f - c.x();
  EXPECT_LT((Seen(mirrored.scene).surface().shading_normal - Eigen::Vector3f(-0.5f, 0.0f, right.z())).norm(),
            kNormalCode);
  Square turned = tilted(right);
  for (Eigen::Vector2f& c : turned.scene.meshes[0].texture_coordinates)
    c = Eigen::Vector2f(1.0f - c.y(), c.x());
  // Now u grows to the north.
  EXPECT_LT((Seen(turned.scene).surface().shading_normal - Eigen::Vector3f(0.0f, 0.5f, right.z())).norm(),
            kNormalCode);
}

TEST(NormalMap, ObeysTheTangentsOfTheFile) {
  Square square = tilted({0.5f, 0.0f, std::sqrt(0.75f)});
  square.scene.meshes[0].tangents.assign(4, Eigen::Vector4f(0.0f, 1.0f, 0.0f, 1.0f));
  EXPECT_LT(
      (Seen(square.scene).surface().shading_normal - Eigen::Vector3f(0.0f, 0.5f, std::sqrt(0.75f))).norm(),
      kNormalCode);
}

TEST(NormalMap, IsADentFromBehind) {
  const Eigen::Vector3f to_east(0.5f, 0.0f, std::sqrt(0.75f));
  const Seen below(tilted(to_east).scene, {0.0, 0.0, -5.0});
  EXPECT_LT((below.surface().shading_normal + to_east).norm(), kNormalCode);
}

TEST(NormalMap, StaysAboveItsTriangle) {
  const Seen seen(tilted(Eigen::Vector3f(0.98f, 0.0f, -0.199f)).scene);
  EXPECT_GT(seen.surface().shading_normal.z(), 0.0f);
  EXPECT_NEAR(seen.surface().shading_normal.norm(), 1.0f, 1e-5f);
}

TEST(NormalMap, WidensTheLobeByWhatItAveragesAway) {
  // Grooves of ±20°, far narrower than a pixel: the mean has a length of cos 20°, so α² grows by
  // 2 (1 − cos 20°) / cos 20° = 0.1283.
  Square square(64.0);
  const float sine = std::sin(20.0f * static_cast<float>(kRadPerDeg));
  square.material().normal_map.texture = square.add(textureOf(64, 64, [&](int x, int) {
    return normalTexel({x % 2 == 0 ? sine : -sine, 0.0f, std::sqrt(1.0f - sine * sine)});
  }));
  square.material().roughness = 0.3f;
  const float expected = std::pow(std::pow(0.3f, 4.0f) + 0.1283f, 0.25f);
  EXPECT_NEAR(Seen(square.scene).surface().roughness, expected, 0.01f);  // 8 bits move the angle by 0.3°
  Square even = tilted({0.0f, 0.0f, 1.0f});
  even.material().roughness = 0.3f;
  EXPECT_EQ(Seen(even.scene).surface().roughness, 0.3f);
}

TEST(EmissionMap, MultipliesTheEmissionInLinearLight) {
  Square square;
  square.material().emission = LinearRgb(1000.0f, 1000.0f, 1000.0f);
  square.material().emission_map.texture = square.add(textureOf(2, 2, [](int, int) {
    return Texel{255, 188, 0, 255};
  }));
  const Eigen::Array3f glow = Seen(square.scene).surface().emission;
  EXPECT_NEAR(glow[0], 1000.0f, 0.1f);
  EXPECT_NEAR(glow[1], 502.9f, 0.1f);  // ((188/255 + 0.055) / 1.055)^2.4
  EXPECT_EQ(glow[2], 0.0f);
}

TEST(OcclusionMap, DimsAmbientLightAlone) {
  Square square, bare;
  square.material().occlusion_map.texture = square.add(textureOf(2, 2, [](int, int) {
    return Texel{51, 255, 255, 255};
  }));
  square.material().occlusion_strength = 0.5f;
  const Seen seen(square.scene), open(bare.scene);
  EXPECT_NEAR(seen.surface().cavity, 0.6f, 1e-4f);  // 1 + 0.5 (0.2 − 1)
  // At night there is but ambient light; by day the sun stays.
  const sky::Daylight day = daylightAt(180.0, 45.0);
  const Eigen::Array3f lost = open.light(day) - seen.light(day);
  const Eigen::Array3f sky = skyPart(day, Eigen::Vector3f::UnitZ(), Eigen::Array3f::Constant(0.5f));
  EXPECT_NEAR(lost[2] / sky[2], 0.4f, 0.04f);  // the rough lobe: a tenth
}

TEST(Wrap, ClampsAndMirrors) {
  // Left half black, right half white; the middle of the square looks at u = 1.25 of it.
  for (const auto& [wrap, expected] :
       {std::pair(scene::Wrap::kRepeat, 0.0f), std::pair(scene::Wrap::kClamp, 0.5f),
        std::pair(scene::Wrap::kMirror, 0.5f)}) {
    Square square(2.5);
    scene::Texture texture = textureOf(64, 64, [](int x, int) {
      return x < 32 ? Texel{0, 0, 0, 255} : Texel{255, 255, 255, 255};
    });
    texture.wrap_u = wrap;
    square.material().base_texture = square.add(texture);
    EXPECT_NEAR(Seen(square.scene).surface().albedo[0], expected, 1e-3f);
  }
  // At u = 1.75 a mirrored texture is black again, a clamped one white.
  for (const auto& [wrap, expected] :
       {std::pair(scene::Wrap::kClamp, 0.5f), std::pair(scene::Wrap::kMirror, 0.0f)}) {
    Square square(3.5);
    scene::Texture texture = textureOf(64, 64, [](int x, int) {
      return x < 32 ? Texel{0, 0, 0, 255} : Texel{255, 255, 255, 255};
    });
    texture.wrap_u = wrap;
    square.material().base_texture = square.add(texture);
    EXPECT_NEAR(Seen(square.scene).surface().albedo[0], expected, 1e-3f);
  }
}

TEST(Coordinates, OfASecondSetAreItsOwn) {
  Square square;
  square.scene.meshes[0].more_texture_coordinates.emplace_back(4, Eigen::Vector2f(0.75f, 0.75f));
  square.material().metalness = 1.0f;
  square.material().metalness_map = {
      square.add(textureOf(64, 64,
                           [](int x, int y) {
                             return Texel{0, 0, static_cast<std::uint8_t>(x >= 32 && y >= 32 ? 255 : 0), 255};
                           })),
      1, 2};
  EXPECT_NEAR(Seen(square.scene).surface(-10, -8).metalness, 1.0f, 1e-4f);
  // A set that the mesh lacks: the factor counts.
  square.material().metalness_map.coordinates = 2;
  EXPECT_EQ(Seen(square.scene).surface().metalness, 1.0f);
}

/// White ground, and a black pane above it that lets 1 − alpha through.
scene::Scene pane(float alpha) {
  Square ground;
  ground.material().base_color = LinearRgb(1.0f, 1.0f, 1.0f);
  Square above(1.0, 1.0f);
  above.material().base_color = LinearRgb(0.0f, 0.0f, 0.0f);
  above.material().alpha_mode = scene::AlphaMode::kBlend;
  above.material().alpha = alpha;
  ground.scene.materials.push_back(above.material());
  ground.scene.meshes.push_back(above.scene.meshes[0]);
  ground.scene.meshes[1].material = 1;
  return ground.scene;
}

TEST(Blending, ShowsEachByItsShare) {
  const Seen seen(pane(0.25f));
  double total = 0.0;
  for (const light::Tile& tile : seen.renderer.surfaces().tiles) {
    for (const light::Surface& s : tile.surfaces) {
      if (s.pixel != 24 * 64 + 32) continue;
      EXPECT_NEAR(s.share[0], s.material == 1 ? 0.25f : 0.75f, 1e-5f);
      EXPECT_NEAR(s.position.z(), s.material == 1 ? 1.0f : 0.0f, 1e-4f);
      total += static_cast<double>(s.share[0]) * s.samples;
    }
  }
  EXPECT_NEAR(total, 4.0, 1e-4);
}

TEST(Blending, LetsItsShareOfTheSkyThrough) {
  const Seen up(pane(0.25f), {0.0, 0.0, -5.0});
  Square lone(1.0, 0.0f);
  lone.material().alpha_mode = scene::AlphaMode::kBlend;
  lone.material().alpha = 0.25f;
  lone.material().base_color = LinearRgb(0.0f, 0.0f, 0.0f);
  lone.material().dielectric = LinearRgb(0.0f, 0.0f, 0.0f);
  lone.material().dielectric_grazing = 0.0f;
  const sky::Daylight day = daylightAt(0.0, 20.0);
  const Seen black(lone.scene, {0.0, 0.1, -5.0});
  lone.scene.materials[0].alpha = 0.0f;
  const Seen open(lone.scene, {0.0, 0.1, -5.0});
  const Eigen::Array3f through = black.light(day) / open.light(day);
  // But for the air before the pane, 5 m of it: 1e-3.
  EXPECT_NEAR(through[1], 0.75f, 2e-3f);
}

/// Mean of the green of 30 × 20 pixels in the middle.
double meanOfMiddle(const Seen& seen, const sky::Daylight& day) {
  const image::LinearImage image = seen.renderer.light(day);
  double sum = 0.0;
  for (int y = 14; y < 34; ++y) {
    for (int x = 17; x < 47; ++x) sum += static_cast<double>(at(image, x, y)[1]);
  }
  return sum / 600.0;
}

TEST(Blending, IsNotSeenOnTheSurfaceThatItLiesOn) {
  scene::Scene scene = pane(0.5f);
  for (Eigen::Vector3f& position : scene.meshes[1].positions) position.z() = 0.0f;
  const Seen seen(scene, {0.3, 0.2, 6.0});
  for (const light::Tile& tile : seen.renderer.surfaces().tiles)
    for (const light::Surface& surface : tile.surfaces) EXPECT_EQ(surface.material, 0);
}

TEST(Blending, ShadesTheGroundByItsShare) {
  // The sun stands so high that the shadow of the pane covers the middle. Without a bake all see the whole
  // sky, so that of the ground's light only the sun's is shaded.
  const sky::Daylight day = daylightAt(180.0, 80.0);
  const double open = meanOfMiddle(Seen(pane(0.0f)), day);
  const double sky = static_cast<double>(skyPart(day, Eigen::Vector3f::UnitZ(), Eigen::Array3f::Ones())[1]);
  // The pane is black but for its reflection, 4 % of the light at most.
  const double expected = 0.75 * (sky + 0.75 * (open - sky));
  EXPECT_NEAR(meanOfMiddle(Seen(pane(0.25f)), day) / expected, 1.0, 0.04);
}

// Rays that are stopped by chance would differ by some ten per cent from pixel to pixel.
TEST(Blending, CastsAShadowWithoutGrain) {
  const sky::Daylight day = daylightAt(180.0, 80.0);
  const image::LinearImage image = Seen(pane(0.5f)).renderer.light(day);
  const image::LinearImage open = Seen(pane(0.0f)).renderer.light(day);
  EXPECT_LT(at(image, 32, 24)[1], 0.4f * at(open, 32, 24)[1]);  // 0.5 of the ground, of which most is sun
  for (int y = 14; y < 34; ++y) {
    for (int x = 17; x < 46; ++x)
      EXPECT_NEAR(at(image, x, y)[1] / at(image, x + 1, y)[1], 1.0f, 2e-3f) << x << " " << y;
  }
}

// A poster 2 mm before a wall is no bottom of a box.
TEST(Blending, IsSeenJustAboveASurface) {
  scene::Scene scene = pane(0.5f);
  for (Eigen::Vector3f& position : scene.meshes[1].positions) position.z() = 0.002f;
  const Seen seen(scene, {0.0, 0.1, 30.0});
  EXPECT_TRUE(std::any_of(seen.renderer.surfaces().tiles.begin(), seen.renderer.surfaces().tiles.end(),
                          [](const light::Tile& tile) {
                            return std::any_of(tile.surfaces.begin(), tile.surfaces.end(),
                                               [](const light::Surface& s) { return s.material == 1; });
                          }));
}

TEST(Blending, IsTheSameEveryTime) {
  const sky::Daylight day = daylightAt(180.0, 60.0);
  const Seen a(pane(0.4f)), b(pane(0.4f));
  EXPECT_EQ(a.renderer.light(day).data, b.renderer.light(day).data);
}

}  // namespace
}  // namespace sunlit::test
