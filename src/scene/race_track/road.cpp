#include "scene/race_track/road.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "scene/race_track/ground.h"
#include "scene/race_track/road_paint.h"

namespace sunlit::scene::race_track {
namespace {

constexpr int kStretches = 26;
constexpr double kPixel_m = 0.0425;
// Painted beyond both ends, so that filtering does not reach round to the other end.
constexpr int kMargin_px = 12;
constexpr float kKerbHeight_m = 0.055f;

struct Column {
  double left;
  bool asphalt;  ///< towards the next column
  bool painted;  ///< towards the next column
};
// From right to left, so that faces look up.
constexpr Column kColumns[] = {{-14.0, false, false}, {-12.0, false, false}, {-10.0, false, false},
                               {-8.5, false, false},  {-6.98, false, true},  {-6.2, false, true},
                               {-5.7, false, true},   {-5.1, false, true},   {-4.5, true, true},
                               {-2.2, true, true},    {0.0, true, true},     {2.2, true, true},
                               {4.5, false, true},    {5.1, false, true},    {5.7, false, true},
                               {6.2, false, true},    {6.98, false, false},  {8.5, false, false},
                               {10.0, false, false},  {12.0, false, false},  {14.0, false, false}};
constexpr int kColumnCount = static_cast<int>(sizeof(kColumns) / sizeof(kColumns[0]));

Eigen::Vector3f stripPoint(double along, double left) {
  Eigen::Vector3f p = groundPoint(TrackPlace{along, left});
  const double side = std::abs(left);
  const double kerb = kerbWidth(along, left > 0 ? 1 : -1);
  if (kerb > 0.0 && side > kHalfWidth && side < kHalfWidth + kerb + 0.3) {
    const float rise = static_cast<float>((side - kHalfWidth) / kerb);
    p.z() += kKerbHeight_m * smoothStep(0.0f, 0.7f, rise);
  }
  // The strip dips into the open land at its rim, and lies just above it before.
  if (side > kStripHalfWidth - 0.1) {
    p.z() -= 0.35f;
  } else if (side > 8.0) {
    p.z() += 0.02f;
  }
  return p;
}

Eigen::Vector3f stripNormal(double along, double left) {
  constexpr double kStep = 0.3;
  const Eigen::Vector3f ahead =
      groundPoint(TrackPlace{along + kStep, left}) - groundPoint(TrackPlace{along - kStep, left});
  const Eigen::Vector3f across =
      groundPoint(TrackPlace{along, left + kStep}) - groundPoint(TrackPlace{along, left - kStep});
  return ahead.cross(across).normalized();
}

struct Stretch {
  double from;
  double to;
  int cells;
  float margin;  ///< of the picture, in texture coordinates
};

// The columns of one kind along one stretch, as one mesh.
Mesh stretchMesh(const Stretch& stretch, bool asphalt, bool painted) {
  Mesh mesh;
  for (int c = 0; c + 1 < kColumnCount; ++c) {
    if (kColumns[c].asphalt != asphalt || kColumns[c].painted != painted) continue;
    const std::uint32_t first = static_cast<std::uint32_t>(mesh.positions.size());
    for (int i = 0; i <= stretch.cells; ++i) {
      const float t = static_cast<float>(i) / static_cast<float>(stretch.cells);
      const double along = stretch.from + (stretch.to - stretch.from) * t;
      for (int k = 0; k < 2; ++k) {
        const double left = kColumns[c + k].left;
        mesh.positions.push_back(stripPoint(along, left));
        mesh.normals.push_back(stripNormal(along, left));
        const float v = static_cast<float>((kPaintedHalfWidth - left) / (2.0 * kPaintedHalfWidth));
        if (painted)
          mesh.texture_coordinates.emplace_back(stretch.margin + t * (1.0f - 2.0f * stretch.margin), v);
        if (!painted) mesh.colors.push_back(turfColor(course().point({along, left})));
      }
      if (i == stretch.cells) continue;
      const std::uint32_t a = first + 2u * static_cast<std::uint32_t>(i);
      mesh.triangles.push_back({a, a + 2, a + 3});
      mesh.triangles.push_back({a, a + 3, a + 1});
    }
  }
  return mesh;
}

int roadMaterial(Assembly& assembly, int texture, bool asphalt) {
  Material material;
  material.name = asphalt ? "asphalt" : "verge";
  material.base_color = LinearRgb(1.0f, 1.0f, 1.0f);
  material.base_texture = texture;
  material.roughness = asphalt ? 0.85f : 1.0f;
  material.detail.contrast = asphalt ? 0.22f : 0.38f;
  material.detail.coarsest_m = asphalt ? 0.6f : 6.0f;
  material.detail.finest_m = asphalt ? 0.009f : 0.012f;
  material.detail.gain = 0.95f;
  // As the open turf has it, so that no seam shows.
  if (!asphalt) material.detail.tint = {1.1f, 0.9f, 0.9f};
  return assembly.addMaterial(std::move(material));
}

std::vector<Kerb> findKerbs() {
  std::vector<Kerb> found;
  constexpr double kBend = 1.0 / 60.0;
  const double length = course().length();
  for (const int side : {1, -1}) {
    double start = -1.0;
    for (double s = 0.0; s < length; s += 1.0) {
      const bool bend = side * course().curvature(s) > kBend;
      if (bend && start < 0.0) start = s;
      if (bend || start < 0.0) continue;
      Random random(91u, static_cast<std::uint32_t>(s));
      const double width = random.range(0.9f, 1.5f);
      found.push_back({start - 4.0, s + 4.0, side, width});
      found.push_back({s + random.range(0.0f, 4.0f), s + random.range(16.0f, 24.0f), -side, 0.75 * width});
      start = -1.0;
    }
  }
  return found;
}

}  // namespace

const std::vector<Kerb>& kerbs() {
  static const std::vector<Kerb> instance = findKerbs();
  return instance;
}

double kerbWidth(double along, int side) {
  const double length = course().length();
  const double s = along - length * std::floor(along / length);
  double width = 0.0;
  for (const Kerb& kerb : kerbs()) {
    if (kerb.side == side && s > kerb.from && s < kerb.to) width = std::max(width, kerb.width);
  }
  return width;
}

void addRoad(Assembly& assembly) {
  const double length = course().length();
  const double step = length / kStretches;
  const int inner_px = static_cast<int>(std::lround(step / kPixel_m));
  const double margin_m = step * kMargin_px / inner_px;
  kerbs();
  std::array<Texture, kStretches> pictures;
  tbb::parallel_for(0, kStretches, [&](int i) {
    const RoadStretch stretch{i * step - margin_m, (i + 1) * step + margin_m, inner_px + 2 * kMargin_px};
    pictures[i] = paintRoad(stretch).texture("road " + std::to_string(i));
  });
  for (int i = 0; i < kStretches; ++i) {
    const int texture = assembly.addTexture(std::move(pictures[i]));
    const float margin = static_cast<float>(kMargin_px) / static_cast<float>(inner_px + 2 * kMargin_px);
    const Stretch stretch{i * step, (i + 1) * step, static_cast<int>(std::lround(step / 2.0)), margin};
    for (const bool asphalt : {true, false}) {
      Mesh mesh = stretchMesh(stretch, asphalt, true);
      mesh.material = roadMaterial(assembly, texture, asphalt);
      mesh.name = (asphalt ? "asphalt " : "verge ") + std::to_string(i);
      assembly.add(std::move(mesh));
    }
    Mesh rim = stretchMesh(stretch, false, false);
    rim.material = assembly.palette().grass;
    rim.name = "strip " + std::to_string(i);
    assembly.add(std::move(rim));
  }
}

}  // namespace sunlit::scene::race_track
