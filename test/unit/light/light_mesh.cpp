// Which samples the nodes of a mesh, and rays that meet them, are left with where others are of no use.
#include <gtest/gtest.h>

#include <numeric>

#include "light/bake/gather/exchange.h"
#include "light/bake/samples/light_place.h"
#include "light/bake/samples/transport_data.h"

namespace sunlit::light {
namespace {

using Expected = std::vector<std::uint32_t>;

bool nowhere(std::uint32_t, std::uint32_t) {
  return false;
}

/// A strip of triangles: nodes n, n + 1 and n + 2 are the corners of cell n. Node n has the sample n alone.
LightMesh strip(std::uint32_t nodes) {
  LightMesh mesh;
  for (std::uint32_t n = 0; n + 2 < nodes; ++n) mesh.cells.push_back({{n, n + 1, n + 2}});
  for (std::uint32_t n = 0; n < nodes; ++n) {
    mesh.first_share.push_back(n);
    mesh.shares.push_back({n, 1.0f});
  }
  mesh.first_share.push_back(nodes);
  return mesh;
}

TEST(LightPlace, OfASideThatCannotBeSeenIsThatOfTheOther) {
  LightMesh mesh = strip(3);
  mesh.roots.own() = {{0, LightMesh::kNone}, {LightMesh::kSealed, 0}, {LightMesh::kNone, LightMesh::kNone}};
  const auto weights = [&](std::uint32_t triangle, bool front) {
    const LightPlace place = lightPlace(mesh, {triangle, front}, {0.5f, 0.25f, 0.25f});
    return place.known() ? place.weight[0] : -1.0f;
  };
  EXPECT_EQ(weights(0, false), 0.5f);
  EXPECT_EQ(weights(1, true), 0.0f);  // dark
  EXPECT_EQ(weights(2, true), -1.0f);
}

TEST(LightMesh, ANodeWithoutUsefulSamplesHasThatOfTheNearest) {
  LightMesh mesh = strip(5);
  const std::vector<bool> useless = {false, false, true, true, true};
  // Node 2 is in a cell with 0 and 1, node 3 with 1 alone, node 4 with 2 and 3, which had none either.
  EXPECT_EQ(mesh.usefulSamples(useless, nowhere), (Expected{0, 1, 0, 1, 0}));
  mesh.drop(useless, mesh.usefulSamples(useless, nowhere));
  EXPECT_EQ(mesh.shares[3].sample, 1u);
  EXPECT_EQ(mesh.shares[3].weight, 1.0f);
  EXPECT_EQ(mesh.shares[0].sample, 0u);
}

TEST(LightMesh, FarFromUsefulSamplesNodesKeepTheirOwn) {
  LightMesh mesh = strip(11);
  std::vector<bool> useless(11, true);
  useless[0] = false;
  // Four rings of cells reach nodes 1 and 2, 3 and 4, 5 and 6, 7 and 8.
  EXPECT_EQ(mesh.usefulSamples(useless, nowhere)[8], 0u);
  EXPECT_EQ(mesh.usefulSamples(useless, nowhere)[9], LightMesh::kNone);
  mesh.drop(useless, mesh.usefulSamples(useless, nowhere));
  EXPECT_EQ(mesh.shares[8].sample, 0u);
  EXPECT_EQ(mesh.shares[9].sample, 9u);
}

TEST(LightMesh, ANodeHasTheSampleOfAFartherOneRatherThanThatBehindAWall) {
  const LightMesh mesh = strip(6);
  const std::vector<bool> useless = {false, true, true, true, true, false};
  // Cells about node 3 lead to 5 at once, and to 0 in two steps.
  EXPECT_EQ(mesh.usefulSamples(useless, nowhere)[3], 5u);
  const auto parted = [](std::uint32_t sample, std::uint32_t other) { return sample == 3 && other == 5; };
  EXPECT_EQ(mesh.usefulSamples(useless, parted)[3], 0u);
  // Better than none.
  EXPECT_EQ(mesh.usefulSamples(useless, [](std::uint32_t, std::uint32_t) { return true; })[3], 5u);
}

TEST(LightMesh, OfSeveralSamplesTheUsefulOnesShareAllTheWeight) {
  LightMesh mesh = strip(3);
  mesh.first_share.own() = {0, 3, 4, 5};
  mesh.shares.own() = {{0, 0.5f}, {1, 0.2f}, {2, 0.3f}, {1, 1.0f}, {2, 1.0f}};
  const std::vector<bool> useless = {true, false, false};
  EXPECT_EQ(mesh.usefulSamples(useless, nowhere)[0], 2u);
  mesh.drop(useless, mesh.usefulSamples(useless, nowhere));
  EXPECT_EQ(mesh.shares[0].weight, 0.0f);
  EXPECT_FLOAT_EQ(mesh.shares[1].weight, 0.4f);
  EXPECT_FLOAT_EQ(mesh.shares[2].weight, 0.6f);
}

TEST(Exchange, RaysThatMeetUselessSamplesMeetThoseBeside) {
  SceneSamples samples;
  samples.mesh = strip(11);
  samples.receivers.resize(11);
  samples.paints.resize(11);
  samples.other_side.resize(11);
  samples.nearest_sample.resize(11);
  std::iota(samples.nearest_sample.begin(), samples.nearest_sample.end(), 0u);
  const SkyPatches patches(1);
  const BakedRooms none;
  Exchange exchange(samples, patches, none);
  exchange.seen[0].hits = {SampleAndByte::of(1, 7), SampleAndByte::of(4, 7), SampleAndByte::of(10, 9)};
  exchange.seen[0].up = 3;
  // 4 is amid others; the cells around 10 and those beside them hold none that is of use.
  exchange.passOver({false, false, true, true, true, true, true, true, true, true, true}, nowhere);
  EXPECT_EQ(exchange.ray(0, 0).from, 1u);
  EXPECT_EQ(exchange.ray(0, 1).from, 0u);
  EXPECT_EQ(exchange.ray(0, 1).direction, 7u);
  EXPECT_EQ(exchange.ray(0, 2).from, 10u);
}

}  // namespace
}  // namespace sunlit::light
