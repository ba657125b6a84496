#include "light/sun_disc.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "sunlit/quantity/angle.h"

namespace sunlit::light {
namespace {

/// The same points for every pixel: a penumbra then consists of fine steps that lie still in the world, from
/// wherever it is seen. Points that vary from pixel to pixel would turn them into grain that clings to the
/// screen, and feature detectors find grain. Points of a Fibonacci spiral fill the disc evenly: point i of n
/// at radius sqrt((i + ½) / n), i golden angles round.
constexpr int kDiscPoints = 16;
constexpr double kGoldenAngle = 2.39996322972865332;  ///< rad; π (3 − √5)
/// The order in which they are used. The first four lie near the rim, about 90° apart, so that hardly any
/// shadow edge can cross the disc without their telling; the others refine.
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
                 const Surfaces& surfaces)
    : visibility_(visibility),
      scene_(scene),
      surfaces_(surfaces),
      shines_(sun.illuminance.value.maxCoeff() > 0.0f),
      towards_(sun.towards.vector().cast<float>()),
      radius_rad_(static_cast<float>(sun.angular_radius.rad())) {
  const Eigen::Vector3f across =
      std::abs(towards_.z()) < 0.9f ? Eigen::Vector3f::UnitZ() : Eigen::Vector3f::UnitX();
  right_ = across.cross(towards_).normalized() * std::tan(radius_rad_);
  up_ = towards_.cross(right_);
}

/// Surfaces whose rays disagree, and those amid such: a mesh or a treetop may stop all of one pixel's first
/// rays by chance, which would show as a dark dot. Not masked surfaces themselves: foliage shades itself leaf
/// by leaf, more rays cost much there, and what they would smooth is hidden in the leaves.
std::vector<bool> SunDisc::worthRefining(const Tile& tile, const std::vector<Tally>& tallies) const {
  constexpr int kStride = Surfaces::kTileSize + 2;  // with a margin, so that every pixel has eight neighbours
  std::array<std::uint8_t, kStride * kStride> mixed{};
  const auto place = [&](const Surface& surface) {
    const int x = static_cast<int>(surface.pixel) % surfaces_.width - tile.x;
    const int y = static_cast<int>(surface.pixel) / surfaces_.width - tile.y;
    return static_cast<std::size_t>((y + 1) * kStride + x + 1);
  };
  for (std::size_t i = 0; i < tallies.size(); ++i) {
    if (tallies[i].mixed()) mixed[place(tile.surfaces[i])] = 1;
  }
  std::vector<bool> worth(tallies.size(), false);
  for (std::size_t i = 0; i < tallies.size(); ++i) {
    const Surface& surface = tile.surfaces[i];
    const auto material = static_cast<std::size_t>(surface.material);
    if (tallies[i].cast == 0 || scene_.materials[material].alpha_mode == scene::AlphaMode::kMask) continue;
    const std::size_t at = place(surface);
    int around = 0;
    for (const std::size_t row : {at - kStride, at, at + kStride})
      around += mixed[row - 1] + mixed[row] + mixed[row + 1];
    worth[i] = tallies[i].mixed() || around >= 4;  // beside a straight edge there are three
  }
  return worth;
}

int SunDisc::firstRays(const Surface& surface) const {
  // One a sample; but a whole pixel gets all of the first points, however few samples it has.
  const int samples = static_cast<int>(surface.samples);
  return std::max(samples, kFirstPoints * samples / surfaces_.samples_per_pixel);
}

void SunDisc::appendRays(const Tile& tile, const Surface& surface, bool refine, RayList* rays) const {
  const int begin = refine ? firstRays(surface) : 0;
  const int end = refine ? std::max(begin, kDiscPoints) : firstRays(surface);
  const auto surface_index = static_cast<std::uint32_t>(&surface - tile.surfaces.data());
  for (int i = begin; i < end; ++i) {
    const int point = kOrder[static_cast<std::size_t>(i % kDiscPoints)];
    const Eigen::Vector2f& at = discPoints().at[static_cast<std::size_t>(point)];
    const Eigen::Vector3f direction = towards_ + at.x() * right_ + at.y() * up_;
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
  const std::vector<bool> worth = refine ? worthRefining(tile, *tallies) : std::vector<bool>();
  for (std::size_t i = 0; i < tile.surfaces.size(); ++i) {
    const Surface& surface = tile.surfaces[i];
    if (refine && !worth[i]) continue;
    if (surface.geometric_normal.dot(towards_) < -std::sin(radius_rad_))
      continue;  // the whole disc is behind it
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
    if (tallies[i].cast > 0)
      shares[i] = static_cast<float>(tallies[i].lit) / static_cast<float>(tallies[i].cast);
  }
  return shares;
}

}  // namespace sunlit::light
