#include "scene/race_track/buildings.h"

#include <cmath>

#include "scene/race_track/facade.h"
#include "scene/race_track/ground.h"
#include "scene/race_track/layout.h"
#include "scene/race_track/poster.h"
#include "scene/race_track/shapes.h"
#include "sunlit/quantity/angle.h"

namespace sunlit::scene::race_track {
namespace {

struct House {
  Frame frame;  // x along its front, which looks to −y; on the ground
  float width;
  float depth;
  float height;
  int floors;
  WallKind kind;
  Color wall;
  std::uint32_t seed;
};

/// Light out of a window, `frame` at the middle of its glass: as of an even, matt sheet, by the cosine.
void addWindowLight(Assembly& assembly, const Frame& frame, const Opening& window,
                    const LinearRgb& intensity) {
  if (!(intensity.luminance() > 0.0f)) return;
  // What a wall that faces the window loses of its light by the range R, anywhere: at most I d² / R⁴ ≤ I /
  // R². 0.2 lx are still seen by a night without moon, where nothing but windows shines.
  constexpr float kLost_lx = 0.05f;
  Lamp lamp;
  lamp.name = "window";
  lamp.group = kWindowLamps;
  lamp.radius_m = std::sqrt(window.width * window.height / kPiFloat);
  lamp.position = frame * Point(0.0f, -0.05f, 0.0f);
  lamp.direction = -frame.linear().col(1);
  lamp.intensity = intensity;
  lamp.inner_rad = 0.0f;
  lamp.outer_rad = 0.5f * kPiFloat;
  lamp.exponent = 1.0f;
  lamp.range_m = std::sqrt(intensity.luminance() / kLost_lx);
  assembly.addLamp(std::move(lamp));
}

// One wall, `frame` at the middle of its foot, looking to −y, with its sills and frames in relief.
void addWall(Assembly& assembly, const Frame& frame, const FacadePlan& plan) {
  const std::vector<Opening> openings = planOpenings(plan);
  const Canvas lit = paintLitWindows(plan, openings);
  const Picture picture = assembly.addFacade(paintFacade(plan, openings), lit);
  const float x = 0.5f * plan.width_m;
  addQuad(assembly, {picture.material, Color::Ones()},
          {frame * Point(-x, 0, 0), frame * Point(x, 0, 0), frame * Point(x, 0, plan.height_m),
           frame * Point(-x, 0, plan.height_m)},
          picture.rect);
  const Paint trim{assembly.palette().concrete, {0.42f, 0.40f, 0.37f}};
  const Paint wood{assembly.palette().matte, {0.50f, 0.48f, 0.44f}};
  for (const Opening& o : openings) {
    const float middle = o.x + 0.5f * o.width - x;
    if (o.door) {
      addBox(assembly, trim, shifted(frame, {middle, -0.3f, -0.1f}), {1.5f, 0.6f, 0.16f});
      addBox(assembly, wood, shifted(frame, {middle, -0.35f, 2.25f}), {1.5f, 0.7f, 0.07f});
      continue;
    }
    addBox(assembly, trim, shifted(frame, {middle, -0.07f, o.z - 0.1f}), {o.width + 0.24f, 0.14f, 0.07f});
    addBox(assembly, wood, shifted(frame, {middle, -0.03f, o.z + o.height}), {o.width + 0.12f, 0.06f, 0.08f});
    for (const float side : {-0.5f, 0.5f})
      addBox(assembly, wood, shifted(frame, {middle + side * (o.width + 0.06f), -0.03f, o.z}),
             {0.06f, 0.06f, o.height});
    addWindowLight(assembly, shifted(frame, {middle, 0.0f, o.z + 0.5f * o.height}), o,
                   windowIntensity(lit, o));
  }
}

Canvas paintTiles(const Color& tile, std::uint32_t seed) {
  Random random(641u, seed);
  Canvas canvas(224, 112, tile);
  for (int row = 0; row < 20; ++row) {
    for (int k = -1; k < 29; ++k) {
      const float x = 8.0f * k + (row % 2) * 4.0f;
      const float y = 5.6f * row;
      canvas.rectangle({x, y}, {x + 8.0f, y + 5.6f}, {tile * random.range(0.6f, 1.25f), 1.0f});
      canvas.rectangle({x, y + 4.4f}, {x + 8.0f, y + 5.6f}, {0.35f * tile, 0.8f});
      canvas.rectangle({x, y}, {x + 1.2f, y + 5.6f}, {0.5f * tile, 0.7f});
    }
  }
  for (int i = 0; i < 14; ++i) {
    const float width = random.range(3, 16);
    const float height = random.range(2, 9);
    const float x = random.range(0, 224);
    const float y = random.range(0, 112);
    canvas.ellipse({x, y}, {width, height}, 0.0f, {{0.10f, 0.12f, 0.05f}, 0.4f});
  }
  canvas.mottle(40.0f, 0.2f, random.bits());
  return canvas;
}

void addGableRoof(Assembly& assembly, const House& house, Random& random) {
  const Color tiles[] = {
      {0.26f, 0.085f, 0.045f}, {0.085f, 0.085f, 0.09f}, {0.20f, 0.12f, 0.07f}, {0.15f, 0.16f, 0.15f}};
  const float shade = random.range(0.8f, 1.2f);
  const Color tile = tiles[random.below(4)] * shade;
  const float x = 0.5f * house.width + 0.35f;
  const float y = 0.5f * house.depth + 0.45f;
  const float rise = house.depth * random.range(0.30f, 0.48f);
  const float low = house.height - 0.45f * rise / (0.5f * house.depth);
  const Frame& f = house.frame;
  const float ridge = house.height + rise;
  const Picture front = assembly.addPicture(paintTiles(tile, random.bits()));
  const Picture back = assembly.addPicture(paintTiles(tile, random.bits()));
  addQuad(assembly, {front.material, Color::Ones()},
          {f * Point(-x, -y, low), f * Point(x, -y, low), f * Point(x, 0, ridge), f * Point(-x, 0, ridge)},
          front.rect);
  addQuad(assembly, {back.material, Color::Ones()},
          {f * Point(x, y, low), f * Point(-x, y, low), f * Point(-x, 0, ridge), f * Point(x, 0, ridge)},
          back.rect);
  const float wx = 0.5f * house.width;
  const float wy = 0.5f * house.depth;
  const Paint gable{assembly.palette().plaster, house.wall * 0.9f};
  addTriangle(
      assembly, gable,
      {f * Point(wx, -wy, house.height), f * Point(wx, wy, house.height), f * Point(wx, 0, ridge - 0.05f)});
  addTriangle(assembly, gable,
              {f * Point(-wx, wy, house.height), f * Point(-wx, -wy, house.height),
               f * Point(-wx, 0, ridge - 0.05f)});
  const Paint gutter{assembly.palette().metal, {0.22f, 0.22f, 0.21f}};
  for (const float side : {-y, y})
    addBar(assembly, gutter, {f * Point(-x, side, low), 0.06f}, {f * Point(x, side, low), 0.06f});
  const Paint brick{assembly.palette().roof, {0.22f, 0.09f, 0.06f}};
  const Point stack(random.range(-0.6f, 0.6f) * wx, 0.4f * wy, house.height + 0.4f * rise);
  addBox(assembly, brick, shifted(f, stack), {0.6f, 0.5f, 0.6f * rise + 0.8f});
}

void addHouse(Assembly& assembly, const House& house) {
  Random random(house.seed);
  const float w = house.width;
  const float d = house.depth;
  const Frame turned[] = {shifted(house.frame, {0, -0.5f * d, 0}), shifted(house.frame, {0.5f * w, 0, 0}),
                          shifted(house.frame, {0, 0.5f * d, 0}), shifted(house.frame, {-0.5f * w, 0, 0})};
  for (int k = 0; k < 4; ++k) {
    Frame wall = turned[k];
    wall.rotate(Eigen::AngleAxisf(0.5f * kPiFloat * static_cast<float>(k), Point::UnitZ()));
    addWall(assembly, wall,
            {k % 2 == 0 ? w : d, house.height, house.floors, house.kind, house.wall, k == 0,
             house.seed + static_cast<std::uint32_t>(k)});
  }
  addBox(assembly, {assembly.palette().concrete, {0.25f, 0.24f, 0.22f}}, shifted(house.frame, {0, 0, -1.2f}),
         {w + 0.12f, d + 0.12f, 1.4f});
  addGableRoof(assembly, house, random);
}

// Looks at the track from `place`, level, a step above the ground there.
Frame facingTrackFrame(const TrackPlace& place, float twist) {
  const Eigen::Vector2d t = course().tangent(place.along);
  const float along = std::atan2(static_cast<float>(t.y()), static_cast<float>(t.x()));
  return standing(groundPoint(place) + Point(0, 0, 0.15f),
                  along + (place.left > 0.0 ? 0.0f : kPiFloat) + twist);
}

void addHouseAt(Assembly& assembly, const Plot& plot, std::uint32_t seed_index) {
  Random random(681u, seed_index);
  const Color walls[] = {{0.52f, 0.48f, 0.38f}, {0.55f, 0.54f, 0.50f}, {0.28f, 0.10f, 0.065f},
                         {0.46f, 0.30f, 0.14f}, {0.20f, 0.26f, 0.30f}, {0.35f, 0.38f, 0.25f},
                         {0.50f, 0.33f, 0.26f}};
  const bool barn = plot.kind == Plot::Kind::kBarn;
  House house;
  house.frame = facingTrackFrame(plot.place, barn ? 0.1f : 0.35f * random.bell());
  house.width = barn ? 15.0f : random.range(8.0f, 11.5f);
  house.depth = barn ? 9.0f : random.range(6.5f, 8.5f);
  house.floors = barn ? 1 : 1 + random.below(2);
  house.height = barn ? 4.6f : 2.9f * static_cast<float>(house.floors) + 0.3f;
  // So that neighbours differ.
  const int kind = static_cast<int>(seed_index * 37u % 100u);
  house.kind = barn        ? WallKind::kTimber
               : kind < 50 ? WallKind::kPlaster
               : kind < 80 ? WallKind::kBrick
                           : WallKind::kTimber;
  house.wall = barn                             ? Color(0.22f, 0.055f, 0.04f)
               : house.kind == WallKind::kBrick ? Color(0.27f, 0.11f, 0.07f)
                                                : walls[seed_index % 7u];
  house.wall *= random.range(0.85f, 1.1f);
  house.seed = random.bits();
  addHouse(assembly, house);
}

// The ground in front of the pits, cast in slabs.
void addApron(Assembly& assembly, const Frame& frame, float width, float depth) {
  for (int i = 0; i < 12; ++i) {
    Random random(652u, static_cast<std::uint32_t>(i));
    const float slab = width / 12.0f;
    addBox(assembly, {assembly.palette().concrete, Color(0.27f, 0.26f, 0.245f) * random.range(0.75f, 1.15f)},
           shifted(frame, {(static_cast<float>(i) - 5.5f) * slab, -0.5f * depth - 4.4f, -0.9f}),
           {slab - 0.03f, 7.8f, 0.9f});
  }
}

// A box of machinery on the roof over the bay at `x`.
void addRoofUnit(Assembly& assembly, const Frame& frame, float x, Random& random) {
  const float width = random.range(0.8f, 2.0f);
  const float height = random.range(0.6f, 1.4f);
  const float aside = random.range(-2.0f, 2.0f);
  const float forward = random.range(-3.0f, 3.0f);
  const Color tone = Color(0.40f, 0.40f, 0.42f) * random.range(0.5f, 1.2f);
  addBox(assembly, {assembly.palette().matte, tone}, shifted(frame, {x + aside, forward, 7.6f}),
         {width, 1.2f, height});
}

// Garages with offices above and a flat roof.
void addPits(Assembly& assembly, const Plot& plot) {
  constexpr int kBays = 9;
  constexpr float kBay_m = 7.6f;
  constexpr float kDepth_m = 12.0f;
  // So long that the ground's own ups and downs would show through the apron.
  const Frame frame = shifted(facingTrackFrame(plot.place, 0.0f), {0.0f, 0.0f, 0.12f});
  const Palette& p = assembly.palette();
  for (int i = 0; i < kBays; ++i) {
    Random random(651u, static_cast<std::uint32_t>(i));
    const float x = (static_cast<float>(i) - 0.5f * (kBays - 1)) * kBay_m;
    const FacadePlan upper{
        kBay_m, 3.3f,         1, WallKind::kSheet, Color(0.48f, 0.49f, 0.50f) * random.range(0.85f, 1.1f),
        false,  random.bits()};
    addWall(assembly, shifted(frame, {x, -0.5f * kDepth_m, 4.0f}), upper);
    // The door, some of them half open, and the dark behind it.
    const float open = random.chance(0.45f) ? random.range(0.8f, 2.6f) : 0.0f;
    const Picture door = assembly.addPicture(paintPoster({224, 110}, random.bits()));
    const float half = 0.5f * kBay_m - 0.45f;
    const float front = -0.5f * kDepth_m;
    addQuad(assembly, {door.material, Color::Ones()},
            {frame * Point(x - half, front + 0.3f, open), frame * Point(x + half, front + 0.3f, open),
             frame * Point(x + half, front + 0.3f, 3.4f), frame * Point(x - half, front + 0.3f, 3.4f)},
            door.rect);
    addBox(assembly, {p.concrete, Color(0.36f, 0.35f, 0.33f) * random.range(0.8f, 1.1f)},
           shifted(frame, {x - 0.5f * kBay_m, front + 0.2f, -0.5f}), {0.9f, 0.5f, 4.5f});
    addBox(assembly, {p.matte, paintColor(random)}, shifted(frame, {x, front + 0.1f, 3.4f}),
           {kBay_m, 0.45f, 0.6f});
    const Picture number = assembly.addPicture(
        paintSign({64, 40}, std::to_string(i + 1), {paintColor(random), {0.7f, 0.7f, 0.66f}, random.bits()}));
    addQuad(assembly, {number.material, Color::Ones()},
            {frame * Point(x - 0.5f, front - 0.14f, 3.45f), frame * Point(x + 0.5f, front - 0.14f, 3.45f),
             frame * Point(x + 0.5f, front - 0.14f, 3.95f), frame * Point(x - 0.5f, front - 0.14f, 3.95f)},
            number.rect);
    addRoofUnit(assembly, frame, x, random);
  }
  const float width = kBays * kBay_m;
  addBox(assembly, {p.concrete, {0.34f, 0.33f, 0.31f}}, shifted(frame, {0, -0.2f, 7.3f}),
         {width + 1.0f, kDepth_m + 2.2f, 0.35f});
  addBox(assembly, {p.concrete, {0.16f, 0.155f, 0.15f}}, shifted(frame, {0, 0, -1.0f}),
         {width + 0.6f, kDepth_m + 0.8f, 1.02f});
  addApron(assembly, frame, width, kDepth_m);
  addBox(assembly, {p.plaster, {0.42f, 0.41f, 0.38f}}, shifted(frame, {0, 0.5f * kDepth_m - 0.2f, 0.0f}),
         {width, 0.3f, 7.3f});
  for (const float side : {-0.5f, 0.5f})
    addBox(assembly, {p.plaster, {0.44f, 0.42f, 0.39f}}, shifted(frame, {side * width, 0, 0.0f}),
           {0.3f, kDepth_m, 7.3f});
}

void addTower(Assembly& assembly, const Plot& plot) {
  const Frame frame = facingTrackFrame(plot.place, 0.0f);
  const Palette& p = assembly.palette();
  House shaft{frame, 5.0f, 5.0f, 10.5f, 3, WallKind::kPlaster, {0.55f, 0.53f, 0.48f}, 661u};
  for (int k = 0; k < 4; ++k) {
    Frame wall = frame;
    wall.rotate(Eigen::AngleAxisf(0.5f * kPiFloat * static_cast<float>(k), Point::UnitZ()));
    addWall(
        assembly, shifted(wall, {0, -2.5f, -0.2f}),
        {5.0f, 10.5f, 3, WallKind::kPlaster, shaft.wall, k == 0, shaft.seed + static_cast<std::uint32_t>(k)});
    addWall(assembly, shifted(wall, {0, -3.4f, 10.4f}),
            {6.8f,
             3.0f,
             1,
             WallKind::kSheet,
             {0.35f, 0.06f, 0.05f},
             false,
             671u + static_cast<std::uint32_t>(k)});
  }
  addBox(assembly, {p.concrete, {0.35f, 0.34f, 0.32f}}, shifted(frame, {0, 0, 10.2f}), {7.2f, 7.2f, 0.2f});
  addBox(assembly, {p.concrete, {0.30f, 0.29f, 0.28f}}, shifted(frame, {0, 0, 13.4f}), {7.8f, 7.8f, 0.3f});
  addTube(assembly, {p.metal, {0.4f, 0.4f, 0.4f}},
          {{frame * Point(1, 1, 13.5f), 0.06f}, {frame * Point(1, 1, 19.0f), 0.03f}}, 6);
}

}  // namespace

void addBuildings(Assembly& assembly) {
  std::uint32_t index = 0;
  for (const Plot& plot : plots()) {
    ++index;
    if (plot.kind == Plot::Kind::kHouse || plot.kind == Plot::Kind::kBarn) addHouseAt(assembly, plot, index);
    if (plot.kind == Plot::Kind::kPits) addPits(assembly, plot);
    if (plot.kind == Plot::Kind::kTower) addTower(assembly, plot);
  }
}

}  // namespace sunlit::scene::race_track
