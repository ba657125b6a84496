#include "light/bake/samples/wall_cuts.h"

#include <tbb/parallel_for.h>

#include <algorithm>

namespace sunlit::light {
namespace {

constexpr float kRoom_m = 0.01f;  // between two sheets: there may be a room
constexpr std::size_t kEdgesAtOnce = kPacket / 2;

/// Whether light may differ much between two places: of a sign or a fence both sides see much the same sky,
/// and the nodes for cuts there are better spent elsewhere. Rooms may differ by lamps.
bool mayDiffer(const MeshNode& a, const MeshNode& b) {
  constexpr float kRoom = 0.1f, kLeastPart = 0.35f, kMostApart = 0.7f;
  const auto [less, more] = std::minmax({a.open[3], b.open[3]});
  // By where the open sky lies, too: of a high wall one side has the sun, the other one not.
  return more < kRoom || less < kLeastPart * more ||
         (a.open - b.open).norm() > kMostApart * 0.5f * (less + more);
}

template <typename Cuts>
std::ptrdiff_t countOf(const Cuts& cuts) {
  return 3 - std::count(cuts.begin(), cuts.end(), nullptr);
}

}  // namespace

WallCuts::WallCuts(const BakeScene& scene, LightMesh* mesh, std::vector<MeshNode>* nodes)
    : scene_(scene), mesh_(mesh), nodes_(nodes) {}

std::vector<std::uint32_t> WallCuts::cut(const Progress& progress) {
  constexpr int kMostPasses = 4;
  findCrossings(progress);
  for (int pass = 0; pass < kMostPasses && (divideRooms() || divideCorners()); ++pass) findCrossings();
  for (Crossing& crossing : crossings_) {
    crossing.before = addNode(crossing.edge, crossing.into);
    crossing.behind = addNode(crossing.edge, crossing.out_of);
  }
  visitLeaves([&](std::uint32_t c) {
    const Cuts cuts = cutsOf(mesh_->cells[c]);
    if (countOf(cuts) > 0) cut(c, cuts);
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

void WallCuts::findCrossings(const Progress& progress) {
  crossings_ = edgesAtWalls();
  findWalls(progress);
  keepThose([](const Crossing& one) { return one.into >= 0.0f; });
  findRooms();
  keepThose([this](const Crossing& one) { return one.is_room || partsLight(one); });
}

template <typename Wanted>
void WallCuts::keepThose(const Wanted& wanted) {
  const auto kept = std::stable_partition(crossings_.begin(), crossings_.end(), wanted);
  crossings_.erase(kept, crossings_.end());
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

/// A cut is straight: where two walls meet in a cell, it gets a node there. Returns whether one did.
bool WallCuts::divideCorners() {
  bool any = false;
  visitLeaves([&](std::uint32_t c) { any = divideCorner(c) || any; });
  return any;
}

bool WallCuts::divideCorner(std::uint32_t cell) {
  const Cuts cuts = cutsOf(mesh_->cells[cell]);
  if (countOf(cuts) != 2) return false;
  const std::size_t k = firstCut(cuts);
  const std::optional<Eigen::Vector3f> weights = cornerWithin(cell, k, cuts);
  if (!weights) return false;
  const auto [from, to, apex] = cornersFrom(cell, k);
  // Behind it lies a point of the edge that is not cut.
  const float onwards = (*weights)[2] / ((*weights)[1] + (*weights)[2]), before = 1.0f - (*weights)[0];
  const std::uint32_t behind = addNode({to, apex}, onwards), corner = addNode({from, behind}, before);
  for (const std::uint32_t n : {behind, corner}) (*nodes_)[n].nearest_m = 0.0f;
  const std::uint32_t child = divide(cell, (k + 1) % 3, onwards);  // (to, behind, from), (behind, apex, from)
  const std::uint32_t first = divide(child, 1, (*weights)[0]);     // (behind, corner, to), (corner, from, to)
  const std::uint32_t second = divide(child + 1, 2, before);  // (from, corner, apex), (corner, behind, apex)
  setLeaf(first, {behind, corner, to});
  setLeaf(first + 1, {corner, from, to});
  setLeaf(second, {from, corner, apex});
  setLeaf(second + 1, {corner, behind, apex});
  return true;
}

/// Weights of the cell's corners, from its corner `k` on, for the place where the walls meet that this one
/// sees along both its edges; if that is within the cell.
std::optional<Eigen::Vector3f> WallCuts::cornerWithin(std::uint32_t cell, std::size_t k,
                                                      const Cuts& cuts) const {
  constexpr double kLeast = 0.02, kFlat = 0.1;
  constexpr float kSameWall = 0.9f;  // cosine
  const auto corners = cornersFrom(cell, k);
  const auto wallOf = [&](const Crossing& crossing) {
    return scene_.geometry.planes[crossing.walls[crossing.edge.first == corners[0] ? 0 : 1]];
  };
  const scene::Plane one = wallOf(*cuts[k]), other = wallOf(*cuts[(k + 2) % 3]);
  if (std::abs(one.normal.dot(other.normal)) > kSameWall) return std::nullopt;
  // Heights of the corners above both walls are to be 0, and weights to sum to 1.
  Eigen::Matrix3d heights;
  for (Eigen::Index i = 0; i < 3; ++i) {
    const Eigen::Vector3f& at = (*nodes_)[corners[static_cast<std::size_t>(i)]].position;
    heights.col(i) << one.height(at), other.height(at), 1.0;
  }
  const double scale = heights.topRows<2>().norm();
  if (std::abs(heights.determinant()) < kFlat * kLeast * scale * scale) return std::nullopt;
  const Eigen::Vector3d weights = heights.inverse() * Eigen::Vector3d::UnitZ();
  if (weights.minCoeff() < kLeast) return std::nullopt;
  return weights.cast<float>();
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
      const bool near = std::min(from.nearest_m, to.nearest_m) < 2.0f * length_m;
      if (near && (from.valid || to.valid)) edges.push_back(std::minmax(a, b));
    }
  }
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  std::vector<Crossing> found(edges.size());
  for (std::size_t i = 0; i < edges.size(); ++i) found[i].edge = edges[i];
  return found;
}

/// Two rays for each of all crossings, each of which goes from `starts` to the edge's one and other end;
/// `visit` gets the crossing and, as a lane, what its first ray met.
template <typename Starts, typename Visit>
void WallCuts::castTwice(const Starts& starts, const Progress& progress, const Visit& visit) {
  const std::size_t packets = (crossings_.size() + kEdgesAtOnce - 1) / kEdgesAtOnce;
  WorkDone done(progress, packets);
  tbb::parallel_for(std::size_t{0}, packets, [&](std::size_t p) {
    const std::size_t begin = p * kEdgesAtOnce;
    const std::size_t count = std::min(kEdgesAtOnce, crossings_.size() - begin);
    RayPacket packet;
    HitPacket hits;
    for (std::size_t i = 0; i < kEdgesAtOnce; ++i) {
      const Crossing& crossing = crossings_[begin + std::min(i, count - 1)];
      const auto [a, b] = crossing.edge;
      const Eigen::Vector3f one = (*nodes_)[a].aboveBumps(), other = (*nodes_)[b].aboveBumps();
      const auto [to_one, to_other] = starts(crossing, one, other);
      packet.set(2 * i, to_other, other - to_other, i < count);
      packet.set(2 * i + 1, to_one, one - to_one, i < count);
    }
    scene_.rays.cast(packet, &hits);
    done.add();
    for (std::size_t i = 0; i < count; ++i) visit(&crossings_[begin + i], hits, 2 * i);
  });
}

/// By a ray from either end.
void WallCuts::findWalls(const Progress& progress) {
  const auto starts = [](const Crossing&, const Eigen::Vector3f& one, const Eigen::Vector3f& other) {
    return std::make_pair(other, one);
  };
  castTwice(starts, progress, [&](Crossing* crossing, const HitPacket& hits, std::size_t lane) {
    const Eigen::Vector3f way = wayOf(crossing->edge);
    if (!meetsWall(hits, lane) || !meetsWall(hits, lane + 1)) return;
    // Of a sheet both are the same, but for rounding.
    const auto [into, out_of] = std::minmax({hits.distance[lane], 1.0f - hits.distance[lane + 1]});
    if (std::max(std::min(into, 1.0f - out_of), out_of - into) * way.norm() < kOnIt_m) return;
    crossing->into = into;
    crossing->out_of = out_of;
    crossing->walls = {hits.triangle[lane], hits.triangle[lane + 1]};
  });
}

/// By rays from amid what is between the walls.
void WallCuts::findRooms() {
  const auto starts = [](const Crossing& crossing, const Eigen::Vector3f& one, const Eigen::Vector3f& other) {
    const Eigen::Vector3f middle = one + 0.5f * (crossing.into + crossing.out_of) * (other - one);
    return std::make_pair(middle, middle);
  };
  castTwice(starts, nullptr, [&](Crossing* crossing, const HitPacket& hits, std::size_t lane) {
    const Eigen::Vector3f way = wayOf(crossing->edge);
    crossing->is_room = (crossing->out_of - crossing->into) * way.norm() > kRoom_m && meetsWall(hits, lane) &&
                        !leavesBody(hits.triangle[lane], way) && meetsWall(hits, lane + 1) &&
                        !leavesBody(hits.triangle[lane + 1], -way);
  });
}

Eigen::Vector3f WallCuts::wayOf(const Edge& edge) const {
  return (*nodes_)[edge.second].position - (*nodes_)[edge.first].position;
}

bool WallCuts::meetsWall(const HitPacket& hits, std::size_t lane) const {
  const std::uint32_t hit = hits.triangle[lane];
  return hit != HitPacket::kNothing && hits.distance[lane] <= 1.0f && !isLeaf(scene_.traits[hit].kind);
}

bool WallCuts::leavesBody(std::uint32_t triangle, const Eigen::Vector3f& way) const {
  return scene_.traits[triangle].solid && scene_.geometry.planes[triangle].normal.dot(way) > 0.0f;
}

/// What lies within a body, or below a sheet, has no light of its own.
bool WallCuts::partsLight(const Crossing& crossing) const {
  const MeshNode &from = (*nodes_)[crossing.edge.first], &to = (*nodes_)[crossing.edge.second];
  return from.valid && to.valid && mayDiffer(from, to);
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

/// The edge that leaves the corner which stands alone, or the only one that is cut.
std::size_t WallCuts::firstCut(const Cuts& cuts) {
  std::size_t k = 0;
  while (cuts[k] == nullptr || (countOf(cuts) == 2 && cuts[(k + 2) % 3] == nullptr)) ++k;
  return k;
}

void WallCuts::cut(std::uint32_t cell, const Cuts& cuts) {
  const auto count = countOf(cuts);
  const std::size_t k = firstCut(cuts);
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
