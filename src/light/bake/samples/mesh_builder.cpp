#include "light/bake/samples/mesh_builder.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "light/bake/samples/burial_test.h"
#include "light/bake/samples/sheet_sides.h"
#include "light/bake/samples/wall_sides.h"
#include "sunlit/quantity/photometry.h"
#include "sunlit/quantity/random.h"

namespace sunlit::light {
namespace {

/// Longest edge of a cell, in harmonic mean distances of what its corners see.
constexpr float kReachShare = 0.6f;
/// Longest edge of a cell, in distances of the closest thing that its corners see.
constexpr float kNearShare = 0.7f;
/// Edges shorter than this are not halved for kNearShare.
constexpr float kNearLimit_m = 2.0f;
/// Cosine between planes: ground beside ground that slopes more is no thing that stands on it.
constexpr float kSamePlane = 0.9f;
/// Difference of light between the corners of a cell, in means of it, from which on it may not be larger.
constexpr float kSmooth = 0.6f;
/// How many times larger a cell of even light may be at most: something thin may stand amid it.
constexpr float kMostLarger = 10.0f;
/// How many times finer than elsewhere cells may become at walls.
constexpr float kFinerAtWalls = 4.0f;
/// Shortest edge that may be halved, as a share of its distance from the origin.
constexpr float kLeastShare = 2e-6f;
/// Urgency of a cell with a wall amid it, where light leaks.
constexpr float kCutUrgency = 4.0f;
/// Height of normals: below it, as on trunks, leaves nearby count as walls do; ground has too many above it.
constexpr float kSteep = 0.5f;
constexpr std::size_t kNodesAtOnce = RayPacket::kSize;

std::uint64_t pairKey(std::uint32_t a, std::uint32_t b) {
  return static_cast<std::uint64_t>(std::min(a, b)) << 32 | std::max(a, b);
}

}  // namespace

MeshBuilder::MeshBuilder(const BakeScene& scene, const AreaLights& bright)
    : geometry_(scene.geometry),
      rays_(scene.rays),
      traits_(scene.traits),
      bright_(bright),
      occupied_(scene.geometry, scene.traits) {
  const SkyPatches patches(1);
  const std::vector<SkyPatches::Ray>& all = patches.coarseRays();
  for (std::size_t i = 0; i < all.size(); ++i) {
    // Half of the directions tell distances well enough.
    if (SkyPatches::inHalf(static_cast<int>(i))) directions_.push_back(all[i]);
  }
  const auto rootOf = [&](bool sealed) { return sealed ? LightMesh::kSealed : LightMesh::kNone; };
  for (const TriangleTraits& t : traits_) mesh.roots.push_back({rootOf(t.sealed[0]), rootOf(t.sealed[1])});
}

void MeshBuilder::plant(std::uint32_t triangle, int side) {
  const Eigen::Vector3f flat = sideNormal(geometry_, triangle, side);
  LightMesh::Cell cell;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::uint32_t v = geometry_.triangles[triangle][k];
    // As pictures are shaded.
    Eigen::Vector3f normal = geometry_.normals[v];
    if (normal.dot(flat) < 0.0f) normal = -normal;
    if (normal.isZero()) normal = flat;
    cell.corner[k] = index.at(geometry_.positions[v], normal, flat);
  }
  const auto number = static_cast<std::uint32_t>(mesh.cells.size());
  mesh.roots[triangle][static_cast<std::size_t>(side)] = number;
  mesh.cells.push_back(cell);
  addLeaf(number);
}

void MeshBuilder::addLeaf(std::uint32_t number) {
  const LightMesh::Cell& cell = mesh.cells[number];
  const Eigen::Vector3f middle = middleOf(cell, index.nodes);
  for (const std::uint32_t n : cell.corner) index.nodes[n].pullTowards(middle);
  active_.push_back(number);
}

