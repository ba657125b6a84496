#include "render/tile_detail.h"

#include <algorithm>

namespace sunlit::render {
namespace {

/// For up to DetailPoints::kCount entries of one material.
void applyTo(const TileDetail::Entry* entries, std::size_t count, const SceneDetail& scene,
             std::vector<light::Surface>* surfaces) {
  DetailPoints points;
  for (std::size_t i = 0; i < DetailPoints::kCount; ++i) {
    const TileDetail::Entry& entry = entries[i < count ? i : 0];
    points.x[i] = entry.middle.x();
    points.y[i] = entry.middle.y();
    points.z[i] = entry.middle.z();
    points.footprint[i] = entry.footprint;
    points.spread[i] = entry.spread;
  }
  const auto material = static_cast<std::size_t>(entries[0].material);
  std::array<float, DetailPoints::kCount> sums;
  sumOctaves(*scene.octaves[material], points, &sums);
  for (std::size_t i = 0; i < count; ++i) {
    Eigen::Array3f& albedo = (*surfaces)[entries[i].surface].albedo;
    albedo = (albedo * (1.0f + scene.tints[material] * sums[i])).max(0.0f).min(1.0f);
  }
}

}  // namespace

SceneDetail::SceneDetail(const scene::Scene& scene, const View& view)
    : octaves(scene.materials.size()), tints(scene.materials.size()) {
  for (std::size_t i = 0; i < scene.materials.size(); ++i) {
    const scene::Detail& detail = scene.materials[i].detail;
    tints[i] = detail.tint;
    if (detail.contrast > 0.0f) octaves[i].emplace(detail, view.eye());
  }
  sample_right = (view.pixelRight() / view.supersampling).cast<float>();
  sample_down = (view.pixelDown() / view.supersampling).cast<float>();
}

void TileDetail::add(const Entry& entry) {
  const auto material = static_cast<std::size_t>(entry.material);
  if (material >= entries_.size()) entries_.resize(material + 1);
  entries_[material].push_back(entry);
  // Seen exactly from the side, a surface has no finite footprint.
  static constexpr float kLargest_m = 1e9f;  // static, so that GCC before 11 needs no capture
  const auto bounded = [](float value) { return value < kLargest_m ? std::max(value, 1e-9f) : kLargest_m; };
  Entry& added = entries_[material].back();
  added.footprint = bounded(entry.footprint);
  added.spread = bounded(entry.spread);
}

void TileDetail::apply(const SceneDetail& scene, std::vector<light::Surface>* surfaces) {
  constexpr std::size_t kAtOnce = DetailPoints::kCount;
  for (std::vector<Entry>& entries : entries_) {
    for (std::size_t first = 0; first < entries.size(); first += kAtOnce)
      applyTo(&entries[first], std::min(kAtOnce, entries.size() - first), scene, surfaces);
    entries.clear();
  }
}

}  // namespace sunlit::render
