#include "light/transport/leaf_openness.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <mutex>
#include <stdexcept>

#include "light/cutout.h"
#include "light/sky_sectors.h"
#include "light/transport/sky_patches.h"
#include "sunlit/light/visibility.h"

namespace sunlit::light {
namespace {

constexpr float kStep_m = 0.5f;  ///< of a grid, where a card is not too large
constexpr int kMostSteps = 7;
/// Trees of larger cards are made to be seen from afar.
constexpr float kFar_m = 5.0f;
constexpr int kFarSteps = 3;
constexpr std::size_t kSectors = SkyView::kSectors;
constexpr float kClear_m = 1e-3f;
/// Nodes are that much nearer to the triangle's middle than its edges; where they are but three, such as in a
/// tuft of grass, they stand for the parts around them.
constexpr float kInwards = 0.04f, kInwardsOfThree = 0.3f;
/// Neighbouring nodes look in other directions: of three around a point each in a third of them.
constexpr int kTurns = 3;
constexpr std::size_t kBlock = 64;  ///< triangles a task
/// Triangles, neighbours mostly, whose rays of one direction travel together.
constexpr std::size_t kTogether = 6;

int nodeCount(int steps) {
  return (steps + 1) * (steps + 2) / 2;
}
int nodeAt(int i, int j, int steps) {
  return i * (steps + 1) - i * (i - 1) / 2 + j;
}

/// The three nodes around a point of the triangle, and their weights.
struct Around {
  std::array<int, 3> node;
  std::array<float, 3> weight;
  Around(float second, float third, int steps) {
    const float u = second * static_cast<float>(steps), v = third * static_cast<float>(steps);
    const int i = std::clamp(static_cast<int>(u), 0, steps - 1);
    const int j = std::clamp(static_cast<int>(v), 0, steps - 1 - i);
    const float x = u - static_cast<float>(i), y = v - static_cast<float>(j);
    if (x + y <= 1.0f || i + j + 2 > steps) {
      node = {nodeAt(i, j, steps), nodeAt(i + 1, j, steps), nodeAt(i, j + 1, steps)};
      weight = {1.0f - x - y, x, y};
    } else {
      node = {nodeAt(i + 1, j + 1, steps), nodeAt(i + 1, j, steps), nodeAt(i, j + 1, steps)};
      weight = {x + y - 1.0f, 1.0f - y, 1.0f - x};
    }
  }
};

int stepsOf(const Geometry& geometry, std::uint32_t t) {
  const auto& c = geometry.triangles[t];
  const Eigen::Vector3f a = geometry.positions[c[0]], b = geometry.positions[c[1]],
                        d = geometry.positions[c[2]];
  const float edge = std::sqrt((b - a).cross(d - a).norm());
  if (edge > kFar_m) return kFarSteps;
  return std::clamp(static_cast<int>(std::ceil(edge / kStep_m)), 1, kMostSteps);
}

struct Node {
  Eigen::Vector3f position, normal;
  int turn;
  bool needed = false;
  std::array<float, kSectors> seen = {};  ///< solid angle, sr
};

class Looker {
 public:
  Looker(const std::shared_ptr<const Geometry>& geometry, const std::vector<TriangleTraits>& traits)
      : geometry_(*geometry), visibility_(geometry), cutouts_(*geometry) {
    const SkyPatches patches(1);
    for (const SkyPatches::Ray& ray : patches.coarseRays()) {
      if (ray.patch == SkyPatches::kBelow) continue;
      const auto turn = static_cast<std::size_t>((ray.patch + ray.patch / 30) % kTurns);
      directions_[turn].push_back(ray);
      whole_[turn][SkySectors::of(ray.patch)] += ray.solid_angle;
    }
    openness_.first.assign(traits.size(), LeafOpenness::kNone);
    const std::vector<std::uint32_t>& masked = cutouts_.maskedTriangles();
    std::size_t at = 0;
    for (std::uint32_t i = 0; i < masked.size(); ++i) {
      const std::uint32_t t = masked[i];
      // Wire and the like have but the sky on one side, and mirror it more sharply than by sectors.
      const auto material = static_cast<std::size_t>(geometry_.materials[t]);
      if (!isLeaf(traits[t].kind) || geometry_.scene->materials[material].transmission <= 0.0f) continue;
      leaves_.push_back(i);
      openness_.first[t] = static_cast<std::uint32_t>(at);
      at += 1 + kSectors * static_cast<std::size_t>(nodeCount(stepsOf(geometry_, t)));
      if (at >= LeafOpenness::kNone)
        throw std::runtime_error("bake of light: too many leaves for 4 GB of grids");
    }
    openness_.grids.resize(at);
    if (leaves_.empty()) openness_.first.clear();
  }

  LeafOpenness look(const std::function<void(double)>& progress) {
    const std::size_t blocks = (leaves_.size() + kBlock - 1) / kBlock;
    std::mutex mutex;
    std::size_t done = 0;
    tbb::parallel_for(std::size_t{0}, blocks, [&](std::size_t block) {
      const std::size_t end = std::min(leaves_.size(), (block + 1) * kBlock);
      for (std::size_t i = block * kBlock; i < end; i += kTogether)
        lookFrom(leaves_.data() + i, std::min(kTogether, end - i));
      const std::lock_guard<std::mutex> lock(mutex);
      progress(static_cast<double>(++done) / static_cast<double>(blocks));
    });
    return std::move(openness_);
  }

 private:
  void lookFrom(const std::uint32_t* masked, std::size_t count) {
    std::vector<Node> nodes;
    for (std::size_t i = 0; i < count; ++i) addNodes(masked[i], &nodes);
    for (int turn = 0; turn < kTurns; ++turn) cast(turn, &nodes);
    const Node* from = nodes.data();
    for (std::size_t i = 0; i < count; ++i) from = write(cutouts_.maskedTriangles()[masked[i]], from);
  }