void MeshBuilder::lookAround(const std::vector<std::uint32_t>& from) {
  std::vector<MeshNode>& nodes = index.nodes;
  const std::size_t packets = (from.size() + kNodesAtOnce - 1) / kNodesAtOnce;
  tbb::parallel_for(std::size_t{0}, packets, [&](std::size_t p) {
    const std::size_t begin = p * kNodesAtOnce;
    const int count = static_cast<int>(std::min(kNodesAtOnce, from.size() - begin));
    std::array<Receiver, kNodesAtOnce> receivers;
    std::array<float, kNodesAtOnce> all{}, near{}, nearest;
    std::array<BurialTest, kNodesAtOnce> burials;
    std::array<Eigen::Vector4f, kNodesAtOnce> open;
    open.fill(Eigen::Vector4f::Zero());
    nearest.fill(1e9f);
    findRoom(from.data() + begin, count);
    for (int i = 0; i < count; ++i)
      receivers[static_cast<std::size_t>(i)] = nodes[from[begin + static_cast<std::size_t>(i)]].receiver();
    probe(rays_, directions_, {receivers.data(), count},
          [&](int lane, std::size_t r, float weight, const HitLayers& hits) {
            const auto i = static_cast<std::size_t>(lane);
            all[i] += weight;
            burials[i].add({receivers[i].normal, directions_[r].towards, weight, hits.ends, lane}, geometry_,
                           traits_);
            hits.visit(lane, [&](const HitPacket& met, float share, PackedTint) {
              const std::uint32_t hit = met.triangle[i];
              if (hit == HitPacket::kNothing) {
                open[i] += share * weight * directions_[r].towards.homogeneous();
                return;
              }
              if (isLeaf(traits_[hit].kind) && receivers[i].normal.z() > kSteep) return;
              near[i] += share * weight / std::max(met.distance[i], 0.05f);
              if (std::abs(geometry_.planes[hit].normal.dot(receivers[i].normal)) < kSamePlane)
                nearest[i] = std::min(nearest[i], met.distance[i]);
            });
          });
    for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
      MeshNode& node = nodes[from[begin + i]];
      node.valid = !burials[i].buried();
      node.reach_m = near[i] > 0.0f ? all[i] / near[i] : 1e9f;
      node.nearest_m = nearest[i];
      if (all[i] > 0.0f) node.open = open[i] / all[i];
      if (!bright_.any()) continue;
      const AreaLights::Light light = bright_.about(receivers[i], from[begin + i]);
      node.shone_lx = LinearRgb(light.above + light.below).luminance();
      node.bright_m = light.distance_m;
    }
  });
}

/// Pulled into a wall or through it, a node would be taken for one that is within it.
void MeshBuilder::findRoom(const std::uint32_t* from, int count) {
  RayPacket packet;
  HitPacket hits;
  for (int i = 0; i < RayPacket::kSize; ++i) {
    const MeshNode& node = index.nodes[from[std::min(i, count - 1)]];
    const Receiver receiver = node.receiver();
    const Eigen::Vector3f pull = receiver.origins[0] - node.position;
    packet.set(static_cast<std::size_t>(i), node.position + receiver.lifts[0], pull,
               i < count && !pull.isZero(0.0f));
  }
  rays_.cast(packet, &hits);
  for (int i = 0; i < count; ++i) {
    const std::uint32_t hit = hits.triangle[i];
    if (hit == HitPacket::kNothing || hits.distance[i] > 1.0f || isLeaf(traits_[hit].kind)) continue;
    MeshNode& node = index.nodes[from[i]];
    if (std::abs(geometry_.planes[hit].height(node.position)) < static_cast<double>(kOnIt_m)) continue;
    node.room_m = hits.distance[i] * (node.receiver().origins[0] - node.position).norm();
  }
}

void MeshBuilder::lookAroundFromNew() {
  std::vector<std::uint32_t> fresh(index.nodes.size() - looked_);
  std::iota(fresh.begin(), fresh.end(), static_cast<std::uint32_t>(looked_));
  stepOffSheets({geometry_, rays_, traits_}, looked_, &index.nodes);
  lookAround(fresh);
  for (; looked_ < index.nodes.size(); ++looked_) valid_ += index.nodes[looked_].valid ? 1 : 0;
}

/// By how much light differs between the corners, all of them valid, in steps that may be interpolated.
float MeshBuilder::variation(const LightMesh::Cell& cell) const {
  constexpr float kLeastOpen = 0.05f;
  float most = 0.0f, mean = 0.0f;
  for (std::size_t k = 0; k < 3; ++k) {
    const Eigen::Vector4f& here = index.nodes[cell.corner[k]].open;
    const Eigen::Vector4f& next = index.nodes[cell.corner[(k + 1) % 3]].open;
    most = std::max(most, (here - next).norm());
    mean += here[3] / 3.0f;
  }
  return most / (kSmooth * std::max(mean, kLeastOpen));
}

