#include "light/picture/fog/lamp_glow.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>

#include "light/geometry/ray_list.h"
#include "sunlit/quantity/photometry.h"

namespace sunlit::light {
namespace {

/// px beside a tile within which a lamp still glows so unevenly that corners of cells do not tell.
constexpr float kMargin_px = 16.0f;
constexpr float kNowhere_px = -1e6f;
/// Of all that glows: a cone's edge changes more in the middle of a cell than corners tell.
constexpr float kUneven = 0.01f;
/// What a corner counts that looks less far than to a slice, or past one that is the last: what it knows may
/// be of another room, and counts where no other corner knows more.
constexpr float kUnlike = 0.01f;

GlowProfile dark() {
  GlowProfile profile;
  profile.before.fill(Eigen::Array3f::Zero());
  profile.last.fill(Eigen::Array3f::Zero());
  return profile;
}

/// cd/m², of all of the fog.
float luminanceOf(const GlowProfile& profile) {
  return LinearRgb(profile.before.back()).luminance();
}

Eigen::Array3f at(const GlowProfile& profile, float place) {
  const auto slice = std::min(static_cast<std::size_t>(place), FogSlices::kCount - 1);
  return profile.before[slice] + (place - static_cast<float>(slice)) * profile.last[slice];
}

/// Those that make all but a small share of the glow, by what of each may reach the eye, as they come.
std::vector<LampBeam> worthSeeing(const std::vector<scene::Lamp>& lamps, const sky::Fog& fog,
                                  const Eigen::Vector3f& eye, float left_out) {
  std::vector<LampBeam> beams;
  std::vector<float> most;
  for (const scene::Lamp& lamp : lamps) {
    const LampBeam& beam = beams.emplace_back(lamp);
    const Eigen::Vector3f way = beam.position() - eye;
    const float distance_m = std::max(way.norm(), 1.0f),
                in_fog_m = fog.within(way.z() / distance_m, distance_m);
    most.push_back(beam.brightest() / distance_m *
                   std::exp(-FogScatter::kLeastExtinction * fog.per_m * in_fog_m));
  }
  std::vector<std::size_t> order(beams.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return most[a] < most[b]; });
  float spared = left_out * std::accumulate(most.begin(), most.end(), 0.0f);
  std::vector<char> kept(beams.size(), 1);
  for (const std::size_t i : order) {
    spared -= most[i];
    if (spared < 0.0f) break;
    kept[i] = 0;
  }
  std::vector<LampBeam> worth;
  for (std::size_t i = 0; i < beams.size(); ++i) {
    if (kept[i] != 0) worth.push_back(beams[i]);
  }
  return worth;
}

}  // namespace

LampGlow::Lattice::Lattice(const Surfaces& surfaces, int cell)
    : cell_px(cell),
      columns((surfaces.width + cell - 1) / cell + 1),
      rows((surfaces.height + cell - 1) / cell + 1) {}

float LampGlow::Lattice::x(std::size_t i) const {
  return static_cast<float>(static_cast<int>(i % static_cast<std::size_t>(columns)) * cell_px) - 0.5f;
}

float LampGlow::Lattice::y(std::size_t i) const {
  return static_cast<float>(static_cast<int>(i / static_cast<std::size_t>(columns)) * cell_px) - 0.5f;
}

LampGlow::Among LampGlow::among(const Lattice& lattice, float x, float y) {
  const float column = (x + 0.5f) / static_cast<float>(lattice.cell_px),
              row = (y + 0.5f) / static_cast<float>(lattice.cell_px);
  const int left = std::clamp(static_cast<int>(column), 0, lattice.columns - 2),
            top = std::clamp(static_cast<int>(row), 0, lattice.rows - 2);
  const float right = column - static_cast<float>(left), down = row - static_cast<float>(top);
  const auto first = static_cast<std::size_t>(top * lattice.columns + left),
             below = first + static_cast<std::size_t>(lattice.columns);
  return {{first, first + 1, below, below + 1},
          {(1.0f - right) * (1.0f - down), right * (1.0f - down), (1.0f - right) * down, right * down}};
}

