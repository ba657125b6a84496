/// Nodes that sheets stand on.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "light/bake/samples/mesh_nodes.h"
#include "light/bake/samples/transport_data.h"
#include "light/bake/samples/triangle_kinds.h"
#include "light/bake/samples/work_done.h"

namespace sunlit::light {

/// Those of the nodes from number `first` on that a sheet stands on look around from beside it: from within
/// its plane they would see nothing of it.
void stepOffSheets(const BakeScene& scene, std::size_t first, std::vector<MeshNode>* nodes);

/// A node where a sheet meets the ground has cells on both sides of it, and would give both the light of one.
/// It becomes one node for each side.
class SheetSides {
 public:
  /// Keeps references and pointers.
  SheetSides(const BakeScene& scene, LightMesh* mesh, std::vector<MeshNode>* nodes);
  struct Side {
    std::uint32_t node;
    std::uint32_t original;  ///< which may be the same
  };
  /// All those that come of nodes with two sides or more.
  std::vector<Side> separate(const Progress& progress = nullptr);

 private:
  /// Cells about one node, and the side that each is on.
  struct Group {
    std::size_t begin, end;  ///< into around_
    std::vector<std::uint32_t> sides;
  };
  void findCells();
  void findSides(Group* group) const;
  Eigen::Vector3f within(const CellAround& around) const;

  BakeScene scene_;
  LightMesh* mesh_;
  std::vector<MeshNode>* nodes_;
  std::vector<CellAround> around_;
};

}  // namespace sunlit::light
