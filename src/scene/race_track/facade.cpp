#include "scene/race_track/facade.h"

#include <cmath>
#include <optional>

namespace sunlit::scene::race_track {
namespace {

constexpr float kPixelsPerMetre = kFacadePixelsPerMetre;

void layBricks(Canvas& canvas, const FacadePlan& plan, Random& random) {
  constexpr float kCourse_px = 2.6f;
  constexpr float kBrick_px = 8.0f;
  const Color mortar(0.30f, 0.28f, 0.25f);
  for (int row = 0; row * kCourse_px < canvas.height(); ++row) {
    const float y = row * kCourse_px;
    for (float x = (row % 2) * -0.5f * kBrick_px; x < canvas.width(); x += kBrick_px) {
      const float blue = random.range(0.8f, 1.1f);
      const float green = random.range(0.85f, 1.1f);
      const Color tone = plan.wall * random.range(0.65f, 1.3f) * Color(1.0f, green, blue);
      canvas.rectangle({x, y}, {x + kBrick_px, y + kCourse_px}, {mortar, 0.9f});
      canvas.rectangle({x, y}, {x + kBrick_px - 1.0f, y + kCourse_px - 0.7f}, {tone, 1.0f});
    }
  }
}

void layBoards(Canvas& canvas, const FacadePlan& plan, Random& random) {
  const bool upright = plan.kind == WallKind::kSheet;
  const float pitch = upright ? 6.0f : 5.0f;
  const float w = static_cast<float>(canvas.width());
  const float h = static_cast<float>(canvas.height());
  for (float u = 0.0f; u < (upright ? w : h); u += pitch) {
    const Color tone = plan.wall * (upright ? random.range(0.88f, 1.08f) : random.range(0.7f, 1.25f));
    canvas.rectangle(upright ? Pixel(u, 0) : Pixel(0, u), upright ? Pixel(u + pitch, h) : Pixel(w, u + pitch),
                     {tone, 1.0f});
    canvas.rectangle(upright ? Pixel(u, 0) : Pixel(0, u), upright ? Pixel(u + 1.2f, h) : Pixel(w, u + 1.0f),
                     {0.5f * tone, 0.9f});
  }
}

// Sky above, trees below, a curtain behind: what a pane shows.
void glaze(Canvas& canvas, const Pixel& low, const Pixel& high, Random& random) {
  const Color sky(0.25f, 0.31f, 0.38f);
  const Color dark(0.018f, 0.022f, 0.024f);
  const float horizon = low.y() + (high.y() - low.y()) * random.range(0.3f, 0.7f);
  const float phase = random.range(0.0f, 100.0f);
  const float clear = random.range(0.15f, 0.8f);
  for (int y = static_cast<int>(low.y()); y < high.y(); ++y) {
    for (int x = static_cast<int>(low.x()); x < high.x(); ++x) {
      const float edge = horizon + 7.0f * fractal(0.12f * x + phase, phase, 3, 631u);
      const float above = smoothStep(1.5f, -1.5f, y - edge);
      canvas.blend(x, y, {dark + clear * above * (sky - dark), 1.0f});
    }
  }
  if (random.chance(0.45f)) {
    const Color curtain = Color(0.35f, 0.33f, 0.29f) * random.range(0.4f, 1.0f);
    const float w = (high.x() - low.x()) * random.range(0.15f, 0.4f);
    canvas.rectangle(low, {low.x() + w, high.y()}, {curtain, 0.6f});
    canvas.rectangle({high.x() - w, low.y()}, high, {curtain, 0.6f});
  }
}

/// What the windows of one front have in common.
struct WindowStyle {
  WindowStyle(const FacadePlan& plan, const Opening& opening) {
    Random random(632u, plan.seed);
    frame = random.chance(0.6f) ? Color(0.62f, 0.60f, 0.56f) : Color(0.16f, 0.09f, 0.05f);
    trim = random.range(0.4f, 0.9f) * Color(0.7f, 0.68f, 0.62f);
    for (int i = 0; i < (opening.width > 1.6f ? 3 : 2); ++i) barred.push_back(random.chance(0.5f));
    if (random.chance(0.35f)) shutter = Color(0.05f, 0.14f, 0.09f) * random.range(0.5f, 3.0f);
  }

