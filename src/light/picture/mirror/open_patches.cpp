#include "light/picture/mirror/open_patches.h"

#include "sunlit/quantity/vector_clones.h"

namespace sunlit::light {
namespace {

/// Samples that a surface takes its light from.
struct SampleRows {
  struct Row {
    std::uint32_t sample;
    const std::uint8_t* values;  ///< one a patch
    float share;                 ///< of the sample
    float weight;                ///< of its values
  };
  std::array<Row, 24> rows;
  std::size_t count = 0;

  SampleRows(const TransportData& data, const LightPlace& place) {
    const LightMesh& mesh = data.mesh;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t node = place.node[k];
      for (std::uint32_t s = mesh.first_share[node]; s < mesh.first_share[node + 1]; ++s) {
        if (count == rows.size()) break;  // a node of more samples than this needs no more of them
        const std::uint32_t sample = mesh.shares[s].sample;
        const float share = place.weight[k] * mesh.shares[s].weight;
        rows[count++] = {sample, data.direct.row(sample), share, share * data.direct.scales[sample]};
      }
    }
  }
};

/// A patch that the surface's own plane cuts says little.
inline bool tells(float cosine, float solid_angle) {
  return cosine > 0.02f * solid_angle;
}

/// `sums` are over the rows. All patches at once take less time than patches asked for one by one.
SUNLIT_WIDE_VECTOR_CLONES
void divideByWhole(const float* normal, const float* __restrict sums, float* __restrict share,
                   float* __restrict known) {
  const MirrorPlaces::Middles& middles = mirrorPlaces().middles;
  const float x = normal[0], y = normal[1], z = normal[2];
  const float *const mx = middles.x.data(), *const my = middles.y.data(), *const mz = middles.z.data();
  const float* const angle = middles.solid_angle.data();
  for (int p = 0; p < SkyPatches::kCount; ++p) {
    const float whole = x * mx[p] + y * my[p] + z * mz[p];
    const bool use = tells(whole, angle[p]);
    const float part = sums[p] / (use ? whole : 1.0f);
    const float one = use ? 1.0f : 0.0f;
    known[p] = one;
    share[p] = one * (part < 1.0f ? part : 1.0f);
  }
}

/// The samples' own: as in the bake, normals of the file count where they are sensible, and maps of them do
/// not.
const Eigen::Vector3f& bakedNormal(const Surface& surface, const scene::Material& material) {
  if (material.normal_map.given()) return surface.geometric_normal;
  constexpr float kSensible = 0.7f;
  return surface.shading_normal.dot(surface.geometric_normal) < kSensible ? surface.geometric_normal
                                                                          : surface.shading_normal;
}

OpenPatches ofBytes(const PatchBytes& bytes) {
  OpenPatches open;
  for (std::size_t p = 0; p < bytes.size(); ++p)
    open.share[p] = static_cast<float>(bytes[p]) * (1.0f / 255.0f);
  open.known.fill(1.0f);
  open.known[SkyPatches::kBelow] = 0.0f;
  return open;
}

OpenPatches ofGathered(const GatheredSky& gathered, const Eigen::Vector3f& normal, bool thin) {
  OpenPatches open = ofBytes(gathered.open);
  if (thin) return open;
  const MirrorPlaces::Middles& middles = mirrorPlaces().middles;
  for (std::size_t p = 0; p < gathered.open.size(); ++p) {
    const float cosine = normal.x() * middles.x[p] + normal.y() * middles.y[p] + normal.z() * middles.z[p];
    if (tells(cosine, middles.solid_angle[p])) continue;
    open.share[p] = open.known[p] = 0.0f;
  }
  return open;
}

OpenPatches ofLeaf(const LeafOpenness& leaves, const Surface& surface, const SkyOpenness& sky) {
  return ofBytes(leaves.patches(surface.triangle, sky.within));
}

}  // namespace

OpenPatches openPatches(const TransportData& data, const Surface& surface, const WholeOutlook& outlook,
                        const scene::Material& material) {
  const bool thin = material.transmission > 0.0f;
  if (outlook.gathered) return ofGathered(*outlook.gathered, surface.geometric_normal, thin);
  if (outlook.sheet.sky.known) return ofLeaf(data.leaves, surface, outlook.sheet.sky);
  const SampleRows samples(data, outlook.own.light);
  PatchValues sums;
  sums.fill(0.0f);
  Eigen::Array3f tints = Eigen::Array3f::Zero();
  for (std::size_t i = 0; i < samples.count; ++i) {
    const SampleRows::Row& row = samples.rows[i];
    addTimes(row.weight, row.values, sums.data());
    if (!data.direct_tints.empty())
      tints += data.direct_tints[row.sample].value() * row.share * data.direct.sum(row.sample);
  }
  const Eigen::Vector3f& normal = thin ? surface.shading_normal : bakedNormal(surface, material);
  OpenPatches open;
  open.tint = PackedTint(tints);
  divideByWhole(normal.data(), sums.data(), open.share.data(), open.known.data());
  return open;
}

}  // namespace sunlit::light
