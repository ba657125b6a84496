// How far light is followed from surface to surface: between two walls made by hand, alone and beside much
// else.
#include "light/bake/gather/exchange.h"

#include <gtest/gtest.h>

#include "light/bake/gather/discs_in_rooms.h"
#include "paper_scene.h"
#include "sunlit/quantity/random.h"

namespace sunlit::light {
namespace {

constexpr std::uint32_t kWall = 256;  // samples of each of two walls that see nothing but each other

/// The first of the walls looks east, the second, whose samples follow, west. `others` see nothing.
SceneSamples twoWalls(std::size_t others) {
  SceneSamples samples;
  samples.receivers.resize(2 * kWall + others);
  for (std::uint32_t i = 0; i < samples.receivers.size(); ++i)
    samples.receivers[i].normal = (i / kWall == 1 ? -1.0f : 1.0f) * Eigen::Vector3f::UnitX();
  samples.other_side.resize(samples.receivers.size());
  samples.paints.resize(samples.receivers.size());
  for (Paint& paint : samples.paints) {
    paint.albedo.setConstant(0.9f);
    paint.roughness = 1.0f;
    paint.dielectric.setConstant(0.04f);
    paint.dielectric_grazing = 1.0f;
  }
  return samples;
}

/// What samples of the walls see: each all over the one across.
struct Walls {
  explicit Walls(std::size_t others) : samples(twoWalls(others)), exchange(samples, patches, rooms) {
    for (std::uint32_t i = 0; i < 2 * kWall; ++i) {
      SampleHits& seen = exchange.seen[i];
      // Rays that leave a wall backwards count nothing.
      for (int k = 0; k < SkyPatches::kCoarse; ++k) {
        const bool up = k < SkyPatches::kAbove;
        seen.hits.push_back(SampleAndByte::of((i + kWall) % (2 * kWall),
                                              static_cast<std::uint32_t>(up ? k : k - SkyPatches::kAbove)));
      }
      seen.up = SkyPatches::kAbove;
      seen.scale_up = seen.scale_down = 1.0f;
    }
  }
  /// Of `light`, lx, on samples from `begin` to `end`.
  Exchange::FirstBounce firstBounce(std::uint32_t begin, std::uint32_t end,
                                    const Eigen::Array3f& light) const {
    StraightLight lamps(samples.receivers.size());
    for (std::uint32_t i = begin; i < end; ++i) lamps.direct[i] = light;
    const std::vector<Arrived> nothing(samples.receivers.size());
    return {exchange.receivedOf(exchange.sentOf(lamps, nothing), nothing), Exchange::kAllBounces};
  }