/// By how much what shines lights the corners, valid ones among them, differently, in steps that may be
/// interpolated; and no less than by how far off it is, lest a pool of light lies unseen amid the cell.
float MeshBuilder::shoneUnevenly(const LightMesh::Cell& cell) const {
  constexpr float kSmoothShine = 0.4f, kFaint_lx = 0.05f;
  // Of the distance: between two nodes light bends away from a line by at most 6 % then.
  constexpr float kShineShare = 0.35f;
  float least = 1e9f, most = 0.0f, nearest = 1e9f;
  for (const std::uint32_t n : cell.corner) {
    const MeshNode& node = index.nodes[n];
    if (!node.valid) continue;
    least = std::min(least, node.shone_lx);
    most = std::max(most, node.shone_lx);
    nearest = std::min(nearest, node.bright_m);
  }
  if (!(most > 0.0f)) return 0.0f;
  const float uneven = (most - least) / (kSmoothShine * std::max(0.5f * (most + least), kFaint_lx));
  return std::max(uneven, longestEdge(cell, index.nodes) / (kShineShare * nearest));
}

/// Above 1 where the cell must be halved.
float MeshBuilder::urgency(const LightMesh::Cell& cell, float finest_m, Pass pass) const {
  const float longest = longestEdge(cell, index.nodes);
  float reach = 1e9f, nearest = 1e9f;
  int valid = 0;
  Eigen::AlignedBox3f box;
  for (const std::uint32_t n : cell.corner) {
    const MeshNode& node = index.nodes[n];
    box.extend(node.position);
    if (!node.valid) continue;
    ++valid;
    reach = std::min(reach, node.reach_m);
    nearest = std::min(nearest, node.nearest_m);
  }
  if (longest <= finest_m) return 0.0f;
  const float coarse = longest / occupied_.coarsest_m(box);
  if (valid == 0) return coarse;
  if (valid < 3) reach = std::min(reach, finest_m * 2.0f);
  const float least = 1.0f / kMostLarger;
  const float share = pass == Pass::kAll || valid < 3 ? 1.0f : std::clamp(variation(cell), least, 1.0f);
  return std::max({coarse, shoneUnevenly(cell), share * longest / std::max(finest_m, kReachShare * reach),
                   share * longest / std::max(kNearLimit_m, kNearShare * nearest)});
}

/// Whether a wall stands between the corners of a small cell: light on both its sides would be mixed there.
bool MeshBuilder::cut(const LightMesh::Cell& cell, float finest_m) const {
  if (longestEdge(cell, index.nodes) <= finest_m / kFinerAtWalls || !mayCarry(cell, index.nodes))
    return false;
  RayPacket packet;
  HitPacket hits;
  for (std::size_t i = 0; i < RayPacket::kSize; ++i) {
    const Eigen::Vector3f from = index.nodes[cell.corner[i % 3]].aboveBumps();
    packet.set(i, from, index.nodes[cell.corner[(i + 1) % 3]].aboveBumps() - from, i < 3);
  }
  rays_.cast(packet, &hits);
  for (int i = 0; i < 3; ++i) {
    const std::uint32_t hit = hits.triangle[i];
    if (hit != HitPacket::kNothing && hits.distance[i] < 1.0f && !isLeaf(traits_[hit].kind)) return true;
  }
  return false;
}

std::uint32_t MeshBuilder::middle(std::uint32_t a, std::uint32_t b) {
  const auto [entry, fresh] = middles_.try_emplace(pairKey(a, b), 0u);
  if (fresh) {
    const MeshNode& from = index.nodes[a];
    const MeshNode& to = index.nodes[b];
    const Eigen::Vector3f position = 0.5f * (from.position + to.position);
    const Eigen::Vector3f normal = (from.normal + to.normal).normalized();
    entry->second = index.at(position, normal, (from.flat() + to.flat()).normalized());
  }
  return entry->second;
}

void MeshBuilder::split(std::uint32_t number) {
  const std::array<std::uint32_t, 3> corner = mesh.cells[number].corner;
  std::size_t longest = 0;
  float length = 0.0f;
  for (std::size_t k = 0; k < 3; ++k) {
    const float edge =
        (index.nodes[corner[k]].position - index.nodes[corner[(k + 1) % 3]].position).squaredNorm();
    if (edge > length) {
      length = edge;
      longest = k;
    }
  }
  const std::uint32_t from = corner[longest], to = corner[(longest + 1) % 3],
                      apex = corner[(longest + 2) % 3];
  // Below some 16 steps of single precision the halves would not come out shorter: it would never end.
  if (std::sqrt(length) < kLeastShare * index.nodes[from].position.cwiseAbs().maxCoeff()) return;
  const std::uint32_t between = middle(from, to);
  const auto child = static_cast<std::uint32_t>(mesh.cells.size());
  mesh.cells.push_back({{from, between, apex}});
  mesh.cells.push_back({{between, to, apex}});
  mesh.cells[number] = LightMesh::Cell::divided(child, longest, 0.5f);
  addLeaf(child);
  addLeaf(child + 1);
}

