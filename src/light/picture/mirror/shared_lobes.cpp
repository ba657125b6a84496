#include "light/picture/mirror/shared_lobes.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "light/picture/mirror/lobe_rays.h"

namespace sunlit::light {
namespace {

/// A rough surface that mirrors, as others are compared with it.
struct Rough {
  Eigen::Vector3f position, shading_normal, geometric_normal;
  float roughness, metalness;
  float reach_m;  ///< as far others may be that show it the same
  int x, y;
};

/// What one shows, or several together.
struct Shown {
  Eigen::Array3f sum = Eigen::Array3f::Zero();
  float weight = 0.0f;

  void add(float times, const Shown& other) {
    sum += times * other.sum;
    weight += times * other.weight;
  }
};

/// All of a picture, by pixels.
struct RoughOnes {
  std::vector<Rough> all;
  std::vector<Shown> shown;
  std::vector<Eigen::Array3f*> luminances;  ///< of each
  std::vector<std::uint32_t> first;         ///< of a pixel, and of one beyond the last
};

/// visit(surface, tile, index of what it mirrors in the tile) of each that fills its lobe, until it says no.
template <typename Visit>
void forEachRough(const Surfaces& surfaces, const Reflections& reflections, const Visit& visit) {
  for (std::size_t t = 0; t < reflections.tiles.size(); ++t) {
    const std::vector<Reflections::Mirroring>& mirroring = reflections.tiles[t].surfaces;
    for (std::size_t i = 0; i < mirroring.size(); ++i) {
      const Surface& surface = surfaces.tiles[t].surfaces[mirroring[i].surface];
      if (fillsLobe(surface) && !visit(surface, t, i)) return;
    }
  }
}

bool anyFillsLobe(const Surfaces& surfaces, const Reflections& reflections) {
  bool any = false;
  forEachRough(surfaces, reflections, [&](const Surface&, std::size_t, std::size_t) {
    any = true;
    return false;
  });
  return any;
}

RoughOnes collect(const Surfaces& surfaces, const Reflections& reflections, MirroredLuminances* luminances) {
  RoughOnes ones;
  const auto width = static_cast<std::uint32_t>(surfaces.width);
  ones.first.assign(static_cast<std::size_t>(surfaces.width) * static_cast<std::size_t>(surfaces.height) + 1,
                    0);
  forEachRough(surfaces, reflections, [&](const Surface& surface, std::size_t, std::size_t) {
    ++ones.first[surface.pixel + 1];
    return true;
  });
  for (std::size_t i = 1; i < ones.first.size(); ++i) ones.first[i] += ones.first[i - 1];
  ones.all.resize(ones.first.back());
  ones.shown.resize(ones.all.size());
  ones.luminances.resize(ones.all.size());
  std::vector<std::uint32_t> next = ones.first;
  forEachRough(surfaces, reflections, [&](const Surface& surface, std::size_t tile, std::size_t i) {
    const Reflections::Mirroring& mirroring = reflections.tiles[tile].surfaces[i];
    Eigen::Array3f* const luminance = &(*luminances)[tile][i];
    const std::uint32_t at = next[surface.pixel]++;
    ones.all[at] = {surface.position,
                    surface.shading_normal,
                    surface.geometric_normal,
                    surface.roughness,
                    surface.metalness,
                    mirroring.nearest_m,
                    static_cast<int>(surface.pixel % width),
                    static_cast<int>(surface.pixel / width)};
    // Where all of its rays went below the surface, points of what shines count for those about.
    ones.shown[at] = {
        mirroring.weight > 0.0f ? Eigen::Array3f(mirroring.weight * *luminance) : mirroring.shining,
        mirroring.weight};
    ones.luminances[at] = luminance;
    return true;
  });
  return ones;
}

/// Pixels of so many blocks about one along an axis, as many of each column, or row, of a block.
struct Window {
  int first, last;
  bool even;  ///< one more than blocks have, its ends by half

