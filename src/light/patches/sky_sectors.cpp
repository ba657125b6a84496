#include "light/patches/sky_sectors.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <utility>

#include "sunlit/quantity/angle.h"
#include "sunlit/sky/octahedral.h"

namespace sunlit::light {
namespace {

constexpr int kSide = 48;  ///< cells of the map of normals, an axis
constexpr std::size_t kCells = kSide * kSide;
constexpr int kRaysPerPatch = 3;

/// The sectors that a ring of SkyPatches is in, each of as many patches.
struct Sectors {
  std::size_t first;
  int count;
};
constexpr std::array<Sectors, SkyPatches::kRings.size()> kOfRing = {
    {{0, 10}, {0, 10}, {10, 6}, {10, 6}, {16, 6}, {16, 6}, {22, 2}, {22, 2}, {22, 1}}};

using Shares = std::array<float, SkyPatches::kAbove>;
/// Of each patch, its share of its sector.
Shares sharesOfSectors() {
  std::array<float, SkySectors::kCount> whole{};
  for (int p = 0; p < SkyPatches::kAbove; ++p) whole[SkySectors::of(p)] += SkyPatches::solidAngle(p);
  Shares shares;
  for (int p = 0; p < SkyPatches::kAbove; ++p)
    shares[static_cast<std::size_t>(p)] = SkyPatches::solidAngle(p) / whole[SkySectors::of(p)];
  return shares;
}

using Sums = std::array<float, SkySectors::kCount>;
/// Adds what is open of a ring, whose patches are alike. Every leaf asks for it, so that how many there are
/// is known to the compiler.
template <std::size_t kRing>
void addRing(const PatchBytes& patches, const Shares& shares, Sums* sums) {
  constexpr Sectors sectors = kOfRing[kRing];
  constexpr auto kFirst = static_cast<std::size_t>(SkyPatches::kRings[kRing].first);
  constexpr auto kEach = static_cast<std::size_t>(SkyPatches::kRings[kRing].patches / sectors.count);
  for (std::size_t k = 0; k < static_cast<std::size_t>(sectors.count); ++k) {
    const std::size_t begin = kFirst + kEach * k;
    int bytes = 0;
    for (std::size_t p = begin; p < begin + kEach; ++p) bytes += patches[p];
    (*sums)[sectors.first + k] += shares[begin] * static_cast<float>(bytes);
  }
}
template <std::size_t... kRing>
void addRings(const PatchBytes& patches, const Shares& shares, std::index_sequence<kRing...>, Sums* sums) {
  (addRing<kRing>(patches, shares, sums), ...);
}

}  // namespace

std::size_t SkySectors::of(int patch) {
  const std::size_t index = SkyPatches::ringOf(patch);
  const SkyPatches::Ring& ring = SkyPatches::kRings[index];
  const Sectors& sectors = kOfRing[index];
  return sectors.first + static_cast<std::size_t>((patch - ring.first) * sectors.count / ring.patches);
}

std::array<std::uint8_t, SkySectors::kCount> SkySectors::openOf(const PatchBytes& patches) {
  static const Shares shares = sharesOfSectors();
  Sums sum;
  sum.fill(0.5f);
  addRings(patches, shares, std::make_index_sequence<kOfRing.size()>(), &sum);
  std::array<std::uint8_t, kCount> open;
  for (std::size_t sector = 0; sector < kCount; ++sector)
    open[sector] = static_cast<std::uint8_t>(std::min(sum[sector], 255.0f));
  return open;
}

SkySectors::SkySectors(const sky::Daylight& day) : table_(kCells * kCount, Eigen::Array4f::Zero()) {
  struct Ray {
    Eigen::Vector3f towards;
    std::size_t sector;
    Eigen::Array4f light;  ///< times its solid angle; fourth: the latter's share of π
  };
  std::vector<Ray, Eigen::aligned_allocator<Ray>> rays;
  const SkyPatches patches(kRaysPerPatch);
  for (const SkyPatches::Ray& ray : patches.rays()) {
    if (ray.patch == SkyPatches::kBelow) continue;
    const Eigen::Array3f light = day.skyLuminance(ray.towards).value * ray.solid_angle;
    rays.push_back({ray.towards, of(ray.patch), {light[0], light[1], light[2], ray.solid_angle / kPiFloat}});
  }
  tbb::parallel_for(std::size_t{0}, kCells, [&](std::size_t cell) {
    const Eigen::Vector3f normal = sky::octahedralMiddle(kSide, cell);
    for (const Ray& ray : rays) {
      const float cosine = normal.dot(ray.towards);
      if (cosine > 0.0f) table_[cell * kCount + ray.sector] += cosine * ray.light;
    }
  });
}

const Eigen::Array4f* SkySectors::rowOf(const Eigen::Vector3f& normal) const {
  const auto cell = static_cast<std::size_t>(sky::octahedralCell(kSide, normal.x(), normal.y(), normal.z()));
  return table_.data() + cell * kCount;
}

SkySectors::OfBothSides SkySectors::irradiance(const SkyOpenness& view, const Eigen::Vector3f& normal) const {
  const Eigen::Array4f *const front = rowOf(normal), *const behind = rowOf(-normal);
  OfBothSides sum{Eigen::Array4f::Zero(), Eigen::Array4f::Zero()};
  for (std::size_t sector = 0; sector < kCount; ++sector) {
    const auto open = static_cast<float>(view.open[sector]);
    sum.front += front[sector] * open;
    sum.behind += behind[sector] * open;
  }
  return {sum.front / 255.0f, sum.behind / 255.0f};
}

}  // namespace sunlit::light
