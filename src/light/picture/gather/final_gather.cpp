#include "light/picture/gather/final_gather.h"

#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <mutex>
#include <utility>
#include <vector>

#include "light/geometry/corners.h"
#include "light/geometry/morton.h"
#include "light/geometry/ray_list.h"
#include "light/geometry/triangle_grid.h"
#include "light/patches/sky_patches.h"
#include "light/picture/gather/kept_nodes.h"
#include "sunlit/quantity/vector_clones.h"

namespace sunlit::light {
namespace {

constexpr float kLargest_m = 2.0f;  ///< beyond it the bake's nodes tell as much: edgeOf() a triangle
/// Between nodes: the first of kFinest_m · 2^k that is not below kPixels of a picture's pixels there.
constexpr float kFinest_m = 0.05f, kPixels = 2.0f / 3.0f;
constexpr int kMostSteps = 1000;
/// Nodes at the rim are drawn towards the triangle's middle, by so much of a step times their distance to it:
/// on the rim itself chance would decide on which side of what touches it they lie. Those of a triangle
/// without any others then stand for the parts around them.
constexpr float kInwards = 0.3f;
/// Nodes aim in three ways: no two that share a triangle of a grid aim at the same points.
constexpr std::size_t kAims = 3;
constexpr std::size_t kBlock = 192;  ///< nodes whose rays are cast together
constexpr float kBlock_m = 0.5f;     ///< of space, whose nodes follow each other
constexpr std::size_t kPatches = GatheredSky::kPatches;
static_assert(kPatches == SkyPatches::kCount, "a share for each patch");

/// A node: its triangle, the side that it looks from, and its place in the triangle's grid.
struct Node {
  std::uint32_t triangle;
  bool front;
  int steps;
  GridNode at;

  static constexpr int kBits = 10;  ///< of each number in a grid
  static_assert(kMostSteps < 1 << kBits, "steps fit into a key");

  KeptNodes::Key key() const {
    const auto number = [](int value) { return static_cast<KeptNodes::Key>(value); };
    return KeptNodes::Key{triangle} << (1 + 3 * kBits) | number(front) << 3 * kBits |
           number(steps) << 2 * kBits | number(at.second) << kBits | number(at.third);
  }
  static Node of(KeptNodes::Key key) {
    constexpr KeptNodes::Key kMask = (1u << kBits) - 1;
    const auto number = [key](int shift) { return static_cast<int>(key >> shift & kMask); };
    return {static_cast<std::uint32_t>(key >> (1 + 3 * kBits)),
            (key >> 3 * kBits & 1u) != 0,
            number(2 * kBits),
            {number(kBits), number(0)}};
  }
};

/// What is divided into steps: a short side of half a square. Long thin triangles need nodes closer along
/// them than steps of their edgeOf() are, but steps of their longest edge would be many nodes side by side.
float spanOf(float edge_m, float longest_m) {
  constexpr float kOfHalfSquare = 1.41421356f;
  return std::sqrt(edge_m * longest_m / kOfHalfSquare);
}

/// A surface, and the nodes that it lies between.
struct Place {
  std::uint32_t surface;  ///< index into Tile::surfaces
  std::array<KeptNodes::Key, 3> key;
  std::array<float, 3> weight;
};

/// Between three skies.
SUNLIT_WIDE_VECTOR_CLONES
void blend(const std::array<const std::uint8_t*, 3>& skies, const std::array<float, 3>& weight,
           std::uint8_t* __restrict open) {
  const std::uint8_t *const a = skies[0], *const b = skies[1], *const c = skies[2];
  const float of_a = weight[0], of_b = weight[1], of_c = weight[2];
  for (std::size_t p = 0; p < kPatches; ++p) {
    const float sum =
        of_a * static_cast<float>(a[p]) + of_b * static_cast<float>(b[p]) + of_c * static_cast<float>(c[p]);
    open[p] = static_cast<std::uint8_t>(static_cast<int>(sum + 0.5f));
  }
}

/// Which rays of a node got through, patch by patch.
struct Counts {
  std::array<std::uint8_t, kPatches> cast{}, open{};

