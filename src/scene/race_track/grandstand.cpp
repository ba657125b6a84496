#include "scene/race_track/grandstand.h"

#include <cmath>

#include "scene/race_track/ground.h"
#include "scene/race_track/layout.h"
#include "scene/race_track/poster.h"
#include "scene/race_track/shapes.h"
#include "sunlit/quantity/angle.h"

namespace sunlit::scene::race_track {
namespace {

struct Stand {
  Frame frame;  // its front looks to −y; x along it
  float width;
  int rows;
  bool roof;
  std::uint32_t seed;
};
constexpr float kRow_m = 0.85f;
constexpr float kRise_m = 0.45f;
constexpr float kSeat_m = 0.55f;
constexpr float kFoot_m = 1.1f;

// A person as seen from the front, in clothes of the seed.
Canvas paintPerson(std::uint32_t seed) {
  Random random(701u, seed);
  Canvas canvas(44, 84, paintColor(random), 0.0f);
  const Color skin = Color(0.45f, 0.28f, 0.19f) * random.range(0.35f, 1.1f);
  const Color shirt = paintColor(random);
  const Color trousers = Color(0.06f, 0.07f, 0.11f) * random.range(0.5f, 3.0f);
  canvas.rectangle({12, 52}, {32, 82}, {trousers, 1.0f});
  canvas.rectangle({21, 60}, {23, 82}, {0.4f * trousers, 1.0f});
  canvas.ellipse({22, 40}, {13, 18}, 0.0f, {shirt, 1.0f});
  const float arm = random.chance(0.25f) ? -26.0f : 14.0f;
  canvas.line({{11, 32}, {6, 40}, {8.0f, 40.0f + arm}}, 5.0f, {shirt * 0.8f, 1.0f});
  canvas.line({{33, 32}, {38, 40}, {36, 54}}, 5.0f, {shirt * 0.75f, 1.0f});
  if (random.chance(0.4f)) {
    const Color belt = paintColor(random);
    canvas.rectangle({11, 36}, {33, random.range(39, 46)}, {belt, 1.0f});
  }
  canvas.ellipse({22, 14}, {7, 9}, 0.0f, {skin, 1.0f});
  const Color hair = Color(0.06f, 0.04f, 0.025f) * random.range(0.4f, 5.0f);
  canvas.ellipse({22, 8}, {8, 6}, 0.0f, {random.chance(0.35f) ? paintColor(random) : hair, 1.0f});
  canvas.mottle(9.0f, 0.25f, random.bits());
  return canvas;
}

std::vector<Picture> paintCrowd(Assembly& assembly) {
  std::vector<Picture> crowd;
  for (std::uint32_t i = 0; i < 34; ++i) crowd.push_back(assembly.addCutOut(paintPerson(i)));
  return crowd;
}

Point seatPoint(int row, float x) {
  return {x, kRow_m * (static_cast<float>(row) + 0.5f), kFoot_m + kRise_m * static_cast<float>(row)};
}

void addSteps(Assembly& assembly, const Stand& stand) {
  Random random(stand.seed);
  for (int r = 0; r < stand.rows; ++r) {
    const float top = kFoot_m + kRise_m * static_cast<float>(r);
    // In pieces, since each was cast on its own.
    for (float x = -0.5f * stand.width; x < 0.5f * stand.width - 0.1f; x += 5.0f) {
      const Paint paint{assembly.palette().concrete, Color(0.32f, 0.31f, 0.29f) * random.range(0.75f, 1.15f)};
      const float piece = std::min(5.0f, 0.5f * stand.width - x);
      addBox(assembly, paint,
             shifted(stand.frame, {x + 0.5f * piece, kRow_m * (static_cast<float>(r) + 0.5f), -0.5f}),
             {piece - 0.03f, kRow_m, top + 0.5f});
    }
  }
}

void addSeats(Assembly& assembly, const Stand& stand, const std::vector<Picture>& crowd) {
  Random random(stand.seed + 1u);
  const Frame& f = stand.frame;
  for (int r = 0; r < stand.rows; ++r) {
    for (float x = -0.5f * stand.width + 0.6f; x < 0.5f * stand.width - 0.5f; x += kSeat_m) {
      if (std::abs(std::remainder(x, 9.0f)) < 0.6f) continue;  // gangways
      const Point s = seatPoint(r, x);
      const int block = static_cast<int>(std::floor((x + 100.0f) / 9.0f));
      const Color colors[] = {srgb(30, 70, 150), srgb(190, 40, 35), srgb(220, 215, 205), srgb(225, 165, 30)};
      const Paint paint{assembly.palette().satin,
                        colors[(block + (r > stand.rows / 2 ? 1 : 0)) % 4] * random.range(0.55f, 1.05f)};
      const float w = 0.22f;
      const auto at = [&](float dx, float dy, float dz) { return Point(f * Point(s + Point(dx, dy, dz))); };
      addQuad(assembly, paint,
              {at(-w, -0.15f, 0.40f), at(w, -0.15f, 0.40f), at(w, 0.22f, 0.38f), at(-w, 0.22f, 0.38f)});
      addQuad(assembly, paint,
              {at(-w, 0.22f, 0.38f), at(w, 0.22f, 0.38f), at(w, 0.30f, 0.80f), at(-w, 0.30f, 0.80f)});
      if (!random.chance(0.34f)) continue;
      const Picture& person = crowd[static_cast<std::size_t>(random.below(static_cast<int>(crowd.size())))];
      const float h = random.chance(0.2f) ? random.range(1.5f, 1.8f) : random.range(1.1f, 1.3f);
      const float half = 0.26f * h;
      const float turn = 0.12f * random.bell();
      Card card{{at(-half, turn, 0.02f), at(half, -turn, 0.02f), at(half, -turn, h), at(-half, turn, h)},
                person.rect,
                even(f.linear() * Point(0.0f, -0.8f, 0.6f))};
      if (random.chance(0.5f)) std::swap(card.rect.top_left.x(), card.rect.bottom_right.x());
      const float blue = random.range(0.6f, 1.2f);
      const float green = random.range(0.6f, 1.2f);
      const float red = random.range(0.6f, 1.2f);
      addCard(assembly, {person.material, {red, green, blue}}, card);
    }
  }
}

void addRoof(Assembly& assembly, const Stand& stand) {
  Random random(stand.seed + 2u);
  const Palette& p = assembly.palette();
  const float depth = kRow_m * static_cast<float>(stand.rows);
  const float top = kFoot_m + kRise_m * static_cast<float>(stand.rows) + 3.0f;
  const Frame& f = stand.frame;
  constexpr float kBay_m = 7.0f;
  for (float x = -0.5f * stand.width; x <= 0.5f * stand.width + 0.1f; x += kBay_m) {
    const Paint steel{p.metal, Color(0.50f, 0.51f, 0.52f) * random.range(0.75f, 1.05f)};
    addTube(assembly, steel,
            {{f * Point(x, depth - 0.4f, -0.5f), 0.16f}, {f * Point(x, depth - 0.4f, top), 0.14f}}, 8);
    addBar(assembly, steel, {f * Point(x, depth - 0.4f, top), 0.10f},
           {f * Point(x, -1.0f, top + 0.9f), 0.07f});
    addBar(assembly, steel, {f * Point(x, depth - 0.4f, top - 1.6f), 0.07f},
           {f * Point(x, 0.35f * depth, top + 0.5f), 0.06f});
  }
  for (float x = -0.5f * stand.width - 0.6f; x < 0.5f * stand.width + 0.5f; x += 1.2f) {
    const Paint sheet{p.roof, Color(0.46f, 0.47f, 0.48f) * random.range(0.7f, 1.1f)};
    const auto slab = [&](float lift) {
      return Corners{f * Point(x, -1.6f, top + 1.1f + lift), f * Point(x + 1.2f, -1.6f, top + 1.1f + lift),
                     f * Point(x + 1.2f, depth + 0.6f, top + lift), f * Point(x, depth + 0.6f, top + lift)};
    };
    addQuad(assembly, sheet, slab(0.12f));
  }
  for (float x = -0.5f * stand.width; x < 0.5f * stand.width - 1.0f; x += 6.0f) {
    const Picture picture = assembly.addPicture(paintPoster({224, 40}, random.bits()));
    const float end = std::min(x + 5.6f, 0.5f * stand.width);
    addQuad(assembly, {picture.material, Color::Ones()},
            {f * Point(x, -1.66f, top + 0.55f), f * Point(end, -1.66f, top + 0.55f),
             f * Point(end, -1.66f, top + 1.45f), f * Point(x, -1.66f, top + 1.45f)},
            picture.rect);
  }
  for (float x = -0.5f * stand.width; x < 0.5f * stand.width - 0.1f; x += 6.0f) {
    const float length = std::min(6.0f, 0.5f * stand.width - x);
    addBox(assembly, {p.plaster, Color(0.40f, 0.40f, 0.41f) * random.range(0.8f, 1.1f)},
           shifted(f, {x + 0.5f * length, depth + 0.15f, -0.5f}), {length - 0.03f, 0.2f, top - 1.2f});
  }
}

/// Below the roof, some 40 lx on the seats.
void addLights(Assembly& assembly, const Stand& stand) {
  const float depth = kRow_m * static_cast<float>(stand.rows);
  const float top = kFoot_m + kRise_m * static_cast<float>(stand.rows) + 3.0f;
  for (float x = -0.5f * stand.width + 4.5f; x < 0.5f * stand.width; x += 9.0f) {
    Lamp lamp;
    lamp.name = "grandstand lamp";
    lamp.group = kGrandstandLamps;
    lamp.radius_m = 0.15f;
    lamp.position = stand.frame * Point(x, 0.4f * depth, top + 0.2f);
    lamp.intensity = kGrandstandLamp_cd;
    lamp.inner_rad = 0.9f;
    lamp.outer_rad = 1.4f;
    addBox(assembly, {assembly.palette().grandstand_lamp, {0.6f, 0.6f, 0.6f}},
           shifted(stand.frame, {x, 0.4f * depth, top + 0.25f}), {1.2f, 0.3f, 0.06f});
    assembly.addLamp(std::move(lamp));
  }
}

void addRailing(Assembly& assembly, const Stand& stand) {
  const Paint steel{assembly.palette().metal, {0.45f, 0.45f, 0.44f}};
  const Frame& f = stand.frame;
  for (float x = -0.5f * stand.width; x < 0.5f * stand.width; x += 2.0f) {
    addBar(assembly, steel, {f * Point(x, -0.1f, kFoot_m - 0.2f), 0.025f},
           {f * Point(x, -0.1f, kFoot_m + 0.95f), 0.025f});
    for (const float z : {0.5f, 0.95f})
      addBar(assembly, steel, {f * Point(x, -0.1f, kFoot_m + z), 0.02f},
             {f * Point(std::min(x + 2.0f, 0.5f * stand.width), -0.1f, kFoot_m + z), 0.02f});
  }
}

Stand standAt(const Plot& plot, std::uint32_t seed) {
  const bool main = plot.kind == Plot::Kind::kStand;
  Stand stand;
  const float side = plot.place.left > 0.0 ? 1.0f : -1.0f;
  const Eigen::Vector2d t = course().tangent(plot.place.along);
  const float yaw =
      std::atan2(static_cast<float>(t.y()), static_cast<float>(t.x())) + (side > 0 ? 0.0f : kPiFloat);
  stand.rows = main ? 12 : 6;
  stand.width = main ? 63.0f : 22.0f;
  stand.roof = main;
  stand.seed = seed;
  const double front = std::abs(plot.place.left) - 0.5 * kRow_m * stand.rows;
  stand.frame = standing(groundPoint(TrackPlace{plot.place.along, side * front}), yaw);
  return stand;
}

}  // namespace

void addGrandstands(Assembly& assembly) {
  const std::vector<Picture> crowd = paintCrowd(assembly);
  std::uint32_t seed = 711u;
  for (const Plot& plot : plots()) {
    if (plot.kind != Plot::Kind::kStand && plot.kind != Plot::Kind::kBleachers) continue;
    const Stand stand = standAt(plot, seed += 10u);
    addSteps(assembly, stand);
    addSeats(assembly, stand, crowd);
    addRailing(assembly, stand);
    if (!stand.roof) continue;
    addRoof(assembly, stand);
    addLights(assembly, stand);
  }
}

}  // namespace sunlit::scene::race_track
