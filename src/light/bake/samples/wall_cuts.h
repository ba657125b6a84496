/// Cells that walls thinner than they are go through.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "light/bake/samples/mesh_nodes.h"
#include "light/bake/samples/transport_data.h"
#include "light/bake/samples/triangle_kinds.h"
#include "light/bake/samples/work_done.h"

namespace sunlit::light {

/// A sheet, or a wall of a few centimetres, has no node within it: a cell with corners on both its sides
/// would mix their light. It is cut along the wall; where an edge meets it lie two nodes, one on each side.
class WallCuts {
 public:
  /// Keeps the pointers, and references of the scene.
  WallCuts(const BakeScene& scene, LightMesh* mesh, std::vector<MeshNode>* nodes);
  /// The corners of what comes of cells that were cut; new ones are at the end of all nodes.
  std::vector<std::uint32_t> cut(const Progress& progress = nullptr);

 private:
  using Edge = std::pair<std::uint32_t, std::uint32_t>;  ///< nodes, the smaller number first
  /// An edge that goes through a wall.
  struct Crossing {
    Edge edge;
    float into = -1.0f, out_of = -1.0f;  ///< the wall, in lengths of the edge; below 0: there is none
    std::array<std::uint32_t, 2>
        walls{};           ///< triangles that the edge meets from its first end, its other one
    bool is_room = false;  ///< it is two walls with room between them, which an end may be within
    std::uint32_t before = LightMesh::kNone, behind = LightMesh::kNone;  ///< nodes, on each side
  };
  /// The same as seen from a cell.
  struct Cut {
    float share;              ///< of the edge that lies before it
    std::uint32_t near, far;  ///< nodes
  };
  using Cuts = std::array<const Crossing*, 3>;  ///< of a cell's edges, from each corner to the next; or null

  template <typename Visit>
  void visitLeaves(const Visit& visit);
  void findCrossings(const Progress& progress = nullptr);
  template <typename Wanted>
  void keepThose(const Wanted& wanted);
  std::vector<Crossing> edgesAtWalls() const;
  template <typename Starts, typename Visit>
  void castTwice(const Starts& starts, const Progress& progress, const Visit& visit);
  void findWalls(const Progress& progress);
  void findRooms();
  Eigen::Vector3f wayOf(const Edge& edge) const;
  bool meetsWall(const HitPacket& hits, std::size_t lane) const;
  bool leavesBody(std::uint32_t triangle, const Eigen::Vector3f& way) const;
  bool partsLight(const Crossing& crossing) const;
  std::uint32_t addNode(const Edge& edge, float at);
  bool divideRooms();
  void divideRooms(std::uint32_t cell);
  bool divideCorners();
  bool divideCorner(std::uint32_t cell);
  std::optional<Eigen::Vector3f> cornerWithin(std::uint32_t cell, std::size_t k, const Cuts& cuts) const;
  Cuts cutsOf(const LightMesh::Cell& cell) const;
  Cut along(const Crossing& crossing, std::uint32_t from) const;
  static std::size_t firstCut(const Cuts& cuts);
  void cut(std::uint32_t cell, const Cuts& cuts);
  std::array<std::uint32_t, 3> cornersFrom(std::uint32_t leaf, std::size_t k) const;
  std::uint32_t divide(std::uint32_t cell, std::size_t edge, float share);
  void setLeaf(std::uint32_t cell, const std::array<std::uint32_t, 3>& corner);

  BakeScene scene_;
  LightMesh* mesh_;
  std::vector<MeshNode>* nodes_;
  std::vector<std::uint32_t> touched_;
  std::vector<Crossing> crossings_;  ///< by edge
};

}  // namespace sunlit::light
