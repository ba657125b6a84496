#include "light/bake/samples/sample_paint.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "light/bake/samples/mesh_leaves.h"
#include "light/shading/reflectances.h"
#include "light/shading/shading.h"
#include "sunlit/light/reflection.h"
#include "sunlit/light/visibility.h"
#include "sunlit/quantity/angle.h"

namespace sunlit::light {
namespace {

void findNearest(SceneSamples* samples) {
  const LightMesh& mesh = samples->mesh;
  samples->nearest_sample.resize(mesh.nodeCount());
  for (std::size_t n = 0; n < mesh.nodeCount(); ++n) {
    const auto first = mesh.shares.begin() + mesh.first_share[n];
    const auto end = mesh.shares.begin() + mesh.first_share[n + 1];
    samples->nearest_sample[n] =
        std::max_element(first, end, [](const LightMesh::Share& a, const LightMesh::Share& b) {
          return a.weight < b.weight;
        })->sample;
  }
}

/// Of a ray glass has the share that it sends back, scatters or swallows: of that it reflects more than of
/// all, clear glass everything.
Paint paintOfGlass(const scene::Material& material) {
  Reflection sheet = {Eigen::Vector3f::UnitZ(), Eigen::Vector3f::UnitZ(), material.base_color.value,
                      material.roughness, material.metalness};
  sheet.dielectric = material.dielectric.value;
  sheet.dielectric_grazing = material.dielectric_grazing;
  sheet.glass = material.glass;
  constexpr int kParts = 32;  // of equal irradiance: even in the square of the cosine
  Eigen::Array3f reflected = Eigen::Array3f::Zero();
  float stopped = 0.0f;
  for (int i = 0; i < kParts; ++i) {
    const float cosine = std::sqrt((static_cast<float>(i) + 0.5f) / kParts);
    sheet.to_eye = Eigen::Vector3f(std::sqrt(1.0f - cosine * cosine), 0.0f, cosine);
    const AmbientReflectance shows = ambientReflectance(sheet);
    reflected += shows.specular + kPiFloat * shows.diffuse;
    stopped += 1.0f - LinearRgb(straightThrough(sheet)).luminance();
  }
  // Smooth metal reflects its colour, all of it.
  return {(reflected / std::max(stopped, 1e-6f)).min(1.0f), scene::Material::kSmoothest, 1.0f,
          material.dielectric.value, material.dielectric_grazing};
}

/// Of each material that is glass.
std::vector<std::optional<Paint>> paintsOfGlass(const scene::Scene& scene) {
  std::vector<std::optional<Paint>> paints(scene.materials.size());
  for (std::size_t m = 0; m < paints.size(); ++m)
    if (isGlass(scene.materials[m])) paints[m] = paintOfGlass(scene.materials[m]);
  return paints;
}

}  // namespace

void paintSamples(const Geometry& geometry, SceneSamples* samples) {
  const LightMesh& mesh = samples->mesh;
  findNearest(samples);
  const Reflectances reflectances(geometry);
  const std::vector<std::optional<Paint>> glass = paintsOfGlass(*geometry.scene);
  samples->paints.assign(samples->receivers.size(), Paint());
  std::vector<float> areas(samples->receivers.size(), 0.0f);
  for (std::uint32_t t = 0; t < mesh.roots.size(); ++t) {
    const auto& c = geometry.triangles[t];
    const Eigen::Vector3f a = geometry.positions[c[0]];
    const float whole = (geometry.positions[c[1]] - a).cross(geometry.positions[c[2]] - a).norm();
    for (const bool front : {true, false}) {
      const std::uint32_t root = mesh.roots[t][front ? 0 : 1];
      if (!LightMesh::isCell(root)) continue;
      visitLeaves(mesh, root, Eigen::Matrix3f::Identity(),
                  [&](const LightMesh::Cell& cell, const Eigen::Matrix3f& corners) {
                    const std::optional<Paint>& pane = glass[static_cast<std::size_t>(geometry.materials[t])];
                    const Paint paint = pane ? *pane : reflectances.mean({t, front}, corners);
                    const float area = whole * std::abs(corners.determinant());
                    for (std::uint32_t node : cell.corner) {
                      const std::uint32_t sample = samples->nearest_sample[node];
                      samples->paints[sample] += area * paint;
                      areas[sample] += area;
                    }
                  });
    }
  }
  for (std::size_t i = 0; i < areas.size(); ++i) {
    if (areas[i] > 0.0f) samples->paints[i] *= 1.0f / areas[i];
    areas[i] /= 6.0f;  // half of the cross product, and a third of each cell
  }
  samples->areas_m2 = std::move(areas);
}

}  // namespace sunlit::light
