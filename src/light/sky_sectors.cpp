#include "light/sky_sectors.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>

#include "light/transport/sky_patches.h"
#include "sunlit/quantity/angle.h"
#include "sunlit/sky/octahedral.h"

namespace sunlit::light {
namespace {

constexpr std::size_t kSide = 48;  ///< cells of the map of normals, an axis
constexpr int kRaysPerPatch = 3;

/// A band of the sky from one elevation to another, in sectors of as many patches.
struct Band {
  int first_patch, patches;  ///< of one of its rings
  std::size_t first_sector;
  int sectors;
};
/// The rings of SkyPatches.
constexpr std::array<Band, 9> kBands = {{{0, 30, 0, 10},
                                         {30, 30, 0, 10},
                                         {60, 30, 10, 6},
                                         {90, 24, 10, 6},
                                         {114, 24, 16, 6},
                                         {138, 18, 16, 6},
                                         {156, 12, 22, 2},
                                         {168, 6, 22, 2},
                                         {174, 1, 22, 2}}};

std::size_t cellOf(const Eigen::Vector3f& normal) {
  const Eigen::Vector2f at = sky::octahedralPlace(normal);
  const auto step = [](float x) {
    const auto i = static_cast<int>((x + 1.0f) * (0.5f * static_cast<float>(kSide)));
    return static_cast<std::size_t>(std::clamp(i, 0, static_cast<int>(kSide) - 1));
  };
  return step(at.y()) * kSide + step(at.x());
}

Eigen::Vector3f normalOf(std::size_t cell) {
  const auto middle = [](std::size_t i) {
    return (2.0f * static_cast<float>(i) + 1.0f) / static_cast<float>(kSide) - 1.0f;
  };
  return sky::octahedralDirection(middle(cell % kSide), middle(cell / kSide));
}

}  // namespace

std::size_t SkySectors::of(int patch) {
  std::size_t ring = kBands.size() - 1;
  while (patch < kBands[ring].first_patch) --ring;
  const Band& band = kBands[ring];
  return band.first_sector +
         static_cast<std::size_t>((patch - band.first_patch) * band.sectors / band.patches);
}

SkySectors::SkySectors(const sky::Daylight& day) : table_(kSide * kSide * kCount, Eigen::Array4f::Zero()) {
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
  tbb::parallel_for(std::size_t{0}, kSide * kSide, [&](std::size_t cell) {
    const Eigen::Vector3f normal = normalOf(cell);
    for (const Ray& ray : rays) {
      const float cosine = normal.dot(ray.towards);
      if (cosine > 0.0f) table_[cell * kCount + ray.sector] += cosine * ray.light;
    }
  });
}

Eigen::Array4f SkySectors::irradiance(const SkyView& view, const Eigen::Vector3f& normal) const {
  const Eigen::Array4f* row = table_.data() + cellOf(normal) * kCount;
  Eigen::Array4f sum = Eigen::Array4f::Zero();
  for (std::size_t sector = 0; sector < kCount; ++sector)
    sum += row[sector] * static_cast<float>(view.open[sector]);
  return sum / 255.0f;
}

}  // namespace sunlit::light
