// Which points of a scene nobody sees, by what the rays that leave them meet.
#include "light/bake/samples/burial_test.h"

#include <gtest/gtest.h>

#include "paper_scene.h"

namespace sunlit::light {
namespace {

const Eigen::Vector3f kUp = Eigen::Vector3f::UnitZ(), kAside = Eigen::Vector3f::UnitX();

/// Rays of a point on a wall that meet sheets or nothing.
class Outlook {
 public:
  Outlook() {
    scene::Scene scene;
    scene.materials = {paint(0.5f)};
    addGround(&scene, 0, 1.0f);
    geometry_ = worldOf(std::move(scene)).geometry;
    traits_.assign(geometry_->triangles.size(), TriangleTraits());
  }
  Outlook& nothingAbove(float share) { return add(share, kUp, HitPacket::kNothing, 0.0f); }
  Outlook& nothingBelow(float share) { return add(share, -kUp, HitPacket::kNothing, 0.0f); }
  Outlook& front(float share, float distance_m) { return add(share, -kUp, 0, distance_m); }
  Outlook& back(float share, float distance_m) { return add(share, kUp, 0, distance_m); }
  Outlook& backOfBody(float share, float distance_m) {
    traits_[0].solid = true;
    add(share, kUp, 0, distance_m);
    traits_[0].solid = false;
    return *this;
  }
  Outlook& of(const Eigen::Vector3f& normal) {
    normal_ = normal;
    return *this;
  }
  bool buried() const { return test_.buried(); }

 private:
  Outlook& add(float share, const Eigen::Vector3f& towards, std::uint32_t triangle, float distance_m) {
    HitPacket hits;
    hits.triangle[0] = triangle;
    hits.distance[0] = distance_m;
    test_.add({normal_, towards, share, hits, 0}, *geometry_, traits_);
    return *this;
  }
  std::shared_ptr<const Geometry> geometry_;
  std::vector<TriangleTraits> traits_;
  Eigen::Vector3f normal_ = kAside;
  BurialTest test_;
};

TEST(Burial, OfWhatStandsInTheOpen) {
  EXPECT_FALSE(Outlook().nothingAbove(0.5f).front(0.5f, 3.0f).buried());
  EXPECT_FALSE(Outlook().nothingAbove(0.5f).nothingBelow(0.5f).buried());  // a bridge without land
  EXPECT_FALSE(Outlook().front(1.0f, 3.0f).buried());                      // a room
  // A room of sheets that are turned the wrong way round.
  EXPECT_FALSE(Outlook().back(1.0f, 3.0f).buried());
  // The corner of a floor between two walls.
  EXPECT_FALSE(Outlook().nothingAbove(0.25f).front(0.75f, 0.05f).buried());
}

TEST(Burial, UnderASheetOfGroundThatHasAHole) {
  // Measured where a bridge's wall goes on below a bank: the void below, which is bright, and a little sky.
  EXPECT_TRUE(
      Outlook().nothingAbove(0.05f).nothingBelow(0.37f).front(0.01f, 2.0f).back(0.57f, 1.0f).buried());
  // A beam under a roof of a single sheet, on the edge of the world, has more sky before it.
  EXPECT_FALSE(Outlook().nothingAbove(0.2f).nothingBelow(0.25f).back(0.55f, 1.0f).buried());
}

TEST(Burial, RightUnderTheEdgeOfASheetOfGround) {
  // Measured at the foot of a wall that a bank ends at, a few millimetres below it: sky beyond the bank, too.
  EXPECT_TRUE(
      Outlook().nothingAbove(0.22f).nothingBelow(0.5f).back(0.19f, 0.02f).front(0.09f, 3.0f).buried());
  // A wall on the edge of the world under the eaves of a single sheet, which are farther away.
  EXPECT_FALSE(
      Outlook().nothingAbove(0.22f).nothingBelow(0.5f).back(0.19f, 0.5f).front(0.09f, 3.0f).buried());
}

TEST(Burial, BehindAWallOfASingleSheet) {
  // Measured at the ends of beams that go through the wall of a tunnel: they see a bank behind it.
  EXPECT_TRUE(Outlook().back(0.71f, 0.3f).back(0.06f, 4.0f).front(0.23f, 4.0f).buried());
  // A wall of sheets that are turned the wrong way round, beside its neighbour and a road.
  EXPECT_FALSE(Outlook().back(0.71f, 3.0f).front(0.29f, 4.0f).buried());
  // Under a roof on posts, at its rim.
  EXPECT_FALSE(Outlook().back(0.71f, 0.3f).nothingAbove(0.1f).front(0.19f, 4.0f).buried());
}

TEST(Burial, WithinTheSlabOfABridge) {
  // Measured at the upper end of a beam: much of the bridge is of single sheets.
  EXPECT_TRUE(Outlook()
                  .backOfBody(0.25f, 3.0f)
                  .back(0.56f, 6.0f)
                  .nothingAbove(0.03f)
                  .nothingBelow(0.02f)
                  .front(0.14f, 9.0f)
                  .buried());
}

TEST(Burial, HalfWithinABody) {
  EXPECT_TRUE(Outlook().backOfBody(0.38f, 2.0f).back(0.59f, 2.0f).front(0.03f, 2.0f).buried());
}

TEST(Burial, UnderASheetThatLiesOnAnother) {
  // Grass a few centimetres under a pavement's edge: covered by what is parallel to it.
  EXPECT_TRUE(Outlook().of(kUp).nothingAbove(0.03f).front(0.74f, 0.07f).front(0.23f, 2.0f).buried());
  // The foot of a wall: as close, but at right angles.
  EXPECT_FALSE(Outlook().of(kAside).nothingAbove(0.03f).front(0.74f, 0.07f).front(0.23f, 2.0f).buried());
}

}  // namespace
}  // namespace sunlit::light