  float share(std::size_t patch) const {
    return static_cast<float>(open[patch]) / static_cast<float>(cast[patch]);
  }
};

/// Of each patch above the horizon those beside it.
std::vector<std::vector<int>> neighboursOfPatches() {
  std::vector<std::vector<int>> neighbours;
  for (int patch = 0; patch < SkyPatches::kAbove; ++patch)
    neighbours.push_back(SkyPatches::neighbours(patch));
  return neighbours;
}

/// A patch that a node's plane cuts may have had no ray before it: it is as open as those beside it are.
GatheredSky skyOf(const Counts& counts) {
  static const std::vector<std::vector<int>> neighbours = neighboursOfPatches();
  GatheredSky sky;
  for (std::size_t p = 0; p < neighbours.size(); ++p) {
    float sum = 0.0f, told = 0.0f;
    if (counts.cast[p] > 0) {
      sum = counts.share(p);
      told = 1.0f;
    } else {
      for (const int neighbour : neighbours[p]) {
        const auto n = static_cast<std::size_t>(neighbour);
        if (counts.cast[n] == 0) continue;
        sum += counts.share(n);
        told += 1.0f;
      }
    }
    if (told > 0.0f) sky.open[p] = static_cast<std::uint8_t>(static_cast<int>(255.0f * sum / told + 0.5f));
  }
  return sky;
}

}  // namespace

class FinalGather::Implementation {
 public:
  Implementation(std::shared_ptr<const Geometry> geometry, std::shared_ptr<const Visibility> visibility,
                 int rays_per_patch)
      : geometry_(std::move(geometry)), visibility_(std::move(visibility)), rays_per_patch_(rays_per_patch) {
    // The rays of each aim fill a patch evenly, and those of all together do.
    const SkyPatches all(static_cast<int>(kAims) * rays_per_patch);
    std::array<std::size_t, SkyPatches::kAbove> number{};
    for (const SkyPatches::Ray& ray : all.rays()) {
      if (ray.patch == SkyPatches::kBelow) continue;
      rays_[number[static_cast<std::size_t>(ray.patch)]++ % kAims].push_back({ray.towards, ray.patch});
    }
  }

  void look(const Surfaces& surfaces, Outlooks* outlooks) {
    std::vector<std::vector<Place>> places(surfaces.tiles.size());
    const Camera camera{surfaces.eye, surfaces.pixel_right.norm()};
    tbb::parallel_for(std::size_t{0}, places.size(), [&](std::size_t i) {
      places[i] = placesIn(surfaces.tiles[i], (*outlooks)[i], camera);
    });
    const std::vector<KeptNodes::Key> wanted = keysOf(places);
    const std::lock_guard<std::mutex> lock(looking_);
    // So that a thread which waits for others here gets no other work, which might wait for the lock.
    tbb::this_task_arena::isolate([&] {
      require(wanted);
      tbb::parallel_for(std::size_t{0}, places.size(),
                        [&](std::size_t i) { fill(places[i], &(*outlooks)[i]); });
    });
  }

  bool finds(const Geometry& geometry, int rays_per_patch) const {
    return geometry.shape == geometry_->shape && geometry.scene == geometry_->scene &&
           rays_per_patch == rays_per_patch_;
  }

  std::size_t nodesSeen() const { return seen_; }
  std::size_t nodesCast() const { return cast_; }
  std::size_t raysCast() const { return rays_cast_; }
  std::size_t nodesKept() const { return kept_.size(); }

 private:
  struct Ray {
    Eigen::Vector3f towards;
    int patch;
  };
  struct Camera {
    Eigen::Vector3f eye;
    float pixel;  ///< its width at a depth of 1 m, m
  };

  bool isThin(std::uint32_t triangle) const {
    const auto material = static_cast<std::size_t>(geometry_->materials[triangle]);
    return geometry_->scene->materials[material].transmission > 0.0f;
  }

