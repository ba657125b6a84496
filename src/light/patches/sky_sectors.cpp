#include "light/patches/sky_sectors.h"

#include <tbb/parallel_for.h>

#include <algorithm>

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
    {{0, 10}, {0, 10}, {10, 6}, {10, 6}, {16, 6}, {16, 6}, {22, 2}, {22, 2}, {22, 2}}};

/// Neighbouring patches, alike in size, of one sector.
struct Run {
  int begin, end;
  std::size_t sector;
  float share;  ///< each one's of the sector
};
std::vector<Run> runsOfSectors() {
  std::array<float, SkySectors::kCount> whole{};
  std::vector<Run> runs;
  for (int p = 0; p < SkyPatches::kAbove; ++p) {
    const std::size_t sector = SkySectors::of(p);
    whole[sector] += SkyPatches::solidAngle(p);
    if (runs.empty() || runs.back().sector != sector ||
        SkyPatches::ringOf(p) != SkyPatches::ringOf(runs.back().begin))
      runs.push_back({p, p, sector, 0.0f});
    ++runs.back().end;
  }
  for (Run& run : runs) run.share = SkyPatches::solidAngle(run.begin) / whole[run.sector];
  return runs;
}

}  // namespace

std::size_t SkySectors::of(int patch) {
  const std::size_t index = SkyPatches::ringOf(patch);
  const SkyPatches::Ring& ring = SkyPatches::kRings[index];
  const Sectors& sectors = kOfRing[index];
  return sectors.first + static_cast<std::size_t>((patch - ring.first) * sectors.count / ring.patches);
}

std::array<std::uint8_t, SkySectors::kCount> SkySectors::openOf(const PatchBytes& patches) {
  static const std::vector<Run> runs = runsOfSectors();
  std::array<float, kCount> sum;
  sum.fill(0.5f);
  for (const Run& run : runs) {
    int bytes = 0;
    for (int p = run.begin; p < run.end; ++p) bytes += patches[static_cast<std::size_t>(p)];
    sum[run.sector] += run.share * static_cast<float>(bytes);
  }
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
