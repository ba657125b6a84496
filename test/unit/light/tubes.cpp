// Tubes that shine light straight in pictures, as lines.
#include "light/lamps/tube.h"

#include <gtest/gtest.h>

#include "light/bake/samples/compact_sources.h"
#include "night_scene.h"
#include "shining_scene.h"

namespace sunlit::light {
namespace {

constexpr float kThin_m = 0.02f, kLength_m = 1.2f;

/// Without ends, of 16 sides that shine outwards, along the x axis `height` above a black floor.
scene::Scene tubeAboveFloor(float height, float thin_m = kThin_m) {
  constexpr int kAround = 16;
  scene::Scene scene = panelAboveFloor(0.1f, height);
  scene.meshes.pop_back();
  scene::Mesh tube;
  tube.material = 1;
  for (int i = 0; i <= kAround; ++i) {
    const auto turn = static_cast<float>(2.0 * kPi * (i % kAround) / kAround);
    const Eigen::Vector3f out(0.0f, std::cos(turn), std::sin(turn));
    for (const float x : {-0.5f * kLength_m, 0.5f * kLength_m}) {
      tube.positions.push_back(Eigen::Vector3f(x, 0.0f, height) + thin_m * out);
      tube.normals.push_back(out);
    }
  }
  tube.texture_coordinates.assign(tube.positions.size(), Eigen::Vector2f::Zero());
  for (std::uint32_t i = 0; i < 2 * kAround; i += 2) {
    tube.triangles.push_back({i, i + 3, i + 1});
    tube.triangles.push_back({i, i + 2, i + 3});
  }
  scene.meshes.push_back(tube);
  return scene;
}

std::vector<CompactSource> sourcesIn(scene::Scene scene) {
  const World world = baked(std::move(scene));
  const auto& found = world.transport->compactSources();
  return found ? *found : std::vector<CompactSource>();
}

/// A plane at `place` by what lies before it of a line of 1 cd a metre along the x axis, lx.
double byLine(const Eigen::Vector3d& place, const Eigen::Vector3d& normal) {
  constexpr int kParts = 20000;
  double sum = 0.0;
  for (int i = 0; i < kParts; ++i) {
    const double x = static_cast<double>(kLength_m) * ((i + 0.5) / kParts - 0.5);
    const Eigen::Vector3d way = Eigen::Vector3d(x, 0.0, 0.0) - place;
    const double sine = std::hypot(way.y(), way.z()) / way.norm();
    sum += sine * std::max(way.dot(normal), 0.0) / std::pow(way.norm(), 3.0);
  }
  return sum * static_cast<double>(kLength_m) / kParts;
}

TEST(Tubes, AngleIsWithinItsBound) {
  for (double x = -20.0; x < 20.0; x += 0.01)
    EXPECT_NEAR(arcTangent(static_cast<float>(x)), std::atan(x), 3e-7) << x;
}

TEST(Tubes, AreFoundWithTheLightThatTheyShow) {
  const std::vector<CompactSource> found = sourcesIn(tubeAboveFloor(3.0f));
  ASSERT_EQ(found.size(), 1u);
  const CompactSource& tube = found[0];
  EXPECT_TRUE(tube.normal.isZero());
  EXPECT_LT((tube.half.col(0).cwiseAbs() - Eigen::Vector3f(0.5f * kLength_m, 0.0f, 0.0f)).norm(), 1e-4f);
  EXPECT_NEAR(tube.uneven_m, kThin_m, 1e-4f);
  // Of 16 sides it shows between 0.981 and 1 of what a round one shows.
  const float shows = 10000.0f * 2.0f * kThin_m * kLength_m;
  EXPECT_NEAR(tube.intensity[1], 0.99f * shows, 0.015f * shows);
  EXPECT_EQ(kept(sourceOf(kept(tube))), kept(tube));
  // One whose ends shine, too, by 1 / (π · 4) of its sides.
  scene::Scene capped = tubeAboveFloor(3.0f, 0.05f);
  scene::Mesh& mesh = capped.meshes.back();
  for (const std::uint32_t end : {0u, 1u}) {
    const auto corner = [&](std::uint32_t i) { return 2 * i + end; };
    for (std::uint32_t i = 1; i + 1 < 16; ++i)
      mesh.triangles.push_back({corner(0), corner(end == 0 ? i + 1 : i), corner(end == 0 ? i : i + 1)});
  }
  EXPECT_EQ(sourcesIn(std::move(capped)).size(), 1u);
  // One that is not long shows as an ellipsoid does.
  const std::vector<CompactSource> thick = sourcesIn(tubeAboveFloor(3.0f, 0.2f));
  ASSERT_EQ(thick.size(), 1u);
  EXPECT_TRUE(thick[0].half.isZero());
}

TEST(Tubes, LightWhatIsBesideThemAsALineDoes) {
  const CompactSource tube{Eigen::Vector3f::Zero(),
                           Eigen::Array3f::Constant(kLength_m),
                           Eigen::Vector3f::Zero(),
                           Eigen::Matrix3f::Identity(),
                           (Eigen::Matrix<float, 3, 2>() << 0.6f, 0.0f, 0.0f, 0.0f, 0.0f, 0.0f).finished(),
                           false,
                           0.1f,
                           0.6f,
                           kThin_m};
  Tile tile;
  for (const float away : {0.03f, 0.1f, 0.4f, 1.5f, 4.0f, 9.0f, 15.0f})
    for (const float along : {0.0f, 0.5f, 0.9f})
      for (const Eigen::Vector3f& normal :
           {Eigen::Vector3f(0.0f, 0.0f, 1.0f), Eigen::Vector3f(-1.0f, 0.0f, 0.0f),
            Eigen::Vector3f(1.0f, 0.0f, 0.0f), Eigen::Vector3f(0.6f, 0.0f, 0.8f)})
        tile.surfaces.push_back(mattSurface({along, 0.0f, -away}, normal));
  const LampBeam beam(tube);
  const std::vector<double> reflected = reflectedBy(beam, tile);
  for (std::size_t i = 0; i < tile.surfaces.size(); ++i) {
    const Surface& surface = tile.surfaces[i];
    const double expected =
        byLine(surface.position.cast<double>(), surface.shading_normal.cast<double>()) / kPi;
    EXPECT_NEAR(reflected[i], expected, 0.002 * expected + 1e-6)
        << surface.position.transpose() << ", " << surface.shading_normal.transpose();
    // A plane that faces the light, whatever lies behind it.
    const Eigen::Vector3d place = surface.position.cast<double>();
    Eigen::Vector3d light = Eigen::Vector3d::Zero();
    for (int axis = 0; axis < 3; ++axis)
      light[axis] = byLine(place, Eigen::Vector3d::Unit(axis)) - byLine(place, -Eigen::Vector3d::Unit(axis));
    EXPECT_NEAR(beam.at(surface.position)[1], light.norm(), 0.001 * light.norm());
    const LampBeam::Bounds bounds = beam.within({surface.position, surface.position});
    EXPECT_LE(bounds.low, beam.at(surface.position)[1]);
    EXPECT_GE(bounds.high, beam.at(surface.position)[1]);
  }
}

TEST(Tubes, CastSharpShadowsAcrossAndSoftOnesAlong) {
  const auto floor = [](bool plate) {
    scene::Scene scene = tubeAboveFloor(2.0f);
    scene.materials[0] = paint(0.5f);
    if (plate) addBlock(&scene, 0, {-0.2f, -0.2f, 1.0f}, {0.4f, 0.4f, 0.01f});
    std::vector<Looked> points;
    const Eigen::Vector3f to_eye(0.6f, 0.0f, 0.8f);
    for (const float y : {0.1f, 0.36f, 0.44f, 0.8f}) points.push_back({{0.02f, y, 0.0f}, kUp, to_eye});
    for (const float x : {0.1f, 0.4f, 0.7f, 1.3f}) points.push_back({{x, 0.02f, 0.0f}, kUp, to_eye});
    return pictured(baked(std::move(scene)), points);
  };
  const std::vector<double> open = floor(false), beside = floor(true);
  // The plate's edge is 0.2 m from below the tube, half as high: across the tube its shadow ends between 0.36
  // and 0.44 m, 4 cm wide on either side of 0.4 m; along it there is none but some light from the ends.
  const auto share = [&](std::size_t i) { return beside[i] / open[i]; };
  EXPECT_LT(share(0), 0.6);
  EXPECT_GT(share(0), 0.2);  // of 1.2 m the plate hides 0.8 m
  EXPECT_NEAR(share(1), share(0), 0.1);
  for (std::size_t i : {2u, 3u}) EXPECT_NEAR(share(i), 1.0, 0.04) << i;
  for (std::size_t i = 5; i < 8; ++i) EXPECT_GT(share(i), share(i - 1) + 0.05) << i;
  EXPECT_NEAR(share(7), 1.0, 0.04);
}

}  // namespace
}  // namespace sunlit::light