  void addNodes(std::uint32_t masked, std::vector<Node>* nodes) const {
    const std::uint32_t t = cutouts_.maskedTriangles()[masked];
    const int steps = stepsOf(geometry_, t);
    const auto& c = geometry_.triangles[t];
    const std::size_t first = nodes->size();
    const float inwards = steps == 1 ? kInwardsOfThree : kInwards;
    for (int i = 0; i <= steps; ++i) {
      for (int j = 0; i + j <= steps; ++j) {
        const float u = static_cast<float>(i) / static_cast<float>(steps) * (1.0f - inwards) + inwards / 3.0f;
        const float v = static_cast<float>(j) / static_cast<float>(steps) * (1.0f - inwards) + inwards / 3.0f;
        Node node;
        node.position = (1.0f - u - v) * geometry_.positions[c[0]] + u * geometry_.positions[c[1]] +
                        v * geometry_.positions[c[2]];
        node.normal = geometry_.planes[t].normal;
        node.turn = (i + 2 * j + static_cast<int>(t % kTurns)) % kTurns;
        nodes->push_back(node);
      }
    }
    findNeeded(masked, steps, nodes->data() + first);
  }

  /// Nodes around which nothing is solid are never asked for.
  void findNeeded(std::uint32_t masked, int steps, Node* nodes) const {
    const int across = 3 * steps;
    for (int i = 0; i < across; ++i) {
      for (int j = 0; i + j < across; ++j) {
        const float u = (static_cast<float>(i) + 0.33f) / static_cast<float>(across);
        const float v = (static_cast<float>(j) + 0.33f) / static_cast<float>(across);
        if (!cutouts_.solid(masked, u, v)) continue;
        for (const int node : Around(u, v, steps).node) nodes[node].needed = true;
      }
    }
  }

  void cast(int turn, std::vector<Node>* nodes) const {
    thread_local std::vector<Node*> chosen;
    thread_local std::vector<float> o[3], d[3];
    thread_local std::vector<std::uint8_t> blocked;
    chosen.clear();
    for (Node& node : *nodes) {
      if (node.needed && node.turn == turn) chosen.push_back(&node);
    }
    if (chosen.empty()) return;
    const std::vector<SkyPatches::Ray>& rays = directions_[static_cast<std::size_t>(turn)];
    for (int axis = 0; axis < 3; ++axis) o[axis].clear(), d[axis].clear();
    for (const SkyPatches::Ray& ray : rays) {
      for (const Node* node : chosen) {
        const float side = node->normal.dot(ray.towards) > 0.0f ? kClear_m : -kClear_m;
        const Eigen::Vector3f origin = node->position + side * node->normal;
        for (int axis = 0; axis < 3; ++axis) {
          o[axis].push_back(origin[axis]);
          d[axis].push_back(ray.towards[axis]);
        }
      }
    }
    blocked.resize(o[0].size());
    visibility_.occluded(
        {o[0].data(), o[1].data(), o[2].data(), d[0].data(), d[1].data(), d[2].data(), blocked.size()},
        blocked.data());
    const std::uint8_t* stopped = blocked.data();
    for (const SkyPatches::Ray& ray : rays) {
      const std::size_t sector = SkySectors::of(ray.patch);
      for (Node* node : chosen) {
        if (!*stopped++) node->seen[sector] += ray.solid_angle;
      }
    }
  }

  /// Returns the first node that follows.
  const Node* write(std::uint32_t t, const Node* node) {
    const int steps = stepsOf(geometry_, t);
    std::uint8_t* to = openness_.grids.data() + openness_.first[t];
    *to++ = static_cast<std::uint8_t>(steps);
    for (const Node* end = node + nodeCount(steps); node != end; ++node) {
      const std::array<float, kSectors>& whole = whole_[static_cast<std::size_t>(node->turn)];
      for (std::size_t sector = 0; sector < kSectors; ++sector)
        *to++ = static_cast<std::uint8_t>(std::min(node->seen[sector] / whole[sector], 1.0f) * 255.0f + 0.5f);
    }
    return node;
  }

  const Geometry& geometry_;
  Visibility visibility_;
  Cutouts cutouts_;
  std::array<std::vector<SkyPatches::Ray>, kTurns> directions_;
  std::array<std::array<float, kSectors>, kTurns> whole_{};  ///< solid angle of each turn's, by sector, sr
  std::vector<std::uint32_t> leaves_;                        ///< index into Cutouts::maskedTriangles()
  LeafOpenness openness_;
};

}  // namespace

SkyView LeafOpenness::at(std::uint32_t triangle, const std::array<float, 3>& barycentric) const {
  const std::uint8_t* grid = grids.data() + first[triangle];
  const Around around(barycentric[1], barycentric[2], grid[0]);
  std::array<float, kSectors> sum;
  sum.fill(0.5f);
  for (std::size_t k = 0; k < 3; ++k) {
    const std::uint8_t* node = grid + 1 + kSectors * static_cast<std::size_t>(around.node[k]);
    for (std::size_t sector = 0; sector < kSectors; ++sector)
      sum[sector] += around.weight[k] * static_cast<float>(node[sector]);
  }
  SkyView view;
  view.known = true;
  for (std::size_t sector = 0; sector < kSectors; ++sector)
    view.open[sector] = static_cast<std::uint8_t>(sum[sector]);
  return view;
}

LeafOpenness leafOpenness(const std::shared_ptr<const Geometry>& geometry,
                          const std::vector<TriangleTraits>& traits,
                          const std::function<void(double)>& progress) {
  return Looker(geometry, traits).look(progress);
}

}  // namespace sunlit::light
