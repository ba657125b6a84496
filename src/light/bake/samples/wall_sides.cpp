#include "light/bake/samples/wall_sides.h"

#include <algorithm>
#include <tuple>
#include <utility>

namespace sunlit::light {
namespace {

constexpr std::array<std::uint32_t, 2> kFromNothing = {LightMesh::kNone, LightMesh::kNone};

}  // namespace

WallSides::WallSides(LightMesh* mesh, std::vector<MeshNode>* nodes, Hangs* hangs_between)
    : mesh_(mesh), nodes_(nodes), hangs_between_(hangs_between) {}

void WallSides::separate() {
  for (std::uint32_t n = 0; n < nodes_->size(); ++n)
    if (!open(n)) (*hangs_between_)[n] = kFromNothing;
  const std::vector<CellAround> all = cellsAround();
  std::vector<CellAround> cells;
  for (std::size_t i = 0; i < all.size(); ++i) {
    cells.push_back(all[i]);
    if (i + 1 < all.size() && all[i + 1].node == all[i].node) continue;
    separate(all[i].node, cells);
    cells.clear();
  }
  hangFromOwnSides();
}

/// Of each node inside a wall, those that reach out of it.
std::vector<CellAround> WallSides::cellsAround() const {
  std::vector<CellAround> all;
  for (std::uint32_t c = 0; c < mesh_->cells.size(); ++c) {
    const LightMesh::Cell& cell = mesh_->cells[c];
    if (cell.inner()) continue;
    const auto& corner = cell.corner;
    if (std::none_of(corner.begin(), corner.end(), [&](std::uint32_t n) { return open(n); })) continue;
    for (const std::uint32_t n : corner)
      if (!open(n)) all.push_back({n, c});
  }
  std::sort(all.begin(), all.end());
  return all;
}

/// Neighbours of one cell are on one side, and so is what hangs from another one.
std::vector<WallSides::Neighbour> WallSides::sidesOf(std::uint32_t node,
                                                     const std::vector<CellAround>& cells) const {
  std::vector<Neighbour> found;
  const auto at = [&](std::uint32_t n) {
    return std::find_if(found.begin(), found.end(), [n](const Neighbour& other) { return other.node == n; });
  };
  const auto join = [&](std::uint32_t a, std::uint32_t b) {
    const std::size_t from = at(a)->side, to = at(b)->side;
    for (Neighbour& other : found)
      if (other.side == from) other.side = to;
  };
  for (const CellAround& around : cells) {
    std::uint32_t before = LightMesh::kNone;
    for (const std::uint32_t n : mesh_->cells[around.cell].corner) {
      if (!open(n)) continue;
      if (at(n) == found.end()) found.push_back({n, found.size()});
      if (before != LightMesh::kNone) join(before, n);
      before = n;
    }
  }
  // Along an edge that is halved on one side of it only, towards its other end.
  constexpr int kMostHalvings = 32;
  for (std::size_t i = 0; i < found.size(); ++i) {
    std::uint32_t n = found[i].node;
    for (int step = 0; step < kMostHalvings; ++step) {
      const auto [a, b] = (*hangs_between_)[n];
      if (a != node && b != node) break;
      n = a == node ? b : a;
      if (at(n) == found.end()) continue;
      join(found[i].node, n);
      break;
    }
  }
  return found;
}

void WallSides::separate(std::uint32_t node, const std::vector<CellAround>& cells) {
  const std::vector<Neighbour> found = sidesOf(node, cells);
  std::vector<std::uint32_t> own(found.size(), LightMesh::kNone);  // of each side
  own[found.front().side] = node;
  for (const Neighbour& other : found) {
    if (own[other.side] == LightMesh::kNone) {
      own[other.side] = static_cast<std::uint32_t>(nodes_->size());
      const MeshNode copy = (*nodes_)[node];
      nodes_->push_back(copy);
      hangs_between_->push_back(kFromNothing);
    }
    places_.push_back({node, other.node, own[other.side]});
  }
  for (const CellAround& around : cells) {
    auto& corner = mesh_->cells[around.cell].corner;
    const auto out = std::find_if(corner.begin(), corner.end(), [&](std::uint32_t n) { return open(n); });
    const auto side = std::find_if(found.begin(), found.end(), [&](const Neighbour& other) {
                        return other.node == *out;
                      })->side;
    std::replace(corner.begin(), corner.end(), node, own[side]);
  }
}

/// What has both ends inside walls hangs no more.
void WallSides::hangFromOwnSides() {
  const auto before = [](const Place& a, const Place& b) {
    return std::tie(a.node, a.neighbour) < std::tie(b.node, b.neighbour);
  };
  std::sort(places_.begin(), places_.end(), before);
  for (auto& ends : *hangs_between_) {
    if (ends == kFromNothing || (open(ends[0]) && open(ends[1]))) continue;
    if (!open(ends[0])) std::swap(ends[0], ends[1]);
    const Place wanted = {ends[1], ends[0], LightMesh::kNone};
    const auto place = std::lower_bound(places_.begin(), places_.end(), wanted, before);
    const bool known = place != places_.end() && place->node == ends[1] && place->neighbour == ends[0];
    if (open(ends[0]) && known) {
      ends[1] = place->own;
    } else {
      ends = kFromNothing;
    }
  }
}

}  // namespace sunlit::light