  SceneSamples samples;
  SkyPatches patches{1};
  BakedRooms rooms;
  Exchange exchange;
};

/// Of the first wall, on which 1 lx falls.
float passedOnBetween(std::size_t others) {
  const Walls walls(others);
  const auto has = walls.exchange.passedOn({walls.firstBounce(0, kWall, Eigen::Array3f::Ones())});
  return has[0][0].above[1] + has[0][0].below[1];
}

TEST(Exchange, FollowsLightBetweenTwoWallsWhateverElseThereIs) {
  const float alone = passedOnBetween(0);
  EXPECT_GT(alone, 2.0f);  // ρ² / (1 − ρ²), ρ up to 0.9
  // A land that they are 1 % of: by the mean over all samples a tenth and more were missing.
  EXPECT_NEAR(passedOnBetween(50000), alone, 1e-4f * alone);
}

TEST(Exchange, FollowsSourcesTogetherAsEachAlone) {
  Walls walls(3000);
  walls.exchange.tints.resize(walls.samples.receivers.size());
  for (std::uint32_t i = 0; i < 2 * kWall; ++i)  // some see the other wall through green glass
    walls.exchange.tints[i].assign(walls.exchange.seen[i].hits.size(),
                                   i % 3 == 0 ? PackedTint({0.3f, 0.8f, 0.6f}) : PackedTint());
  std::vector<Exchange::FirstBounce> sources;
  for (std::uint32_t k = 0; k < 6; ++k) {
    const auto strength = static_cast<float>(k);  // the first is dark
    sources.push_back(walls.firstBounce(10 * k, 10 * k + 200, strength * Eigen::Array3f(1.0f, 0.1f, 3.0f)));
  }
  sources[2].most = 1;
  sources[3].most = 4;
  const std::vector<std::vector<Arrived>> together = walls.exchange.passedOn(sources);
  ASSERT_EQ(together.size(), sources.size());
  for (std::size_t k = 0; k < sources.size(); ++k) {
    const std::vector<Arrived> alone = walls.exchange.passedOn({sources[k]}).front();
    for (std::size_t i = 0; i < alone.size(); ++i) {
      EXPECT_TRUE((alone[i].above == together[k][i].above).all()) << k << " " << i;
      EXPECT_TRUE((alone[i].below == together[k][i].below).all()) << k << " " << i;
    }
  }
  const std::uint32_t lit = 50, across = lit + kWall;
  EXPECT_TRUE((together[0][across].all() == 0.0f).all());
  EXPECT_TRUE((together[1][lit].all() > 0.0f).all());
  EXPECT_TRUE((together[2][lit].all() == 0.0f).all());
  EXPECT_TRUE((together[2][across].all() > 0.0f).all());
  EXPECT_TRUE((together[5][across].all() > together[3][across].all()).all());
}

/// The same walls as rooms whose light is told by coefficients: the second is lit from everywhere.
void addRoomsOfTwoWalls(std::uint32_t others, TransportData* data) {
  const std::uint32_t count = 2 * kWall + others;
  for (Coefficients* part : {&data->direct, &data->above.coefficients, &data->below.coefficients})
    part->resize(count);
  for (PassedOn* part : {&data->above, &data->below}) part->tints.assign(count, {1.0f, 1.0f, 1.0f});
  std::array<float, SkyPatches::kCount> even;
  even.fill(1.0f);
  for (std::uint32_t i = kWall; i < 2 * kWall; ++i) data->direct.set(i, even.data());
  BakedRooms& rooms = data->rooms;
  for (std::uint32_t i = 0; i < count; ++i) {
    rooms.samples.push_back(i);
    rooms.first.push_back(static_cast<std::uint32_t>(rooms.links.size()));
    if (i < 2 * kWall) {
      rooms.links.push_back(BakedRooms::Link::of((i + kWall) % (2 * kWall), 1));
      rooms.sources.push_back({i, LightMesh::kNone, {0.8f, 0.8f, 0.8f}, {0.8f, 0.8f, 0.8f}, {}, {}, 0, 0, 0});
    }
    rooms.below.push_back(static_cast<std::uint32_t>(rooms.links.size()));
    rooms.scales.push_back(1.0f);
  }
  rooms.first.push_back(static_cast<std::uint32_t>(rooms.links.size()));
  rooms.mirrored.resize(count);
}

World groundWorld() {
  scene::Scene scene;
  scene.materials = {paint(0.5f)};
  addGround(&scene, 0, 10.0f);
  return worldOf(std::move(scene));
}

/// Light of the first wall by the sun, which shines on the second.
float ofTheSunBetween(std::uint32_t others) {
  const sky::Daylight day = onlySun(180.0, 45.0);
  TransportData data;
  addRoomsOfTwoWalls(others, &data);
  const World world = groundWorld();
  return discsInRooms(data, day, *world.visibility, DiscsThroughCloud(data, nullptr, day)).at(0).above[1];
}

TEST(DiscsInRooms, FollowTheSunBetweenTwoWallsWhateverElseThereIs) {
  const float alone = ofTheSunBetween(0);
  // By the mean over all rooms more than half were missing.
  EXPECT_NEAR(ofTheSunBetween(100000), alone, 1e-5f * alone);
}

TEST(DiscsInRooms, SeeAsMuchOfSmallPatchesOfTheSunAsThereIs) {
  // Of each of many sources of 1 m² a hundredth lies in the sun: points at random, one place behind a gap.
  constexpr std::uint32_t kSources = 4000, kPoints = 144;
  constexpr float kGap_m = 0.01f;
  TransportData data;
  const std::uint32_t count = kSources + 1;
  for (Coefficients* part : {&data.direct, &data.above.coefficients, &data.below.coefficients})
    part->resize(count);
  for (PassedOn* part : {&data.above, &data.below}) part->tints.assign(count, {1.0f, 1.0f, 1.0f});
  BakedRooms& rooms = data.rooms;
  rooms.samples.push_back(kSources);
  rooms.first.push_back(0);
  for (std::uint32_t s = 0; s < kSources; ++s) {
    rooms.links.push_back(BakedRooms::Link::of(s, 1));
    rooms.sources.push_back(
        {s, LightMesh::kNone, {1.0f, 1.0f, 1.0f}, {}, {}, {0.0f, 0.0f, 1.0f}, s * kPoints, kPoints, 32});
    for (std::uint32_t k = 0; k < kPoints; ++k) {
      const std::uint64_t key = std::uint64_t{s} << 32 | k;
      rooms.points.push_back({uniform(key, 0), uniform(key, 1), 0.0f, 1.0f / kPoints});
    }
  }
  rooms.first.push_back(kSources);
  rooms.below.push_back(kSources);
  rooms.scales.push_back(1.0f);
  rooms.mirrored.resize(1);
  scene::Scene scene;
  scene.materials = {paint(0.5f)};
  addBlock(&scene, 0, {kGap_m, -1.0f, 1.0f}, {3.0f, 3.0f, 0.1f});
  addBlock(&scene, 0, {-3.0f, -1.0f, 1.0f}, {3.0f, 3.0f, 0.1f});
  const World world = worldOf(std::move(scene));
  const sky::Daylight day = onlySun(180.0, 90.0);
  const float all =
      discsInRooms(data, day, *world.visibility, DiscsThroughCloud(data, nullptr, day)).at(0).above[1];
  // 44 % with nothing of those that no probe has met. By chance 3 %, one standard deviation.
  EXPECT_NEAR(all / kSources, kGap_m, 0.12f * kGap_m);
}

TEST(DiscsInRooms, LeaveOutWhatPicturesLeaveOut) {
  TransportData data;
  addRoomsOfTwoWalls(0, &data);
  const World world = groundWorld();
  for (const float sky_cd : {100.0f, 1000.0f}) {  // 314 and 3142 lx on the ground, beside a sun of 1 lx
    sky::UniformSky sky;
    sky.luminance = LinearRgb(sky_cd, sky_cd, sky_cd);
    sky.sun = onlySun(180.0, 45.0).sun();
    const sky::Daylight day = sky::uniformDaylight(sky);
    const DiscsThroughCloud through(data, nullptr, day);
    EXPECT_EQ(discsInRooms(data, day, *world.visibility, through).empty(), sky_cd > 500.0f);
  }
}

}  // namespace
}  // namespace sunlit::light
