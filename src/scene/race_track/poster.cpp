#include "scene/race_track/poster.h"

#include <array>
#include <cmath>

namespace sunlit::scene::race_track {
namespace {

// Made-up names, put together from halves.
constexpr const char* kHeads[] = {"SOL", "LUX", "VEL", "TOR", "KAR", "NOVA", "AERO", "PRO", "MAX", "ZEN",
                                  "ORB", "DYN", "FER", "HEL", "RAP", "QUA",  "BRI",  "ALT", "MER", "VOL"};
constexpr const char* kTails[] = {"ARIS", "TEX", "OIL",  "GRIP",  "TYRES", "MOTO", "CAST",
                                  "ONE",  "WAY", "LINE", "GAS",   "BANK",  "COLA", "TOOLS",
                                  "AIR",  "NET", "TEC",  "SPORT", "FUEL",  "LAMP"};
constexpr const char* kWords[] = {"RACING",         "SINCE 1924",  "BETTER BY DAY", "WORLD SERIES",
                                  "TEAM",           "FAST + SAFE", "DRIVE",         "OPEN 24/7",
                                  "THE BRIGHT ONE", "BRAKES",      "SUPPLY",        "RADIO 98.6",
                                  "FOR WINNERS",    "CUP",         "EST. 1961",     "MADE FOR IT"};

std::string name(Random& random) {
  const std::string head = kHeads[random.below(20)];
  const char* const tail = kTails[random.below(20)];
  return head + (random.chance(0.3f) ? "-" : "") + tail;
}

void addShapes(Canvas& canvas, Random& random) {
  const float w = static_cast<float>(canvas.width());
  const float h = static_cast<float>(canvas.height());
  const int kind = random.below(6);
  const Color color = paintColor(random);
  if (kind == 0) {
    const float x = w * random.range(0.05f, 0.9f);
    canvas.polygon({{x, 0.0f}, {x + 0.3f * w, 0.0f}, {x + 0.3f * w - h, h}, {x - h, h}}, {color, 1.0f});
  } else if (kind == 1) {
    for (int i = 0; i < 4; ++i) {
      const Ink ink{paintColor(random), 0.8f};
      const Pixel radii = Pixel::Constant(h * random.range(0.15f, 0.7f));
      canvas.ellipse({w * random.unit(), h * random.unit()}, radii, 0.0f, ink);
    }
  } else if (kind == 2) {
    canvas.rectangle({0.0f, 0.0f}, {w, 0.16f * h}, {color, 1.0f});
    canvas.rectangle({0.0f, 0.84f * h}, {w, h}, {paintColor(random), 1.0f});
  } else if (kind == 3) {
    for (int i = 0; i < 9; ++i) {
      const Ink ink{i % 2 ? color : paintColor(random), 0.85f};
      const float width = h * random.range(0.03f, 0.15f);
      canvas.line({{w * random.unit(), -5.0f}, {w * random.unit(), h + 5.0f}}, width, ink);
    }
  } else if (kind == 4) {
    // A sun with rays.
    const float y = h * random.range(0.3f, 0.7f);
    const Pixel middle(w * random.range(0.1f, 0.9f), y);
    for (int i = 0; i < 12; ++i)
      canvas.line({middle, middle + h * Pixel(std::cos(0.5236f * i), std::sin(0.5236f * i))}, 0.05f * h,
                  {color, 1.0f});
    canvas.ellipse(middle, Pixel::Constant(0.3f * h), 0.0f, {paintColor(random), 1.0f});
  } else {
    for (int i = 0; i < 40; ++i) {
      const float y = h * random.unit();
      const Pixel corner(w * random.unit(), y);
      const Ink ink{i % 3 ? color : paintColor(random), 0.7f};
      const float height = h * random.range(0.05f, 0.25f);
      canvas.rectangle(corner, corner + Pixel(h * random.range(0.05f, 0.25f), height), ink);
    }
  }
}

void weather(Canvas& canvas, Random& random) {
  canvas.mottle(0.35f * static_cast<float>(canvas.height()), 0.16f, random.bits());
  canvas.streaks(4 + random.below(8), 0.45f, random);
}

}  // namespace

Color paintColor(Random& random) {
  const std::array<Color, 14> colors = {
      srgb(200, 30, 28), srgb(20, 70, 160),  srgb(245, 200, 30),  srgb(30, 120, 60),  srgb(235, 235, 228),
      srgb(28, 28, 30),  srgb(235, 120, 25), srgb(90, 45, 130),   srgb(60, 165, 190), srgb(190, 195, 200),
      srgb(120, 20, 40), srgb(150, 190, 50), srgb(230, 130, 150), srgb(15, 45, 80)};
  const Color base = colors[static_cast<std::size_t>(random.below(14))];
  return (base * random.range(0.7f, 1.0f)).min(0.8f);
}

Canvas paintPoster(const PosterSize& size, std::uint32_t seed) {
  Random random(601u, seed);
  const Color ground = paintColor(random);
  Canvas canvas(size.width_px, size.height_px, ground);
  addShapes(canvas, random);
  if (random.chance(0.5f)) addShapes(canvas, random);
  const float w = static_cast<float>(size.width_px);
  const float h = static_cast<float>(size.height_px);
  const std::string title = name(random);
  const Color ink = ground.mean() > 0.25f ? Color(0.02f, 0.02f, 0.025f) : Color(0.75f, 0.74f, 0.70f);
  float letter = h * random.range(0.32f, 0.52f);
  letter *= std::min(1.0f, 0.9f * w / textWidth(title, letter));
  const bool plate = random.chance(0.6f);
  const float top = (h - letter) * random.range(0.25f, 0.6f);
  const Pixel corner((w - textWidth(title, letter)) * random.range(0.2f, 0.8f), top);
  if (plate)
    canvas.rectangle(corner - Pixel::Constant(0.22f * letter),
                     corner + Pixel(textWidth(title, letter), 1.25f * letter), {ground, 0.9f});
  canvas.text(title, corner, letter, {ink, 1.0f});
  if (h > 0.3f * w) {
    const std::string motto = kWords[random.below(16)];
    float small = 0.14f * h;
    small *= std::min(1.0f, 0.8f * w / textWidth(motto, small));
    const Color color = random.chance(0.5f) ? ink : paintColor(random);
    canvas.text(motto, {0.08f * w * random.range(0.5f, 3.0f), h - 1.5f * small}, small, {color, 1.0f});
  }
  weather(canvas, random);
  return canvas;
}

Canvas paintSign(const PosterSize& size, const std::string& letters, const SignStyle& style) {
  Random random(602u, style.seed);
  Canvas canvas(size.width_px, size.height_px, style.ground);
  const float w = static_cast<float>(size.width_px);
  const float h = static_cast<float>(size.height_px);
  canvas.line({{3, 3}, {w - 3, 3}, {w - 3, h - 3}, {3, h - 3}, {3, 3}}, 0.04f * h, {style.ink, 1.0f});
  float letter = 0.6f * h;
  letter *= std::min(1.0f, 0.85f * w / textWidth(letters, letter));
  canvas.text(letters, {0.5f * (w - textWidth(letters, letter)) + 0.1f * letter, 0.5f * (h - letter)}, letter,
              {style.ink, 1.0f});
  weather(canvas, random);
  return canvas;
}

Canvas paintChevrons(const PosterSize& size, bool to_left, std::uint32_t seed) {
  Random random(603u, seed);
  Canvas canvas(size.width_px, size.height_px, srgb(225, 222, 214) * random.range(0.7f, 1.0f));
  const float h = static_cast<float>(size.height_px);
  const float sign = to_left ? -1.0f : 1.0f;
  for (float x = random.range(-h, 0.0f); x < static_cast<float>(size.width_px) + h; x += 1.2f * h) {
    const float tip = x + sign * 0.35f * h;
    canvas.polygon({{x, 0.0f},
                    {x + 0.6f * h, 0.0f},
                    {tip + 0.6f * h, 0.5f * h},
                    {x + 0.6f * h, h},
                    {x, h},
                    {tip, 0.5f * h}},
                   {srgb(190, 25, 25) * random.range(0.7f, 1.1f), 1.0f});
  }
  weather(canvas, random);
  return canvas;
}

}  // namespace sunlit::scene::race_track