LampGlow::LampGlow(const std::vector<scene::Lamp>* lamps, const sky::Fog& fog, const Surfaces& surfaces,
                   const Visibility& visibility)
    : surfaces_(surfaces),
      fog_(fog),
      slices_(fog),
      corners_(surfaces, kCell),
      shadow_corners_(surfaces, kCell * kCellsOfShadow) {
  if (lamps == nullptr || lamps->empty() || !(fog.per_m > 0.0f)) return;
  beams_ = worthSeeing(*lamps, fog, surfaces.eye, kLeftOut);
  const PixelOfDirection pixels(surfaces);
  for (const LampBeam& beam : beams_) {
    scatter_.emplace_back(beam, fog, surfaces.eye);
    const auto place = pixels.at((beam.position() - surfaces.eye).normalized().cast<double>());
    pixels_.push_back(place ? Eigen::Vector2f(place->pixel.cast<float>())
                            : Eigen::Vector2f::Constant(kNowhere_px));
  }
  findSights(visibility);
  open_.resize(beams_.size());
  tbb::parallel_for(std::size_t{0}, beams_.size(), [&](std::size_t i) { findShadows(i, visibility); });
  profiles_.assign(corners_.size(), dark());
  of_spots_.resize(beams_.size());
  for (std::size_t lamp = 0; lamp < beams_.size(); ++lamp)
    if (beams_[lamp].isSpot()) of_spots_[lamp].resize(corners_.size());
  tbb::parallel_for(std::size_t{0}, corners_.size(), [&](std::size_t i) {
    for (std::size_t lamp = 0; lamp < beams_.size(); ++lamp) {
      const float others = luminanceOf(profiles_[i]);
      add(lamp, corners_.x(i), corners_.y(i), &profiles_[i]);
      if (beams_[lamp].isSpot()) of_spots_[lamp][i] = luminanceOf(profiles_[i]) - others;
    }
  });
}

void LampGlow::findSights(const Visibility& visibility) {
  RayList rays;
  rays.reserve(shadow_corners_.size());
  for (std::size_t i = 0; i < shadow_corners_.size(); ++i) {
    const Eigen::Vector3f towards = surfaces_.towards(shadow_corners_.x(i), shadow_corners_.y(i));
    sights_.push_back({towards, std::numeric_limits<float>::infinity()});
    rays.add(static_cast<std::uint32_t>(i), surfaces_.eye, towards);
  }
  std::vector<Hit> hits(rays.size());
  visibility.closest(rays.rays(), hits.data());
  for (std::size_t i = 0; i < hits.size(); ++i) {
    if (hits[i].triangle != Hit::kMiss)
      sights_[i].end_m = hits[i].distance - fog_.begins(sights_[i].towards.z());
  }
}

void LampGlow::findShadows(std::size_t lamp, const Visibility& visibility) {
  const LampBeam& beam = beams_[lamp];
  std::vector<OpenSlices>& open = open_[lamp];
  OpenSlices all;
  all.fill(1.0f);
  open.assign(shadow_corners_.size(), all);
  if (!beam.castsShadows()) return;
  RayList rays;
  rays.reserve(open.size() * FogSlices::kCount);
  for (std::size_t i = 0; i < open.size(); ++i) {
    const auto& [towards, seen_m] = sights_[i];
    if (!std::isfinite(fog_.begins(towards.z()))) continue;
    for (std::size_t slice = 0; slice < FogSlices::kCount; ++slice) {
      const float from_m = slices_.end(slice), end_m = slices_.end(slice + 1),
                  to_m = seen_m > from_m ? std::min(seen_m, end_m) : end_m;
      const Eigen::Vector3f point = scatter_[lamp].middle(towards, from_m, to_m);
      const Eigen::Vector3f way = beam.ball() - point;
      const float distance_m = way.norm();
      if (distance_m <= beam.spared_m()) continue;
      rays.add(static_cast<std::uint32_t>(i * FogSlices::kCount + slice), point,
               way * ((distance_m - beam.spared_m()) / distance_m));
    }
  }
  std::vector<std::uint8_t> blocked(rays.size());
  visibility.occludedWithin(rays.rays(), blocked.data());
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const std::size_t number = rays.number()[i];
    if (blocked[i] != 0) open[number / FogSlices::kCount][number % FogSlices::kCount] = 0.0f;
  }
}

LampOpen LampGlow::openAt(std::size_t lamp, float x, float y) const {
  const Among about = among(shadow_corners_, x, y);
  LampOpen open{}, weights{};
  for (std::size_t k = 0; k < 4; ++k) {
    const std::size_t corner = about.corners[k];
    const float end_m = sights_[corner].end_m;
    for (std::size_t slice = 0; slice < FogSlices::kCount; ++slice) {
      const bool reached = slices_.end(slice) < end_m, passed = slices_.end(slice + 1) < end_m;
      const float share = open_[lamp][corner][slice],
                  in_passed = about.weights[k] * (reached ? 1.0f : kUnlike),
                  in_last = in_passed * (passed ? kUnlike : 1.0f);
      open.passed[slice] += in_passed * share;
      open.last[slice] += in_last * share;
      weights.passed[slice] += in_passed;
      weights.last[slice] += in_last;
    }
  }
  for (std::size_t slice = 0; slice < FogSlices::kCount; ++slice) {
    open.passed[slice] /= weights.passed[slice];
    open.last[slice] /= weights.last[slice];
  }
  return open;
}

void LampGlow::add(std::size_t lamp, float x, float y, GlowProfile* profile) const {
  scatter_[lamp].addAlong(surfaces_.towards(x, y), slices_, openAt(lamp, x, y), profile);
}

