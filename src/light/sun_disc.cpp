#include "light/sun_disc.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "sunlit/quantity/angle.h"

namespace sunlit::light {
namespace {

/// Points of a Fibonacci spiral fill the disc evenly: point i of n at radius sqrt((i + ½) / n), i golden angles round.
constexpr int kDiscPoints = 16;
constexpr double kGoldenAngle = 2.39996322972865332;  ///< rad; π (3 − √5)
/// The order in which they are used. The first four lie near the rim, about 90° apart, so that hardly any shadow edge
/// can cross the disc without their telling; the others refine.
constexpr std::array<int, kDiscPoints> kOrder = {14, 8, 12, 10, 0, 1, 2, 3, 4, 5, 6, 7, 9, 11, 13, 15};
constexpr int kFirstPoints = 4;

struct DiscPoints {
  std::array<Eigen::Vector2f, kDiscPoints> at;
  DiscPoints() {
    for (int i = 0; i < kDiscPoints; ++i) {
      const double radius = std::sqrt((i + 0.5) / kDiscPoints);
      at[static_cast<std::size_t>(i)] = {static_cast<float>(radius * std::cos(kGoldenAngle * i)),
                                         static_cast<float>(radius * std::sin(kGoldenAngle * i))};
    }
  }
};

const DiscPoints& discPoints() {
  static const DiscPoints points;
  return points;
}

/// A fixed, well-mixed angle per pixel turns what would be bands in a penumbra into fine grain that stands still.
float pixelAngle(std::uint32_t pixel) {
  std::uint32_t h = pixel * 747796405u + 2891336453u;  // PCG-RXS-M-XS, O'Neill 2014
  h = ((h >> ((h >> 28u) + 4u)) ^ h) * 277803737u;
  h = (h >> 22u) ^ h;
  return static_cast<float>(h) * static_cast<float>(2.0 * kPi / 4294967296.0);
}

}  // namespace

struct SunDisc::RayList {
  std::vector<float> ox, oy, oz, dx, dy, dz;
  std::vector<std::uint32_t> surface;
  void clear() {
    for (auto* list : {&ox, &oy, &oz, &dx, &dy, &dz}) list->clear();
    surface.clear();
  }
};

/// What the rays of one surface met.
struct SunDisc::Tally {
  int cast = 0;
  int lit = 0;
  bool mixed() const { return lit > 0 && lit < cast; }
};

SunDisc::SunDisc(const sky::DiscLight& sun, const Visibility& visibility, const scene::Scene& scene,
                 int samples_per_pixel)
    : visibility_(visibility),
      scene_(scene),
      samples_per_pixel_(samples_per_pixel),
      shines_(sun.illuminance.value.maxCoeff() > 0.0f),
      towards_(sun.towards.vector().cast<float>()),
      radius_rad_(static_cast<float>(sun.angular_radius.rad())) {
  const Eigen::Vector3f across =
      std::abs(towards_.z()) < 0.9f ? Eigen::Vector3f::UnitZ() : Eigen::Vector3f::UnitX();
  right_ = across.cross(towards_).normalized() * std::tan(radius_rad_);
  up_ = towards_.cross(right_);
}

/// Foliage shades itself leaf by leaf: more rays cost much there, and what they would smooth is hidden in the leaves.
bool SunDisc::worthRefining(const Surface& surface, const Tally& tally) const {
  return tally.mixed() &&
         scene_.materials[static_cast<std::size_t>(surface.material)].alpha_mode == scene::AlphaMode::kOpaque;
}

int SunDisc::firstRays(const Surface& surface) const {
  // One a sample; but a whole pixel gets all of the first points, however few samples it has.
  const int samples = static_cast<int>(surface.samples);
  return std::max(samples, kFirstPoints * samples / samples_per_pixel_);
}

void SunDisc::appendRays(const Tile& tile, const Surface& surface, bool refine, RayList* rays) const {
  const float angle = pixelAngle(surface.pixel);
  const float cosine = std::cos(angle);
  const float sine = std::sin(angle);
  const int begin = refine ? firstRays(surface) : 0;
  const int end = refine ? std::max(begin, kDiscPoints) : firstRays(surface);
  const auto surface_index = static_cast<std::uint32_t>(&surface - tile.surfaces.data());
  for (int i = begin; i < end; ++i) {
    const int point = kOrder[static_cast<std::size_t>(i % kDiscPoints)];
    const Eigen::Vector2f& at = discPoints().at[static_cast<std::size_t>(point)];
    const Eigen::Vector3f direction = towards_ + (cosine * at.x() - sine * at.y()) * right_ +
                                      (sine * at.x() + cosine * at.y()) * up_;
    const std::uint32_t sample = surface.first_sample + static_cast<std::uint32_t>(i) % surface.samples;
    // A ray below the surface's own plane starts inside it: the part of the disc there is hidden.
    const bool above = surface.geometric_normal.dot(direction) > 0.0f;
    rays->surface.push_back(above ? surface_index : surface_index | 0x80000000u);
    rays->ox.push_back(tile.origin_x[sample]);
    rays->oy.push_back(tile.origin_y[sample]);
    rays->oz.push_back(tile.origin_z[sample]);
    rays->dx.push_back(direction.x());
    rays->dy.push_back(direction.y());
    rays->dz.push_back(direction.z());
  }
}

void SunDisc::cast(const Tile& tile, bool refine, std::vector<Tally>* tallies) const {
  thread_local RayList rays;
  thread_local std::vector<std::uint8_t> blocked;
  rays.clear();
  for (std::size_t i = 0; i < tile.surfaces.size(); ++i) {
    const Surface& surface = tile.surfaces[i];
    if (refine && !worthRefining(surface, (*tallies)[i])) continue;
    if (surface.geometric_normal.dot(towards_) < -std::sin(radius_rad_)) continue;  // the whole disc is behind it
    appendRays(tile, surface, refine, &rays);
  }
  blocked.assign(rays.surface.size(), 0);
  visibility_.occluded({rays.ox.data(), rays.oy.data(), rays.oz.data(), rays.dx.data(), rays.dy.data(),
                        rays.dz.data(), rays.surface.size()},
                       blocked.data());
  for (std::size_t i = 0; i < rays.surface.size(); ++i) {
    Tally& tally = (*tallies)[rays.surface[i] & 0x7fffffffu];
    ++tally.cast;
    if ((rays.surface[i] & 0x80000000u) == 0 && !blocked[i]) ++tally.lit;
  }
}

std::vector<float> SunDisc::visibleShares(const Tile& tile) const {
  std::vector<Tally> tallies(tile.surfaces.size());
  std::vector<float> shares(tile.surfaces.size(), 0.0f);
  if (!shines_) return shares;
  cast(tile, false, &tallies);
  cast(tile, true, &tallies);
  for (std::size_t i = 0; i < shares.size(); ++i) {
    if (tallies[i].cast > 0) shares[i] = static_cast<float>(tallies[i].lit) / static_cast<float>(tallies[i].cast);
  }
  return shares;
}

}  // namespace sunlit::light