  Color frame, trim;
  std::vector<bool> barred;  ///< one a pane
  std::optional<Color> shutter;
};

void paintOpening(Canvas& canvas, const FacadePlan& plan, const Opening& opening, Random& random) {
  const float h = static_cast<float>(canvas.height());
  const auto [low, high] = OpeningPixels(opening, h);
  const WindowStyle style(plan, opening);
  const Color& frame = style.frame;
  canvas.rectangle(low - Pixel(4, 4), high + Pixel(4, opening.door ? 0 : 4), {style.trim, 0.9f});
  canvas.rectangle(low - Pixel(1.5f, 1.5f), high + Pixel(1.5f, 1.5f), {0.3f * frame, 1.0f});
  canvas.rectangle(low, high, {frame * random.range(0.8f, 1.1f), 1.0f});
  if (opening.door) {
    const Color leaf = plan.wall.mean() > 0.3f ? Color(0.20f, 0.07f, 0.04f) : Color(0.06f, 0.16f, 0.20f);
    canvas.rectangle(low + Pixel(2, 2), high - Pixel(2, 0), {leaf * random.range(0.6f, 1.4f), 1.0f});
    glaze(canvas, low + Pixel(5, 5), {high.x() - 5, low.y() + 0.35f * (high.y() - low.y())}, random);
    canvas.rectangle({high.x() - 7, 0.5f * (low.y() + high.y())},
                     {high.x() - 4, 0.5f * (low.y() + high.y()) + 2}, {{0.6f, 0.55f, 0.4f}, 1.0f});
    return;
  }
  for (const Pane& pane : panesOf(plan, opening, h)) {
    glaze(canvas, pane.low, pane.high, random);
    if (pane.barred) canvas.rectangle(pane.barLow(), pane.barHigh(), {frame, 1.0f});
  }
  if (style.shutter) {
    const float half = 0.5f * (high.x() - low.x()) / static_cast<float>(style.barred.size());
    for (const float x : {low.x() - 4.0f - half, high.x() + 4.0f}) {
      canvas.rectangle({x, low.y()}, {x + half, high.y()}, {*style.shutter, 1.0f});
      for (float y = low.y(); y < high.y(); y += 3.0f)
        canvas.rectangle({x + 1, y}, {x + half - 1, y + 1}, {0.5f * *style.shutter, 1.0f});
    }
  }
  // Rain has washed dirt off the sill.
  for (int i = 0; i < 3; ++i) {
    const float x = random.range(low.x(), high.x());
    const float drop = random.range(6.0f, 26.0f);
    canvas.rectangle({x, high.y() + 4}, {x + random.range(1.0f, 3.0f), high.y() + 4 + drop},
                     {{0.06f, 0.055f, 0.045f}, 0.35f});
  }
}

}  // namespace

Canvas emptyFront(const FacadePlan& plan, const Color& color) {
  return Canvas(static_cast<int>(plan.width_m * kPixelsPerMetre),
                static_cast<int>(plan.height_m * kPixelsPerMetre), color);
}

OpeningPixels::OpeningPixels(const Opening& opening, float canvas_height)
    : low(opening.x * kPixelsPerMetre, canvas_height - (opening.z + opening.height) * kPixelsPerMetre),
      high((opening.x + opening.width) * kPixelsPerMetre, canvas_height - opening.z * kPixelsPerMetre) {}

std::vector<Pane> panesOf(const FacadePlan& plan, const Opening& opening, float canvas_height) {
  const std::vector<bool> barred = WindowStyle(plan, opening).barred;
  const auto [low, high] = OpeningPixels(opening, canvas_height);
  const float step = opening.width * kPixelsPerMetre / static_cast<float>(barred.size());
  std::vector<Pane> panes;
  for (std::size_t i = 0; i < barred.size(); ++i) {
    const float x = low.x() + static_cast<float>(i) * step;
    panes.push_back({{x + 1.5f, low.y() + 2.0f}, {x + step - 1.5f, high.y() - 2.0f}, barred[i]});
  }
  return panes;
}

std::vector<Opening> planOpenings(const FacadePlan& plan) {
  Random random(633u, plan.seed);
  const float storey = plan.height_m / static_cast<float>(plan.floors);
  const int columns = std::max(1, static_cast<int>(plan.width_m / random.range(2.2f, 3.0f)));
  const float pitch = plan.width_m / static_cast<float>(columns);
  const float width = std::min(random.range(0.9f, 1.8f), pitch - 0.6f);
  const int door = plan.has_door ? random.below(columns) : -1;
  std::vector<Opening> openings;
  for (int f = 0; f < plan.floors; ++f) {
    for (int c = 0; c < columns; ++c) {
      const float x = (static_cast<float>(c) + 0.5f) * pitch;
      if (f == 0 && c == door) {
        openings.push_back({x - 0.5f, 0.05f, 1.0f, 2.1f, true});
      } else if (random.chance(0.85f)) {
        openings.push_back(
            {x - 0.5f * width, f * storey + 0.95f, width, std::min(1.35f, storey - 1.35f), false});
      }
    }
  }
  return openings;
}

Canvas paintFacade(const FacadePlan& plan, const std::vector<Opening>& openings) {
  Random random(634u, plan.seed);
  Canvas canvas = emptyFront(plan, plan.wall);
  if (plan.kind == WallKind::kBrick) layBricks(canvas, plan, random);
  if (plan.kind == WallKind::kTimber || plan.kind == WallKind::kSheet) layBoards(canvas, plan, random);
  canvas.mottle(70.0f, 0.18f, random.bits());
  canvas.mottle(9.0f, 0.10f, random.bits());
  const float h = static_cast<float>(canvas.height());
  const float w = static_cast<float>(canvas.width());
  // A darker foot, splashed by rain.
  for (int y = static_cast<int>(h - 0.7f * kPixelsPerMetre); y < h; ++y) {
    const float wet = smoothStep(h - 0.7f * kPixelsPerMetre, h, static_cast<float>(y));
    for (int x = 0; x < w; ++x)
      canvas.blend(x, y,
                   {{0.11f, 0.10f, 0.085f}, 0.7f * wet * (0.6f + 0.4f * noise(0.06f * x, 0.1f * y, 635u))});
  }
  canvas.streaks(7, 0.3f, random);
  for (const Opening& opening : openings) paintOpening(canvas, plan, opening, random);
  if (random.chance(0.7f)) {
    const float x = random.chance(0.5f) ? 4.0f : w - 8.0f;
    canvas.rectangle({x, 0}, {x + 4, h}, {{0.20f, 0.20f, 0.20f}, 1.0f});
    canvas.rectangle({x + 4, 0}, {x + 6, h}, {{0.04f, 0.04f, 0.04f}, 0.5f});
  }
  return canvas;
}

}  // namespace sunlit::scene::race_track
