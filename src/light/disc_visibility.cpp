#include "light/disc_visibility.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "light/angles.h"

namespace sunlit::light {
namespace {

/// What probes met, as bits of one byte.
constexpr std::uint8_t kLit = 1, kDark = 2;

/// Points of a Fibonacci spiral fill the disc evenly: point i of n at radius sqrt((i + ½) / n). This is the
/// order in which they are used, the same for every pixel of the same parity: a penumbra then consists of
/// fine steps that lie still in the world. Points at random would turn it into grain that clings to the
/// screen, and feature detectors find grain. The first four lie near the rim, about 90° apart, so that hardly
/// any shadow edge can cross the disc without their telling; neighbouring pixels probe different ones.
constexpr std::array<int, 16> kOrder = {14, 8, 12, 10, 0, 1, 2, 3, 4, 5, 6, 7, 9, 11, 13, 15};
constexpr int kFirstPoints = 4;

}  // namespace

struct DiscVisibility::RayList {
  std::array<std::vector<float>, 6> values;  ///< origins x, y, z, directions x, y, z
  std::vector<std::uint32_t> surface;        ///< of the tile
  std::size_t count = 0;

  /// Makes room for `more` rays.
  void reserve(std::size_t more) {
    if (count + more <= surface.size()) return;
    const std::size_t size = 2 * (count + more);
    for (auto& list : values) list.resize(size);
    surface.resize(size);
  }
  void add(std::uint32_t index, const Eigen::Vector3f& origin, const Eigen::Vector3f& direction) {
    surface[count] = index;
    for (std::size_t k = 0; k < 3; ++k) {
      values[k][count] = origin[static_cast<Eigen::Index>(k)];
      values[k + 3][count] = direction[static_cast<Eigen::Index>(k)];
    }
    ++count;
  }
  Rays rays() const {
    return {values[0].data(),
            values[1].data(),
            values[2].data(),
            values[3].data(),
            values[4].data(),
            values[5].data(),
            count};
  }
  /// The rays of `other`, those together that start in one column towards the disc: as seen from there,
  /// foliage lies about in depth, and neighbours in the picture meet other leaves.
  void setInColumns(const RayList& other, const Eigen::Vector3f& across, const Eigen::Vector3f& up);
};

void DiscVisibility::RayList::setInColumns(const RayList& other, const Eigen::Vector3f& across,
                                           const Eigen::Vector3f& up) {
  constexpr std::uint32_t kSide = 32;  // columns, there and back in every second row
  thread_local std::vector<Eigen::Array2f> places;
  places.resize(other.count);
  Eigen::Array2f low = Eigen::Array2f::Constant(std::numeric_limits<float>::max()), high = -low;
  for (std::size_t i = 0; i < other.count; ++i) {
    const Eigen::Vector3f origin(other.values[0][i], other.values[1][i], other.values[2][i]);
    places[i] = {origin.dot(across), origin.dot(up)};
    low = low.min(places[i]);
    high = high.max(places[i]);
  }
  const float scale = (static_cast<float>(kSide) - 0.5f) / std::max((high - low).maxCoeff(), 1e-3f);
  std::array<std::uint32_t, kSide * kSide + 1> begins{};
  thread_local std::vector<std::uint32_t> columns;
  columns.resize(other.count);
  for (std::size_t i = 0; i < other.count; ++i) {
    const Eigen::Array2f cell = (places[i] - low) * scale;
    const auto x = static_cast<std::uint32_t>(cell.x()), y = static_cast<std::uint32_t>(cell.y());
    columns[i] = y * kSide + (y % 2 == 0 ? x : kSide - 1 - x);
    ++begins[columns[i] + 1];
  }
  for (std::size_t i = 1; i < begins.size(); ++i) begins[i] += begins[i - 1];
  count = 0;
  reserve(other.count);
  count = other.count;
  for (std::size_t i = 0; i < other.count; ++i) {
    const std::uint32_t to = begins[columns[i]]++;
    surface[to] = other.surface[i];
    for (std::size_t k = 0; k < 6; ++k) values[k][to] = other.values[k][i];
  }
}

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
      mixed_(surfaces.width, surfaces.height) {
  const Eigen::Vector3f across =
      std::abs(towards_.z()) < 0.9f ? Eigen::Vector3f::UnitZ() : Eigen::Vector3f::UnitX();
  across_ = across.cross(towards_).normalized();
  const Eigen::Vector3f right = across_ * std::tan(radius_rad_);
  const Eigen::Vector3f up = towards_.cross(right);
  up_ = towards_.cross(across_);
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

int DiscVisibility::raysAfter(Step step, int samples) const {
  if (step == Step::kProbe) return 1;
  // One a sample; but a whole pixel gets all of the first points, however few samples it has.
  const int pixel = surfaces_.samples_per_pixel;
  const int first = std::max(samples, kFirstPoints * samples / pixel);
  return step == Step::kSample ? first : std::max(first, kPoints * samples / pixel);
}

bool DiscVisibility::facesDisc(const LightTable::Site& site) const {
  return site.thin || (site.geometric_normal.dot(towards_) > -std::sin(radius_rad_) &&
                       site.shading_normal.dot(towards_) > 0.0f);
}

bool DiscVisibility::mayWait(const LightTable::Site& site) const {
  const auto width = static_cast<std::uint32_t>(surfaces_.width);
  return !site.leaves && site.samples == static_cast<std::uint32_t>(surfaces_.samples_per_pixel) &&
         ((site.pixel % width + site.pixel / width) & 1u) == 1;
}

bool DiscVisibility::wantsMore(const Tally& tally, Step step) const {
  if (step == Step::kSample && tally.waits) {
    const std::uint8_t around = met_.anyAround(tally.pixel);
    return around != kLit && around != kDark;
  }
  if (tally.cast == 0) return false;
  if (step == Step::kSample) return met_.anyAround(tally.pixel) == (kLit | kDark);
  // Not foliage, which shades itself leaf by leaf: more rays cost much there, and what they would smooth is
  // hidden in the leaves. But surfaces amid such as disagree, too: a mesh or a treetop may stop all of one
  // pixel's first rays by chance, which would show as a dark dot. Beside a straight edge there are three.
  return !tally.leaves && (tally.mixed() || mixed_.countAround(tally.pixel) >= 4);
}

void DiscVisibility::appendRays(const Tile& tile, const LightTable::Site& site, std::uint32_t index,
                                Step step, Tally* tally, RayList* rays) const {
  const auto width = static_cast<std::uint32_t>(surfaces_.width);
  const std::uint32_t parity = (site.pixel % width & 1u) + 2u * (site.pixel / width & 1u);
  const auto end = static_cast<std::uint32_t>(raysAfter(step, site.samples));
  if (tally->cast >= end) return;
  rays->reserve(end - tally->cast);
  for (std::uint32_t i = tally->cast; i < end; ++i, ++tally->cast) {
    const Eigen::Vector3f& direction = directions_[i < kFirstPoints ? (i + parity) % kFirstPoints : i];
    const std::uint32_t sample = site.first_sample + (i + parity) % site.samples;
    Eigen::Vector3f origin(tile.origin_x[sample], tile.origin_y[sample], tile.origin_z[sample]);
    if (site.geometric_normal.dot(direction) <= 0.0f) {
      // The part of the disc below the surface's own plane is hidden, unless light shines through it.
      if (!site.thin) continue;
      origin -= 2.0f * site.clearance_m * site.geometric_normal;
    }
    rays->add(index, origin, direction);
  }
}

void DiscVisibility::castTile(std::size_t number, Step step) {
  thread_local RayList solid, leaves, columns;
  solid.count = leaves.count = 0;
  const Tile& tile = surfaces_.tiles[number];
  const std::vector<LightTable::Site>& sites = table_.tile(number).sites;
  std::vector<Tally>& tallies = tallies_[number];
  for (std::uint32_t i = 0; i < tallies.size(); ++i) {
    if (step == Step::kProbe) {
      tallies[i].pixel = sites[i].pixel;
      tallies[i].leaves = sites[i].leaves;
      if (!facesDisc(sites[i])) continue;
      tallies[i].waits = mayWait(sites[i]);
      if (tallies[i].waits) continue;
    } else if (!wantsMore(tallies[i], step)) {
      continue;
    }
    appendRays(tile, sites[i], i, step, &tallies[i], tallies[i].leaves ? &leaves : &solid);
  }
  cast(solid, &tallies);
  columns.setInColumns(leaves, across_, up_);
  cast(columns, &tallies);
  note(number, step);
}

void DiscVisibility::cast(const RayList& rays, std::vector<Tally>* tallies) {
  if (rays.count == 0) return;
  rays_cast_ += rays.count;
  thread_local std::vector<std::uint8_t> blocked;
  blocked.resize(rays.count);
  visibility_.occluded(rays.rays(), blocked.data());
  for (std::size_t i = 0; i < rays.count; ++i)
    if (!blocked[i]) ++(*tallies)[rays.surface[i]].lit;
}

void DiscVisibility::note(std::size_t number, Step step) {
  const std::vector<Tally>& tallies = tallies_[number];
  for (std::size_t i = 0; i < tallies.size(); ++i) {
    if (tallies[i].cast == 0) {
      if (step == Step::kRefine && tallies[i].waits && met_.anyAround(tallies[i].pixel) == kLit)
        shares_[number][i] = 1.0f;
      continue;
    }
    const std::uint32_t pixel = tallies[i].pixel;
    if (step == Step::kProbe) met_.at(pixel) |= tallies[i].lit > 0 ? kLit : kDark;
    if (step == Step::kSample && tallies[i].mixed()) mixed_.at(pixel) = 1;
    if (step == Step::kRefine)
      shares_[number][i] = static_cast<float>(tallies[i].lit) / static_cast<float>(tallies[i].cast);
  }
}

}  // namespace sunlit::light
