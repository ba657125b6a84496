// What windows show by night. A room whose walls get the illuminance E and reflect the part ρ of it shows
// them at L = ρ E / π: 30 to 110 cd/m² for rooms of 200 to 500 lx (EN 12464-1: 200 lx where people sit and
// wait, 500 where they write) and ρ from 0.5 to 0.7 (the range of the same standard for walls). Drawn
// curtains let a seventh of it through or so.
#include <algorithm>
#include <cmath>

#include "scene/race_track/facade.h"

namespace sunlit::scene::race_track {
namespace {

constexpr float kLitShare = 0.35f;  ///< of the windows, somewhere between dusk and bedtime

/// One room behind one window; places in it by parts of the window, from the left and the top.
struct Room {
  explicit Room(Random& random)
      : curtained(random.chance(0.6f)),
        luminance(random.range(30.0f, 110.0f)),
        side(random.chance(0.6f) ? random.range(0.06f, 0.2f) : 0.0f),
        furniture(random.range(0.6f, 0.85f)),
        lamp(random.range(0.2f, 0.8f)),
        phase(random.range(0.0f, 50.0f)) {
    if (curtained) luminance *= random.range(0.04f, 0.12f);
    // From about 2700 to 4000 K, or that of a bulb through ochre cloth; of luminance 1.
    const float white = random.unit();
    const LinearRgb light(curtained ? Color(1.0f, 0.42f + 0.1f * white, 0.07f + 0.05f * white)
                                    : Color(1.0f, 0.50f + 0.22f * white, 0.15f + 0.3f * white));
    tone = light.value / light.luminance();
  }

  /// cd/m²
  Color at(float x, float y) const {
    const float fold = 1.0f + 0.25f * noise(22.0f * x + phase, 0.6f * y, 637u);
    if (curtained) return tone * luminance * fold * (1.1f - 0.3f * y);
    if (x < side || x > 1.0f - side) return tone * luminance * 0.3f * fold;
    // Lighter towards the lamp and the ceiling, dark where things stand before the wall.
    const float away = std::hypot(x - lamp, y - 0.12f);
    const float wall = luminance * (0.75f + 0.6f * smoothStep(0.9f, 0.0f, away));
    const float top = furniture + 0.18f * noise(4.0f * x + phase, phase, 638u);
    return tone * wall * (y > top ? 0.25f : 1.0f);
  }

  bool curtained;
  float luminance;  ///< cd/m²
  float side;       ///< part that a curtain at each side takes
  float furniture;  ///< its height
  float lamp;       ///< where the ceiling's hangs
  float phase;
  Color tone;
};

}  // namespace

Canvas paintLitWindows(const FacadePlan& plan, const std::vector<Opening>& openings) {
  Canvas canvas = emptyFront(plan, Color::Zero());
  for (std::size_t i = 0; i < openings.size(); ++i) {
    Random random(636u, mix(plan.seed, static_cast<std::uint32_t>(i)));
    if (openings[i].door || !random.chance(kLitShare)) continue;
    const Room room(random);
    const std::vector<Pane> panes = panesOf(plan, openings[i], static_cast<float>(canvas.height()));
    const Pixel corner = panes.front().low, extent = panes.back().high - corner;
    for (const Pane& pane : panes) {
      for (int y = static_cast<int>(pane.low.y()); y < pane.high.y(); ++y) {
        for (int x = static_cast<int>(pane.low.x()); x < pane.high.x(); ++x) {
          const Pixel part = (Pixel(x, y) - corner).cwiseQuotient(extent);
          canvas.blend(x, y, {room.at(part.x(), part.y()) / kFullWindow_cd_per_m2});
        }
      }
      if (pane.barred) canvas.rectangle(pane.barLow(), pane.barHigh(), {Color::Zero()});
    }
  }
  return canvas;
}

LinearRgb windowIntensity(const Canvas& lit, const Opening& opening) {
  const OpeningPixels at(opening, static_cast<float>(lit.height()));
  const Eigen::Vector2i low = at.low.cast<int>(), high = at.high.cast<int>();
  Color sum = Color::Zero();
  for (int y = std::max(low.y(), 0); y < std::min(high.y(), lit.height()); ++y)
    for (int x = std::max(low.x(), 0); x < std::min(high.x(), lit.width()); ++x) sum += lit.color(x, y);
  return LinearRgb(sum * (kFullWindow_cd_per_m2 / (kFacadePixelsPerMetre * kFacadePixelsPerMetre)));
}

}  // namespace sunlit::scene::race_track
