#include "scene/race_track/furniture.h"

#include <cmath>
#include <string>

#include "scene/race_track/barriers.h"
#include "scene/race_track/ground.h"
#include "scene/race_track/layout.h"
#include "scene/race_track/poster.h"
#include "scene/race_track/road.h"
#include "scene/race_track/shapes.h"
#include "sunlit/quantity/angle.h"

namespace sunlit::scene::race_track {
namespace {

// A frame whose −y looks at drivers who come along, turned a little towards the track.
Frame facingDrivers(const TrackPlace& place, float turn_in) {
  const Eigen::Vector2d t = course().tangent(place.along);
  const float along = std::atan2(static_cast<float>(t.y()), static_cast<float>(t.x()));
  return standing(groundPoint(place), along - 0.5f * kPiFloat + (place.left > 0.0 ? turn_in : -turn_in));
}

double behindBarrier(double along, int side, double distance) {
  return side * (barrierOffset(along, side) + distance);
}

struct Board {
  float width;
  float height;
  float low;  // its lower edge above the ground
};

void addBoard(Assembly& assembly, const Frame& frame, const Board& board, const Picture& picture) {
  const Paint post{assembly.palette().metal, {0.30f, 0.30f, 0.30f}};
  const float x = 0.5f * board.width;
  const float top = board.low + board.height;
  for (const float side : {-0.7f, 0.7f})
    addTube(assembly, post,
            {{frame * Point(side * x, 0.08f, -0.4f), 0.045f}, {frame * Point(side * x, 0.08f, top), 0.045f}},
            6);
  addBox(assembly, {assembly.palette().matte, {0.20f, 0.20f, 0.20f}}, shifted(frame, {0, 0.02f, board.low}),
         {board.width, 0.05f, board.height});
  addQuad(assembly, {picture.material, Color::Ones()},
          {frame * Point(-x, -0.015f, board.low), frame * Point(x, -0.015f, board.low),
           frame * Point(x, -0.015f, top), frame * Point(-x, -0.015f, top)},
          picture.rect);
}

/// A lamp of 1200 cd that shines down from below its head's glass: some 20 lx on the road, as on a town's
/// main streets (EN 13201-2, class C2). Warm white.
void addStreetLight(Assembly& assembly, const Frame& head, std::uint32_t seed) {
  Lamp lamp;
  lamp.name = "street lamp " + std::to_string(seed);
  lamp.group = kStreetLamps;
  lamp.radius_m = 0.1f;
  lamp.position = head * Point(0.05f, 0.0f, -0.16f);
  lamp.intensity = kStreetLamp_cd;
  lamp.inner_rad = 0.9f;
  lamp.outer_rad = 1.35f;
  assembly.addLamp(std::move(lamp));
}

void addLamp(Assembly& assembly, const TrackPlace& place, std::uint32_t seed) {
  Random random(seed);
  const Eigen::Vector2d left = leftOf(course().tangent(place.along));
  const float side = place.left > 0.0 ? -1.0f : 1.0f;
  const Point in(side * static_cast<float>(left.x()), side * static_cast<float>(left.y()), 0.0f);
  const Point root = groundPoint(place);
  const float height = random.range(7.0f, 8.5f);
  const Paint steel{assembly.palette().metal, Color(0.33f, 0.34f, 0.34f) * random.range(0.6f, 1.15f)};
  const Point lean = sway(0.08f, random);
  const Point top = root + lean + Point(0, 0, height);
  addTube(assembly, steel,
          {{root - Point(0, 0, 0.3f), 0.11f},
           {root + Point(0, 0, 1.2f), 0.10f},
           {root + Point(0, 0, 1.21f), 0.075f},
           {top, 0.05f},
           {top + 0.5f * in + Point(0, 0, 0.35f), 0.04f},
           {top + 1.8f * in + Point(0, 0, 0.45f), 0.035f}},
          8);
  const Frame head = standing(top + 1.9f * in + Point(0, 0, 0.40f), std::atan2(in.y(), in.x()));
  addBox(assembly, {assembly.palette().matte, {0.22f, 0.22f, 0.23f}}, head, {0.7f, 0.28f, 0.12f});
  addBox(assembly, {assembly.palette().street_lamp, {0.6f, 0.6f, 0.55f}}, shifted(head, {0.05f, 0, -0.05f}),
         {0.5f, 0.22f, 0.05f});
  addStreetLight(assembly, head, seed);
  const Picture label = assembly.addPicture(
      paintSign({32, 24}, std::to_string(seed % 97u), {paintColor(random), {0.05f, 0.05f, 0.05f}, seed}));
  addBoard(assembly, facingDrivers({place.along, place.left}, 0.0f), {0.35f, 0.28f, 1.7f}, label);
}

void addLamps(Assembly& assembly) {
  std::uint32_t seed = 801u;
  for (double s = 12.0; s < course().length(); s += 33.0) {
    Random random(++seed);
    const int side = random.chance(0.6f) ? 1 : -1;
    addLamp(assembly, {s + 4.0 * random.bell(), behindBarrier(s, side, 1.9)}, seed);
  }
}

void addAdvertisements(Assembly& assembly) {
  for (std::uint32_t i = 0; i < 46; ++i) {
    Random random(811u, i);
    const double s = (i + 0.6 * random.unit()) / 46.0 * course().length();
    const int side = random.chance(0.5f) ? 1 : -1;
    const bool large = random.chance(0.3f);
    const Frame frame =
        facingDrivers({s, behindBarrier(s, side, large ? 4.0 : 2.4)}, random.range(0.2f, 0.9f));
    const Board board{large ? 6.0f : random.range(2.4f, 3.6f), large ? 2.6f : random.range(1.0f, 1.5f),
                      large ? random.range(1.6f, 3.2f) : random.range(0.5f, 1.4f)};
    const PosterSize size{large ? 320 : 200,
                          static_cast<int>((large ? 320 : 200) * board.height / board.width)};
    addBoard(assembly, frame, board, assembly.addPicture(paintPoster(size, random.bits())));
  }
}

// Every 50 m the distance, before bends 150, 100 and 50, and in the bends chevrons.
void addSigns(Assembly& assembly) {
  for (std::uint32_t k = 1; k <= 20; ++k) {
    Random random(821u, k);
    const int side = k % 2 == 0 ? 1 : -1;
    const double s = 50.0 * k;
    const Picture picture = assembly.addPicture(
        paintSign({72, 48}, std::to_string(50u * k), {paintColor(random), {0.72f, 0.71f, 0.67f}, k}));
    addBoard(assembly, facingDrivers({s, behindBarrier(s, side, 0.75)}, 0.15f), {0.9f, 0.6f, 1.1f}, picture);
  }
  std::uint32_t index = 0;
  for (const Kerb& kerb : kerbs()) {
    if (kerb.to - kerb.from < 24.0) continue;
    Random random(822u, ++index);
    const int outside = -kerb.side;
    for (double s = kerb.from + 6.0; s < kerb.to - 4.0; s += random.range(7.0f, 11.0f)) {
      const Frame frame = facingDrivers({s, behindBarrier(s, outside, 0.7)}, 0.9f);
      const Picture picture = assembly.addPicture(paintChevrons({96, 32}, kerb.side > 0, random.bits()));
      addBoard(assembly, frame, {1.8f, 0.6f, random.range(0.95f, 1.2f)}, picture);
    }
  }
}

void addMarshalPost(Assembly& assembly, const TrackPlace& place, std::uint32_t seed) {
  Random random(seed);
  const Palette& p = assembly.palette();
  const Frame frame = facingDrivers(place, 1.2f);
  addBox(assembly, {p.concrete, {0.33f, 0.32f, 0.30f}}, shifted(frame, {0, 0, -0.4f}), {2.6f, 2.2f, 0.9f});
  for (const float x : {-1.15f, 1.15f}) {
    for (const float y : {-0.95f, 0.95f})
      addBox(assembly, {p.metal, {0.35f, 0.35f, 0.35f}}, shifted(frame, {x, y, 0.5f}), {0.08f, 0.08f, 2.2f});
  }
  const Color orange = Color(0.62f, 0.20f, 0.02f) * random.range(0.7f, 1.05f);
  addBox(assembly, {p.matte, orange}, shifted(frame, {0, 0, 2.7f}), {2.9f, 2.5f, 0.12f});
  for (const float x : {-1.15f, 1.15f})
    addBox(assembly, {p.wood, Color(0.30f, 0.24f, 0.16f) * random.range(0.7f, 1.2f)},
           shifted(frame, {x, 0, 0.5f}), {0.05f, 1.9f, 1.0f});
  const Picture number = assembly.addPicture(
      paintSign({96, 64}, "P" + std::to_string(seed % 50u), {orange, {0.03f, 0.03f, 0.03f}, seed}));
  addQuad(assembly, {number.material, Color::Ones()},
          {frame * Point(-0.75f, -1.02f, 0.55f), frame * Point(0.75f, -1.02f, 0.55f),
           frame * Point(0.75f, -1.02f, 1.5f), frame * Point(-0.75f, -1.02f, 1.5f)},
          number.rect);
  addTube(assembly, {p.satin, {0.45f, 0.03f, 0.03f}},
          {{frame * Point(0.8f, -0.3f, 0.5f), 0.08f}, {frame * Point(0.8f, -0.3f, 1.1f), 0.08f}}, 8);
}

void addCone(Assembly& assembly, const Point& place, Random& random) {
  const Palette& p = assembly.palette();
  const Color orange = Color(0.60f, 0.14f, 0.02f) * random.range(0.6f, 1.1f);
  const Color white = Color(0.62f, 0.61f, 0.58f) * random.range(0.6f, 1.0f);
  const Point lean = sway(0.03f, random) + Point::UnitZ();
  const float h = random.chance(0.3f) ? 0.45f : 0.7f;
  addBox(assembly, {p.rubber, 0.6f * orange},
         standing(place - Point(0, 0, 0.01f), random.range(0.0f, kPiFloat)), {0.55f * h, 0.55f * h, 0.05f});
  const float cuts[] = {0.04f, 0.45f, 0.68f, 1.0f};
  for (int k = 0; k < 3; ++k) {
    const auto ring = [&](float t) { return Ring{place + t * h * lean, h * (0.20f * (1.0f - t) + 0.035f)}; };
    addTube(assembly, {p.satin, k == 1 ? white : orange}, {ring(cuts[k]), ring(cuts[k + 1])}, 10);
  }
}

void addCones(Assembly& assembly) {
  for (std::uint32_t i = 0; i < 34; ++i) {
    Random random(831u, i);
    const double s = (i + random.unit()) / 34.0 * course().length();
    const int side = random.chance(0.5f) ? 1 : -1;
    const int row = 1 + random.below(5);
    for (int k = 0; k < row; ++k) {
      const double along = s + 1.7 * k;
      const double left =
          side * (kHalfWidth + std::max(0.55, kerbWidth(along, side) + 0.3) + 0.25 * random.unit() + 0.1 * k);
      addCone(assembly, groundPoint(TrackPlace{along, left}), random);
    }
  }
}

void addFlag(Assembly& assembly, const Point& root, std::uint32_t seed) {
  Random random(seed);
  const float height = random.range(5.0f, 7.0f);
  addTube(assembly, {assembly.palette().metal, {0.5f, 0.5f, 0.5f}},
          {{root - Point(0, 0, 0.3f), 0.05f}, {root + Point(0, 0, height), 0.03f}}, 6);
  const Picture picture = assembly.addPicture(paintPoster({96, 64}, random.bits()));
  const float yaw = 0.7f + 0.4f * random.bell();
  const Point out(std::cos(yaw), std::sin(yaw), 0.0f);
  const Point side(-out.y(), out.x(), 0.0f);
  constexpr int kSteps = 7;
  const float phase = random.range(0.0f, 6.0f);
  const auto at = [&](int k, float up) {
    const float t = static_cast<float>(k) / kSteps;
    return Point(root + Point(0, 0, height - 1.25f + 1.15f * up - 0.45f * t * t) + (0.06f + 1.55f * t) * out +
                 0.16f * t * std::sin(5.0f * t + phase) * side);
  };
  for (int k = 0; k < kSteps; ++k) {
    const float u0 = static_cast<float>(k) / kSteps;
    const float u1 = static_cast<float>(k + 1) / kSteps;
    const Eigen::Vector2f& a = picture.rect.top_left;
    const Eigen::Vector2f& b = picture.rect.bottom_right;
    const PictureRect part{{a.x() + u0 * (b.x() - a.x()), a.y()}, {a.x() + u1 * (b.x() - a.x()), b.y()}};
    addQuad(assembly, {picture.material, Color::Ones()}, {at(k, 0), at(k + 1, 0), at(k + 1, 1), at(k, 1)},
            part);
  }
}

// A portable cabin with a picture on its door.
void addCabin(Assembly& assembly, const Frame& frame, Random& random) {
  const Palette& p = assembly.palette();
  const float shade = random.range(0.4f, 1.0f);
  const Color color = paintColor(random) * shade;
  const float height = random.range(1.9f, 2.4f);
  const float depth = random.range(1.0f, 1.4f);
  const Point size(random.range(1.0f, 2.2f), depth, height);
  addBox(assembly, {p.matte, color}, frame, size);
  addBox(assembly, {p.matte, Color::Constant(random.range(0.2f, 0.6f))}, shifted(frame, {0, 0, size.z()}),
         {size.x() + 0.1f, size.y() + 0.1f, 0.12f});
  for (const float side : {-1.0f, 1.0f}) {
    const Picture picture = assembly.addPicture(paintPoster({72, 64}, random.bits()));
    const float y = side * (0.5f * size.y() + 0.012f);
    const float x = 0.4f * size.x() * -side;
    addQuad(assembly, {picture.material, Color::Ones()},
            {frame * Point(x, y, 0.7f), frame * Point(-x, y, 0.7f), frame * Point(-x, y, 1.6f),
             frame * Point(x, y, 1.6f)},
            picture.rect);
  }
}

void addClutter(Assembly& assembly) {
  for (std::uint32_t i = 0; i < 70; ++i) {
    Random random(841u, i);
    const double s = (i + random.unit()) / 70.0 * course().length();
    const int side = random.chance(0.5f) ? 1 : -1;
    const Point place = groundPoint(TrackPlace{s, behindBarrier(s, side, random.range(1.6f, 3.2f))});
    const Palette& p = assembly.palette();
    const int kind = random.below(5);
    const Frame frame = standing(place - Point(0, 0, 0.05f), random.range(0.0f, kPiFloat));
    if (kind == 0) {
      addTube(assembly, {p.metal, paintColor(random) * 0.7f},
              {{place - Point(0, 0, 0.05f), 0.29f}, {place + Point(0, 0, 0.88f), 0.29f}}, 12);
    } else if (kind == 1) {
      for (int k = 0; k < 1 + random.below(4); ++k) {
        const float x = 0.05f * random.bell();
        const float y = 0.05f * random.bell();
        const Color tone = Color(0.28f, 0.20f, 0.12f) * random.range(0.7f, 1.3f);
        addBox(assembly, {p.wood, tone}, shifted(frame, {x, y, 0.14f * k}), {1.2f, 0.8f, 0.13f});
      }
    } else if (kind == 2) {
      addTyreStack(assembly, place, 1 + random.below(5), random);
    } else if (kind == 3) {
      addCabin(assembly, frame, random);
    } else {
      addFlag(assembly, place, random.bits());
    }
  }
}

}  // namespace

void addFurniture(Assembly& assembly) {
  addLamps(assembly);
  addAdvertisements(assembly);
  addSigns(assembly);
  std::uint32_t seed = 851u;
  for (double s = 70.0; s < course().length() - 40.0; s += 92.0) {
    const int side = (++seed) % 2 == 0 ? 1 : -1;
    addMarshalPost(assembly, {s, behindBarrier(s, side, 2.2)}, seed);
  }
  addCones(assembly);
  addClutter(assembly);
}

}  // namespace sunlit::scene::race_track
