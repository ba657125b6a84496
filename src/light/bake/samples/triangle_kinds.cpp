#include "light/bake/samples/triangle_kinds.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>

#include "light/bake/samples/probe.h"
#include "light/bake/samples/triangle_places.h"
#include "sunlit/light/surfaces.h"
#include "sunlit/light/visibility.h"

namespace sunlit::light {
namespace {

constexpr float kLargeEdge_m = 1.0f;  ///< posts stand half in the open, half behind a board
constexpr float kLargeArea_m2 = 0.3f;
constexpr float kLargestLeaf_m2 = 2.0f;
constexpr float kSmallestSpray_m2 = 0.3f;
constexpr float kLargestSpray_m2 = 4.0f;
constexpr float kClear_m = 2e-3f;  ///< of where rays start, at least

/// Shares of what one side of a triangle sees from its middle.
struct Outlook {
  float up = 0.0f, down = 0.0f, backs = 0.0f, fronts = 0.0f;
  float all() const { return up + down + backs + fronts; }
  /// Nothing escapes, and much of what is seen is seen from behind: within a body, maybe a hollow one.
  bool inside() const { return up + down <= 0.0f && backs > 0.4f * all(); }
  /// Within one that nobody looks into.
  bool sealed() const { return inside() && backs > 0.8f * all(); }
  /// Nothing of the scene and nothing of the sky: the underside of the world.
  bool buried() const { return up + backs + fronts <= 0.0f; }
};

using Outlooks = std::array<Outlook, RayPacket::kSize>;

constexpr std::size_t kPlacesOfSmall = 4;

struct Side {
  std::uint32_t triangle;
  int side;
};

/// Whether a camera may see the side of a triangle of that kind, or light that gets through its sheet. Leaves
/// have both in one.
bool matters(const Geometry& geometry, const Side& side, TriangleKind kind) {
  const auto number = static_cast<std::size_t>(geometry.materials[side.triangle]);
  const scene::Material& material = geometry.scene->materials[number];
  const bool lets_through = seenThrough(material) || material.transmission > 0.0f;
  return side.side == 0 || material.double_sided || (lets_through && !isLeaf(kind));
}

/// What is looked at, and along which rays.
struct Surrounding {
  const Geometry& geometry;
  const BakeRays& rays;
  std::vector<SkyPatches::Ray> pattern;
  /// Of each triangle, whether a side that matters looks at its back. Set by many threads.
  std::vector<std::atomic<bool>> backs_seen;
};

/// Of up to a packet of sides from `first` on, each seen from one place on its triangle.
Outlooks outlooks(const Side* first, int count, const Eigen::Vector3f& place, Surrounding* around) {
  const Geometry& geometry = around->geometry;
  const std::vector<SkyPatches::Ray>& pattern = around->pattern;
  std::array<Receiver, RayPacket::kSize> receivers;
  std::array<bool, RayPacket::kSize> matter{};
  for (int i = 0; i < count; ++i) {
    Receiver& receiver = receivers[static_cast<std::size_t>(i)];
    matter[static_cast<std::size_t>(i)] =
        matters(geometry, first[i], triangleKind(geometry, first[i].triangle));
    receiver.normal = sideNormal(geometry, first[i].triangle, first[i].side);
    const Eigen::Vector3f origin = placeOn(geometry, first[i].triangle, place);
    receiver.origins.fill(origin);
    receiver.lifts.fill(std::max(kClear_m, rayClearance_m(origin, 0.0f)) * receiver.normal);
  }
  Outlooks result;
  probe(around->rays, pattern, {receivers.data(), count},
        [&](int i, std::size_t r, float weight, const HitLayers& hits) {
          Outlook& outlook = result[static_cast<std::size_t>(i)];
          hits.visit(i, [&](const HitPacket& met, float share, PackedTint) {
            const std::uint32_t hit = met.triangle[i];
            if (hit == HitPacket::kNothing) {
              (pattern[r].towards.z() > 0.0f ? outlook.up : outlook.down) += share * weight;
              return;
            }
            // Leaves turn their backs to all sides, and veils close nothing in.
            const bool back = geometry.planes[hit].normal.dot(pattern[r].towards) > 0.0f &&
                              !isLeaf(triangleKind(geometry, hit));
            (back && &met == &hits.ends ? outlook.backs : outlook.fronts) += share * weight;
            if (back && matter[static_cast<std::size_t>(i)])
              around->backs_seen[hit].store(true, std::memory_order_relaxed);
          });
        });
  return result;
}

/// No camera sees the back of a sheet of one side, but what looks at it has light from there.
void useWhatMatters(const Surrounding& around, std::vector<TriangleTraits>* traits) {
  for (std::uint32_t t = 0; t < traits->size(); ++t) {
    TriangleTraits& to = (*traits)[t];
    const bool back_matters = around.backs_seen[t] && !to.solid && !isLeaf(to.kind);
    to.used[0] = to.used[0] && matters(around.geometry, {t, 0}, to.kind);
    to.used[1] = to.used[1] && (back_matters || matters(around.geometry, {t, 1}, to.kind));
  }
}

/// Small triangles that stick through large ones, as a beam through a wall, would have light of both sides
/// all along: they get cells of their own, which are cut there.
void promoteWhatSticksThrough(const BakeRays& rays, const Geometry& geometry,
                              std::vector<TriangleTraits>* traits) {
  constexpr float kAbove_m = 5e-3f;
  constexpr float kLevel = 0.9f;  // what stands on ground goes on below it as a rule
  constexpr std::size_t kEdges = 3, kAtOnce = kPacket / kEdges;
  std::vector<std::uint32_t> small;
  for (std::uint32_t t = 0; t < traits->size(); ++t)
    if ((*traits)[t].kind == TriangleKind::kSmall) small.push_back(t);
  std::vector<char> through(small.size(), 0);
  tbb::parallel_for(std::size_t{0}, (small.size() + kAtOnce - 1) / kAtOnce, [&](std::size_t p) {
    const std::size_t begin = p * kAtOnce, count = std::min(kAtOnce, small.size() - begin);
    RayPacket packet;
    HitPacket hits;
    for (std::size_t lane = 0; lane < kPacket; ++lane) {
      const std::uint32_t t = small[begin + std::min(lane / kEdges, count - 1)];
      const auto& corners = geometry.triangles[t];
      const Eigen::Vector3f from = geometry.positions[corners[lane % kEdges]],
                            to = geometry.positions[corners[(lane + 1) % kEdges]];
      packet.set(lane, from + kAbove_m * geometry.planes[t].normal, to - from, lane / kEdges < count);
    }
    rays.cast(packet, &hits);
    for (std::size_t lane = 0; lane < count * kEdges; ++lane) {
      const std::uint32_t hit = hits.triangle[lane];
      if (hit != HitPacket::kNothing && hits.distance[lane] < 1.0f &&
          (*traits)[hit].kind == TriangleKind::kLarge && std::abs(geometry.planes[hit].normal.z()) < kLevel)
        through[begin + lane / kEdges] = 1;
    }
  });
  for (std::size_t i = 0; i < small.size(); ++i)
    if (through[i] != 0) (*traits)[small[i]].kind = TriangleKind::kLarge;
}

/// Both of what is no leaf, all fronts first.
std::vector<Side> sidesOf(const std::vector<TriangleTraits>& traits) {
  std::vector<Side> sides;
  for (const int side : {0, 1})
    for (std::uint32_t t = 0; t < traits.size(); ++t)
      if (!isLeaf(traits[t].kind)) sides.push_back({t, side});
  return sides;
}

}  // namespace

TriangleKind triangleKind(const Geometry& geometry, std::uint32_t t) {
  const auto& corners = geometry.triangles[t];
  const Eigen::Vector3f a = geometry.positions[corners[0]];
  const Eigen::Vector3f ab = geometry.positions[corners[1]] - a, ac = geometry.positions[corners[2]] - a;
  const float longest = std::sqrt(std::max({ab.squaredNorm(), ac.squaredNorm(), (ac - ab).squaredNorm()}));
  const float area = 0.5f * ab.cross(ac).norm();
  const scene::Material& material =
      geometry.scene->materials[static_cast<std::size_t>(geometry.materials[t])];
  if (material.alpha_mode == scene::AlphaMode::kMask) {
    const bool leaf = material.transmission > 0.0f;
    if (leaf && area > kLargestSpray_m2) return TriangleKind::kCanopy;
    if (leaf && area > kSmallestSpray_m2) return TriangleKind::kSpray;
    if (area < kLargestLeaf_m2) return TriangleKind::kFoliage;
  }
  return longest < kLargeEdge_m && area < kLargeArea_m2 ? TriangleKind::kSmall : TriangleKind::kLarge;
}

std::vector<TriangleTraits> triangleTraits(const Geometry& geometry, const BakeRays& rays,
                                           const Progress& progress) {
  std::vector<TriangleTraits> traits(geometry.triangles.size());
  for (std::uint32_t t = 0; t < traits.size(); ++t) traits[t].kind = triangleKind(geometry, t);
  std::vector<Side> sides = sidesOf(traits);
  promoteWhatSticksThrough(rays, geometry, &traits);
  Surrounding around{geometry, rays, {}, std::vector<std::atomic<bool>>(traits.size())};
  const SkyPatches patches(1);
  for (std::size_t i = 0; i < patches.coarseRays().size(); i += 6)
    around.pattern.push_back(patches.coarseRays()[i]);
  for (std::size_t place = 0; place < kTrianglePlaces.size() && !sides.empty(); ++place) {
    std::vector<std::uint8_t> useless(sides.size()), sealed(sides.size());
    const std::size_t packets = (sides.size() + RayPacket::kSize - 1) / RayPacket::kSize;
    // From the first place all look, from others few.
    WorkDone done(place == 0 ? progress : nullptr, packets);
    tbb::parallel_for(std::size_t{0}, packets, [&](std::size_t p) {
      const std::size_t first = p * RayPacket::kSize;
      const std::size_t end = std::min(first + RayPacket::kSize, sides.size());
      const Outlooks from_there =
          outlooks(sides.data() + first, static_cast<int>(end - first), kTrianglePlaces[place], &around);
      for (std::size_t i = first; i < end; ++i) {
        const Outlook& outlook = from_there[i - first];
        if (place == 0 && sides[i].side == 1) {
          TriangleTraits& to = traits[sides[i].triangle];
          to.solid = outlook.inside();
        }
        sealed[i] = outlook.sealed() ? 1 : 0;
        useless[i] = outlook.sealed() || outlook.buried() ? 1 : 0;
      }
      done.add();
    });
    // What is hidden in one place may be seen in another: a slab half sunk into the ground.
    std::vector<Side> left;
    for (std::size_t i = 0; i < sides.size(); ++i) {
      TriangleTraits& to = traits[sides[i].triangle];
      to.used[sides[i].side] = useless[i] == 0;
      to.sealed[sides[i].side] = sealed[i] != 0 && (place == 0 || to.sealed[sides[i].side]);
      const bool large = to.kind == TriangleKind::kLarge;
      if (useless[i] != 0 && (large || place + 1 < kPlacesOfSmall) && matters(geometry, sides[i], to.kind))
        left.push_back(sides[i]);
    }
    sides.swap(left);
  }
  useWhatMatters(around, &traits);
  return traits;
}

}  // namespace sunlit::light
