#include <cmath>
#include <string>

#include "scene/race_track/road_wear.h"

namespace sunlit::scene::race_track {
namespace {

const Color kWhite(0.60f, 0.59f, 0.55f);
const Color kYellow(0.52f, 0.36f, 0.04f);

struct Stripe {
  double from;
  double to;
  float right;
  float left;
};

void addStripe(Canvas& canvas, const StretchMap& map, const Stripe& stripe, const Color& color) {
  if (!map.sees(stripe.from, stripe.to)) return;
  const Pixel low = map.at(stripe.from, stripe.left);
  const Pixel high = map.at(stripe.to, stripe.right);
  for (int y = static_cast<int>(low.y()); y < high.y(); ++y) {
    for (int x = static_cast<int>(low.x()); x < high.x(); ++x) {
      const float worn =
          smoothStep(0.05f, 0.6f, fractal(0.05f * x + static_cast<float>(stripe.from), 0.03f * y, 4, 221u));
      canvas.blend(x, y, {color, 0.88f - 0.75f * worn});
    }
  }
}

void addStartLine(Canvas& canvas, const StretchMap& map) {
  for (int row = 0; row < 3; ++row) {
    for (int k = 0; k < 12; ++k) {
      const float right = -4.1f + 0.683f * k;
      const bool white = (row + k) % 2 == 0;
      const double from = 0.5 + 0.5 * row;
      addStripe(canvas, map, {from, from + 0.5, right, right + 0.683f},
                white ? kWhite : Color(0.03f, 0.03f, 0.03f));
    }
  }
  // Grid places: a bracket and its number each.
  for (int k = 0; k < 10; ++k) {
    const double s = map.near(-5.0 - 7.0 * k);
    const float right = k % 2 == 0 ? 0.7f : -3.3f;
    addStripe(canvas, map, {s, s + 0.22, right, right + 2.6f}, kWhite);
    addStripe(canvas, map, {s - 1.4, s, right, right + 0.15f}, kWhite);
    addStripe(canvas, map, {s - 1.4, s, right + 2.45f, right + 2.6f}, kWhite);
    if (!map.sees(s - 4.0, s)) continue;
    const float m = map.perMetreLeft();
    const LetterFrame frame{
        map.at(s - 0.7, right + 1.9), {0.0f, 1.1f * m}, {-1.6f * map.perMetreAlong(), 0.0f}};
    canvas.text(std::to_string(k + 1), frame, {kYellow, 0.75f});
  }
}

// Words on the asphalt, to be read when driving.
void addWords(Canvas& canvas, const StretchMap& map) {
  const struct {
    double along;
    float left;
    float height;
    const char* letters;
  } words[] = {{118.0, 2.4f, 3.0f, "100"},    {138.0, 2.0f, 3.0f, "50"},    {289.0, 3.2f, 2.4f, "SLOW"},
               {402.0, 1.4f, 2.6f, "T5"},     {508.0, 3.3f, 2.6f, "SOLIS"}, {566.0, -1.0f, 2.4f, "T7"},
               {655.0, 3.7f, 2.6f, "LUX 66"}, {742.0, 0.2f, 2.5f, "T9"},    {795.0, 3.3f, 2.8f, "BRAKE"},
               {866.0, 1.0f, 2.5f, "T11"},    {930.0, -0.6f, 2.5f, "PIT >"}};
  for (const auto& word : words) {
    if (!map.sees(word.along - 4.0, word.along + 4.0)) continue;
    const LetterFrame frame{map.at(word.along + word.height, word.left),
                            {0.0f, 0.5f * word.height * map.perMetreLeft()},
                            {-word.height * map.perMetreAlong(), 0.0f}};
    canvas.text(word.letters, frame, {(word.along < 300 ? kWhite : kYellow) * 0.75f, 0.97f});
  }
}

// Sprayed by surveyors: crosses, digits, arrows, in many colours, all over the track.
void addSurveyMarks(Canvas& canvas, const StretchMap& map) {
  const Color colors[] = {
      {0.55f, 0.10f, 0.03f}, {0.05f, 0.20f, 0.45f}, kWhite, kYellow, {0.10f, 0.40f, 0.12f}};
  for (std::uint32_t i = 0; i < 260; ++i) {
    Random random(222u, i);
    const double s = map.near(random.unit() * course().length());
    if (!map.sees(s - 2.0, s + 2.0)) continue;
    const float left = random.range(-4.0f, 4.0f);
    const Ink ink{colors[random.below(5)], random.range(0.25f, 0.7f)};
    const int kind = random.below(4);
    const float turn = random.range(-3.1f, 3.1f);
    const float size = random.range(0.15f, 0.5f);
    const auto at = [&](float u, float v) {
      return map.at(s + size * (std::cos(turn) * u - std::sin(turn) * v),
                    left + size * (std::sin(turn) * u + std::cos(turn) * v));
    };
    if (kind == 0) {
      canvas.line({at(-1, 0), at(1, 0)}, 1.8f, ink);
      canvas.line({at(0, -1), at(0, 1)}, 1.8f, ink);
    } else if (kind == 1) {
      canvas.line({at(-1, 0), at(1, 0), at(0.4f, 0.5f)}, 1.8f, ink);
      canvas.line({at(1, 0), at(0.4f, -0.5f)}, 1.8f, ink);
    } else {
      const Pixel corner = at(0, 0);
      const std::string digits = std::to_string(random.below(kind == 2 ? 100 : 2000));
      canvas.text(digits, {corner, at(0, -1) - corner, at(-1, 0) - corner}, ink);
    }
  }
}

}  // namespace

void addMarkings(Canvas& canvas, const RoadStretch& stretch) {
  const StretchMap map(canvas, stretch);
  addStartLine(canvas, map);
  addWords(canvas, map);
  addSurveyMarks(canvas, map);
}

}  // namespace sunlit::scene::race_track
