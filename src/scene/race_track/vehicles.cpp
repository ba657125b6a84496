#include "scene/race_track/vehicles.h"

#include "scene/race_track/poster.h"
#include "sunlit/quantity/angle.h"

namespace sunlit::scene::race_track {
namespace {

void addWheel(Assembly& assembly, const Frame& body, const Point& hub, float radius) {
  Frame frame = shifted(body, hub);
  // Its z outwards: tubes are closed at their last ring.
  frame.rotate(Eigen::AngleAxisf((hub.y() > 0.0f ? -0.5f : 0.5f) * kPiFloat, Point::UnitX()));
  const Palette& p = assembly.palette();
  const auto ring = [&](float z, float r) { return Ring{frame * Point(0, 0, z), r}; };
  addTube(
      assembly, {p.rubber, {0.03f, 0.03f, 0.03f}},
      {ring(-0.09f, 0.6f * radius), ring(-0.08f, radius), ring(0.08f, radius), ring(0.09f, 0.6f * radius)},
      11);
  addTube(assembly, {p.metal, {0.42f, 0.42f, 0.43f}},
          {ring(-0.095f, 0.6f * radius), ring(0.1f, 0.58f * radius)}, 9);
}

// The outline of a car from its side, from the rear foot over the roof to the front: x forward, z up, half
// width.
struct Station {
  float x;
  float z;
  float half;
  bool glass;  // towards the next
};

void addShell(Assembly& assembly, const Frame& frame, const std::vector<Station>& outline,
              const Paint& paint) {
  const Paint glass{assembly.palette().glass, {0.03f, 0.035f, 0.04f}};
  constexpr float kSill_m = 0.22f;
  for (std::size_t i = 0; i + 1 < outline.size(); ++i) {
    const Station& a = outline[i];
    const Station& b = outline[i + 1];
    addQuad(assembly, a.glass ? glass : paint,
            {frame * Point(a.x, a.half, a.z), frame * Point(b.x, b.half, b.z),
             frame * Point(b.x, -b.half, b.z), frame * Point(a.x, -a.half, a.z)});
    for (const float side : {1.0f, -1.0f}) {
      const auto at = [&](const Station& s, float z, float half) {
        return Point(frame * Point(s.x, side * half, z));
      };
      const float belt_a = std::min(a.z, 0.88f);
      const float belt_b = std::min(b.z, 0.88f);
      Corners low = {at(a, kSill_m, 0.86f), at(b, kSill_m, 0.86f), at(b, belt_b, 0.87f),
                     at(a, belt_a, 0.87f)};
      Corners high = {at(a, belt_a, 0.87f), at(b, belt_b, 0.87f), at(b, b.z, b.half), at(a, a.z, a.half)};
      if (side > 0) {
        std::swap(low[0], low[1]);
        std::swap(low[2], low[3]);
        std::swap(high[0], high[1]);
        std::swap(high[2], high[3]);
      }
      addQuad(assembly, paint, low);
      if (a.z > 0.9f || b.z > 0.9f) addQuad(assembly, glass, high);
    }
  }
}

}  // namespace

void addCar(Assembly& assembly, const Frame& frame, std::uint32_t seed) {
  Random random(seed);
  const Palette& p = assembly.palette();
  const float roof = random.range(1.38f, 1.62f);
  const float rear = random.range(-2.2f, -1.85f);
  const float nose = random.range(1.9f, 2.25f);
  const float back = random.chance(0.5f) ? rear + 0.25f : rear + 0.75f;
  const std::vector<Station> outline = {
      {rear, 0.25f, 0.84f, false},
      {rear - 0.03f, 0.62f, 0.85f, false},
      {rear + 0.1f, 0.92f, 0.82f, back > rear + 0.5f ? false : true},
      {back, back > rear + 0.5f ? 0.95f : roof - 0.06f, 0.70f, back > rear + 0.5f},
      {back + 0.45f, roof, 0.62f, false},
      {0.25f, roof + 0.02f, 0.62f, true},
      {0.95f, 0.98f, 0.78f, false},
      {nose - 0.15f, 0.80f, 0.78f, false},
      {nose, 0.58f, 0.80f, false},
      {nose + 0.02f, 0.25f, 0.82f, false}};
  addShell(assembly, frame, outline, {p.satin, paintColor(random)});
  for (const float x : {-1.3f, 1.3f}) {
    for (const float y : {-0.76f, 0.76f}) addWheel(assembly, frame, {x, y, 0.31f}, 0.31f);
  }
  addBox(assembly, {p.matte, {0.03f, 0.03f, 0.03f}}, shifted(frame, {0, 0, 0.18f}),
         {nose - rear - 0.2f, 1.6f, 0.1f});
  for (const float y : {-0.6f, 0.6f}) {
    addBox(assembly, {p.glass, {0.65f, 0.65f, 0.62f}}, shifted(frame, {nose - 0.05f, y, 0.58f}),
           {0.12f, 0.3f, 0.13f});
    addBox(assembly, {p.glass, {0.35f, 0.02f, 0.02f}}, shifted(frame, {rear + 0.01f, y, 0.66f}),
           {0.08f, 0.25f, 0.14f});
  }
  addBox(assembly, {p.matte, {0.60f, 0.58f, 0.50f}}, shifted(frame, {nose + 0.02f, 0, 0.38f}),
         {0.02f, 0.5f, 0.11f});
}

void addVan(Assembly& assembly, const Frame& frame, std::uint32_t seed) {
  Random random(seed);
  const Palette& p = assembly.palette();
  const float roof = random.range(1.9f, 2.5f);
  const Paint paint{p.satin, paintColor(random)};
  const std::vector<Station> outline = {{-2.5f, 0.3f, 0.92f, false},  {-2.5f, roof - 0.05f, 0.86f, false},
                                        {-2.35f, roof, 0.80f, false}, {1.0f, roof, 0.80f, true},
                                        {1.75f, 1.15f, 0.84f, false}, {2.35f, 0.95f, 0.84f, false},
                                        {2.45f, 0.3f, 0.86f, false}};
  addShell(assembly, frame, outline, paint);
  // Panels over the windowless sides, with a livery of its own.
  for (const float side : {1.0f, -1.0f}) {
    const Picture picture = assembly.addPicture(paintPoster({176, 80}, random.bits()));
    const float y = side * 0.895f;
    const float x0 = -2.45f;
    const float x1 = 0.35f;
    Corners face = {frame * Point(x0, y, 0.45f), frame * Point(x1, y, 0.45f),
                    frame * Point(x1, y * 0.98f, roof - 0.12f), frame * Point(x0, y * 0.98f, roof - 0.12f)};
    if (side > 0) face = {face[1], face[0], face[3], face[2]};
    addQuad(assembly, {picture.material, Color::Ones()}, face, picture.rect);
  }
  for (const float x : {-1.55f, 1.6f}) {
    for (const float y : {-0.8f, 0.8f}) addWheel(assembly, frame, {x, y, 0.35f}, 0.35f);
  }
  for (const float y : {-0.62f, 0.62f})
    addBox(assembly, {p.glass, {0.65f, 0.65f, 0.62f}}, shifted(frame, {2.38f, y, 0.65f}),
           {0.1f, 0.28f, 0.2f});
}

void addLorry(Assembly& assembly, const Frame& frame, std::uint32_t seed) {
  Random random(seed);
  const Palette& p = assembly.palette();
  const Paint cab{p.satin, paintColor(random)};
  addBox(assembly, cab, shifted(frame, {3.4f, 0, 0.55f}), {1.9f, 2.3f, 2.2f});
  addBox(assembly, {p.glass, {0.03f, 0.035f, 0.04f}}, shifted(frame, {4.34f, 0, 1.65f}),
         {0.06f, 2.0f, 0.85f});
  for (const float y : {-1.16f, 1.16f})
    addBox(assembly, {p.glass, {0.03f, 0.035f, 0.04f}}, shifted(frame, {3.6f, y, 1.65f}),
           {0.9f, 0.04f, 0.75f});
  addBox(assembly, {p.matte, Color(0.5f, 0.5f, 0.48f) * random.range(0.7f, 1.1f)},
         shifted(frame, {-0.9f, 0, 0.95f}), {6.4f, 2.4f, 2.6f});
  addBox(assembly, {p.matte, {0.04f, 0.04f, 0.04f}}, shifted(frame, {0.2f, 0, 0.5f}), {8.0f, 1.0f, 0.4f});
  for (const float side : {1.0f, -1.0f}) {
    const Picture picture = assembly.addPicture(paintPoster({224, 92}, random.bits()));
    const float y = side * 1.22f;
    Corners face = {frame * Point(-4.05f, y, 1.0f), frame * Point(2.25f, y, 1.0f),
                    frame * Point(2.25f, y, 3.5f), frame * Point(-4.05f, y, 3.5f)};
    if (side > 0) face = {face[1], face[0], face[3], face[2]};
    addQuad(assembly, {picture.material, Color::Ones()}, face, picture.rect);
    for (const float x : {-3.2f, -2.2f, 3.2f}) addWheel(assembly, frame, {x, side * 0.98f, 0.48f}, 0.48f);
  }
}

}  // namespace sunlit::scene::race_track
