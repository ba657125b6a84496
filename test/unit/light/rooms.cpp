// Light in rooms, streets and tunnels, where the sun lights few places and these the rest, beside traced
// paths.
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <numeric>
#include <utility>

#include "baked_scene.h"
#include "light/patches/sky_patches.h"
#include "sunlit/quantity/angle.h"

namespace sunlit::light {
namespace {

const Eigen::Vector3f kUp = Eigen::Vector3f::UnitZ();

/// 6 m × 5 m × 3 m, with a hole of 1.2 m × 1.2 m in its ceiling.
scene::Scene roomWithAHole(float albedo) {
  scene::Scene scene;
  scene.materials = {paint(albedo)};
  const auto block = [&](const Eigen::Vector3f& low, const Eigen::Vector3f& high) {
    addBlock(&scene, 0, low, high - low);
  };
  block({-3.3f, -2.8f, -0.3f}, {3.3f, 2.8f, 0.0f});
  block({-3.3f, -2.8f, 0.0f}, {-3.0f, 2.8f, 3.0f});
  block({3.0f, -2.8f, 0.0f}, {3.3f, 2.8f, 3.0f});
  block({-3.0f, -2.8f, 0.0f}, {3.0f, -2.5f, 3.0f});
  block({-3.0f, 2.5f, 0.0f}, {3.0f, 2.8f, 3.0f});
  block({-3.3f, -2.8f, 3.0f}, {-0.6f, 2.8f, 3.1f});
  block({0.6f, -2.8f, 3.0f}, {3.3f, 2.8f, 3.1f});
  block({-0.6f, -2.8f, 3.0f}, {0.6f, -0.6f, 3.1f});
  block({-0.6f, 0.6f, 3.0f}, {0.6f, 2.8f, 3.1f});
  return scene;
}

std::vector<Looked> aroundTheRoom() {
  std::vector<Looked> places;
  for (const float x : {-2.4f, -1.6f, 1.6f, 2.4f}) {
    for (const float y : {-1.7f, 0.1f, 1.7f})
      places.push_back({{x, y, 3.0f}, -kUp, Eigen::Vector3f(0.2f, 0.3f, -0.9f)});
  }
  for (const float side : {-1.0f, 1.0f}) {
    for (const float z : {0.7f, 1.5f, 2.4f}) {
      const Eigen::Vector3f in_x(-side, 0.0f, 0.0f), in_y(0.0f, -side, 0.0f);
      places.push_back({{3.0f * side, 0.4f, z}, in_x, in_x + 0.2f * kUp});
      places.push_back({{0.5f, 2.5f * side, z}, in_y, in_y + 0.2f * kUp});
    }
  }
  return places;
}

/// Baked once for all that ask for it.
const World& greyRoom() {
  static const World world = baked(roomWithAHole(0.6f));
  return world;
}

TEST(Rooms, AreLitByThePatchOfTheSunFromWhereItLies) {
  const World& world = greyRoom();
  const std::vector<Looked> places = aroundTheRoom();
  // Amid a patch of the sky, between four of them, and such that its light falls on a wall.
  for (const auto& [azimuth_deg, elevation_deg] : {std::pair(180.0, 66.0), {225.0, 60.0}, {250.0, 45.0}}) {
    const sky::Daylight day = onlySun(azimuth_deg, elevation_deg);
    const Errors found = errors(fast(world, places, day), traced(world, places, day, 60000));
    // Measured 3.0 to 6.1 % and 7 to 18 % with the ray library's code for SSE, AVX, AVX2 and AVX-512, of
    // which 2.5 % is noise of the traced light; by four patches of the sky and 160 directions of each sample
    // 12 to 21 % and 32 to 55 %.
    EXPECT_LT(found.mean, 0.07) << azimuth_deg;
    EXPECT_LT(found.worst, 0.2) << azimuth_deg;
  }
}

TEST(Rooms, OfMattWallsThatMirrorNothingKeepTheirLight) {
  scene::Scene scene = roomWithAHole(0.8f);
  scene.materials[0].dielectric = LinearRgb(0.0f, 0.0f, 0.0f);
  scene.materials[0].dielectric_grazing = 0.0f;
  const World world = baked(std::move(scene));
  const std::vector<Looked> places = aroundTheRoom();
  const sky::Daylight day = uniformDay(1000.0f);
  const Errors found = errors(fast(world, places, day), traced(world, places, day, 20000, 64));
  // Measured 3.5 %; 11 % where they were taken for paint that mirrors 4 % at normal incidence.
  EXPECT_LT(std::abs(found.bias), 0.05);
}

TEST(Rooms, OfWhiteWallsKeepTheSunsLight) {
  const World world = baked(roomWithAHole(0.9f));
  const std::vector<Looked> places = aroundTheRoom();
  const sky::Daylight day = onlySun(200.0, 55.0);
  const Errors found = errors(fast(world, places, day), traced(world, places, day, 60000, 64));
  // Measured 3.7 and 7 %; 22 and 67 % by patches.
  EXPECT_LT(found.mean, 0.05);
  EXPECT_LT(found.worst, 0.1);
}

/// The same room, of white walls, with a floor of `roughness`.
scene::Scene roomWithAFloor(float roughness) {
  scene::Scene scene = roomWithAHole(0.7f);
  scene::Material floor = paint(0.15f);
  floor.roughness = roughness;
  scene.materials.push_back(floor);
  addPatch(&scene, 1, {-3.0f, -2.5f, 0.002f}, 6.0f * Eigen::Vector3f::UnitX(),
           5.0f * Eigen::Vector3f::UnitY());
  return scene;
}

const World& polishedRoom() {
  static const World world = baked(roomWithAFloor(0.1f));
  return world;
}

TEST(Rooms, PolishedFloorsThrowTheSunOnWalls) {
  const World& world = polishedRoom();
  // From the west: down through the hole to the floor at x = 1.73 m, up again to the east wall, 2.2 m high.
  const sky::Daylight day = onlySun(270.0, 60.0);
  const auto height = static_cast<float>(3.0 * std::tan(kPi / 3.0) - 3.0);
  const Eigen::Vector3f west = -Eigen::Vector3f::UnitX();
  const std::vector<Looked> places = {{{3.0f, 0.0f, height}, west, west},
                                      {{3.0f, 0.3f, height}, west, west},
                                      {{3.0f, 1.6f, height}, west, west}};
  const std::vector<double> seen = fast(world, places, day), truth = traced(world, places, day, 60000);
  // Fresnel at 30°: 0.04; the wall gets it at 60° to its normal. Of white paint, beside what the room passes
  // on.
  const double glint =
      (0.04 + 0.96 * std::pow(1.0 - std::cos(kPi / 6.0), 5.0)) * std::cos(kPi / 3.0) * 0.7 / kPi;
  EXPECT_NEAR(seen[0] - seen[2], glint, 0.1 * glint);
  for (std::size_t i = 0; i < places.size(); ++i) EXPECT_NEAR(seen[i], truth[i], 0.06 * truth[i]) << i;
}

TEST(Rooms, PolishedFloorsShowWallsThePatchOfTheSunOnOtherWalls) {
  const World& world = polishedRoom();
  // From the west through the hole to the east wall, 0.9 to 1.6 m high. The floor shows it to the west wall
  // at a glancing angle, where Fresnel's share is several times that of an even reflection.
  const Eigen::Vector3f east = Eigen::Vector3f::UnitX();
  std::vector<Looked> places;
  for (const float y : {-1.2f, -0.4f, 0.4f, 1.2f})
    for (const float z : {0.4f, 0.8f, 1.2f, 1.6f}) places.push_back({{-3.0f, y, z}, east, east});
  const std::vector<std::pair<double, double>> suns = {
      {264.0, 27.0}, {267.0, 30.0}, {270.0, 33.0}, {273.0, 27.0}, {276.0, 30.0}};
  double bias = 0.0;
  for (const auto& [azimuth_deg, elevation_deg] : suns) {
    const sky::Daylight day = onlySun(azimuth_deg, elevation_deg);
    bias += errors(fast(world, places, day), traced(world, places, day, 12000)).bias;
  }
  // A patch this small is met by a few rays of each sample, which one sun's light tells with 4 % of chance,
  // on a rough floor, too. Of 15 suns -2 %; -12 % where the floor shows nothing.
  EXPECT_LT(std::abs(bias) / static_cast<double>(suns.size()), 0.03);
}

TEST(Rooms, AreLitByTheSkyThatTheirOpeningsShow) {
  const World& world = greyRoom();
  const std::vector<Looked> places = aroundTheRoom();
  const sky::Daylight day = uniformDay(100.0f);
  const Errors found = errors(fast(world, places, day), traced(world, places, day, 30000));
  // Measured 4.5 and 13 %. By directions that are as coarse at the edges of the hole as elsewhere 12 and 25
  // %.
  EXPECT_LT(found.mean, 0.055);
  EXPECT_LT(found.worst, 0.16);
}

/// 6 m × 5.4 m × 2.75 m, closed, on ground that goes on below its walls: blocks, or sheets of no thickness.
struct SealedRoom {
  float wall_m = 0.0f;
  float turned_rad = 0.0f;
  float ground_x = 15.0f, ground_y = 15.0f;  ///< from its middle
  bool has_beam = false;                     ///< which sticks through a wall
};

scene::Scene sealedRoom(const SealedRoom& room) {
  scene::Scene scene;
  scene.materials = {paint(0.8f)};
  const Eigen::Vector3f across(std::cos(room.turned_rad), std::sin(room.turned_rad), 0.0f);
  const Eigen::Vector3f along(-across.y(), across.x(), 0.0f);
  const Eigen::Vector3f right = room.ground_x * across, ahead = room.ground_y * along;
  addPatch(&scene, 0, -right - ahead, 2.0f * right, 2.0f * ahead);
  const float x = 3.0f + room.wall_m, y = 2.7f + room.wall_m, height = 2.75f;
  const auto block = [&](const Eigen::Vector3f& low, const Eigen::Vector3f& high) {
    const Eigen::Vector3f size = high - low;
    if (size.minCoeff() > 0.0f) return addBlock(&scene, 0, low, size);
    Eigen::Index flat = 0;
    size.minCoeff(&flat);
    Eigen::Index u = (flat + 1) % 3, v = (flat + 2) % 3;
    if (low[flat] > 0.0f) std::swap(u, v);  // its front is inside
    addPatch(&scene, 0, low, size[u] * Eigen::Vector3f::Unit(u), size[v] * Eigen::Vector3f::Unit(v));
  };
  block({-x, 2.7f, 0.0f}, {x, y, height});
  block({-x, -y, 0.0f}, {x, -2.7f, height});
  block({3.0f, -2.7f, 0.0f}, {x, 2.7f, height});
  block({-x, -2.7f, 0.0f}, {-3.0f, 2.7f, height});
  block({-x, -y, height}, {x, y, height + room.wall_m});
  if (room.has_beam) block({0.95f, 2.4f, 1.5f}, {1.05f, 3.0f, 1.6f});
  return scene;
}

/// The brightest place on floor and walls, of a place outdoors.
double brightestInside(const SealedRoom& room) {
  const World world = baked(sealedRoom(room));
  std::vector<Looked> places;
  for (const float x : {-2.98f, -2.8f, -1.5f, 0.1f, 1.4f, 2.7f, 2.98f})
    for (const float y : {-2.68f, -2.5f, -1.2f, 0.2f, 1.3f, 2.4f, 2.68f})
      places.push_back({{x, y, 0.0f}, kUp, kUp});
  for (const float z : {0.02f, 0.3f, 1.5f, 2.7f})
    places.push_back({{1.1f, 2.7f, z}, -Eigen::Vector3f::UnitY(), -Eigen::Vector3f::UnitY()});
  const sky::Daylight day = uniformDay(100.0f);
  const std::vector<double> seen = fast(world, places, day);
  // A single place that is taken for one before the walls is enough to light all of the room.
  return *std::max_element(seen.begin(), seen.end()) /
         fast(world, {{{-5.0f, 0.5f, 0.0f}, kUp, kUp}}, day).front();
}

TEST(Rooms, ThatAreClosedAreDarkThoughTheirFloorGoesOnOutside) {
  for (const float turned_rad : {0.0f, 0.3f}) {
    for (const float wall_m : {0.12f, 0.2f, 0.22f, 0.3f, 0.4f})
      EXPECT_LT(brightestInside({wall_m, turned_rad}), 1e-4) << wall_m << " turned by " << turned_rad;
  }
}

TEST(Rooms, ThatAreClosedAreDarkThoughTheirWallsAreThinnerThanCells) {
  // Turned by 0.7, the room's corners stick out of the edges of cells.
  for (const float turned_rad : {0.0f, 0.3f, 0.7f}) {
    // By cells that are not cut: 0.05 to 0.9. Measured 2e-4 at most.
    for (const float wall_m : {0.0f, 0.01f, 0.05f})
      EXPECT_LT(brightestInside({wall_m, turned_rad}), 1e-3) << wall_m << " turned by " << turned_rad;
  }
  // The third halving of the ground's edges is below the walls.
  for (const float wall_m : {0.0f, 0.05f})
    EXPECT_LT(brightestInside({wall_m, 0.0f, 6.0f, 5.4f}), 1e-4) << wall_m;
}

TEST(Rooms, ThatAreClosedAreDarkThoughABeamSticksThroughAWall) {
  // Where light is interpolated along the beam: 0.02, and as much as of a lamp in such a room.
  EXPECT_LT(brightestInside({0.0f, 0.0f, 15.0f, 15.0f, true}), 1e-3);
}

/// 6 m × 5 m × 2.5 m, with a window of 2 m × 1.2 m to the south, on grey ground.
scene::Scene roomWithAWindow() {
  scene::Scene scene;
  scene.materials = {paint(0.8f), paint(0.35f)};
  const auto block = [&](int material, const Eigen::Vector3f& low, const Eigen::Vector3f& high) {
    addBlock(&scene, material, low, high - low);
  };
  block(1, {-20.0f, -20.0f, -0.1f}, {20.0f, 20.0f, 0.0f});
  block(1, {-3.0f, -2.5f, 0.0f}, {3.0f, 2.5f, 0.1f});
  block(0, {-3.0f, -2.5f, 2.6f}, {3.0f, 2.5f, 2.7f});
  block(0, {-3.0f, 2.4f, 0.1f}, {3.0f, 2.5f, 2.6f});
  block(0, {2.9f, -2.5f, 0.1f}, {3.0f, 2.5f, 2.6f});
  block(0, {-3.0f, -2.5f, 0.1f}, {-2.9f, 2.5f, 2.6f});
  block(0, {-3.0f, -2.5f, 0.1f}, {-1.0f, -2.4f, 2.6f});
  block(0, {1.0f, -2.5f, 0.1f}, {3.0f, -2.4f, 2.6f});
  block(0, {-1.0f, -2.5f, 0.1f}, {1.0f, -2.4f, 0.9f});
  block(0, {-1.0f, -2.5f, 2.1f}, {1.0f, -2.4f, 2.6f});
  return scene;
}

/// Baked once for all that ask for it.
const World& windowedRoom() {
  static const World world = baked(roomWithAWindow());
  return world;
}

/// Right below its ceiling, of which the nearest part takes half of what is seen there: on the north wall,
/// then on the west and the east one, `count` on each, so far from one another.
std::vector<Looked> topsOfWalls(int count, float step_m) {
  std::vector<Looked> places;
  for (const auto& [x, y] : {std::pair(0.0f, 1.0f), {-1.0f, 0.0f}, {1.0f, 0.0f}}) {
    const Eigen::Vector3f in(-x, -y, 0.0f);
    for (int i = 0; i < count; ++i) {
      const float along = step_m * (static_cast<float>(i) - 0.5f * static_cast<float>(count - 1));
      const Eigen::Vector3f place(2.9f * x + along * y, 2.4f * y + along * x, 2.58f);
      places.push_back({place, in, in + 0.2f * kUp});
    }
  }
  return places;
}

TEST(Rooms, AreLitAlikeAlongTheirCorners) {
  const std::vector<Looked> places = topsOfWalls(11, 0.375f);
  const auto found = [&](const sky::Daylight& day) {
    const Errors errors_then =
        errors(fast(windowedRoom(), places, day), traced(windowedRoom(), places, day, 20000));
    EXPECT_LT(errors_then.worst, 0.1);
    return errors_then.mean;
  };
  const std::vector<std::pair<double, double>> suns = {
      {140.0, 45.0}, {150.0, 50.0}, {160.0, 55.0}, {200.0, 50.0}, {215.0, 40.0}};
  double by_suns = 0.0;
  for (const auto& [azimuth_deg, elevation_deg] : suns)
    by_suns += found(onlySun(azimuth_deg, elevation_deg)) / static_cast<double>(suns.size());
  // One sun's patch on the floor is met by chance: 1.8 to 3.7 %, of which 0.4 % is noise of the traced light.
  // Measured 2.5 % in the mean over these, 2.2 to 2.4 % by the sky; 5.4 % by one of them and 3.9 % where some
  // of these samples knew what they see and others did not.
  EXPECT_LT(by_suns, 0.033);
  EXPECT_LT(found(uniformDay(100.0f)), 0.035);
}

TEST(Rooms, SeeTheGroundThroughWindowsByAsManyRaysAsTheSky) {
  constexpr std::size_t kOfWall = 21;
  const std::vector<Looked> places = topsOfWalls(kOfWall, 0.2f);
  double uneven = 0.0;
  std::size_t count = 0;
  for (const sky::Daylight& day : {onlySun(150.0, 50.0), uniformDay(100.0f)}) {
    const std::vector<double> light = fast(windowedRoom(), places, day);
    for (std::size_t i = 1; i + 1 < light.size(); ++i) {
      if (i % kOfWall == 0 || i % kOfWall == kOfWall - 1) continue;
      uneven += std::abs(2.0 * light[i] / (light[i - 1] + light[i + 1]) - 1.0);
      ++count;
    }
  }
  // Measured 0.8 %; 1.8 % where only edges of the sky were looked at closely, 3 % with corners by chance.
  EXPECT_LT(uneven / static_cast<double>(count), 0.012);
}

/// 4 m × 4 m × 3 m, white; its south side is a pane before a black world, that goes so far into the walls.
scene::Scene roomWithAPane(float into_m) {
  scene::Scene scene;
  scene::Material pane = paint(1.0f);
  pane.glass = 1.0f;
  pane.roughness = scene::Material::kSmoothest;
  scene.materials = {paint(0.8f), pane};
  addBlock(&scene, 0, {-2.3f, -2.0f, -0.3f}, {4.6f, 4.3f, 0.3f});
  addBlock(&scene, 0, {-2.3f, -2.0f, 3.0f}, {4.6f, 4.3f, 0.3f});
  addBlock(&scene, 0, {-2.3f, -2.0f, 0.0f}, {0.3f, 4.3f, 3.0f});
  addBlock(&scene, 0, {2.0f, -2.0f, 0.0f}, {0.3f, 4.3f, 3.0f});
  addBlock(&scene, 0, {-2.0f, 2.0f, 0.0f}, {4.0f, 0.3f, 3.0f});
  addPatch(&scene, 1, {-2.0f - into_m, -1.99f, 0.0f}, (4.0f + 2.0f * into_m) * Eigen::Vector3f::UnitX(),
           3.0f * kUp);
  return scene;
}

TEST(Rooms, GetBackWhatTheirPanesMirror) {
  std::vector<Looked> places;
  for (const float x : {-1.5f, -0.5f, 0.5f, 1.5f}) {
    for (const float y : {-1.5f, 0.0f, 1.5f}) places.push_back({{x, y, 3.0f}, -kUp, {0.2f, 0.3f, -0.9f}});
    places.push_back({{x, 2.0f, 2.0f}, -Eigen::Vector3f::UnitY(), {0.1f, -0.9f, 0.1f}});
  }
  const sky::Daylight day = onlySun(180.0, 50.0);
  // Which rays of the bake a pane stops is up to a hash of where they meet it: each of these is another draw.
  Errors of_all;
  for (const float into_m : {0.0f, 1e-4f, 2e-4f, 3e-4f}) {
    const World world = baked(roomWithAPane(into_m));
    const Errors found = errors(fast(world, places, day), traced(world, places, day, 30000));
    of_all.bias += 0.25 * found.bias;
    of_all.mean += 0.25 * found.mean;
  }
  // Of nine panes -2.0 to -5.9 % (mean -3.8, standard deviation 1.3) and 2.7 to 5.9 %.
  EXPECT_LT(std::abs(of_all.bias), 0.05);
  EXPECT_LT(of_all.mean, 0.055);
}

TEST(Rooms, GetNoLightOfTheFacadeFromPanesThatAreSeenFromOutsideAlone) {
  const std::vector<Looked> ceiling = {{{0.5f, 1.5f, 3.0f}, -kUp, {0.2f, 0.3f, -0.9f}},
                                       {{-1.5f, 0.0f, 3.0f}, -kUp, {0.2f, 0.3f, -0.9f}}};
  std::array<std::vector<double>, 2> found;
  for (const bool both : {false, true}) {
    scene::Scene scene = roomWithAPane(0.0f);
    scene.materials[1].double_sided = both;
    found[both ? 1 : 0] = fast(baked(std::move(scene)), ceiling, onlySun(180.0, 50.0));
  }
  EXPECT_EQ(found[0], found[1]);
}

TEST(Rooms, StreetsAreLitByTheSideThatTheSunShinesOn) {
  // 12 m wide, between walls of 20 m.
  scene::Scene scene;
  scene.materials = {paint(0.3f)};
  addBlock(&scene, 0, {-60.0f, -60.0f, -1.0f}, {120.0f, 120.0f, 1.0f});
  addBlock(&scene, 0, {-16.0f, -50.0f, 0.0f}, {10.0f, 100.0f, 20.0f});
  addBlock(&scene, 0, {6.0f, -50.0f, 0.0f}, {10.0f, 100.0f, 20.0f});
  const World world = baked(std::move(scene));
  std::vector<Looked> shaded;
  for (const float y : {-3.0f, 4.0f}) {
    for (const float x : {-5.0f, -2.0f, 2.0f, 5.0f})
      shaded.push_back({{x, y, 0.0f}, kUp, {0.1f, 0.5f, 0.8f}});
    for (const float z : {1.0f, 3.0f, 6.0f})
      shaded.push_back({{6.0f, y, z}, -Eigen::Vector3f::UnitX(), {-0.8f, 0.5f, 0.1f}});
  }
  // From the east, over the roof of that side: it meets the upper part of the other wall alone. Measured 6.7
  // %; 7.6 by patches alone. At the foot of that wall it is 27 % too much, elsewhere 3 % too little to 3 %
  // too much: the floor is no room, and the sky's patches about the sun light more of the wall than it does.
  const sky::Daylight day = onlySun(90.0, 48.0);
  EXPECT_LT(errors(fast(world, shaded, day), traced(world, shaded, day, 60000)).mean, 0.072);
}

/// A pit, 10 m deep and so wide, of black walls; what is second in `scene` lies on its floor.
void addPit(float width_m, scene::Scene* scene) {
  const float half = 0.5f * width_m, outside = half + 1.0f;
  for (const float side : {-1.0f, 1.0f}) {
    const float low = side > 0.0f ? half : -outside;
    addBlock(scene, 0, {low, -outside, 0.0f}, {1.0f, 2.0f * outside, 10.0f});
    addBlock(scene, 0, {-half, low, 0.0f}, {width_m, 1.0f, 10.0f});
  }
  addBlock(scene, 1, {-outside, -outside, -1.0f}, {2.0f * outside, 2.0f * outside, 1.0f});
}

/// Luminance of the floor's middle.
double floorOfPit(scene::Scene scene, float width_m) {
  const World world = baked(std::move(scene));
  std::vector<Looked> places;
  for (const float x : {-0.25f, 0.0f, 0.25f}) {
    for (const float y : {-0.25f, 0.0f, 0.25f})
      places.push_back({{x * width_m, y * width_m, 0.0f}, kUp, {0.3f, 0.0f, 1.0f}, 1});
  }
  const std::vector<double> values = fast(world, places, uniformDay(100.0f));
  return std::accumulate(values.begin(), values.end(), 0.0) / 9.0;
}

/// How much darker a pit's floor is under what addCover(&scene) puts on top.
template <typename AddCover>
double darkenedBy(const scene::Material& cover, float width_m, const AddCover& addCover) {
  scene::Scene scene;
  scene.materials = {paint(0.0f), paint(0.5f), cover};
  addPit(width_m, &scene);
  const double open = floorOfPit(scene, width_m);
  addCover(&scene);
  return floorOfPit(std::move(scene), width_m) / open;
}

TEST(Rooms, AreDarkenedByAPaneByTheAngleAtWhichLightMeetsIt) {
  // The floor sees the sky within 16° of the zenith alone.
  scene::Material glass = paint(1.0f);
  glass.glass = 1.0f;
  glass.roughness = 0.0f;
  const double share = darkenedBy(glass, 4.0f, [](scene::Scene* scene) {
    addPatch(scene, 2, {-2.0f, -2.0f, 9.9f}, 4.0f * Eigen::Vector3f::UnitX(),
             4.0f * Eigen::Vector3f::UnitY());
  });
  // A square of 4 m, 10 m up (of black walls, but for grazing rays), and two faces of 4 % that let (1 − 0.04)
  // / (1 + 0.04) through, less by 0.1 % at 16°; by the mean over a half sphere it were 0.84.
  EXPECT_NEAR(share, 0.96 / 1.04, 0.005);
}

TEST(Rooms, AreDarkenedByWhatBlendsByItsAlpha) {
  scene::Material black = paint(0.0f);
  black.dielectric = LinearRgb(0.0f, 0.0f, 0.0f);
  black.dielectric_grazing = 0.0f;
  black.alpha_mode = scene::AlphaMode::kBlend;
  black.alpha = 0.5f;
  // From the floor the pane is not much larger than what one ray in eight stands for, and is not to be taken
  // for a lid where that one is stopped.
  for (const float width_m : {0.8f, 4.0f}) {
    const double share = darkenedBy(black, width_m, [width_m](scene::Scene* scene) {
      addBlock(scene, 2, {-0.5f * width_m, -0.5f * width_m, 9.5f}, {width_m, width_m, 0.01f});
    });
    // Two sheets. Rays are the same with it and without.
    EXPECT_NEAR(share, 0.25, 0.003) << width_m;
  }
}

TEST(Rooms, SeeHolesThatAreSmallerThanWhatARayStandsFor) {
  // In a lid over a pit 4 m wide, 0.25 m wide, one a square metre: from 9.9 m below a tenth of what a ray in
  // eight stands for.
  constexpr float kWidth_m = 4.0f, kHole_m = 0.25f, kUp_m = 9.9f;
  const double share = darkenedBy(paint(0.0f), kWidth_m, [=](scene::Scene* scene) {
    const float bar_m = 1.0f - kHole_m;
    const Eigen::Vector3f x = Eigen::Vector3f::UnitX(), y = Eigen::Vector3f::UnitY();
    for (int i = 0; i < 4; ++i) {
      const float at = static_cast<float>(i) - 2.0f;
      addPatch(scene, 2, {at, -2.0f, kUp_m}, bar_m * x, 4.0f * y);
      for (int j = 0; j < 4; ++j)
        addPatch(scene, 2, {at + bar_m, static_cast<float>(j) - 2.0f, kUp_m}, kHole_m * x, bar_m * y);
    }
  });
  // Even light: as the area is, about, for holes lie as far from the middle as what is covered.
  // Measured 22 % less: of some holes no looker nearby has found any, of those that were found each takes
  // what it sees. Of each looker by its own rays alone 75 %.
  EXPECT_NEAR(share, kHole_m * kHole_m, 0.3 * kHole_m * kHole_m);
}

TEST(Rooms, BehindMoreCornersThanBouncesAreTracedAreNotBlack) {
  // A passage of 2 × 2 m that turns four times, in squares; its first one is open to the west.
  const std::vector<std::pair<int, int>> squares = {{0, 0}, {1, 0}, {1, 1}, {1, 2}, {2, 2},
                                                    {3, 2}, {3, 3}, {3, 4}, {4, 4}, {5, 4}};
  const auto isFree = [&](int x, int y) {
    return std::find(squares.begin(), squares.end(), std::make_pair(x, y)) != squares.end();
  };
  constexpr float kSide = 2.0f, kWall = 0.2f;
  scene::Scene scene;
  scene.materials = {paint(0.8f)};
  for (const auto& [x, y] : squares) {
    const Eigen::Vector3f low(kSide * static_cast<float>(x), kSide * static_cast<float>(y), 0.0f);
    addBlock(&scene, 0, low - kWall * kUp, {kSide, kSide, kWall});
    addBlock(&scene, 0, low + kSide * kUp, {kSide, kSide, kWall});
    if (!isFree(x - 1, y) && x > 0) addBlock(&scene, 0, low, {kWall, kSide, kSide});
    if (!isFree(x + 1, y))
      addBlock(&scene, 0, low + Eigen::Vector3f(kSide - kWall, 0, 0), {kWall, kSide, kSide});
    if (!isFree(x, y - 1)) addBlock(&scene, 0, low, {kSide, kWall, kSide});
    if (!isFree(x, y + 1))
      addBlock(&scene, 0, low + Eigen::Vector3f(0, kSide - kWall, 0), {kSide, kWall, kSide});
  }
  const World world = baked(scene);
  const sky::Daylight day = uniformDay(10000.0f);
  std::vector<Looked> last;
  for (const float x : {10.3f, 10.7f, 11.1f, 11.5f})
    for (const float y : {8.6f, 9.4f}) last.push_back({{x, y, 0.0f}, kUp, {0.1f, 0.2f, 1.0f}});
  const std::vector<double> seen = fast(world, last, day), truth = traced(world, last, day, 65000);
  const auto sum = [](const std::vector<double>& of) { return std::accumulate(of.begin(), of.end(), 0.0); };
  // Some 14 % too much a corner, of 1/20,000 of what the sky gives outside; the reference's noise is 7 %.
  EXPECT_GT(*std::min_element(seen.begin(), seen.end()), 0.0);
  EXPECT_GT(sum(seen), 0.4 * sum(truth));
  EXPECT_LT(sum(seen), 2.5 * sum(truth));
}

TEST(Rooms, HaveTheSameBitsOnAnyNumberOfThreads) {
  std::vector<std::vector<double>> results;
  for (const std::size_t threads : {std::size_t{1}, std::size_t{3}}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    const World world = baked(roomWithAHole(0.6f));
    results.push_back(fast(world, aroundTheRoom(), onlySun(200.0, 55.0)));
  }
  EXPECT_EQ(results[0], results[1]);
}

TEST(SkyPatches, HoldTheirRays) {
  const SkyPatches patches(5);
  for (const SkyPatches::Ray& ray : patches.rays()) EXPECT_EQ(SkyPatches::patchAt(ray.towards), ray.patch);
}

}  // namespace
}  // namespace sunlit::light