std::vector<std::size_t> LampGlow::near(const Tile& tile) const {
  std::vector<std::size_t> near;
  for (std::size_t i = 0; i < pixels_.size(); ++i) {
    const Eigen::Vector2f& at = pixels_[i];
    const bool beside = at.x() > static_cast<float>(tile.x) - kMargin_px &&
                        at.y() > static_cast<float>(tile.y) - kMargin_px &&
                        at.x() < static_cast<float>(tile.x + tile.width) + kMargin_px &&
                        at.y() < static_cast<float>(tile.y + tile.height) + kMargin_px;
    if (beside || (beams_[i].isSpot() && endsIn(tile, i))) near.push_back(i);
  }
  return near;
}

bool LampGlow::endsIn(const Tile& tile, std::size_t lamp) const {
  constexpr float kHalf_px = 0.5f * static_cast<float>(kCell);
  for (int y = tile.y; y < tile.y + tile.height; y += kCell) {
    for (int x = tile.x; x < tile.x + tile.width; x += kCell) {
      const float right = static_cast<float>(x) - 0.5f + kHalf_px,
                  down = static_cast<float>(y) - 0.5f + kHalf_px;
      const Among about = among(corners_, right, down);
      float told = 0.0f, all = 0.0f;
      for (std::size_t k = 0; k < 4; ++k) {
        told += about.weights[k] * of_spots_[lamp][about.corners[k]];
        all += about.weights[k] * luminanceOf(profiles_[about.corners[k]]);
      }
      GlowProfile there = dark();
      add(lamp, right, down, &there);
      const float own = luminanceOf(there);
      if (std::abs(own - told) > kUneven * std::max(all, own)) return true;
    }
  }
  return false;
}

/// Its pixels' profiles: of the corners of its cells, and of the lamps about it.
class LampGlow::OfTile {
 public:
  OfTile(const LampGlow& glow, const Tile& tile) : glow_(glow), near_(glow.near(tile)) {
    if (near_.empty()) return;
    const Lattice& lattice = glow.corners_;
    for (int row = 0; row <= kCellsOfTile; ++row) {
      for (int column = 0; column <= kCellsOfTile; ++column) {
        const int x = std::min(tile.x / kCell + column, lattice.columns - 1),
                  y = std::min(tile.y / kCell + row, lattice.rows - 1);
        const auto corner = static_cast<std::size_t>(y * lattice.columns + x);
        Corner others{corner, dark()};
        for (std::size_t lamp = 0; lamp < glow.beams_.size(); ++lamp) {
          if (std::find(near_.begin(), near_.end(), lamp) == near_.end())
            glow.add(lamp, lattice.x(corner), lattice.y(corner), &others.profile);
        }
        corners_.push_back(others);
      }
    }
  }

  void find(int x, int y, GlowProfile* profile) const {
    const auto right = static_cast<float>(x), down = static_cast<float>(y);
    const Among about = among(glow_.corners_, right, down);
    *profile = dark();
    for (std::size_t k = 0; k < 4; ++k) {
      const GlowProfile& corner = at(about.corners[k]);
      for (std::size_t i = 0; i <= FogSlices::kCount; ++i)
        profile->before[i] += about.weights[k] * corner.before[i];
      for (std::size_t i = 0; i < FogSlices::kCount; ++i)
        profile->last[i] += about.weights[k] * corner.last[i];
    }
    for (const std::size_t lamp : near_) glow_.add(lamp, right, down, profile);
  }

 private:
  struct Corner {
    std::size_t number;
    GlowProfile profile;  ///< of the lamps that are not near
  };
  const GlowProfile& at(std::size_t corner) const {
    if (near_.empty()) return glow_.profiles_[corner];
    return std::find_if(corners_.begin(), corners_.end(),
                        [corner](const Corner& known) { return known.number == corner; })
        ->profile;
  }

  const LampGlow& glow_;
  std::vector<std::size_t> near_;
  std::vector<Corner> corners_;  ///< where lamps are near
};

void LampGlow::addTo(const Tile& tile, const SkyPixel& sky, image::LinearImage* image) const {
  if (profiles_.empty()) return;
  const OfTile of_tile(*this, tile);
  const float weight = 1.0f / static_cast<float>(surfaces_.samples_per_pixel);
  auto surface = tile.surfaces.begin();
  GlowProfile profile;
  for (int y = tile.y; y < tile.y + tile.height; ++y) {
    for (int x = tile.x; x < tile.x + tile.width; ++x) {
      Eigen::Map<Eigen::Array3f> pixel(image->at(x, y));
      of_tile.find(x, y, &profile);
      const auto number = static_cast<std::uint32_t>(y * surfaces_.width + x);
      for (; surface != tile.surfaces.end() && surface->pixel == number; ++surface) {
        const float distance_m =
            (surface->position - surfaces_.eye).norm() - fog_.begins(-surface->to_eye.z());
        pixel += at(profile, slices_.place(distance_m)) *
                 (weight * static_cast<float>(surface->samples) * surface->air_share);
      }
      if (SkyPixel::skySamples(tile, x, y) > 0) pixel += profile.before.back() * sky.skyShare(tile, x, y);
    }
  }
}

}  // namespace sunlit::light
