#include "light/bake/samples/light_place.h"

#include "light/bake/samples/transport_data.h"

namespace sunlit::light {

LightPlace lightPlace(const LightMesh& mesh, const TriangleSide& side, const std::array<float, 3>& within) {
  LightPlace light;
  const auto& roots = mesh.roots[side.triangle];
  std::uint32_t root = roots[side.front ? 0 : 1];
  if (root == LightMesh::kNone) root = roots[side.front ? 1 : 0];
  if (root == LightMesh::kSealed && mesh.nodeCount() > 0) {
    light.node.fill(0);
    light.weight.fill(0.0f);
  }
  if (!LightMesh::isCell(root)) return light;
  const LightMesh::Place place = mesh.locate(root, within);
  light.node = place.node;
  light.weight = place.weight;
  return light;
}

}  // namespace sunlit::light
