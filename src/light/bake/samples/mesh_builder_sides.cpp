// What MeshBuilder::separateSides() has looked at anew, of a large world as long as it takes to halve cells.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "light/bake/samples/mesh_builder.h"

namespace sunlit::light {

void MeshBuilder::lookAroundAgain(const std::vector<std::uint32_t>& nodes, const Progress& progress) {
  constexpr std::size_t kAtOnce = 4096;
  progress(kCut);
  for (std::size_t begin = 0; begin < nodes.size(); begin += kAtOnce) {
    const std::size_t end = std::min(begin + kAtOnce, nodes.size());
    lookAround({nodes.begin() + static_cast<std::ptrdiff_t>(begin),
                nodes.begin() + static_cast<std::ptrdiff_t>(end)});
    progress(kCut + (1.0 - kCut) * static_cast<double>(end) / static_cast<double>(nodes.size()));
  }
}

}  // namespace sunlit::light
