#include "light/lamps/lamp_light.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "light/angles.h"
#include "light/light_table.h"
#include "light/ray_list.h"
#include "sunlit/light/shading.h"
#include "sunlit/quantity/angle.h"

namespace sunlit::light {
namespace {

constexpr int kPoints = 16, kFirst = 2, kPeriod = 4;
/// How far a pixel looks for others that find it otherwise, px.
constexpr int kReach = 2;
constexpr std::uint8_t kLit = 1, kDark = 2;

/// Points that fill the unit disc evenly (a Fibonacci spiral), those at the rim first: they tell best whether
/// an edge crosses the disc. Turned differently for each of 4 × 4 pixels, the same in all such blocks.
using PointsOfPixel = std::array<Eigen::Vector2f, kPoints>;

const PointsOfPixel& pointsOf(int x, int y) {
  static const std::array<PointsOfPixel, kPeriod* kPeriod> all = [] {
    std::array<PointsOfPixel, kPeriod * kPeriod> made;
    for (std::size_t pixel = 0; pixel < made.size(); ++pixel) {
      // Neighbours are turned by far apart shares of the angle between two points of a quarter's ring.
      const double turned = 2.0 * kPi * static_cast<double>(pixel * 5 % made.size()) / 16.0;
      for (int i = 0; i < kPoints; ++i) {
        const int point = kPoints - 1 - i;
        const double radius = std::sqrt((point + 0.5) / kPoints), turn = kGoldenAngle * point + turned;
        made[pixel][static_cast<std::size_t>(i)] =
            Eigen::Vector2d(radius * std::cos(turn), radius * std::sin(turn)).cast<float>();
      }
    }
    return made;
  }();
  return all[static_cast<std::size_t>(y % kPeriod * kPeriod + x % kPeriod)];
}

Eigen::AlignedBox3f boxOf(const Tile& tile) {
  Eigen::AlignedBox3f box;
  for (const Surface& surface : tile.surfaces) box.extend(surface.position);
  return box;
}

/// What rays of one lamp met in a tile, a pixel each: kLit, kDark or both.
class Met {
 public:
  void note(int x, int y, std::uint8_t what) { at_[index(x)][index(y)] |= what; }
  bool mixedAround(int x, int y) const {
    std::uint8_t found = 0;
    for (int i = std::max(x - kReach, 0); i <= std::min(x + kReach, Surfaces::kTileSize - 1); ++i)
      for (int k = std::max(y - kReach, 0); k <= std::min(y + kReach, Surfaces::kTileSize - 1); ++k)
        found |= at_[index(i)][index(k)];
    return found == (kLit | kDark);
  }