void MeshBuilder::refine(const RefineLimits& limits, const Progress& progress) {
  for (std::uint32_t t = 0; t < geometry_.triangles.size(); ++t) {
    if (traits_[t].kind != TriangleKind::kLarge) continue;
    for (int side = 0; side < 2; ++side) {
      if (traits_[t].used[side]) plant(t, side);
    }
  }
  for (const Pass pass : {Pass::kVaried, Pass::kAll}) {
    while (!active_.empty()) {
      lookAroundFromNew();
      progress(kHalved * std::min(1.0, static_cast<double>(valid_) / static_cast<double>(limits.nodes)));
      halveMostUrgent(limits, pass);
    }
    active_.swap(left_);
  }
  separateSides(progress);
  findHanging();
  WallSides(&mesh, &index.nodes, &hangs_between).separate();
}

void MeshBuilder::halveMostUrgent(const RefineLimits& limits, Pass pass) {
  // Every halving makes at most one node.
  const std::size_t room = limits.nodes > valid_ ? limits.nodes - valid_ : 0;
  if (room == 0) return active_.clear();
  std::vector<float> urgencies(active_.size());
  tbb::parallel_for(std::size_t{0}, active_.size(), [&](std::size_t i) {
    const LightMesh::Cell& cell = mesh.cells[active_[i]];
    urgencies[i] = urgency(cell, limits.finest_m, pass);
    if (urgencies[i] <= 1.0f && cut(cell, limits.finest_m)) urgencies[i] = kCutUrgency;
  });
  std::vector<Split> splits;
  for (std::size_t i = 0; i < active_.size(); ++i) {
    if (urgencies[i] > 1.0f) {
      splits.push_back({active_[i], urgencies[i]});
    } else if (pass == Pass::kVaried) {
      left_.push_back(active_[i]);
    }
  }
  active_.clear();
  if (splits.size() > room) {
    std::sort(splits.begin(), splits.end(), [](const Split& a, const Split& b) {
      // Of equally urgent ones, some from everywhere.
      return a.urgency != b.urgency ? a.urgency > b.urgency : scrambled(a.cell) < scrambled(b.cell);
    });
    // Halves of neighbours share a node, so that there may be room for others yet. A hundredth of all nodes
    // is not worth another look at every cell.
    constexpr std::size_t kWorthIt = 100;
    if (room > limits.nodes / kWorthIt)
      for (std::size_t i = room; i < splits.size(); ++i) active_.push_back(splits[i].cell);
    splits.resize(room);
  }
  for (const Split& s : splits) split(s.cell);
}

/// `middle`: of the cell with the undivided edge.
void MeshBuilder::hang(std::uint32_t a, std::uint32_t b, const Eigen::Vector3f& middle) {
  const std::uint32_t first = originals_[a], last = originals_[b];
  const auto entry = middles_.find(pairKey(first, last));
  if (entry == middles_.end()) return;
  const std::uint32_t between = entry->second;
  if (has_sides_[between] || hangs_between[between][0] != LightMesh::kNone) return;
  if ((has_sides_[first] || has_sides_[last]) && isBehindASheet(index.nodes[between], middle)) return;
  hangs_between[between] = {a, b};
  hang(a, between, middle);
  hang(between, b, middle);
}

/// Whether what a node amid an edge sees is on another side than a cell that the edge bounds.
bool MeshBuilder::isBehindASheet(const MeshNode& node, const Eigen::Vector3f& middle) const {
  constexpr float kAway_m = 5e-3f;
  const Receiver receiver = node.receiver();
  const Eigen::Vector3f from = receiver.origins[0] + receiver.lifts[0];
  const Eigen::Vector3f way =
      node.position + receiver.lifts[0] + kAway_m * (middle - node.position).normalized() - from;
  RayPacket packet;
  HitPacket hits;
  for (std::size_t i = 0; i < kPacket; ++i) packet.set(i, from, way, i == 0);
  rays_.cast(packet, &hits);
  const std::uint32_t hit = hits.triangle[0];
  return hit != HitPacket::kNothing && hits.distance[0] < 1.0f && !isLeaf(traits_[hit].kind);
}

void MeshBuilder::findHanging() {
  hangs_between.assign(index.nodes.size(), {LightMesh::kNone, LightMesh::kNone});
  for (const LightMesh::Cell& cell : mesh.cells) {
    if (cell.inner()) continue;
    const Eigen::Vector3f middle = middleOf(cell, index.nodes);
    for (std::size_t k = 0; k < 3; ++k) hang(cell.corner[k], cell.corner[(k + 1) % 3], middle);
  }
}

}  // namespace sunlit::light
