// Points among leaves find the same light as rays from each of them do.
#include "light/bake/samples/crown_shadows.h"

#include <gtest/gtest.h>

#include <memory>
#include <random>
#include <utility>
#include <vector>

#include "paper_scene.h"

namespace sunlit::light {
namespace {

constexpr int kLeaf = 0, kBoard = 1;
constexpr float kClear_m = 1e-3f;

/// Leaves of a chequered texture at random in a ball of 3 m over ground, a trunk among them, and a wall
/// and another tree's leaf beyond.
scene::Scene tree(std::mt19937* random, std::vector<CrownShadows::Point>* points) {
  const auto between = [&](float low, float high) {
    return low + (high - low) * static_cast<float>((*random)() >> 8) / 16777216.0f;
  };
  const auto way = [&] {
    return Eigen::Vector3f(between(-1, 1), between(-1, 1), between(-1, 1)).normalized();
  };
  scene::Texture chequers;
  chequers.name = "chequers";
  chequers.width = chequers.height = 8;
  for (int i = 0; i < 64; ++i)
    chequers.rgba.own().insert(chequers.rgba.own().end(),
                               {255, 255, 255, static_cast<std::uint8_t>((i / 8 + i) % 2 == 0 ? 255 : 0)});
  scene::Scene scene = leafSceneOf(chequers);
  addGround(&scene, kBoard, 200.0f);
  addBlock(&scene, kBoard, {-0.1f, -0.1f, 0.0f}, {0.2f, 0.2f, 4.0f});
  addPatch(&scene, kBoard, {8.0f, -20.0f, 0.0f}, {0.0f, 40.0f, 0.0f}, {0.0f, 0.0f, 9.0f});
  addPatch(&scene, kLeaf, {-7.0f, -2.0f, 1.0f}, {0.0f, 4.0f, 0.0f}, {0.0f, 0.0f, 5.0f});
  for (int i = 0; i < 60; ++i) {
    const Eigen::Vector3f middle = Eigen::Vector3f(0.0f, 0.0f, 4.0f) + between(0.0f, 1.5f) * way();
    const Eigen::Vector3f a = way(), b = a.cross(way()).normalized();
    addPatch(&scene, kLeaf, middle - 0.6f * (a + b), 1.2f * a, 1.2f * b);
    for (int k = 0; k < 10; ++k)
      points->push_back(
          {middle + between(-0.6f, 0.6f) * a + between(-0.6f, 0.6f) * b, a.cross(b).normalized()});
  }
  return scene;
}

struct Woods {
  std::mt19937 random{7};
  std::vector<CrownShadows::Point> points;
  std::shared_ptr<const Geometry> geometry;
  Cutouts cutouts;
  Visibility visibility;

  Woods()
      : geometry(
            std::make_shared<const Geometry>(std::make_shared<const scene::Scene>(tree(&random, &points)))),
        cutouts(*geometry),
        visibility(geometry) {}

  /// By a ray from each point.
  std::vector<std::uint8_t> openByRays(const Eigen::Vector3f& towards) const {
    std::vector<std::uint8_t> open;
    for (const CrownShadows::Point& point : points) {
      const float side = point.normal.dot(towards) > 0.0f ? kClear_m : -kClear_m;
      const Eigen::Vector3f from = point.position + side * point.normal;
      std::uint8_t blocked = 2;
      visibility.occluded({&from.x(), &from.y(), &from.z(), &towards.x(), &towards.y(), &towards.z(), 1},
                          &blocked);
      open.push_back(blocked == 0 ? 1 : 0);
    }
    return open;
  }
};

const std::vector<Eigen::Vector3f>& directions() {
  static const std::vector<Eigen::Vector3f> all = {
      Eigen::Vector3f(0.0f, 0.0f, 1.0f),
      Eigen::Vector3f(1.0f, 0.0f, 0.03f).normalized(),
      Eigen::Vector3f(-1.0f, 0.0f, 0.2f).normalized(),
      Eigen::Vector3f(0.0f, 1.0f, 0.0f),
      Eigen::Vector3f(0.3f, -0.7f, 0.5f).normalized(),
      Eigen::Vector3f(-0.2f, -0.3f, 0.9f).normalized(),
      Eigen::Vector3f(0.8f, 0.5f, 0.3f).normalized(),
  };
  return all;
}

TEST(CrownShadows, FindsWhatRaysFromEachPointFind) {
  const Woods woods;
  // Cells so small, 1/512 of the tree, that few hold two points: what stands beyond is looked up for each.
  CrownShadows crown({*woods.geometry, woods.cutouts, woods.visibility}, woods.points, 0.004f);
  std::size_t open = 0, differ = 0, all = 0;
  for (const Eigen::Vector3f& towards : directions()) {
    const std::vector<std::uint8_t> by_rays = woods.openByRays(towards);
    const std::vector<std::uint8_t>& found = crown.open(towards);
    for (std::size_t i = 0; i < by_rays.size(); ++i, ++all) {
      open += by_rays[i];
      differ += found[i] != by_rays[i];
    }
  }
  EXPECT_GT(open, all / 10);
  EXPECT_LT(open, all / 2);
  // A point that lies in the shade of an edge, to within a few millionths of a metre, may fall either way.
  EXPECT_LE(differ, all / 1000);
}

TEST(CrownShadows, SharesWhatStandsBeyondWithinACell) {
  const Woods woods;
  CrownShadows crown({*woods.geometry, woods.cutouts, woods.visibility}, woods.points, 0.5f);
  for (const Eigen::Vector3f& towards : directions()) {
    const std::vector<std::uint8_t> by_rays = woods.openByRays(towards);
    const std::vector<std::uint8_t>& found = crown.open(towards);
    std::size_t open = 0, open_by_rays = 0, differ = 0;
    for (std::size_t i = 0; i < by_rays.size(); ++i) {
      open += found[i];
      open_by_rays += by_rays[i];
      differ += found[i] != by_rays[i];
    }
    if (towards.x() < -0.9f) {
      // Towards the leaf beyond, whose chequers are as large as cells: of one point it tells little, but as
      // many are open, to within twice the chance of 60 cells.
      EXPECT_GT(differ, 0u);
      EXPECT_NEAR(static_cast<double>(open), static_cast<double>(open_by_rays), 0.26 * open_by_rays);
    } else {
      // The wall beyond is large: it hides from all points or none. The rest as above.
      EXPECT_LE(differ, 1u) << towards.transpose();
    }
  }
}

TEST(CrownShadows, OfNoPointsIsAskedNothing) {
  const Woods woods;
  CrownShadows crown({*woods.geometry, woods.cutouts, woods.visibility}, {}, 0.5f);
  EXPECT_TRUE(crown.open(directions()[0]).empty());
}

}  // namespace
}  // namespace sunlit::light
