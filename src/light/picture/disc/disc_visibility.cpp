#include "light/picture/disc/disc_visibility.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "light/geometry/ray_list.h"

namespace sunlit::light {
namespace {

/// What probes met, as bits of one byte.
constexpr std::uint8_t kLit = 1, kDark = 2;

constexpr int kDiscPoints = static_cast<int>(DiscPoints::kPoints),
              kQuad = static_cast<int>(DiscPoints::kQuad);
static_assert(kQuad == ShareWindows::kRays);
/// Side of the blocks in which gaps of deep shade are looked for, px, and how many of them a quadrant reaches
/// to each side: 128 probes, of which one gets through with 70 % where 1 % of the disc shines through.
constexpr int kBlock = 4, kQuadrant = 4;
constexpr int kBlocksOfTile = Surfaces::kTileSize / kBlock;

/// Rays of the tile that a thread is busy with.
struct Lists {
  RayList solid, leaves, in_columns;
};
Lists& lists() {
  thread_local Lists of_thread;
  return of_thread;
}

}  // namespace

DiscVisibility::Seen DiscVisibility::straight(const sky::DiscLight& disc, float least_lx,
                                              const Visibility& visibility) {
  const Eigen::Vector3f towards = disc.towards.vector().cast<float>();
  const auto radius_rad = static_cast<float>(disc.angular_radius.rad());
  return {disc.illuminance.value.maxCoeff() > least_lx, towards, radius_rad, DiscPoints(towards, radius_rad),
          std::make_shared<const StraightWay>(visibility)};
}

DiscVisibility::DiscVisibility(Seen disc, const Picture& picture)
    : disc_(std::move(disc)),
      table_(picture.table),
      surfaces_(picture.surfaces),
      tallies_(surfaces_.tiles.size()),
      shares_(surfaces_.tiles.size()),
      met_(mapOfPixels()),
      mixed_(mapOfPixels()),
      lit_(mapOfPixels()),
      gaps_(surfaces_.width / kBlock + 1, surfaces_.height / kBlock + 1) {
  if (disc_.shines) castAll();
}

PixelMap DiscVisibility::mapOfPixels() const {
  return disc_.shines ? PixelMap(surfaces_.width, surfaces_.height) : PixelMap(0, 0);
}

void DiscVisibility::castAll() {
  std::vector<std::size_t> tiles;  // of a mirror's rays most have none
  for (std::size_t i = 0; i < surfaces_.tiles.size(); ++i)
    if (!surfaces_.tiles[i].surfaces.empty()) tiles.push_back(i);
  const auto eachTile = [&tiles](auto step) {
    tbb::parallel_for(std::size_t{0}, tiles.size(), [&](std::size_t i) { step(tiles[i]); });
  };
  eachTile([this](std::size_t tile) { probe(tile); });
  eachTile([this](std::size_t tile) { sample(tile); });
  eachTile([this](std::size_t tile) { follow(tile); });
  eachTile([this](std::size_t tile) { refine(tile); });
}

int DiscVisibility::raysAfter(Step step, int samples, bool fills) const {
  if (step == Step::kProbe) return 1;
  // In mirrors a ray counts once for each sheet of glass that it passes, of which several may be one surface.
  samples = std::min(samples, surfaces_.samples_per_pixel);
  // One a sample, except where neighbours help; but a whole pixel gets a quad, however few samples it has.
  const int pixel = surfaces_.samples_per_pixel;
  const int first = fills ? kQuad : std::max(samples, kQuad * samples / pixel);
  return std::min(step == Step::kSample ? first : std::max(first, kDiscPoints * samples / pixel),
                  kDiscPoints);
}

bool DiscVisibility::facesDisc(const LightTable::DiscTarget& target) const {
  return target.thin || (target.geometric_normal.dot(disc_.towards) > -std::sin(disc_.radius_rad) &&
                         target.shading_normal.dot(disc_.towards) > 0.0f);
}

bool DiscVisibility::fillsPixel(const LightTable::DiscTarget& target) const {
  return !target.leaves && !target.veiled &&
         target.samples == static_cast<std::uint32_t>(surfaces_.samples_per_pixel);
}

std::uint8_t DiscVisibility::enoughMixed(const LightTable::DiscTarget& target, bool fills) {
  // Foliage shades itself leaf by leaf: more rays cost much there, and what they would smooth is hidden in
  // the leaves, unless these are looked at closely. But surfaces amid such as disagree, too: a mesh or a
  // treetop may stop all of one pixel's first rays by chance, which would show as a dark dot. Beside a
  // straight edge there are three; a pixel that windows fail in may lie on a thin shadow, of which few pixels
  // are found to be mixed.
  if (target.leaves) return target.gathered ? 1 : Tally::kNever;
  return fills ? 2 : 4;
}

void DiscVisibility::appendRays(std::size_t number, std::uint32_t index, Step step) {
  const LightTable::DiscTarget& target = table_.tile(number).targets[index];
  const Tile& tile = surfaces_.tiles[number];
  Tally& tally = tallies_[number][index];
  RayList& rays = target.leaves ? lists().leaves : lists().solid;
  const auto end = static_cast<std::uint32_t>(raysAfter(step, target.samples, tally.fills));
  if (tally.cast >= end) return;
  const DiscPoints::OfPixel points = disc_.points.ofPixel(target.x, target.y);
  const std::uint32_t parity = (target.x >> 1 & 1u) + 2u * (target.y & 1u);
  std::uint32_t sample = (tally.cast + parity) % target.samples;
  rays.reserve(end - tally.cast);
  for (std::uint32_t i = tally.cast; i < end; ++i) {
    const Eigen::Vector3f& direction = points[i];
    const std::uint32_t at = target.first_sample + sample;
    if (++sample == target.samples) sample = 0;
    Eigen::Vector3f origin(tile.origin_x[at], tile.origin_y[at], tile.origin_z[at]);
    if (target.geometric_normal.dot(direction) <= 0.0f) {
      // The part of the disc below the surface's own plane is hidden, unless light shines through it.
      if (!target.thin) continue;
      origin -= 2.0f * target.clearance_m * target.geometric_normal;
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
    disc_.way->stopped(list.rays(), blocked.data());
    for (std::size_t i = 0; i < list.size(); ++i) tallies[list.number()[i]].lit += 1 - blocked[i];
  };
  Lists& rays = lists();
  if (rays.solid.size() > 0) castList(rays.solid);
  if (rays.leaves.size() == 0) return;
  rays.in_columns.setInColumns(rays.leaves, disc_.points.across(), disc_.points.up());
  castList(rays.in_columns);
}

void DiscVisibility::probe(std::size_t number) {
  lists().solid.clear();
  lists().leaves.clear();
  const Tile& tile = surfaces_.tiles[number];
  const std::vector<LightTable::DiscTarget>& targets = table_.tile(number).targets;
  std::vector<Tally>& tallies = tallies_[number];
  tallies.resize(targets.size());
  for (std::uint32_t i = 0; i < targets.size(); ++i) {
    const LightTable::DiscTarget& target = targets[i];
    Tally& tally = tallies[i];
    tally.x = static_cast<std::uint8_t>(target.x - tile.x);
    tally.y = static_cast<std::uint8_t>(target.y - tile.y);
    tally.fills = fillsPixel(target);
    tally.enough = enoughMixed(target, tally.fills);
    if (!facesDisc(target) || !(disc_.wanted.empty() || disc_.wanted[number][i])) continue;
    tally.waits = tally.fills && ((target.x + target.y) & 1) == 1;
    if (!tally.waits) appendRays(number, i, Step::kProbe);
  }
  cast(number);
  for (std::size_t i = 0; i < tallies.size(); ++i) {
    if (tallies[i].cast == 0) continue;
    met_.at(targets[i].x, targets[i].y) |= tallies[i].lit > 0 ? kLit : kDark;
    if (tallies[i].fills && tallies[i].lit > 0) gaps_.at(targets[i].x / kBlock, targets[i].y / kBlock) = 1;
  }
}

bool DiscVisibility::hasGapsAround(int x, int y) const {
  const auto inQuadrant = [&](int side, int row) {
    for (int j = 0; j < kQuadrant; ++j)
      for (int i = 0; i < kQuadrant; ++i)
        if (gaps_.at(x + side * i, y + row * j) != 0) return 1;
    return 0;
  };
  // Beyond a straight edge of a shadow light lies in two quadrants, beyond a corner in three.
  return inQuadrant(-1, -1) + inQuadrant(1, -1) + inQuadrant(-1, 1) + inQuadrant(1, 1) >= 4;
}

void DiscVisibility::note(const Tile& tile, const Tally& tally) {
  lit_.at(tile.x + tally.x, tile.y + tally.y) = static_cast<std::uint8_t>(1 + kQuad * tally.lit / tally.cast);
}

void DiscVisibility::sample(std::size_t number) {
  lists().solid.clear();
  lists().leaves.clear();
  const Tile& tile = surfaces_.tiles[number];
  const PixelMap::OfTile met = met_.bitsAround(tile);
  std::array<std::array<bool, kBlocksOfTile>, kBlocksOfTile> gaps;
  for (int y = 0; y < kBlocksOfTile; ++y)
    for (int x = 0; x < kBlocksOfTile; ++x)
      gaps[y][x] = hasGapsAround(tile.x / kBlock + x, tile.y / kBlock + y);
  std::vector<Tally>& tallies = tallies_[number];
  for (std::uint32_t i = 0; i < tallies.size(); ++i) {
    Tally& tally = tallies[i];
    const std::uint8_t around = met[tally.y][tally.x];
    // A few per cent of the sun are as much light as all the sky gives to deep shade.
    const bool gap = tally.fills && gaps[tally.y / kBlock][tally.x / kBlock];
    const bool agree = around == kLit || (around == kDark && !gap);
    if (tally.waits && agree) {
      tally.settled = true;
      tally.lit = tally.cast = 1;
      if (around == kDark) tally.lit = 0;
    } else if (!agree && (tally.waits || tally.cast > 0)) {
      appendRays(number, i, Step::kSample);
    }
  }
  cast(number);
  for (const Tally& tally : tallies) {
    if (tally.mixed()) mixed_.at(tile.x + tally.x, tile.y + tally.y) = 1;
    if (tally.fills && tally.cast > 0) note(tile, tally);
  }
}

void DiscVisibility::follow(std::size_t number) {
  lists().solid.clear();
  lists().leaves.clear();
  const Tile& tile = surfaces_.tiles[number];
  const PixelMap::OfTile mixed = mixed_.bitsAround(tile);
  std::vector<Tally>& tallies = tallies_[number];
  thread_local std::vector<std::uint32_t> followed;
  followed.clear();
  for (std::uint32_t i = 0; i < tallies.size(); ++i) {
    Tally& tally = tallies[i];
    if (!tally.fills || tally.cast != 1 || mixed[tally.y][tally.x] == 0) continue;
    if (tally.settled) {
      tally.settled = false;
      tally.lit = tally.cast = 0;
    }
    appendRays(number, i, Step::kSample);
    followed.push_back(i);
  }
  cast(number);
  for (const std::uint32_t i : followed) note(tile, tallies[i]);
}

void DiscVisibility::refine(std::size_t number) {
  lists().solid.clear();
  lists().leaves.clear();
  const Tile& tile = surfaces_.tiles[number];
  const PixelMap::OfTile mixed = mixed_.countAround(tile);
  const ShareWindows windows(lit_, tile);
  const std::vector<Tally>& tallies = tallies_[number];
  std::vector<float>& shares = shares_[number];
  shares.assign(tallies.size(), -1.0f);
  for (std::uint32_t i = 0; i < tallies.size(); ++i) {
    const Tally& tally = tallies[i];
    if (tally.cast == 0 || tally.enough == Tally::kNever) continue;
    if (tally.fills) shares[i] = windows.share(tally.x, tally.y);
    const bool penumbra = tally.mixed() || mixed[tally.y][tally.x] >= tally.enough;
    if (penumbra && !(tally.fills && (shares[i] >= 0.0f || tally.cast == 1)))
      appendRays(number, i, Step::kRefine);
  }
  cast(number);
  for (std::size_t i = 0; i < tallies.size(); ++i) {
    if (shares[i] >= 0.0f) continue;
    const auto all = static_cast<float>(std::max<int>(tallies[i].cast, 1));
    shares[i] = static_cast<float>(tallies[i].lit) / all;
  }
}

}  // namespace sunlit::light