  std::vector<Place> placesIn(const Tile& tile, const TileOutlooks& outlooks, const Camera& camera) const {
    std::vector<Place> places;
    for (std::uint32_t i = 0; i < tile.surfaces.size(); ++i) {
      const Surface& surface = tile.surfaces[i];
      const WholeOutlook outlook = outlooks.whole(i);
      if (surface.triangle >= geometry_->triangles.size() || !outlook.own.light.known()) continue;
      const float edge = edgeOf(*geometry_, surface.triangle);
      if (!outlook.sheet.sky.known && edge > kLargest_m) continue;
      const float span = spanOf(edge, longestEdge(*geometry_, surface.triangle));
      float step = kFinest_m;
      const float most = kPixels * camera.pixel * (surface.position - camera.eye).norm();
      while (step < most) step *= 2.0f;
      const int steps = std::clamp(static_cast<int>(std::ceil(span / step)), 1, kMostSteps);
      const std::array<float, 3> within = Corners(*geometry_, surface.triangle).within(surface.position);
      const GridPlace place(within[1], within[2], steps);
      // Thin sheets look to both sides from each.
      const bool front = isThin(surface.triangle) ||
                         geometry_->planes[surface.triangle].normal.dot(surface.geometric_normal) > 0.0f;
      Place& added = places.emplace_back();
      added.surface = i;
      added.weight = place.weight;
      for (std::size_t k = 0; k < 3; ++k)
        added.key[k] = Node{surface.triangle, front, steps, place.node[k]}.key();
    }
    return places;
  }

  /// Each once.
  static std::vector<KeptNodes::Key> keysOf(const std::vector<std::vector<Place>>& places) {
    std::vector<KeptNodes::Key> keys;
    for (const std::vector<Place>& of_tile : places)
      for (const Place& place : of_tile) keys.insert(keys.end(), place.key.begin(), place.key.end());
    tbb::parallel_sort(keys.begin(), keys.end());
    keys.erase(std::unique(keys.begin(), keys.end()), keys.end());
    return keys;
  }

  Eigen::Vector3f positionOf(const Node& node) const {
    const float inwards = kInwards / static_cast<float>(node.steps);
    const auto share = [&](int steps) {
      return static_cast<float>(steps) / static_cast<float>(node.steps) * (1.0f - inwards) + inwards / 3.0f;
    };
    const float u = share(node.at.second), v = share(node.at.third);
    const auto& corners = geometry_->triangles[node.triangle];
    return (1.0f - u - v) * geometry_->positions[corners[0]] + u * geometry_->positions[corners[1]] +
           v * geometry_->positions[corners[2]];
  }

  /// Those together that lie together: their rays meet the same things.
  std::vector<KeptNodes::Key> inSpace(std::vector<KeptNodes::Key> keys) const {
    std::vector<std::pair<std::uint64_t, KeptNodes::Key>> order(keys.size());
    tbb::parallel_for(std::size_t{0}, keys.size(), [&](std::size_t i) {
      order[i] = {mortonCode(positionOf(Node::of(keys[i])), kBlock_m), keys[i]};
    });
    tbb::parallel_sort(order.begin(), order.end());
    for (std::size_t i = 0; i < keys.size(); ++i) keys[i] = order[i].second;
    return keys;
  }

  /// Where a node's rays start, and how they are aimed.
  struct Start {
    std::uint32_t number;
    Eigen::Vector3f position, normal, off;
    bool thin;
  };
  Start startOf(std::uint32_t number, const Node& node) const {
    const Eigen::Vector3f position = positionOf(node);
    const Eigen::Vector3f normal = (node.front ? 1.0f : -1.0f) * geometry_->planes[node.triangle].normal;
    return {number, position, normal, rayClearance_m(position, 0.0f) * normal, isThin(node.triangle)};
  }

  /// Parallel rays of neighbouring nodes follow each other, as the ray library likes them.
  static void addRays(const std::vector<Start>& starts, const std::vector<Ray>& rays, RayList* list) {
    list->reserve(starts.size() * rays.size());
    for (const Ray& ray : rays) {
      for (const Start& start : starts) {
        const float side = start.normal.dot(ray.towards) > 0.0f ? 1.0f : -1.0f;
        if (side < 0.0f && !start.thin) continue;
        list->add(start.number << 8 | static_cast<std::uint32_t>(ray.patch),
                  start.position + side * start.off, ray.towards);
      }
    }
  }

