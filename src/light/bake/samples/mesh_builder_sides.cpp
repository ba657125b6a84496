// What walls and sheets make of cells: of a large world it takes as long as to halve them.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

#include "light/bake/samples/mesh_builder.h"
#include "light/bake/samples/sheet_sides.h"
#include "light/bake/samples/wall_cuts.h"

namespace sunlit::light {

/// Of walls and sheets that cells go through, or end at.
void MeshBuilder::separateSides(const Progress& progress) {
  const BakeScene scene{geometry_, rays_, traits_};
  std::vector<std::uint32_t> changed =
      WallCuts(scene, &mesh, &index.nodes).cut(partOf(progress, kHalved, kWalls));
  const std::vector<SheetSides::Side> sides =
      SheetSides(scene, &mesh, &index.nodes).separate(partOf(progress, kWalls, kCut));
  originals_.resize(index.nodes.size());
  std::iota(originals_.begin(), originals_.end(), 0u);
  has_sides_.resize(index.nodes.size());
  for (const SheetSides::Side& side : sides) {
    originals_[side.node] = side.original;
    has_sides_[side.original] = true;
    changed.push_back(side.node);
  }
  std::sort(changed.begin(), changed.end());
  changed.erase(std::unique(changed.begin(), changed.end()), changed.end());
  pullByOwnCells(changed);
  progress(kCut);
  lookAroundAgain(changed, partOf(progress, kCut, 1.0));
  looked_ = index.nodes.size();
}

/// By their size: what is left of a cell before a wall would pull a node through it.
void MeshBuilder::pullByOwnCells(const std::vector<std::uint32_t>& nodes) {
  std::vector<bool> wanted(index.nodes.size());
  for (const std::uint32_t n : nodes) {
    index.nodes[n].pullNoMore();
    wanted[n] = true;
  }
  for (const LightMesh::Cell& cell : mesh.cells) {
    if (cell.inner()) continue;
    const Eigen::Vector3f middle = middleOf(cell, index.nodes);
    for (const std::uint32_t n : cell.corner)
      if (wanted[n]) index.nodes[n].pullTowards(middle, (middle - index.nodes[n].position).norm());
  }
}

void MeshBuilder::lookAroundAgain(const std::vector<std::uint32_t>& nodes, const Progress& progress) {
  constexpr std::size_t kAtOnce = 4096;
  for (std::size_t begin = 0; begin < nodes.size(); begin += kAtOnce) {
    const std::size_t end = std::min(begin + kAtOnce, nodes.size());
    lookAround({nodes.begin() + static_cast<std::ptrdiff_t>(begin),
                nodes.begin() + static_cast<std::ptrdiff_t>(end)});
    progress(static_cast<double>(end) / static_cast<double>(nodes.size()));
  }
}

}  // namespace sunlit::light
