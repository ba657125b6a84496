#include "light/bake/samples/leaf_openness.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/partitioner.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <stdexcept>

#include "light/bake/samples/crown_shadows.h"
#include "light/geometry/corners.h"
#include "light/geometry/cutout.h"
#include "light/geometry/triangle_grid.h"
#include "light/patches/sky_patches.h"
#include "light/patches/sky_sectors.h"
#include "sunlit/light/visibility.h"

namespace sunlit::light {
namespace {

constexpr float kStep_m = 0.4f;  ///< of a grid, where a card is not too large
constexpr int kMostSteps = 9;
/// Trees of larger cards are made to be seen from afar.
constexpr float kFar_m = 5.0f;
constexpr int kFarSteps = 3;
constexpr std::size_t kNodeBytes = LeafOpenness::kNodeBytes;
/// Nodes are that much nearer to the triangle's middle than its edges; where they are but three, such as in a
/// tuft of grass, they stand for the parts around them.
constexpr float kInwards = 0.04f, kInwardsOfThree = 0.3f;
/// Leaves of one square of the map are looked at together, and share what is beyond by cells.
constexpr float kGroup_m = 16.0f, kCell_m = 1.0f;
constexpr float kFarGroup_m = 64.0f, kFarCell_m = 2.0f;

int nodeCount(int steps) {
  return (steps + 1) * (steps + 2) / 2;
}
int nodeAt(const GridNode& node, int steps) {
  return node.second * (steps + 1) - node.second * (node.second - 1) / 2 + node.third;
}

int stepsOf(const Geometry& geometry, std::uint32_t t) {
  const float edge = edgeOf(geometry, t);
  if (edge > kFar_m) return kFarSteps;
  return std::clamp(static_cast<int>(std::ceil(edge / kStep_m)), 1, kMostSteps);
}

/// Each bit of a byte as a byte of its own, 1 or 0, the lowest first in memory.
std::array<std::uint64_t, 256> bitsSpread() {
  std::array<std::uint64_t, 256> spread;
  for (std::size_t byte = 0; byte < spread.size(); ++byte) {
    std::array<std::uint8_t, 8> bits;
    for (std::size_t bit = 0; bit < 8; ++bit) bits[bit] = byte >> bit & 1u;
    std::memcpy(&spread[byte], bits.data(), sizeof(spread[byte]));
  }
  return spread;
}

class Looker {
 public:
  Looker(const std::shared_ptr<const Geometry>& geometry, const std::vector<TriangleTraits>& traits)
      : geometry_(*geometry), visibility_(geometry), cutouts_(*geometry) {
    openness_.first.assign(traits.size(), LeafOpenness::kNone);
    const std::vector<std::uint32_t>& masked = cutouts_.maskedTriangles();
    std::size_t at = 0;
    for (std::uint32_t i = 0; i < masked.size(); ++i) {
      const std::uint32_t t = masked[i];
      // Wire and the like have but the sky on one side, and mirror it more sharply than by sectors.
      const auto material = static_cast<std::size_t>(geometry_.materials[t]);
      if (!isLeaf(traits[t].kind) || geometry_.scene->materials[material].transmission <= 0.0f) continue;
      addToGroup(i);
      openness_.first[t] = static_cast<std::uint32_t>(at);
      at += 1 + kNodeBytes * static_cast<std::size_t>(nodeCount(stepsOf(geometry_, t)));
      if (at >= LeafOpenness::kNone)
        throw std::runtime_error("bake of light: too many leaves for 4 GB of grids");
    }
    openness_.grids.resize(at);
    if (groups_.empty()) openness_.first.own().clear();
  }

  LeafOpenness look(const Progress& progress) {
    std::vector<const Group*> groups;
    for (const auto& [key, group] : groups_) groups.push_back(&group);
    // The largest first, so that none is left alone at the end.
    std::stable_sort(groups.begin(), groups.end(),
                     [](const Group* a, const Group* b) { return a->masked.size() > b->masked.size(); });
    std::size_t all = 0;
    for (const Group* group : groups) all += group->masked.size();
    WorkDone done(progress, all);
    tbb::parallel_for(
        tbb::blocked_range<std::size_t>(0, groups.size(), 1),
        [&](const tbb::blocked_range<std::size_t>& range) {
          for (std::size_t i = range.begin(); i < range.end(); ++i) {
            lookFrom(*groups[i]);
            done.add(groups[i]->masked.size());
          }
        },
        tbb::simple_partitioner());
    return std::move(openness_);
  }

 private:
  /// Leaves of one square of the map.
  struct Group {
    std::vector<std::uint32_t> masked;  ///< index into Cutouts::maskedTriangles()
    float cell_m;
  };
  using Key = std::array<int, 3>;
  struct Points {
    std::vector<CrownShadows::Point> points;
    std::vector<std::size_t> to;  ///< of each point: where its patches are kept
  };

