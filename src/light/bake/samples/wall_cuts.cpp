#include "light/bake/samples/wall_cuts.h"

#include <tbb/parallel_for.h>

#include <algorithm>

namespace sunlit::light {
namespace {

constexpr float kRoom_m = 0.01f;  // between two sheets: there may be a room
constexpr float kOnIt_m = 1e-3f;  // nodes so near to a sheet lie on it: see SheetSides
constexpr std::size_t kEdgesAtOnce = kPacket / 2;

}  // namespace

WallCuts::WallCuts(const BakeScene& scene, LightMesh* mesh, std::vector<MeshNode>* nodes)
    : scene_(scene), mesh_(mesh), nodes_(nodes) {}

std::vector<std::uint32_t> WallCuts::cut() {
  constexpr int kMostPasses = 4;
  for (int pass = 0; pass < kMostPasses; ++pass) {
    findCrossings();
    if (!divideRooms()) break;
  }
  for (Crossing& crossing : crossings_) {
    crossing.before = addNode(crossing.edge, crossing.into);
    crossing.behind = addNode(crossing.edge, crossing.out_of);
  }
  visitLeaves([&](std::uint32_t c) {
    const Cuts cuts = cutsOf(mesh_->cells[c]);
    if (std::any_of(cuts.begin(), cuts.end(), [](const Crossing* one) { return one != nullptr; }))
      cut(c, cuts);
  });
  std::sort(touched_.begin(), touched_.end());
  touched_.erase(std::unique(touched_.begin(), touched_.end()), touched_.end());
  return touched_;
}

/// What becomes of them is not visited.
template <typename Visit>
void WallCuts::visitLeaves(const Visit& visit) {
  const std::size_t cells = mesh_->cells.size();
  for (std::uint32_t c = 0; c < cells; ++c)
    if (!mesh_->cells[c].inner()) visit(c);
}

void WallCuts::findCrossings() {
  crossings_ = edgesAtWalls();
  findWalls(&crossings_);
  const auto is_free = [](const Crossing& one) { return one.into < 0.0f; };
  crossings_.erase(std::remove_if(crossings_.begin(), crossings_.end(), is_free), crossings_.end());
}

/// Where an edge passes through the corner of a room, it gets a node in there. Returns whether one did.
bool WallCuts::divideRooms() {
  bool any = false;
  for (Crossing& crossing : crossings_) {
    if (!crossing.is_room) continue;
    any = true;
    crossing.before = addNode(crossing.edge, 0.5f * (crossing.into + crossing.out_of));
    (*nodes_)[crossing.before].nearest_m = 0.0f;
  }
  if (any) visitLeaves([&](std::uint32_t c) { divideRooms(c); });
  return any;
}

void WallCuts::divideRooms(std::uint32_t cell) {
  const Cuts cuts = cutsOf(mesh_->cells[cell]);
  for (std::size_t k = 0; k < 3; ++k) {
    if (cuts[k] == nullptr || !cuts[k]->is_room) continue;
    const auto [from, to, apex] = cornersFrom(cell, k);
    const std::uint32_t child = divide(cell, k, along(*cuts[k], from).share), amid = cuts[k]->before;
    setLeaf(child, {from, amid, apex});
    setLeaf(child + 1, {amid, to, apex});
    divideRooms(child);
    divideRooms(child + 1);
    return;
  }
}

/// Those near enough to something for a wall to stand on them.
std::vector<WallCuts::Crossing> WallCuts::edgesAtWalls() const {
  std::vector<Edge> edges;
  for (const LightMesh::Cell& cell : mesh_->cells) {
    if (cell.inner()) continue;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = cell.corner[k], b = cell.corner[(k + 1) % 3];
      const MeshNode &from = (*nodes_)[a], &to = (*nodes_)[b];
      const float length_m = (to.position - from.position).norm();
      if ((from.valid || to.valid) && std::min(from.nearest_m, to.nearest_m) < 2.0f * length_m)
        edges.push_back(std::minmax(a, b));
    }
  }
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  std::vector<Crossing> found(edges.size());
  for (std::size_t i = 0; i < edges.size(); ++i) found[i].edge = edges[i];
  return found;
}

/// By a ray from either end.
void WallCuts::findWalls(std::vector<Crossing>* crossings) const {
  const std::size_t packets = (crossings->size() + kEdgesAtOnce - 1) / kEdgesAtOnce;
  tbb::parallel_for(std::size_t{0}, packets, [&](std::size_t p) {
    const std::size_t begin = p * kEdgesAtOnce;
    const std::size_t count = std::min(kEdgesAtOnce, crossings->size() - begin);
    RayPacket packet;
    HitPacket hits;
    for (std::size_t i = 0; i < kEdgesAtOnce; ++i) {
      const auto [a, b] = (*crossings)[begin + std::min(i, count - 1)].edge;
      const Eigen::Vector3f from = (*nodes_)[a].aboveBumps(), to = (*nodes_)[b].aboveBumps();
      packet.set(2 * i, from, to - from, i < count);
      packet.set(2 * i + 1, to, from - to, i < count);
    }
    scene_.rays.cast(packet, &hits);
    for (std::size_t i = 0; i < count; ++i) {
      Crossing& crossing = (*crossings)[begin + i];
      const auto [a, b] = crossing.edge;
      const MeshNode &from = (*nodes_)[a], &to = (*nodes_)[b];
      const Eigen::Vector3f way = to.position - from.position;
      if (!leaves(from, way, hits, 2 * i) || !leaves(to, -way, hits, 2 * i + 1)) continue;
      // Of a sheet both are the same, but for rounding.
      const auto [into, out_of] = std::minmax({hits.distance[2 * i], 1.0f - hits.distance[2 * i + 1]});
      const float beside = std::min(into, 1.0f - out_of);
      if (std::max(beside, out_of - into) * way.norm() < kOnIt_m) continue;
      crossing.into = into;
      crossing.out_of = out_of;
      const auto isSheet = [&](std::size_t lane) { return !scene_.traits[hits.triangle[lane]].solid; };
      crossing.is_room = isSheet(2 * i) && isSheet(2 * i + 1) && (out_of - into) * way.norm() > kRoom_m;
    }
  });
}

