#include "light/bake/samples/thin_sheets.h"

#include "light/bake/samples/mesh_leaves.h"
#include "light/bake/samples/met_sample.h"

namespace sunlit::light {

void coupleSheets(const BakeScene& scene, SceneSamples* samples) {
  const LightMesh& mesh = samples->mesh;
  for (std::uint32_t t = 0; t < mesh.roots.size(); ++t) {
    const auto material = static_cast<std::size_t>(scene.geometry.materials[t]);
    const float transmission = scene.geometry.scene->materials[material].transmission;
    if (!(transmission > 0.0f) || isLeaf(scene.traits[t].kind)) continue;
    const auto& roots = mesh.roots[t];
    if (!LightMesh::isCell(roots[0]) || !LightMesh::isCell(roots[1])) continue;
    for (std::size_t side = 0; side < 2; ++side) {
      visitLeaves(mesh, roots[side], Eigen::Matrix3f::Identity(),
                  [&](const LightMesh::Cell& cell, const Eigen::Matrix3f& corners) {
                    for (Eigen::Index k = 0; k < 3; ++k) {
                      const std::uint32_t node = cell.corner[static_cast<std::size_t>(k)];
                      const std::uint32_t sample = samples->nearest_sample[node];
                      OtherSide& other = samples->other_side[sample];
                      if (other.sample != LightMesh::kNone) continue;
                      const std::uint32_t behind = sampleOn(*samples, roots[1 - side], corners.col(k));
                      if (behind != sample) other = {behind, transmission};
                    }
                  });
    }
  }
}

}  // namespace sunlit::light