  void addToGroup(std::uint32_t masked) {
    const std::uint32_t t = cutouts_.maskedTriangles()[masked];
    const bool far = edgeOf(geometry_, t) > kFar_m;
    const float size = far ? kFarGroup_m : kGroup_m;
    const Eigen::Vector3f& corner = geometry_.positions[geometry_.triangles[t][0]];
    const auto square = [size](float x) {
      return static_cast<int>(std::floor(std::clamp(x / size, -1e9f, 1e9f)));
    };
    const Key key = {far, square(corner.x()), square(corner.y())};
    Group& group = groups_[key];
    group.cell_m = far ? kFarCell_m : kCell_m;
    group.masked.push_back(masked);
  }

  void lookFrom(const Group& group) {
    Points points;
    for (const std::uint32_t masked : group.masked) addPoints(masked, &points);
    const std::vector<std::size_t>& to = points.to;
    CrownShadows crown({geometry_, cutouts_, visibility_}, std::move(points.points), group.cell_m);
    for (const SkyPatches::Ray& ray : patches_.coarseRays()) {
      if (ray.patch == SkyPatches::kBelow) continue;
      const std::vector<std::uint8_t>& open = crown.open(ray.towards);
      const auto byte = static_cast<std::size_t>(ray.patch / 8);
      const int bit = ray.patch % 8;
      for (std::size_t i = 0; i < to.size(); ++i)
        openness_.grids[to[i] + byte] |= static_cast<std::uint8_t>(open[i] << bit);
    }
  }

  void addPoints(std::uint32_t masked, Points* points) {
    const std::uint32_t t = cutouts_.maskedTriangles()[masked];
    const int steps = stepsOf(geometry_, t);
    const auto& c = geometry_.triangles[t];
    const std::vector<bool> needed = neededNodes(masked, steps);
    const std::size_t grid = openness_.first[t];
    openness_.grids[grid] = static_cast<std::uint8_t>(steps);
    const float inwards = steps == 1 ? kInwardsOfThree : kInwards;
    std::size_t node = 0;
    for (int i = 0; i <= steps; ++i) {
      for (int j = 0; i + j <= steps; ++j, ++node) {
        if (!needed[node]) continue;
        const float u = static_cast<float>(i) / static_cast<float>(steps) * (1.0f - inwards) + inwards / 3.0f;
        const float v = static_cast<float>(j) / static_cast<float>(steps) * (1.0f - inwards) + inwards / 3.0f;
        points->points.push_back({(1.0f - u - v) * geometry_.positions[c[0]] + u * geometry_.positions[c[1]] +
                                      v * geometry_.positions[c[2]],
                                  geometry_.planes[t].normal});
        points->to.push_back(grid + 1 + kNodeBytes * node);
      }
    }
  }

  /// Nodes around which nothing is solid are never asked for.
  std::vector<bool> neededNodes(std::uint32_t masked, int steps) const {
    std::vector<bool> needed(static_cast<std::size_t>(nodeCount(steps)), false);
    const int across = 3 * steps;
    for (int i = 0; i < across; ++i) {
      for (int j = 0; i + j < across; ++j) {
        const float u = (static_cast<float>(i) + 0.33f) / static_cast<float>(across);
        const float v = (static_cast<float>(j) + 0.33f) / static_cast<float>(across);
        if (!cutouts_.solid(masked, u, v)) continue;
        for (const GridNode& node : GridPlace(u, v, steps).node)
          needed[static_cast<std::size_t>(nodeAt(node, steps))] = true;
      }
    }
    return needed;
  }

  const Geometry& geometry_;
  Visibility visibility_;
  Cutouts cutouts_;
  const SkyPatches patches_{1};
  std::map<Key, Group> groups_;
  LeafOpenness openness_;
};

}  // namespace

PatchBytes LeafOpenness::patches(std::uint32_t triangle, const std::array<float, 3>& within) const {
  const std::uint8_t* grid = grids.data() + first[triangle];
  const GridPlace around(within[1], within[2], grid[0]);
  std::array<const std::uint8_t*, 3> node;
  for (std::size_t k = 0; k < 3; ++k)
    node[k] = grid + 1 + kNodeBytes * static_cast<std::size_t>(nodeAt(around.node[k], grid[0]));
  // Whole numbers that sum to 255, so that eight patches can be weighed at once.
  const auto a = static_cast<std::uint64_t>(around.weight[0] * 255.0f + 0.5f);
  const auto b = std::min(static_cast<std::uint64_t>(around.weight[1] * 255.0f + 0.5f), 255 - a);
  const std::uint64_t c = 255 - a - b;
  static const std::array<std::uint64_t, 256> spread = bitsSpread();
  PatchBytes open;
  for (std::size_t i = 0; i < kNodeBytes; ++i) {
    const std::uint64_t eight = spread[node[0][i]] * a + spread[node[1][i]] * b + spread[node[2][i]] * c;
    std::memcpy(&open[8 * i], &eight, sizeof(eight));
  }
  return open;
}

SkyOpenness LeafOpenness::at(std::uint32_t triangle, const std::array<float, 3>& within) const {
  SkyOpenness view;
  view.open = SkySectors::openOf(patches(triangle, within));
  view.known = true;
  view.within = within;
  return view;
}

LeafOpenness leafOpenness(const std::shared_ptr<const Geometry>& geometry,
                          const std::vector<TriangleTraits>& traits, const Progress& progress) {
  return Looker(geometry, traits).look(progress);
}

}  // namespace sunlit::light