/// Whether a ray from a node towards the other end of an edge meets a wall, which the node is not within.
bool WallCuts::leaves(const MeshNode& node, const Eigen::Vector3f& way, const HitPacket& hits,
                      std::size_t lane) const {
  const std::uint32_t hit = hits.triangle[lane];
  if (hit == HitPacket::kNothing || hits.distance[lane] > 1.0f || isLeaf(scene_.traits[hit].kind))
    return false;
  return node.valid || !scene_.traits[hit].solid || scene_.geometry.planes[hit].normal.dot(way) < 0.0f;
}

std::uint32_t WallCuts::addNode(const Edge& edge, float at) {
  const MeshNode &from = (*nodes_)[edge.first], &to = (*nodes_)[edge.second];
  const auto between = [at](const Eigen::Vector3f& a, const Eigen::Vector3f& b) {
    return Eigen::Vector3f(a + at * (b - a));
  };
  MeshNode node;
  node.position = between(from.position, to.position);
  node.normal = between(from.normal, to.normal).normalized();
  node.face = boundingFace(node.normal, between(from.flat(), to.flat()).normalized());
  nodes_->push_back(node);
  return static_cast<std::uint32_t>(nodes_->size() - 1);
}

WallCuts::Cuts WallCuts::cutsOf(const LightMesh::Cell& cell) const {
  Cuts cuts{};
  for (std::size_t k = 0; k < 3; ++k) {
    const Edge edge = std::minmax(cell.corner[k], cell.corner[(k + 1) % 3]);
    const auto found =
        std::lower_bound(crossings_.begin(), crossings_.end(), edge,
                         [](const Crossing& one, const Edge& wanted) { return one.edge < wanted; });
    if (found != crossings_.end() && found->edge == edge) cuts[k] = &*found;
  }
  return cuts;
}

/// As it is met on the way from one of its ends.
WallCuts::Cut WallCuts::along(const Crossing& crossing, std::uint32_t from) const {
  const float middle = 0.5f * (crossing.into + crossing.out_of);
  if (crossing.edge.first == from) return {middle, crossing.before, crossing.behind};
  return {1.0f - middle, crossing.behind, crossing.before};
}

void WallCuts::cut(std::uint32_t cell, const Cuts& cuts) {
  const auto count = 3 - std::count(cuts.begin(), cuts.end(), nullptr);
  // Begins at the edge that leaves the corner which stands alone, or at the only one.
  std::size_t k = 0;
  while (cuts[k] == nullptr || (count == 2 && cuts[(k + 2) % 3] == nullptr)) ++k;
  const auto [from, to, apex] = cornersFrom(cell, k);
  const Cut first = along(*cuts[k], from);
  const std::uint32_t child = divide(cell, k, first.share);  // (from, point, apex), (point, to, apex)
  if (count == 1) {
    setLeaf(child, {from, first.near, apex});
    setLeaf(child + 1, {first.far, to, apex});
    return;
  }
  const Cut last = along(*cuts[(k + 2) % 3], apex);
  const std::uint32_t before = divide(child, 2, last.share);  // (apex, end, point), (end, from, point)
  setLeaf(before + 1, {last.far, from, first.near});
  if (count == 2) {
    setLeaf(before, {apex, last.near, first.far});
    setLeaf(child + 1, {first.far, to, apex});
    return;
  }
  // Each corner stands alone: what lies amid the cell is as the apex.
  const Cut opposite = along(*cuts[(k + 1) % 3], to);
  setLeaf(before, {apex, last.near, apex});
  const std::uint32_t behind = divide(child + 1, 1, opposite.share);  // (to, end, point), (end, apex, point)
  setLeaf(behind, {to, opposite.near, first.far});
  setLeaf(behind + 1, {opposite.far, apex, apex});
}

/// Of a leaf, beginning with the one that its edge `k` leaves.
std::array<std::uint32_t, 3> WallCuts::cornersFrom(std::uint32_t leaf, std::size_t k) const {
  const auto& corner = mesh_->cells[leaf].corner;
  return {corner[k], corner[(k + 1) % 3], corner[(k + 2) % 3]};
}

/// The first of its two children.
std::uint32_t WallCuts::divide(std::uint32_t cell, std::size_t edge, float share) {
  const auto child = static_cast<std::uint32_t>(mesh_->cells.size());
  mesh_->cells.push_back({});
  mesh_->cells.push_back({});
  mesh_->cells[cell] = LightMesh::Cell::divided(child, edge, share);
  return child;
}

void WallCuts::setLeaf(std::uint32_t cell, const std::array<std::uint32_t, 3>& corner) {
  mesh_->cells[cell].corner = corner;
  touched_.insert(touched_.end(), corner.begin(), corner.end());
}

}  // namespace sunlit::light
