/// Floors that go on below walls.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "light/bake/samples/mesh_nodes.h"
#include "light/bake/samples/transport_data.h"

namespace sunlit::light {

/// A node inside a wall has no light of its own but that of its neighbours, which stand on both sides: the
/// sun's before the wall would shine in the room behind it. It becomes one node for each side, whose cells
/// get theirs. What hangs from it hangs from that of its own side; it hangs from nothing itself, for the ends
/// of its edge may be on both sides, too.
class WallSides {
 public:
  using Hangs = std::vector<std::array<std::uint32_t, 2>>;  ///< MeshBuilder::hangs_between

  /// Keeps the pointers.
  WallSides(LightMesh* mesh, std::vector<MeshNode>* nodes, Hangs* hangs_between);
  void separate();

 private:
  /// A neighbour that is no such node, and the side that it stands on.
  struct Neighbour {
    std::uint32_t node;
    std::size_t side;
  };
  std::vector<CellAround> cellsAround() const;
  void separate(std::uint32_t node, const std::vector<CellAround>& cells);
  std::vector<Neighbour> sidesOf(std::uint32_t node, const std::vector<CellAround>& cells) const;
  void hangFromOwnSides();
  bool open(std::uint32_t node) const { return (*nodes_)[node].valid; }

  LightMesh* mesh_;
  std::vector<MeshNode>* nodes_;
  Hangs* hangs_between_;
  struct Place {
    std::uint32_t node, neighbour, own;
  };
  std::vector<Place> places_;  ///< whose own node a neighbour has in the place of a node, in their order
};

}  // namespace sunlit::light
