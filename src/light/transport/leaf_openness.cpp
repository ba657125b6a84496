#include "light/transport/leaf_openness.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <mutex>

#include "light/cutout.h"
#include "light/transport/sky_patches.h"
#include "sunlit/light/visibility.h"

namespace sunlit::light {
namespace {

constexpr float kStep_m = 0.35f;  ///< of a grid, where a card is not too large
constexpr int kMostSteps = 7;
constexpr float kClear_m = 1e-3f;
constexpr float kInwards = 0.04f;  ///< nodes are that much nearer to the triangle's middle than its edges
/// Neighbouring nodes look in other directions: what is interpolated between them knows those of all.
constexpr int kTurns = 5;
constexpr std::size_t kBlock = 64;  ///< triangles a task

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
  const float area = 0.5f * (b - a).cross(d - a).norm();
  return std::clamp(static_cast<int>(std::ceil(std::sqrt(2.0f * area) / kStep_m)), 1, kMostSteps);
}

/// One triangle's nodes.
struct Node {
  Eigen::Vector3f position, normal;
  int turn;
  bool needed = false;
  float seen[2] = {0.0f, 0.0f}, all[2] = {0.0f, 0.0f};  ///< by side
};

class Looker {
 public:
  Looker(const std::shared_ptr<const Geometry>& geometry, const std::vector<TriangleTraits>& traits)
      : geometry_(*geometry), visibility_(geometry), cutouts_(*geometry) {
    const SkyPatches patches(1);
    for (const SkyPatches::Ray& ray : patches.coarseRays()) {
      if (ray.patch == SkyPatches::kBelow) continue;
      directions_[static_cast<std::size_t>((ray.patch + ray.patch / 30) % kTurns)].push_back(ray);
    }
    openness_.first.assign(traits.size(), LeafOpenness::kNone);
    const std::vector<std::uint32_t>& masked = cutouts_.maskedTriangles();
    std::size_t at = 0;
    for (std::uint32_t i = 0; i < masked.size(); ++i) {
      const std::uint32_t t = masked[i];
      const auto material = static_cast<std::size_t>(geometry_.materials[t]);
      if (!isLeaf(traits[t].kind) || geometry_.scene->materials[material].transmission <= 0.0f) continue;
      leaves_.push_back(i);
      openness_.first[t] = static_cast<std::uint32_t>(at);
      at += 1 + 2 * static_cast<std::size_t>(nodeCount(stepsOf(geometry_, t)));
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
      for (std::size_t i = block * kBlock; i < end; ++i) lookFrom(leaves_[i]);
      const std::lock_guard<std::mutex> lock(mutex);
      progress(static_cast<double>(++done) / static_cast<double>(blocks));
    });
    return std::move(openness_);
  }

 private:
  void lookFrom(std::uint32_t masked) {
    const std::uint32_t t = cutouts_.maskedTriangles()[masked];
    const int steps = stepsOf(geometry_, t);
    std::vector<Node> nodes = nodesOf(t, steps);
    findNeeded(masked, steps, &nodes);
    for (int turn = 0; turn < kTurns; ++turn) cast(t, turn, &nodes);
    write(t, steps, nodes);
  }

  std::vector<Node> nodesOf(std::uint32_t t, int steps) const {
    const auto& c = geometry_.triangles[t];
    std::vector<Node> nodes;
    for (int i = 0; i <= steps; ++i) {
      for (int j = 0; i + j <= steps; ++j) {
        const float u =
            static_cast<float>(i) / static_cast<float>(steps) * (1.0f - kInwards) + kInwards / 3.0f;
        const float v =
            static_cast<float>(j) / static_cast<float>(steps) * (1.0f - kInwards) + kInwards / 3.0f;
        Node node;
        node.position = (1.0f - u - v) * geometry_.positions[c[0]] + u * geometry_.positions[c[1]] +
                        v * geometry_.positions[c[2]];
        const Eigen::Vector3f& front = geometry_.planes[t].normal;
        node.normal = (1.0f - u - v) * geometry_.normals[c[0]] + u * geometry_.normals[c[1]] +
                      v * geometry_.normals[c[2]];
        const float length = node.normal.norm();
        node.normal = length > 1e-6f ? Eigen::Vector3f(node.normal / length) : front;
        if (node.normal.dot(front) < 0.0f) node.normal = -node.normal;
        node.turn = (i + 2 * j + static_cast<int>(t % kTurns)) % kTurns;
        nodes.push_back(node);
      }
    }
    return nodes;
  }

  /// Nodes around which nothing is solid are never asked for.
  void findNeeded(std::uint32_t masked, int steps, std::vector<Node>* nodes) const {
    const int across = 3 * steps;
    for (int i = 0; i < across; ++i) {
      for (int j = 0; i + j < across; ++j) {
        const float u = (static_cast<float>(i) + 0.33f) / static_cast<float>(across);
        const float v = (static_cast<float>(j) + 0.33f) / static_cast<float>(across);
        if (!cutouts_.solid(masked, u, v)) continue;
        for (const int node : Around(u, v, steps).node)
          (*nodes)[static_cast<std::size_t>(node)].needed = true;
      }
    }
  }

  void cast(std::uint32_t t, int turn, std::vector<Node>* nodes) const {
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
      const float side = geometry_.planes[t].normal.dot(ray.towards) > 0.0f ? kClear_m : -kClear_m;
      for (const Node* node : chosen) {
        const Eigen::Vector3f origin = node->position + side * geometry_.planes[t].normal;
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
      for (Node* node : chosen) {
        const float cosine = node->normal.dot(ray.towards) * ray.solid_angle;
        const std::size_t side = cosine > 0.0f ? 0 : 1;
        node->all[side] += std::abs(cosine);
        if (!*stopped++) node->seen[side] += std::abs(cosine);
      }
    }
  }

  void write(std::uint32_t t, int steps, const std::vector<Node>& nodes) {
    std::uint8_t* to = openness_.grids.data() + openness_.first[t];
    *to++ = static_cast<std::uint8_t>(steps);
    for (const Node& node : nodes) {
      for (std::size_t side = 0; side < 2; ++side) {
        const float up = 0.5f * (1.0f + (side == 0 ? node.normal.z() : -node.normal.z()));
        const float open = node.all[side] > 0.0f ? node.seen[side] / node.all[side] * up : 0.0f;
        *to++ = static_cast<std::uint8_t>(std::clamp(open, 0.0f, 1.0f) * 255.0f + 0.5f);
      }
    }
  }

  const Geometry& geometry_;
  Visibility visibility_;
  Cutouts cutouts_;
  std::array<std::vector<SkyPatches::Ray>, kTurns> directions_;
  std::vector<std::uint32_t> leaves_;  ///< index into Cutouts::maskedTriangles()
  LeafOpenness openness_;
};

}  // namespace

float LeafOpenness::at(std::uint32_t triangle, int side, const std::array<float, 3>& barycentric) const {
  const std::uint8_t* grid = grids.data() + first[triangle];
  const Around around(barycentric[1], barycentric[2], grid[0]);
  float sum = 0.0f;
  for (std::size_t k = 0; k < 3; ++k)
    sum += around.weight[k] * static_cast<float>(grid[1 + 2 * around.node[k] + side]);
  return sum / 255.0f;
}

LeafOpenness leafOpenness(const std::shared_ptr<const Geometry>& geometry,
                          const std::vector<TriangleTraits>& traits,
                          const std::function<void(double)>& progress) {
  return Looker(geometry, traits).look(progress);
}

}  // namespace sunlit::light
