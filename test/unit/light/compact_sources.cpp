// What shines and is small lights straight in pictures, as lamps do: by pencil and paper.
#include "light/bake/samples/compact_sources.h"

#include <gtest/gtest.h>

#include <numeric>

#include "light/picture/bodies/body_light.h"
#include "night_scene.h"
#include "shining_scene.h"

namespace sunlit::light {
namespace {

std::vector<CompactSource> compactIn(scene::Scene scene) {
  const World world = baked(std::move(scene));
  return world.transport->compactSources() ? *world.transport->compactSources()
                                           : std::vector<CompactSource>();
}

/// Without the panel.
scene::Scene blackFloor() {
  scene::Scene scene = panelAboveFloor(0.1f, 5.0f);
  scene.meshes.pop_back();
  return scene;
}

TEST(CompactSources, AreBulbsAsLargeAsTheyShow) {
  const std::vector<CompactSource> found = compactIn(ballAboveFloor(0.15f, 4.0f));
  ASSERT_EQ(found.size(), 1u);
  EXPECT_TRUE(found[0].normal.isZero());
  EXPECT_LT((found[0].position - Eigen::Vector3f(0.0f, 0.0f, 4.0f)).norm(), 1e-3f);
  // A ball of 24 × 12 facets shows up to 2.5 % less than the one around it.
  const double shows = kPi * 0.15 * 0.15 * 10000.0;
  for (const Eigen::Vector3f& towards :
       {Eigen::Vector3f(0.0f, 0.0f, -1.0f), Eigen::Vector3f(0.6f, 0.0f, 0.8f)})
    EXPECT_NEAR(LampBeam(found[0]).at(found[0].position + 2.0f * towards)[1] * 4.0, 0.98 * shows,
                0.02 * shows);
  EXPECT_NEAR(found[0].radius_m, 0.15f, 0.003f);
  EXPECT_NEAR(found[0].reach_m, 0.15f, 1e-3f);
}

TEST(CompactSources, OfABodyThatIsLongGiveMoreToItsSides) {
  scene::Scene scene = ballAboveFloor(0.1f, 4.0f);
  for (Eigen::Vector3f& position : scene.meshes.back().positions)
    position.z() = 4.0f + 2.0f * (position.z() - 4.0f);
  const std::vector<CompactSource> found = compactIn(std::move(scene));
  ASSERT_EQ(found.size(), 1u);
  const LampBeam beam(found[0]);
  // An ellipsoid with half axes of a, a and 2 a shows π a² from above, 2 π a² from a side.
  const double area = kPi * 0.01, below = beam.at({0.0f, 0.0f, 2.0f})[1] * 4.0,
               beside = beam.at({2.0f, 0.0f, 4.0f})[1] * 4.0;
  EXPECT_NEAR(below, area * 10000.0, 0.04 * area * 10000.0);
  EXPECT_NEAR(beside, 2.0 * area * 10000.0, 0.08 * area * 10000.0);
}

TEST(CompactSources, AreTheSidesOfAPanelThatShine) {
  scene::Scene scene = panelAboveFloor(0.6f, 3.0f);
  const std::vector<CompactSource> one = compactIn(scene);
  ASSERT_EQ(one.size(), 1u);
  EXPECT_LT((one[0].normal + Eigen::Vector3f::UnitZ()).norm(), 1e-5f);
  EXPECT_NEAR(one[0].intensity[1], 10000.0f * 0.36f, 1.0f);
  EXPECT_NEAR(one[0].half.col(0).norm(), 0.3f, 1e-4f);
  EXPECT_NEAR(one[0].half.col(1).norm(), 0.3f, 1e-4f);
  EXPECT_FALSE(one[0].round);
  scene.materials[1].double_sided = true;
  const std::vector<CompactSource> both = compactIn(scene);
  ASSERT_EQ(both.size(), 2u);
  EXPECT_LT((both[0].normal + both[1].normal).norm(), 1e-5f);
}

TEST(CompactSources, OfADiscAreRound) {
  scene::Scene scene = blackFloor();
  scene::Mesh disc;
  disc.material = 1;
  constexpr int kAround = 32;
  for (int i = 0; i < kAround; ++i) {
    const auto turn = static_cast<float>(2.0 * kPi * i / kAround);
    disc.positions.emplace_back(0.2f * std::cos(turn), 0.2f * std::sin(turn), 3.0f);
  }
  disc.normals.assign(kAround, -Eigen::Vector3f::UnitZ());
  disc.texture_coordinates.assign(kAround, Eigen::Vector2f::Zero());
  for (std::uint32_t i = 1; i + 1 < kAround; ++i) disc.triangles.push_back({0, i + 1, i});
  scene.meshes.push_back(disc);
  const std::vector<CompactSource> found = compactIn(std::move(scene));
  ASSERT_EQ(found.size(), 1u);
  EXPECT_TRUE(found[0].round);
  EXPECT_NEAR(found[0].half.col(0).norm(), 0.2f, 0.002f);
  EXPECT_NEAR(found[0].intensity[1], 10000.0f * kPiFloat * 0.04f, 10.0f);
}

TEST(CompactSources, ShowAsMuchOfARectangleAsIsOpen) {
  // A board before a panel hides two fifths of its width: of the ellipse within it would hide half.
  const auto below = [](bool board) {
    scene::Scene scene = panelAboveFloor(0.5f, 3.0f);
    scene.materials[0] = paint(0.5f);
    if (board) addBlock(&scene, 0, {-0.1f, -0.3f, 2.98f}, {0.2f, 0.6f, 0.005f});
    std::vector<Looked> points;
    for (int i = 0; i < 16; ++i)
      points.push_back({{0.1f * static_cast<float>(i % 4), 0.1f * static_cast<float>(i / 4), 0.0f},
                        kUp,
                        {0.6f, 0.0f, 0.8f}});
    const std::vector<double> values = pictured(baked(std::move(scene)), points);
    return std::accumulate(values.begin(), values.end(), 0.0);
  };
  EXPECT_NEAR(below(true) / below(false), 0.6, 0.05);  // told in sixteenths
}

TEST(CompactSources, AreNoneOfOtherShapesNorWhereThereAreMany) {
  scene::Scene angle = blackFloor();  // of an L
  addPatch(&angle, 1, {0.0f, 0.0f, 3.0f}, {0.0f, 0.1f, 0.0f}, {0.6f, 0.0f, 0.0f});
  addPatch(&angle, 1, {0.0f, 0.1f, 3.0f}, {0.0f, 0.6f, 0.0f}, {0.1f, 0.0f, 0.0f});
  // They touch at one corner, which is enough.
  EXPECT_EQ(compactIn(std::move(angle)).size(), 0u);
  EXPECT_EQ(compactIn(panelAboveFloor(3.0f, 3.0f)).size(), 0u);  // larger
  scene::Scene tube = ballAboveFloor(0.1f, 4.0f);
  for (Eigen::Vector3f& position : tube.meshes.back().positions) position.x() *= 6.0f;
  EXPECT_EQ(compactIn(std::move(tube)).size(), 0u);
  scene::Scene many = blackFloor();
  for (int i = 0; i < 100; ++i) {
    const auto x = static_cast<float>(i % 10), y = static_cast<float>(i / 10);
    addPatch(&many, 1, {x - 5.0f, y - 5.0f, 3.0f}, {0.0f, 0.1f, 0.0f}, {0.1f, 0.0f, 0.0f});
  }
  const std::size_t all = compactIn(many).size();
  EXPECT_EQ(all, 0u);
  // Beside a hundred faint ones a strong one counts.
  addPatch(&many, 1, {0.25f, 0.25f, 2.8f}, {0.0f, 1.0f, 0.0f}, {1.0f, 0.0f, 0.0f});
  EXPECT_EQ(compactIn(std::move(many)).size(), 1u);
}

TEST(CompactSources, CastShadowsWithSharpEdges) {
  const auto floor = [](bool plate) {
    scene::Scene scene = ballAboveFloor(0.02f, 2.0f);
    scene.materials[0] = paint(0.5f);
    if (plate) addBlock(&scene, 0, {-0.2f, -0.2f, 1.0f}, {0.4f, 0.4f, 0.01f});
    std::vector<Looked> points;
    for (const float x : {0.1f, 0.3f, 0.36f, 0.44f, 0.5f, 0.8f})
      points.push_back({{x, 0.05f, 0.0f}, kUp, {0.6f, 0.0f, 0.8f}});
    return pictured(baked(std::move(scene)), points);
  };
  const std::vector<double> open = floor(false), beside = floor(true);
  // The plate's edge is 0.2 m from the axis, half as high as the bulb: its shadow ends between 0.38 and 0.42
  // m. Into it the plate's underside and the floor pass a little.
  for (std::size_t i = 0; i < 3; ++i) EXPECT_LT(beside[i], 0.04 * open[i]) << i;
  for (std::size_t i = 3; i < 6; ++i) EXPECT_NEAR(beside[i] / open[i], 1.0, 0.04) << i;
}

/// One tile of 16 × 16 pixels, row by row.
Surfaces tileOf(const World& world, const std::vector<Looked>& points) {
  const Surfaces rows = onTriangles(world, points);
  Surfaces whole = rows;
  whole.width = whole.height = Surfaces::kTileSize;
  whole.tiles.resize(1);
  Tile& tile = whole.tiles[0];
  tile.height = Surfaces::kTileSize;
  tile.sky.assign(points.size(), 0);
  for (std::size_t row = 1; row < rows.tiles.size(); ++row) {
    const Tile& more = rows.tiles[row];
    for (Surface surface : more.surfaces) {
      surface.first_sample += static_cast<std::uint32_t>(tile.origin_x.size());
      tile.surfaces.push_back(surface);
    }
    tile.origin_x.insert(tile.origin_x.end(), more.origin_x.begin(), more.origin_x.end());
    tile.origin_y.insert(tile.origin_y.end(), more.origin_y.begin(), more.origin_y.end());
    tile.origin_z.insert(tile.origin_z.end(), more.origin_z.begin(), more.origin_z.end());
  }
  return whole;
}

TEST(CompactSources, CastSoftShadowsWithoutGrain) {
  scene::Scene scene = panelAboveFloor(0.6f, 3.0f);
  scene.materials[0] = paint(0.5f);
  addBlock(&scene, 0, {0.0f, -2.0f, 1.5f}, {2.0f, 4.0f, 0.01f});
  const World world = baked(std::move(scene));
  // Amid the penumbra of the board's edge, which is 0.6 m wide: 16 pixels of 1 cm.
  std::vector<Looked> points;
  for (int i = 0; i < 256; ++i)
    points.push_back({{0.01f * static_cast<float>(i % 16) - 0.08f, 0.01f * static_cast<float>(i / 16), 0.0f},
                      kUp,
                      {0.6f, 0.0f, 0.8f}});
  const Surfaces surfaces = tileOf(world, points);
  const image::LinearImage picture =
      pictureOf(surfaces, outlooksOf(surfaces, world), world, illumination(world, uniformDay(0.0f), kOn));
  const float most = picture.at(0, 8)[1];
  for (int y = 0; y < 16; ++y) {
    for (int x = 1; x + 1 < 16; ++x) {
      // It falls by a sixtieth of all a pixel; sixteenths of a pixel alone would differ by 6 %, or 12.
      const float bend = picture.at(x - 1, y)[1] - 2.0f * picture.at(x, y)[1] + picture.at(x + 1, y)[1];
      EXPECT_LT(std::abs(bend), 0.04f * most) << x << " " << y;
    }
  }
}

TEST(CompactSources, OfAPanelLightWhatIsBesideItAsThePolygonDoes) {
  // 1.2 × 0.4 m, below which lie patches that face it, walls beside it, and some whose plane cuts it.
  const CompactSource panel{Eigen::Vector3f::Zero(),
                            Eigen::Array3f::Constant(48.0f),
                            -Eigen::Vector3f::UnitZ(),
                            Eigen::Matrix3f::Identity(),
                            (Eigen::Matrix<float, 3, 2>() << 0.6f, 0.0f, 0.0f, 0.2f, 0.0f, 0.0f).finished(),
                            false,
                            0.4f,
                            0.64f,
                            0.0f};
  Tile tile;
  for (const float away : {0.15f, 0.3f, 0.6f, 1.5f, 4.0f, 9.0f}) {
    for (const Eigen::Vector3f& normal :
         {Eigen::Vector3f(0.0f, 0.0f, 1.0f), Eigen::Vector3f(-1.0f, 0.0f, 0.0f),
          Eigen::Vector3f(0.0f, 0.6f, 0.8f)})
      tile.surfaces.push_back(mattSurface({0.3f * away, 0.1f, -away}, normal));
  }
  const std::vector<double> reflected = reflectedBy(LampBeam(panel), tile);
  for (std::size_t i = 0; i < tile.surfaces.size(); ++i) {
    const Surface& surface = tile.surfaces[i];
    double expected = 0.0;
    constexpr int kParts = 120;
    for (int k = 0; k < kParts * kParts; ++k) {
      const Eigen::Vector3d at(0.6 * (2.0 * (k % kParts) + 1.0 - kParts) / kParts,
                               0.2 * (2.0 * (k / kParts) + 1.0 - kParts) / kParts, 0.0);
      const Eigen::Vector3d way = at - surface.position.cast<double>();
      const double cosines =
          std::max(way.z(), 0.0) * std::max(way.dot(surface.shading_normal.cast<double>()), 0.0);
      expected += 48.0 / (kParts * kParts) * cosines / (way.squaredNorm() * way.squaredNorm()) / kPi;
    }
    // Patches of 0.15 × 0.2 m are points from 0.15 m on.
    const double tolerance = -surface.position.z() < 0.5f ? 0.06 : 0.015;
    EXPECT_NEAR(reflected[i], expected, tolerance * expected)
        << surface.position.transpose() << ", " << surface.shading_normal.transpose();
  }
}

TEST(CompactSources, DoNotLightBodiesTwice) {
  scene::Scene scene = panelAboveFloor(0.5f, 4.0f);
  scene::Mesh plate;
  {
    scene::Scene of_plate;
    addPatch(&of_plate, 0, {-0.1f, -0.1f, 0.0f}, {0.2f, 0.0f, 0.0f}, {0.0f, 0.2f, 0.0f});
    plate = of_plate.meshes[0];
  }
  World world(std::make_shared<const scene::Scene>(scene), {{plate}});
  world.transport = Transport::bake(world.geometry, {});
  const auto placed = world.bodies->placed({Eigen::Isometry3d(Eigen::Translation3d(0.0, 0.0, 1.0))});
  const BodyLight body_light(world);
  const auto views = body_light.look(*placed, std::make_shared<Visibility>(world.visibility, placed));
  const Illumination light = illumination(world, uniformDay(0.0f), kOn);
  ASSERT_TRUE(light.compact_sources);
  // What pictures add straight to a body is not in what it has around it, which is the black floor.
  const double straight = 10000.0 * 0.25 / 9.0;
  EXPECT_LT(body_light.around(*views, light)[0].illuminance(kUp)[1], 0.1 * straight);
}

TEST(CompactSources, AreKeptAsTheyAre) {
  for (const CompactSource& source : compactIn(ballAboveFloor(0.15f, 4.0f)))
    EXPECT_EQ(kept(sourceOf(kept(source))), kept(source));
  for (const CompactSource& source : compactIn(panelAboveFloor(0.5f, 4.0f)))
    EXPECT_EQ(kept(sourceOf(kept(source))), kept(source));
}

}  // namespace
}  // namespace sunlit::light
