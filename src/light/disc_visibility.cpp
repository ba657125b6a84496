#include "light/disc_visibility.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "light/angles.h"
#include "light/ray_list.h"

namespace sunlit::light {
namespace {

/// What probes met, as bits of one byte.
constexpr std::uint8_t kLit = 1, kDark = 2;

/// Points of a Fibonacci spiral fill the disc evenly: point i of n at radius sqrt((i + ½) / n). These are the
/// orders in which they are used, the same for every pixel of the same parity: a penumbra then consists of
/// fine steps that lie still in the world. Points at random would turn it into grain that clings to the
/// screen, and feature detectors find grain. The first four lie near the rim, about 90° apart, so that hardly
/// any shadow edge can cross the disc without their telling. They are the same in all pixels: with others in
/// odd pixels, where x + y is odd, the error of thin shadows was a tenth larger. The first half of the points
/// fills the disc evenly, too: half of them outer ones, and of the inner ones those of even number in even
/// pixels and those of odd number in odd ones, so that neighbours complete each other.
constexpr std::array<std::array<int, 16>, 2> kOrder = {
    {{14, 8, 12, 10, 0, 2, 4, 6, 1, 3, 5, 7, 9, 11, 13, 15},
     {14, 8, 12, 10, 1, 3, 5, 7, 0, 2, 4, 6, 9, 11, 13, 15}}};
constexpr int kFirstPoints = 4;
/// Neighbours complete each other where they differ by at most this. Half of the points may be off by one.
constexpr int kEighths = 8, kMostDifferent = 3;

/// Rays of the tile that a thread is busy with.
struct Lists {
  RayList solid, leaves, in_columns;
};
Lists& lists() {
  thread_local Lists of_thread;
  return of_thread;
}

}  // namespace

DiscVisibility::DiscVisibility(const sky::DiscLight& disc, float least_lx, const Visibility& visibility,
                               const LightTable& table, const Surfaces& surfaces)
    : visibility_(visibility),
      table_(table),
      surfaces_(surfaces),
      shines_(disc.illuminance.value.maxCoeff() > least_lx),
      towards_(disc.towards.vector().cast<float>()),
      radius_rad_(static_cast<float>(disc.angular_radius.rad())),
      tallies_(surfaces.tiles.size()),
      shares_(surfaces.tiles.size()),
      met_(surfaces.width, surfaces.height),
      mixed_(surfaces.width, surfaces.height),
      share_(surfaces.width, surfaces.height) {
  const Eigen::Vector3f across =
      std::abs(towards_.z()) < 0.9f ? Eigen::Vector3f::UnitZ() : Eigen::Vector3f::UnitX();
  across_ = across.cross(towards_).normalized();
  const Eigen::Vector3f right = across_ * std::tan(radius_rad_);
  const Eigen::Vector3f up = towards_.cross(right);
  up_ = towards_.cross(across_);
  for (std::size_t odd = 0; odd < 2; ++odd) {
    for (std::size_t i = 0; i < kPoints; ++i) {
      const int point = kOrder[odd][i];
      const double radius = std::sqrt((point + 0.5) / kPoints), turn = kGoldenAngle * point;
      directions_[odd][i] = towards_ + static_cast<float>(radius * std::cos(turn)) * right +
                            static_cast<float>(radius * std::sin(turn)) * up;
    }
  }
  castAll();
}

void DiscVisibility::castAll() {
  if (!shines_) return;
  const auto eachTile = [this](auto step) {
    tbb::parallel_for(std::size_t{0}, surfaces_.tiles.size(), step);
  };
  eachTile([this](std::size_t tile) { probe(tile); });
  eachTile([this](std::size_t tile) { sample(tile); });
  eachTile([this](std::size_t tile) { refine(tile); });
  eachTile([this](std::size_t tile) { complete(tile); });
}

int DiscVisibility::raysAfter(Step step, int samples) const {
  if (step == Step::kProbe) return 1;
  // One a sample; but a whole pixel gets all of the first points, however few samples it has.
  const int pixel = surfaces_.samples_per_pixel;
  const int first = std::max(samples, kFirstPoints * samples / pixel);
  if (step == Step::kSample) return first;
  // What is not alone in its pixel has no neighbours to complete it.
  const bool half = step == Step::kRefine && samples == pixel;
  return std::max(first, (half ? kPoints / 2 : kPoints) * samples / pixel);
}

bool DiscVisibility::facesDisc(const LightTable::Site& site) const {
  return site.thin || (site.geometric_normal.dot(towards_) > -std::sin(radius_rad_) &&
                       site.shading_normal.dot(towards_) > 0.0f);
}

bool DiscVisibility::fillsPixel(const LightTable::Site& site) const {
  return !site.leaves && site.samples == static_cast<std::uint32_t>(surfaces_.samples_per_pixel);
}

void DiscVisibility::appendRays(std::size_t number, std::uint32_t index, Step step) {
  const LightTable::Site& site = table_.tile(number).sites[index];
  const Tile& tile = surfaces_.tiles[number];
  Tally& tally = tallies_[number][index];
  RayList& rays = site.leaves ? lists().leaves : lists().solid;
  const auto end = static_cast<std::uint32_t>(raysAfter(step, site.samples));
  if (tally.cast >= end) return;
  // All first points in turn also among the pixels of a checkerboard, which is what is probed of solid
  // ground.
  const auto& directions = directions_[site.leaves ? 0 : (site.x + site.y) & 1u];
  const std::uint32_t parity = (site.x >> 1 & 1u) + 2u * (site.y & 1u);
  std::uint32_t sample = (tally.cast + parity) % site.samples;
  rays.reserve(end - tally.cast);
  for (std::uint32_t i = tally.cast; i < end; ++i) {
    const Eigen::Vector3f& direction = directions[i < kFirstPoints ? (i + parity) % kFirstPoints : i];
    const std::uint32_t at = site.first_sample + sample;
    if (++sample == site.samples) sample = 0;
    Eigen::Vector3f origin(tile.origin_x[at], tile.origin_y[at], tile.origin_z[at]);
    if (site.geometric_normal.dot(direction) <= 0.0f) {
      // The part of the disc below the surface's own plane is hidden, unless light shines through it.
      if (!site.thin) continue;
      origin -= 2.0f * site.clearance_m * site.geometric_normal;
    }
    rays.add(index, origin, direction);
  }
  tally.cast = static_cast<std::uint8_t>(end);
}

void DiscVisibility::cast(std::size_t number) {
  Tally* const tallies = tallies_[number].data();
  thread_local std::vector<std::uint8_t> blocked;
  const auto castList = [&](const RayList& list) {
    rays_cast_ += list.size();
    blocked.resize(list.size());
    visibility_.occluded(list.rays(), blocked.data());
    for (std::size_t i = 0; i < list.size(); ++i) tallies[list.number()[i]].lit += 1 - blocked[i];
  };
  Lists& rays = lists();
  if (rays.solid.size() > 0) castList(rays.solid);
  if (rays.leaves.size() == 0) return;
  rays.in_columns.setInColumns(rays.leaves, across_, up_);
  castList(rays.in_columns);
}

void DiscVisibility::probe(std::size_t number) {
  lists().solid.clear();
  lists().leaves.clear();
  const Tile& tile = surfaces_.tiles[number];
  const std::vector<LightTable::Site>& sites = table_.tile(number).sites;
  std::vector<Tally>& tallies = tallies_[number];
  tallies.resize(sites.size());
  for (std::uint32_t i = 0; i < sites.size(); ++i) {
    const LightTable::Site& site = sites[i];
    Tally& tally = tallies[i];
    tally.x = static_cast<std::uint8_t>(site.x - tile.x);
    tally.y = static_cast<std::uint8_t>(site.y - tile.y);
    tally.leaves = site.leaves;
    tally.fills = fillsPixel(site);
    if (!facesDisc(site)) continue;
    tally.waits = tally.fills && ((site.x + site.y) & 1) == 1;
    if (!tally.waits) appendRays(number, i, Step::kProbe);
  }
  cast(number);
  for (std::size_t i = 0; i < tallies.size(); ++i)
    if (tallies[i].cast > 0) met_.at(sites[i].x, sites[i].y) |= tallies[i].lit > 0 ? kLit : kDark;
}

void DiscVisibility::sample(std::size_t number) {
  lists().solid.clear();
  lists().leaves.clear();
  const PixelMap::OfTile met = met_.bitsAround(surfaces_.tiles[number]);
  std::vector<Tally>& tallies = tallies_[number];
  for (std::uint32_t i = 0; i < tallies.size(); ++i) {
    Tally& tally = tallies[i];
    const std::uint8_t around = met[tally.y][tally.x];
    const bool agree = around == kLit || around == kDark;
    if (tally.waits && agree) {
      tally.settled = true;
      tally.lit = tally.cast = 1;
      if (around == kDark) tally.lit = 0;
    } else if (!agree && (tally.waits || tally.cast > 0)) {
      appendRays(number, i, Step::kSample);
    }
  }
  cast(number);
  const Tile& tile = surfaces_.tiles[number];
  for (const Tally& tally : tallies) {
    if (tally.mixed()) mixed_.at(tile.x + tally.x, tile.y + tally.y) = 1;
  }
}

void DiscVisibility::refine(std::size_t number) {
  lists().solid.clear();
  lists().leaves.clear();
  const PixelMap::OfTile mixed = mixed_.countAround(surfaces_.tiles[number]);
  const std::vector<Tally>& tallies = tallies_[number];
  for (std::uint32_t i = 0; i < tallies.size(); ++i) {
    const Tally& tally = tallies[i];
    // Not foliage, which shades itself leaf by leaf: more rays cost much there, and what they would smooth is
    // hidden in the leaves. But surfaces amid such as disagree, too: a mesh or a treetop may stop all of one
    // pixel's first rays by chance, which would show as a dark dot. Beside a straight edge there are three.
    if (tally.cast == 0 || tally.leaves || tally.settled) continue;
    if (tally.mixed() || mixed[tally.y][tally.x] >= 4) appendRays(number, i, Step::kRefine);
  }
  cast(number);
  const Tile& tile = surfaces_.tiles[number];
  for (const Tally& tally : tallies) {
    if (tally.fills && tally.cast > 0) {
      share_.at(tile.x + tally.x, tile.y + tally.y) =
          static_cast<std::uint8_t>(1 + kEighths * tally.lit / tally.cast);
    }
  }
}

float DiscVisibility::shareAmongNeighbours(const Tile& tile, const Tally& tally) const {
  const int x = tile.x + tally.x, y = tile.y + tally.y;
  const int own = share_.at(x, y);
  int sum = 0;
  for (const int other :
       {share_.at(x - 1, y), share_.at(x + 1, y), share_.at(x, y - 1), share_.at(x, y + 1)}) {
    if (other == 0 || std::abs(other - own) > kMostDifferent) return -1.0f;
    sum += other - 1;
  }
  // The mean of the own half and, as the light changes evenly from one side to the other, the mean of theirs.
  return (static_cast<float>(own - 1) + 0.25f * static_cast<float>(sum)) / (2.0f * kEighths);
}

void DiscVisibility::complete(std::size_t number) {
  lists().solid.clear();
  lists().leaves.clear();
  const Tile& tile = surfaces_.tiles[number];
  const std::vector<Tally>& tallies = tallies_[number];
  std::vector<float>& shares = shares_[number];
  shares.assign(tallies.size(), -1.0f);
  for (std::uint32_t i = 0; i < tallies.size(); ++i) {
    if (!tallies[i].fills || tallies[i].cast != kPoints / 2) continue;
    shares[i] = shareAmongNeighbours(tile, tallies[i]);
    if (shares[i] < 0.0f) appendRays(number, i, Step::kComplete);
  }
  cast(number);
  for (std::size_t i = 0; i < tallies.size(); ++i) {
    if (shares[i] >= 0.0f) continue;
    const auto all = static_cast<float>(std::max<int>(tallies[i].cast, 1));
    shares[i] = static_cast<float>(tallies[i].lit) / all;
  }
}

}  // namespace sunlit::light