 private:
  static std::size_t index(int i) { return static_cast<std::size_t>(i); }
  std::array<std::array<std::uint8_t, Surfaces::kTileSize>, Surfaces::kTileSize> at_ = {};
};

}  // namespace

LampLight::LampLight(const std::vector<scene::Lamp>& lamps, float day_lx, const Picture& picture)
    : beams_(lamps.begin(), lamps.end()), day_lx_(day_lx), picture_(picture) {}

/// Without those, weakest first, whose sum is at most half of kLeftOut everywhere in the tile.
std::vector<std::uint32_t> LampLight::lampsOf(const Tile& tile) const {
  const Eigen::AlignedBox3f box = boxOf(tile);
  std::vector<std::pair<float, std::uint32_t>> at_most;
  float certain = day_lx_;
  for (std::uint32_t i = 0; i < beams_.size(); ++i) {
    const LampBeam::Bounds bounds = beams_[i].within(box);
    certain += bounds.low;
    if (bounds.high > 0.0f) at_most.emplace_back(bounds.high, i);
  }
  std::sort(at_most.begin(), at_most.end());
  std::vector<std::uint32_t> chosen;
  float left_out = 0.0f;
  for (const auto& [high, lamp] : at_most) {
    left_out += high;
    if (left_out > 0.5f * kLeftOut * certain) chosen.push_back(lamp);
  }
  std::sort(chosen.begin(), chosen.end());
  return chosen;
}

std::vector<LampLight::Target> LampLight::targetsOf(const LampBeam& beam, const Tile& tile,
                                                    const std::vector<float>& least_lx) const {
  std::vector<Target> targets;
  const auto width = static_cast<std::uint32_t>(picture_.surfaces.width);
  for (std::uint32_t i = 0; i < tile.surfaces.size(); ++i) {
    const Surface& surface = tile.surfaces[i];
    if (!(beam.brightestAt(surface.position) > least_lx[i])) continue;
    const scene::Material& material = picture_.scene.materials[static_cast<std::size_t>(surface.material)];
    const Eigen::Vector3f way = beam.position() - surface.position;
    const float distance_m = std::max(way.norm(), 1e-6f);
    const Eigen::Vector3f towards = way / distance_m;
    if (surface.geometric_normal.dot(towards) <= 0.0f && !(material.transmission > 0.0f)) continue;
    const Eigen::Array3f luminance =
        directReflectance(reflectionOf(surface, material), towards, std::atan(beam.radius_m() / distance_m)) *
        beam.at(surface.position);
    if (!(luminance.maxCoeff() > 0.0f)) continue;
    targets.push_back({i, luminance, static_cast<std::uint8_t>(surface.pixel % width % Surfaces::kTileSize),
                       static_cast<std::uint8_t>(surface.pixel / width % Surfaces::kTileSize), 0, 0});
  }
  return targets;
}

void LampLight::cast(const LampBeam& beam, const Tile& tile, const std::vector<Target*>& targets,
                     int up_to) const {
  thread_local RayList rays;
  thread_local std::vector<std::uint8_t> blocked;
  rays.clear();
  rays.reserve(targets.size() * kPoints);
  for (std::uint32_t k = 0; k < targets.size(); ++k) {
    Target& target = *targets[k];
    const Surface& surface = tile.surfaces[target.surface];
    const PointsOfPixel& points = pointsOf(target.x, target.y);
    for (; target.cast < up_to; ++target.cast) {
      const std::uint32_t at = surface.first_sample + (target.cast + target.x + target.y) % surface.samples;
      Eigen::Vector3f origin(tile.origin_x[at], tile.origin_y[at], tile.origin_z[at]);
      const Eigen::Vector3f middle = beam.position() - origin;
      const bool behind = surface.geometric_normal.dot(middle) <= 0.0f;
      if (behind) origin -= 2.0f * surface.clearance_m * surface.geometric_normal;
      const float distance_m = middle.norm();
      // What lies within the lamp's ball, such as its bulb, is part of it and hides nothing.
      if (distance_m <= beam.radius_m() + surface.clearance_m) {
        ++target.lit;
        continue;
      }
      const Eigen::Vector3f aside = LampBeam::across(middle / distance_m) *
                                    (beam.radius_m() * points[static_cast<std::size_t>(target.cast)]);
      const float reach = 1.0f - (beam.radius_m() + surface.clearance_m) / distance_m;
      rays.add(k, origin, reach * (middle + aside));
    }
  }
  blocked.resize(rays.size());
  picture_.visibility.occludedWithin(rays.rays(), blocked.data());
  for (std::size_t i = 0; i < rays.size(); ++i) targets[rays.number()[i]]->lit += 1 - blocked[i];
}

void LampLight::findShadows(const LampBeam& beam, const Tile& tile, std::vector<Target>* targets) const {
  std::vector<Target*> asked;
  asked.reserve(targets->size());
  for (Target& target : *targets) asked.push_back(&target);
  cast(beam, tile, asked, kFirst);
  Met met;
  for (const Target& target : *targets) {
    if (target.lit > 0) met.note(target.x, target.y, kLit);
    if (target.lit < target.cast) met.note(target.x, target.y, kDark);
  }
  asked.clear();
  for (Target& target : *targets)
    if (met.mixedAround(target.x, target.y)) asked.push_back(&target);
  cast(beam, tile, asked, kPoints);
}

void LampLight::light(const Tile& tile, std::vector<Eigen::Array3f>* luminances) const {
  luminances->clear();
  if (beams_.empty() || tile.surfaces.empty()) return;
  const std::vector<std::uint32_t> lamps = lampsOf(tile);
  if (lamps.empty()) return;
  luminances->assign(tile.surfaces.size(), Eigen::Array3f::Zero());
  // The other half of kLeftOut: what each of the lamps may fall short of at each surface.
  std::vector<float> least_lx(tile.surfaces.size());
  const float each = 0.5f * kLeftOut / static_cast<float>(lamps.size());
  for (std::size_t i = 0; i < least_lx.size(); ++i) {
    float sum = day_lx_;
    for (const std::uint32_t lamp : lamps) sum += beams_[lamp].brightestAt(tile.surfaces[i].position);
    least_lx[i] = each * sum;
  }
  for (const std::uint32_t lamp : lamps) {
    const LampBeam& beam = beams_[lamp];
    std::vector<Target> targets = targetsOf(beam, tile, least_lx);
    if (beam.castsShadows()) findShadows(beam, tile, &targets);
    for (const Target& target : targets) {
      const float seen =
          target.cast == 0 ? 1.0f : static_cast<float>(target.lit) / static_cast<float>(target.cast);
      (*luminances)[target.surface] += seen * target.unhidden;
    }
  }
}

}  // namespace sunlit::light
