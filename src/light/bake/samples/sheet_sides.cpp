#include "light/bake/samples/sheet_sides.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <numeric>

namespace sunlit::light {
namespace {

/// Whether a ray ends at a sheet before its length. What lies within a body is seen by nobody: no side of its
/// own.
bool meetsSheet(const BakeScene& scene, const HitPacket& hits, std::size_t lane) {
  const std::uint32_t hit = hits.triangle[lane];
  if (hit == HitPacket::kNothing || !(hits.distance[lane] < 1.0f)) return false;
  return !isLeaf(scene.traits[hit].kind) && !scene.traits[hit].solid;
}

/// On the side that its cells are on, if these are on one.
void stepOff(const scene::Plane& sheet, MeshNode* node) {
  constexpr float kAside_m = 5e-3f, kLeast = 0.1f;
  const Eigen::Vector3f level = sheet.normal - sheet.normal.dot(node->flat()) * node->flat();
  if (level.norm() < kLeast) return;
  node->aside = (node->inwards.dot(level) < 0.0f ? -kAside_m : kAside_m) * level.normalized();
}

/// Whether a ray from one point to another one passes right by a node, where it may slip through between two
/// sheets that meet there. Points between them tell, too.
bool opposite(const Eigen::Vector3f& one, const Eigen::Vector3f& other, const Eigen::Vector3f& node) {
  constexpr float kBy_m = 3e-4f, kStep = 1.2e-7f;
  // Single precision tells places no better there, and points may lie on the node.
  if (kStep * node.cwiseAbs().maxCoeff() > kBy_m) return false;
  const Eigen::Vector3f way = other - one;
  return (one - node).dot(other - node) < 0.0f && (node - one).cross(way).norm() < kBy_m * way.norm();
}

}  // namespace

void stepOffSheets(const BakeScene& scene, std::size_t first, std::vector<MeshNode>* nodes) {
  const std::size_t packets = (nodes->size() - first + kPacket - 1) / kPacket;
  tbb::parallel_for(std::size_t{0}, packets, [&](std::size_t p) {
    const std::size_t begin = first + p * kPacket, count = std::min(kPacket, nodes->size() - begin);
    // No sheet within kOnIt_m lies along both ways.
    for (const bool across : {false, true}) {
      RayPacket packet;
      HitPacket hits;
      for (std::size_t i = 0; i < kPacket; ++i) {
        const MeshNode& node = (*nodes)[begin + std::min(i, count - 1)];
        const Eigen::Vector3f one = 2.0f * kOnIt_m * node.flat().unitOrthogonal();
        const Eigen::Vector3f way = across ? Eigen::Vector3f(node.flat().cross(one)) : one;
        packet.set(i, node.aboveBumps() - way, 2.0f * way, i < count);
      }
      scene.rays.cast(packet, &hits);
      for (std::size_t i = 0; i < count; ++i)
        if (meetsSheet(scene, hits, i))
          stepOff(scene.geometry.planes[hits.triangle[i]], &(*nodes)[begin + i]);
    }
  });
}

SheetSides::SheetSides(const BakeScene& scene, LightMesh* mesh, std::vector<MeshNode>* nodes)
    : scene_(scene), mesh_(mesh), nodes_(nodes) {}

std::vector<SheetSides::Side> SheetSides::separate(const Progress& progress) {
  findCells();
  std::vector<Group> groups;
  for (std::size_t i = 0; i < around_.size(); ++i) {
    if (i == 0 || around_[i].node != around_[i - 1].node) groups.push_back({i, i, {}});
    groups.back().end = i + 1;
  }
  WorkDone done(progress, groups.size());
  tbb::parallel_for(std::size_t{0}, groups.size(), [&](std::size_t g) {
    findSides(&groups[g]);
    done.add();
  });
  std::vector<Side> found;
  for (const Group& group : groups) {
    const std::uint32_t sides = 1 + *std::max_element(group.sides.begin(), group.sides.end());
    if (sides == 1) continue;
    const std::uint32_t node = around_[group.begin].node;
    std::vector<std::uint32_t> own = {node};
    const MeshNode copy = (*nodes_)[node];
    for (; own.size() < sides; nodes_->push_back(copy))
      own.push_back(static_cast<std::uint32_t>(nodes_->size()));
    for (const std::uint32_t n : own) found.push_back({n, node});
    for (std::size_t i = group.begin; i < group.end; ++i) {
      LightMesh::Cell& cell = mesh_->cells[around_[i].cell];
      const std::uint32_t of_side = own[group.sides[i - group.begin]];
      std::replace(cell.corner.begin(), cell.corner.end(), node, of_side);
    }
  }
  return found;
}

/// Where something is near enough to stand on a node.
void SheetSides::findCells() {
  std::vector<char> near(nodes_->size(), 0);
  for (const LightMesh::Cell& cell : mesh_->cells) {
    if (cell.inner() || !mayCarry(cell, *nodes_)) continue;
    for (const std::uint32_t n : cell.corner) near[n] = 1;
  }
  for (std::uint32_t c = 0; c < mesh_->cells.size(); ++c) {
    if (mesh_->cells[c].inner()) continue;
    for (const std::uint32_t n : mesh_->cells[c].corner)
      if (near[n] != 0) around_.push_back({n, c});
  }
  std::sort(around_.begin(), around_.end());
}

/// A point of a cell near one of its corners, and as much above it.
Eigen::Vector3f SheetSides::within(const CellAround& around) const {
  constexpr float kMost_m = 4e-3f;  // lest what stands beside the node is between the points
  const MeshNode& node = (*nodes_)[around.node];
  const Eigen::Vector3f way = middleOf(mesh_->cells[around.cell], *nodes_) - node.position;
  const float away_m = std::min(kMost_m, 0.5f * way.norm());
  return node.position + std::max(away_m, Receiver::clearance_m(node.position)) * node.flat() +
         away_m * way.normalized();
}

/// Cells whose points see each other are on one side, and so is what sees one of these.
void SheetSides::findSides(Group* group) const {
  const std::size_t count = group->end - group->begin;
  std::vector<std::uint32_t>& sides = group->sides;
  sides.resize(count);
  std::iota(sides.begin(), sides.end(), 0u);
  std::vector<Eigen::Vector3f> points;
  for (std::size_t i = group->begin; i < group->end; ++i) points.push_back(within(around_[i]));
  const MeshNode& node = (*nodes_)[around_[group->begin].node];
  const Eigen::Vector3f above = node.position + Receiver::clearance_m(node.position) * node.flat();
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t first = i + 1; first < count; first += kPacket) {
      RayPacket packet;
      HitPacket hits;
      for (std::size_t lane = 0; lane < kPacket; ++lane) {
        const std::size_t j = std::min(first + lane, count - 1);
        packet.set(lane, points[i], points[j] - points[i],
                   first + lane < count && sides[j] != sides[i] && !opposite(points[i], points[j], above));
      }
      scene_.rays.cast(packet, &hits);
      for (std::size_t lane = 0; lane < kPacket && first + lane < count; ++lane) {
        const std::size_t j = first + lane;
        if (sides[j] == sides[i] || packet.valid[lane] == 0 || meetsSheet(scene_, hits, lane)) continue;
        const std::uint32_t joined = sides[j];
        std::replace(sides.begin(), sides.end(), joined, sides[i]);
      }
    }
  }
  // 0, 1, … in their order.
  std::vector<std::uint32_t> seen;
  for (std::uint32_t& side : sides) {
    const auto at = std::find(seen.begin(), seen.end(), side) - seen.begin();
    if (at == std::distance(seen.begin(), seen.end())) seen.push_back(side);
    side = static_cast<std::uint32_t>(at);
  }
}

}  // namespace sunlit::light
