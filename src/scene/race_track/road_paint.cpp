#include "scene/race_track/road_paint.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "scene/race_track/ground.h"
#include "scene/race_track/road.h"
#include "scene/race_track/road_wear.h"

namespace sunlit::scene::race_track {
namespace {

const Color kWhitePaint(0.62f, 0.61f, 0.57f);
const Color kRedPaint(0.42f, 0.035f, 0.025f);

// What is the same for all texels of one column of the picture.
struct Slice {
  double along;
  Eigen::Vector2d centre;
  Eigen::Vector2d left;
  float line;     // driving line, left
  float rubber;   // strength of the tyre tracks
  float tone;     // of this surfacing
  float seam;     // how far its seams have wandered
  float edge[2];  // where the asphalt ends: right, left
  float kerb[2];  // width of kerbs: right, left
  Color kerb_color[2];
  Color turf[2];      // at the asphalt
  Color far_turf[2];  // where the picture ends
};

Color kerbBlock(double along, int side) {
  // Blocks of about a metre, no two of the same length or wear.
  const int block = static_cast<int>(std::floor(along + 0.16 * noise(static_cast<float>(along), 2.0f, 61u)));
  const std::uint32_t h = mix(static_cast<std::uint32_t>(block), static_cast<std::uint32_t>(side + 1), 62u);
  const float fade = 0.65f + 0.35f * static_cast<float>(h & 255u) / 255.0f;
  const Color base = block % 2 == 0 ? kRedPaint : kWhitePaint;
  return base * fade + (1.0f - fade) * Color(0.25f, 0.22f, 0.19f);
}

Slice sliceAt(double along) {
  Slice slice;
  slice.along = along;
  slice.centre = course().point({along, 0.0});
  slice.left = leftOf(course().tangent(along));
  slice.line = static_cast<float>(course().drivingLine(along));
  const float s = static_cast<float>(along);
  slice.rubber =
      0.20f + 0.35f * std::min(1.0f, 30.0f * static_cast<float>(std::abs(course().curvature(along + 8.0)))) +
      0.12f * noise(s / 17.0f, 5.0f, 63u);
  // Surfaced piecewise, over the years.
  const float joint = s / 88.0f + 0.4f * noise(s / 88.0f, 1.0f, 64u);
  const std::uint32_t piece = mix(static_cast<std::uint32_t>(static_cast<int>(std::floor(joint))), 65u);
  slice.tone = 0.080f + 0.055f * static_cast<float>(piece & 1023u) / 1023.0f;
  slice.seam = 0.15f * noise(s / 9.0f, 1.0f, 72u);
  for (int k = 0; k < 2; ++k) {
    const int side = k == 0 ? -1 : 1;
    slice.edge[k] = static_cast<float>(kHalfWidth) + 0.16f * fractal(s / 1.4f, 3.0f * k, 4, 66u);
    slice.kerb[k] = static_cast<float>(kerbWidth(along, side));
    slice.kerb_color[k] = kerbBlock(along, side);
    slice.turf[k] = turfColor(slice.centre + kHalfWidth * side * slice.left);
    slice.far_turf[k] = turfColor(slice.centre + kPaintedHalfWidth * side * slice.left);
  }
  return slice;
}

// How much rubber lies so far from the driving line, m: most under the wheels, some between them. From a
// table, which is cheaper than exponentials for every pixel.
float wheelTrack(float distance) {
  constexpr int kPerMetre = 64;
  static const std::array<float, 10 * kPerMetre> table = [] {
    std::array<float, 10 * kPerMetre> values;
    for (std::size_t i = 0; i < values.size(); ++i) {
      const float d = static_cast<float>(i) / kPerMetre;
      values[i] = std::exp(-(d - 0.75f) * (d - 0.75f) / 0.18f) + 0.45f * std::exp(-d * d / 3.0f);
    }
    return values;
  }();
  return table[std::min(static_cast<std::size_t>(distance * kPerMetre), table.size() - 1)];
}

Color asphalt(const Slice& slice, float left, float x, float y) {
  const float s = static_cast<float>(slice.along);
  float tone = slice.tone * (1.0f + 0.24f * fractal(x / 3.5f, y / 3.5f, 3, 71u));
  // Longitudinal seams of the paver, and lanes laid on different days.
  tone *= 1.0f + 0.07f * noise(left * 0.6f + slice.seam, s / 160.0f, 73u);
  // Grains of stone.
  const std::uint32_t grain = squareHash(25.0f * x, 25.0f * y, 74u);
  tone *=
      0.88f + 0.24f * static_cast<float>(grain & 255u) / 255.0f + ((grain >> 8) % 61u == 0u ? 0.5f : 0.0f);
  // Rubber where the wheels run.
  const float track = wheelTrack(std::abs(left - slice.line));
  tone *= 1.0f - slice.rubber * std::min(1.0f, track) * (0.75f + 0.4f * noise(s / 3.0f, left * 2.5f, 75u));
  Color color = tone * Color(1.03f, 1.0f, 0.95f);
  // Dust gathers off the line.
  if (std::abs(left) < 2.6f) return color;
  const float dust =
      0.5f * smoothStep(2.6f, 4.6f, std::abs(left)) * (0.6f + 0.5f * fractal(x / 1.6f, y / 1.6f, 3, 76u));
  return color + std::max(0.0f, dust) * (Color(0.19f, 0.16f, 0.12f) - color);
}

Color turf(const Slice& slice, float left, float x, float y) {
  const int k = left > 0.0f;
  const float out = std::abs(left) - static_cast<float>(kHalfWidth);
  const float outermost = static_cast<float>(kPaintedHalfWidth - kHalfWidth);
  const float way = std::min(1.0f, out / outermost);
  Color color = slice.turf[k] + way * (slice.far_turf[k] - slice.turf[k]);
  // Fades out towards the rim, where plain turf takes over.
  const float strength = 1.0f - smoothStep(0.6f, 1.0f, way);
  const float clump = strength * fractal(x / 0.35f, y / 0.35f, 3, 81u);
  color *= 1.0f + 0.55f * clump;
  const float hue = strength * noise(x / 0.8f, y / 0.8f, 82u);
  color *= Color(1.0f + 0.22f * hue, 1.0f, 1.0f - 0.12f * hue);
  // Trodden soil and stones next to the asphalt.
  const float bare = (1.0f - smoothStep(0.1f, 1.1f, out + 0.7f * fractal(x / 1.3f, y / 1.3f, 3, 83u)));
  color += 0.85f * bare * (Color(0.17f, 0.135f, 0.10f) * (1.0f + 0.4f * clump) - color);
  const std::uint32_t pebble = squareHash(22.0f * x, 22.0f * y, 84u);
  if (static_cast<float>(pebble & 1023u) < 140.0f * bare)
    color = Color(0.26f, 0.24f, 0.21f) * (0.5f + (pebble >> 24) / 255.0f);
  return color;
}

Color edgeLine(const Slice& slice, float left, const Color& below) {
  const float inset = std::abs(left) - 4.14f;
  if (inset < 0.0f || inset > 0.16f) return below;
  const float s = static_cast<float>(slice.along);
  const float worn = smoothStep(
      -0.1f, 0.6f, fractal(s / 1.1f, left * 4.0f, 4, 85u) + 0.5f * fractal(s / 13.0f, left, 2, 86u));
  return below + (0.92f - 0.85f * worn) * (kWhitePaint - below);
}

Color kerb(const Slice& slice, float left, float x, float y) {
  const int k = left > 0.0f;
  Color color = slice.kerb_color[k];
  const float s = static_cast<float>(slice.along);
  const float chips = smoothStep(0.15f, 0.55f, fractal(x / 0.5f, y / 0.5f, 4, 87u));
  color += 0.75f * chips * (Color(0.30f, 0.28f, 0.25f) - color);
  // Rubber smeared along it.
  const float smear = smoothStep(0.0f, 0.7f, fractal(s / 2.6f, left * 7.0f, 3, 88u));
  color *= 1.0f - 0.55f * smear;
  return color * (1.0f + 0.12f * fractal(x / 0.08f, y / 0.08f, 2, 89u));
}

Color surface(const Slice& slice, float left) {
  const Eigen::Vector2d p = slice.centre + static_cast<double>(left) * slice.left;
  const float x = static_cast<float>(p.x());
  const float y = static_cast<float>(p.y());
  const int k = left > 0.0f;
  const float side = std::abs(left);
  const float hard = static_cast<float>(kHalfWidth);
  if (slice.kerb[k] > 0.0f && side > hard && side < hard + slice.kerb[k]) return kerb(slice, left, x, y);
  const float edge = slice.kerb[k] > 0.0f ? hard : slice.edge[k];
  const float blend = smoothStep(edge - 0.03f, edge + 0.03f, side);
  if (blend >= 1.0f) return turf(slice, left, x, y);
  const Color road = edgeLine(slice, left, asphalt(slice, left, x, y));
  return blend > 0.0f ? Color(road + blend * (turf(slice, left, x, y) - road)) : road;
}

}  // namespace

Canvas paintRoad(const RoadStretch& stretch) {
  Canvas canvas(stretch.width_px, kPaintedHeight_px, Color::Zero());
  for (int i = 0; i < stretch.width_px; ++i) {
    const double t = (i + 0.5) / stretch.width_px;
    const Slice slice = sliceAt(stretch.from + t * (stretch.to - stretch.from));
    for (int j = 0; j < kPaintedHeight_px; ++j) {
      const double left = kPaintedHalfWidth * (1.0 - 2.0 * (j + 0.5) / kPaintedHeight_px);
      canvas.color(i, j) = surface(slice, static_cast<float>(left));
    }
  }
  addWear(canvas, stretch);
  addMarkings(canvas, stretch);
  return canvas;
}

}  // namespace sunlit::scene::race_track
