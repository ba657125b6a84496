#include "light/disc_visibility.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <cstring>

namespace sunlit::light {
namespace {

/// What probes met, as bits of one byte.
constexpr std::uint8_t kLit = 1, kDark = 2;

/// Points of a Fibonacci spiral fill the disc evenly: point i of n at radius sqrt((i + ½) / n), i golden
/// angles round.
constexpr double kGoldenAngle = 2.39996322972865332;  ///< rad; π (3 − √5)
/// The order in which they are used, the same for every pixel of the same parity: a penumbra then consists of
/// fine steps that lie still in the world. Points at random would turn it into grain that clings to the
/// screen, and feature detectors find grain. The first four lie near the rim, about 90° apart, so that hardly
/// any shadow edge can cross the disc without their telling; neighbouring pixels probe different ones.
constexpr std::array<int, 16> kOrder = {14, 8, 12, 10, 0, 1, 2, 3, 4, 5, 6, 7, 9, 11, 13, 15};
constexpr int kFirstPoints = 4;

}  // namespace

struct DiscVisibility::RayList {
  std::vector<float> ox, oy, oz, dx, dy, dz;
  std::vector<std::uint32_t> surface;
  std::vector<std::uint8_t> blocked;
  void clear() {
    for (auto* list : {&ox, &oy, &oz, &dx, &dy, &dz}) list->clear();
    surface.clear();
  }
  void add(std::uint32_t index, const Eigen::Vector3f& origin, const Eigen::Vector3f& direction) {
    surface.push_back(index);
    ox.push_back(origin.x());
    oy.push_back(origin.y());
    oz.push_back(origin.z());
    dx.push_back(direction.x());
    dy.push_back(direction.y());
    dz.push_back(direction.z());
  }
};

std::uint8_t DiscVisibility::PixelMap::anyAround(std::uint32_t pixel) const {
  // Five bytes of each of five rows, as whole words.
  const std::uint8_t* const at = &values_[place(pixel)] - 2 * stride_ - 2;
  std::uint64_t rows = 0;
  for (std::size_t row = 0; row < 5; ++row) {
    std::uint64_t eight;
    std::memcpy(&eight, at + row * stride_, sizeof(eight));
    rows |= eight;
  }
  std::array<std::uint8_t, 8> columns;
  std::memcpy(columns.data(), &rows, sizeof(rows));
  return static_cast<std::uint8_t>(columns[0] | columns[1] | columns[2] | columns[3] | columns[4]);
}

int DiscVisibility::PixelMap::countAround(std::uint32_t pixel) const {
  const std::uint8_t* const at = &values_[place(pixel)];
  int count = 0;
  for (const std::uint8_t* row : {at - stride_, at, at + stride_})
    for (int i = -1; i <= 1; ++i) count += row[i] != 0 ? 1 : 0;
  return count;
}

DiscVisibility::DiscVisibility(const sky::DiscLight& disc, float least_lx, const Visibility& visibility,
                               const scene::Scene& scene, const Surfaces& surfaces)
    : visibility_(visibility),
      scene_(scene),
      surfaces_(surfaces),
      shines_(disc.illuminance.value.maxCoeff() > least_lx),
      towards_(disc.towards.vector().cast<float>()),
      radius_rad_(static_cast<float>(disc.angular_radius.rad())),
      tallies_(surfaces.tiles.size()),
      shares_(surfaces.tiles.size()),
      met_(surfaces.width, surfaces.height),
      mixed_(surfaces.width, surfaces.height) {
  const Eigen::Vector3f across =
      std::abs(towards_.z()) < 0.9f ? Eigen::Vector3f::UnitZ() : Eigen::Vector3f::UnitX();
  const Eigen::Vector3f right = across.cross(towards_).normalized() * std::tan(radius_rad_);
  const Eigen::Vector3f up = towards_.cross(right);
  for (std::size_t i = 0; i < kPoints; ++i) {
    const double radius = std::sqrt((kOrder[i] + 0.5) / kPoints);
    directions_[i] = towards_ + static_cast<float>(radius * std::cos(kGoldenAngle * kOrder[i])) * right +
                     static_cast<float>(radius * std::sin(kGoldenAngle * kOrder[i])) * up;
  }
  castAll();
}

void DiscVisibility::castAll() {
  for (std::size_t i = 0; i < surfaces_.tiles.size(); ++i) {
    tallies_[i].resize(surfaces_.tiles[i].surfaces.size());
    shares_[i].assign(surfaces_.tiles[i].surfaces.size(), 0.0f);
  }
  if (!shines_) return;
  for (const Step step : {Step::kProbe, Step::kSample, Step::kRefine}) {
    tbb::parallel_for(std::size_t{0}, surfaces_.tiles.size(), [&](std::size_t i) { castTile(i, step); });
  }
}

int DiscVisibility::raysAfter(Step step, const Surface& surface) const {
  if (step == Step::kProbe) return 1;
  // One a sample; but a whole pixel gets all of the first points, however few samples it has.
  const int samples = static_cast<int>(surface.samples);
  const int pixel = surfaces_.samples_per_pixel;
  const int first = std::max(samples, kFirstPoints * samples / pixel);
  return step == Step::kSample ? first : std::max(first, kPoints * samples / pixel);
}

bool DiscVisibility::facesDisc(const Surface& surface) const {
  return materialOf(surface).transmission > 0.0f ||
         (surface.geometric_normal.dot(towards_) > -std::sin(radius_rad_) &&
          surface.shading_normal.dot(towards_) > 0.0f);
}

bool DiscVisibility::wantsMore(const Tally& tally, Step step) const {
  if (tally.cast == 0) return false;
  if (step == Step::kSample) return met_.anyAround(tally.pixel) == (kLit | kDark);
  // Not foliage, which shades itself leaf by leaf: more rays cost much there, and what they would smooth is
  // hidden in the leaves. But surfaces amid such as disagree, too: a mesh or a treetop may stop all of one
  // pixel's first rays by chance, which would show as a dark dot. Beside a straight edge there are three.
  return !tally.leaves && (tally.mixed() || mixed_.countAround(tally.pixel) >= 4);
}

void DiscVisibility::appendRays(const Tile& tile, std::uint32_t index, Step step, RayList* rays) {
  const Surface& surface = tile.surfaces[index];
  Tally& tally = tallies_[static_cast<std::size_t>(&tile - surfaces_.tiles.data())][index];
  const bool thin = materialOf(surface).transmission > 0.0f;
  const auto width = static_cast<std::uint32_t>(surfaces_.width);
  const std::uint32_t parity = (surface.pixel % width & 1u) + 2u * (surface.pixel / width & 1u);
  const auto end = static_cast<std::uint32_t>(raysAfter(step, surface));
  for (std::uint32_t i = tally.cast; i < end; ++i, ++tally.cast) {
    const Eigen::Vector3f& direction = directions_[i < kFirstPoints ? (i + parity) % kFirstPoints : i];
    const std::uint32_t sample = surface.first_sample + (i + parity) % surface.samples;
    Eigen::Vector3f origin(tile.origin_x[sample], tile.origin_y[sample], tile.origin_z[sample]);
    if (surface.geometric_normal.dot(direction) <= 0.0f) {
      // The part of the disc below the surface's own plane is hidden, unless light shines through it.
      if (!thin) continue;
      origin -= 2.0f * surface.clearance_m * surface.geometric_normal;
    }
    rays->add(index, origin, direction);
  }
}

void DiscVisibility::castTile(std::size_t number, Step step) {
  thread_local RayList rays;
  rays.clear();
  const Tile& tile = surfaces_.tiles[number];
  std::vector<Tally>& tallies = tallies_[number];
  for (std::uint32_t i = 0; i < tallies.size(); ++i) {
    if (step == Step::kProbe) {
      const Surface& surface = tile.surfaces[i];
      tallies[i].pixel = surface.pixel;
      tallies[i].leaves = materialOf(surface).alpha_mode == scene::AlphaMode::kMask;
      if (!facesDisc(surface)) continue;
    } else if (!wantsMore(tallies[i], step)) {
      continue;
    }
    appendRays(tile, i, step, &rays);
  }
  rays.blocked.assign(rays.surface.size(), 0);
  visibility_.occluded({rays.ox.data(), rays.oy.data(), rays.oz.data(), rays.dx.data(), rays.dy.data(),
                        rays.dz.data(), rays.surface.size()},
                       rays.blocked.data());
  for (std::size_t i = 0; i < rays.surface.size(); ++i) {
    if (!rays.blocked[i]) ++tallies[rays.surface[i]].lit;
  }
  note(number, step);
}

void DiscVisibility::note(std::size_t number, Step step) {
  const std::vector<Tally>& tallies = tallies_[number];
  for (std::size_t i = 0; i < tallies.size(); ++i) {
    if (tallies[i].cast == 0) continue;
    const std::uint32_t pixel = tallies[i].pixel;
    if (step == Step::kProbe) met_.at(pixel) |= tallies[i].lit > 0 ? kLit : kDark;
    if (step == Step::kSample && tallies[i].mixed()) mixed_.at(pixel) = 1;
    if (step == Step::kRefine)
      shares_[number][i] = static_cast<float>(tallies[i].lit) / static_cast<float>(tallies[i].cast);
  }
}

}  // namespace sunlit::light