  void require(const std::vector<KeptNodes::Key>& wanted) {
    seen_ = wanted.size();
    try {
      castNew(kept_.require(wanted));
    } catch (...) {
      kept_ = KeptNodes();  // some of them were not filled in
      throw;
    }
  }

  void castNew(std::vector<KeptNodes::Key> fresh) {
    cast_ = fresh.size();
    rays_cast_ = 0;
    fresh = inSpace(std::move(fresh));
    tbb::parallel_for(std::size_t{0}, (fresh.size() + kBlock - 1) / kBlock, [&](std::size_t block) {
      const auto first = fresh.begin() + static_cast<std::ptrdiff_t>(block * kBlock);
      castFrom({first, first + std::min<std::ptrdiff_t>(kBlock, fresh.end() - first)});
    });
  }

  void castFrom(const std::vector<KeptNodes::Key>& keys) {
    thread_local RayList rays;
    thread_local std::vector<std::uint8_t> blocked;
    std::array<std::vector<Start>, kAims> starts;
    for (std::uint32_t i = 0; i < keys.size(); ++i) {
      const Node node = Node::of(keys[i]);
      starts[static_cast<std::size_t>(node.at.second + 2 * node.at.third) % kAims].push_back(
          startOf(i, node));
    }
    rays.clear();
    for (std::size_t aim = 0; aim < kAims; ++aim) addRays(starts[aim], rays_[aim], &rays);
    blocked.resize(rays.size());
    visibility_->occluded(rays.rays(), blocked.data());
    rays_cast_ += rays.size();
    std::array<Counts, kBlock> counts{};
    for (std::size_t i = 0; i < rays.size(); ++i) {
      Counts& of_node = counts[rays.number()[i] >> 8];
      const std::uint32_t patch = rays.number()[i] & 0xffu;
      ++of_node.cast[patch];
      of_node.open[patch] = static_cast<std::uint8_t>(of_node.open[patch] + 1 - blocked[i]);
    }
    for (std::size_t i = 0; i < keys.size(); ++i) kept_.at(keys[i]) = skyOf(counts[i]);
  }

  void fill(const std::vector<Place>& places, TileOutlooks* outlooks) const {
    outlooks->gathered.resize(places.size());
    for (std::size_t i = 0; i < places.size(); ++i) {
      const Place& place = places[i];
      const std::array<const std::uint8_t*, 3> skies = {kept_.at(place.key[0]).open.data(),
                                                        kept_.at(place.key[1]).open.data(),
                                                        kept_.at(place.key[2]).open.data()};
      blend(skies, place.weight, outlooks->gathered[i].open.data());
      outlooks->surfaces[place.surface].gathered = static_cast<std::uint32_t>(i);
    }
  }

  std::shared_ptr<const Geometry> geometry_;
  std::shared_ptr<const Visibility> visibility_;
  int rays_per_patch_;
  std::array<std::vector<Ray>, kAims> rays_;
  std::mutex looking_;  ///< of all below
  KeptNodes kept_;
  std::size_t seen_ = 0, cast_ = 0;
  std::atomic<std::size_t> rays_cast_{0};
};

FinalGather::FinalGather(std::shared_ptr<const Geometry> geometry,
                         std::shared_ptr<const Visibility> visibility, int rays_per_patch)
    : implementation_(
          std::make_unique<Implementation>(std::move(geometry), std::move(visibility), rays_per_patch)) {}
FinalGather::~FinalGather() = default;

void FinalGather::look(const Surfaces& surfaces, Outlooks* outlooks) {
  implementation_->look(surfaces, outlooks);
}
bool FinalGather::finds(const Geometry& geometry, int rays_per_patch) const {
  return implementation_->finds(geometry, rays_per_patch);
}
std::size_t FinalGather::nodesSeen() const {
  return implementation_->nodesSeen();
}
std::size_t FinalGather::nodesCast() const {
  return implementation_->nodesCast();
}
std::size_t FinalGather::raysCast() const {
  return implementation_->raysCast();
}
std::size_t FinalGather::nodesKept() const {
  return implementation_->nodesKept();
}

}  // namespace sunlit::light