  Window(int at, std::uint32_t blocks, int length) {
    const int half = static_cast<int>(blocks) * kLobePixels / 2;
    first = at - half;
    last = at + half;
    even = first >= 0 && last < length;
    if (even) return;
    first = std::clamp(first, 0, std::max(length - 2 * half, 0));
    last = std::min(first + 2 * half, length) - 1;
  }
  float weight(int at) const { return even && (at == first || at == last) ? 0.5f : 1.0f; }
};

/// Whether surfaces mirror much the same.
bool alike(const Rough& a, const Rough& b) {
  constexpr float kSameNormal = 0.995f;  // 6°
  constexpr float kSameRoughness = 0.1f;
  constexpr float kThickness_m = 0.02f, kSlope = 0.01f;  // of one plane
  const Eigen::Vector3f apart = b.position - a.position;
  const float off = a.geometric_normal.dot(apart), allowed = kSlope * kSlope * apart.squaredNorm();
  return std::abs(a.roughness - b.roughness) < kSameRoughness &&
         (a.metalness > 0.5f) == (b.metalness > 0.5f) &&
         a.shading_normal.dot(b.shading_normal) > kSameNormal &&
         off * off < kThickness_m * kThickness_m + allowed;
}

bool isNear(const Rough& a, const Rough& b) {
  return (a.position - b.position).squaredNorm() <= a.reach_m * a.reach_m;
}

/// Of what rays met, others may be so far from where they started.
constexpr float kNear = 1.0f;
/// But those of its own block always may, px: where a mirror stands on something, a pixel's own few rays
/// would be all that it shows, and one of them that gets away to the sky a bright dot.
constexpr float kLeastNear = 0.7072f * static_cast<float>(kLobePixels);

/// Sets reach_m, which is what each one's own rays met at the nearest, to what they may share by what those
/// of its block have met.
template <typename PixelAt>
void findReaches(const Surfaces& surfaces, const PixelAt& pixelAt, RoughOnes* ones) {
  std::vector<float> reaches(ones->all.size());
  const float least_rad = kLeastNear * lobePixels(surfaces).rad;
  constexpr std::size_t kGrain = 1024;
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, reaches.size(), kGrain), [&](const auto& range) {
    for (std::size_t i = range.begin(); i < range.end(); ++i) {
      const Rough& one = ones->all[i];
      const Window across(one.x, 1, surfaces.width), down(one.y, 1, surfaces.height);
      float nearest = one.reach_m;
      for (int y = down.first; y <= down.last; ++y) {
        for (int x = across.first; x <= across.last; ++x) {
          const std::size_t pixel = pixelAt(x, y);
          for (std::uint32_t k = ones->first[pixel]; k < ones->first[pixel + 1]; ++k)
            if (alike(one, ones->all[k])) nearest = std::min(nearest, ones->all[k].reach_m);
        }
      }
      reaches[i] = std::max(kNear * nearest, least_rad * (one.position - surfaces.eye).norm());
    }
  });
  for (std::size_t i = 0; i < reaches.size(); ++i) ones->all[i].reach_m = reaches[i];
}

/// For each what those of one row, or column, show together that are like it.
template <typename WindowOf, typename PixelAt>
std::vector<Shown> shared(const RoughOnes& ones, const std::vector<Shown>& shown, const WindowOf& windowOf,
                          const PixelAt& pixelAt) {
  std::vector<Shown> sums(shown.size());
  constexpr std::size_t kGrain = 1024;
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, shown.size(), kGrain), [&](const auto& range) {
    for (std::size_t i = range.begin(); i < range.end(); ++i) {
      const Rough& one = ones.all[i];
      const Window window = windowOf(one);
      for (int at = window.first; at <= window.last; ++at) {
        const std::size_t pixel = pixelAt(one, at);
        for (std::uint32_t k = ones.first[pixel]; k < ones.first[pixel + 1]; ++k)
          if (alike(one, ones.all[k]) && isNear(one, ones.all[k])) sums[i].add(window.weight(at), shown[k]);
      }
    }
  });
  return sums;
}

}  // namespace

void shareLobes(const Surfaces& surfaces, const Reflections& reflections, MirroredLuminances* luminances) {
  if (!anyFillsLobe(surfaces, reflections)) return;
  RoughOnes ones = collect(surfaces, reflections, luminances);
  const LobePixels pixels = lobePixels(surfaces);
  const auto pixel = [&](int x, int y) { return static_cast<std::size_t>(y * surfaces.width + x); };
  findReaches(surfaces, pixel, &ones);
  const std::vector<Shown> rows = shared(
      ones, ones.shown,
      [&](const Rough& one) {
        const LobeReach reach = lobeReach(one.roughness, pixels);
        return Window(one.x, std::isinf(one.reach_m) ? reach.across : reach.down, surfaces.width);
      },
      [&](const Rough& one, int x) { return pixel(x, one.y); });
  const std::vector<Shown> blocks = shared(
      ones, rows,
      [&](const Rough& one) { return Window(one.y, lobeReach(one.roughness, pixels).down, surfaces.height); },
      [&](const Rough& one, int y) { return pixel(one.x, y); });
  for (std::size_t i = 0; i < blocks.size(); ++i)
    if (blocks[i].weight > 0.0f) *ones.luminances[i] = blocks[i].sum / blocks[i].weight;
}

}  // namespace sunlit::light
