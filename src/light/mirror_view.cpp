#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "light/mirror_places.h"
#include "light/mirror_sky.h"
#include "sunlit/quantity/vector_clones.h"

namespace sunlit::light {
namespace {

/// Samples that a surface takes its light from.
struct SampleRows {
  struct Row {
    const std::uint8_t* values;  ///< one a patch
    float weight;
  };
  std::array<Row, 24> rows;
  std::size_t count = 0;

  /// Samples of thin sheets take but part of their light from this side.
  SampleRows(const TransportData& data, const Surface& surface, float transmission) {
    const LightMesh& mesh = data.mesh;
    const float scale = 1.0f / (1.0f - std::min(transmission, 0.9f));
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t node = surface.light.node[k];
      for (std::uint32_t s = mesh.first_share[node]; s < mesh.first_share[node + 1]; ++s) {
        if (count == rows.size()) break;  // a node of more samples than this needs no more of them
        const std::uint32_t sample = mesh.shares[s].sample;
        rows[count++] = {data.direct.row(sample), scale * surface.light.weight[k] * mesh.shares[s].weight *
                                                      data.direct.scales[sample]};
      }
    }
  }
};

/// How much of each patch is open at a surface.
struct OpenPatches {
  PatchValues share;  ///< 0 … 1
  PatchValues known;  ///< 1, or 0 where the surface's samples don't tell, and `share` is 0
};

// The two loops apart, each over all patches at once, which takes less time than patches asked for one by
// one.
SUNLIT_VECTOR_CLONES
void addRow(const SampleRows::Row& row, float* __restrict sums) {
  const std::uint8_t* const values = row.values;
  const float weight = row.weight;
  for (int p = 0; p < SkyPatches::kCount; ++p) sums[p] += weight * static_cast<float>(values[p]);
}

/// `sums` are over the rows.
SUNLIT_VECTOR_CLONES
void divideByWhole(const float* normal, const MirrorPlaces::Middles& middles, const float* __restrict sums,
                   float* __restrict share, float* __restrict known) {
  const float x = normal[0], y = normal[1], z = normal[2];
  const float *const mx = middles.x.data(), *const my = middles.y.data(), *const mz = middles.z.data();
  const float* const angle = middles.solid_angle.data();
  for (int p = 0; p < SkyPatches::kCount; ++p) {
    const float whole = x * mx[p] + y * my[p] + z * mz[p];
    // A patch that the surface's own plane cuts says little.
    const bool tells = whole > 0.02f * angle[p];
    const float part = sums[p] / (tells ? whole : 1.0f);
    const float one = tells ? 1.0f : 0.0f;
    known[p] = one;
    share[p] = one * (part < 1.0f ? part : 1.0f);
  }
}

/// Of a surface with `normal`.
OpenPatches openPatches(const SampleRows& samples, const Eigen::Vector3f& normal,
                        const MirrorPlaces::Middles& middles) {
  OpenPatches open;
  PatchValues sums;
  sums.fill(0.0f);
  for (std::size_t i = 0; i < samples.count; ++i) addRow(samples.rows[i], sums.data());
  divideByWhole(normal.data(), middles, sums.data(), open.share.data(), open.known.data());
  return open;
}

/// The samples' own: as in the bake, normals of the file count where they are sensible.
const Eigen::Vector3f& bakedNormal(const Surface& surface) {
  constexpr float kSensible = 0.7f;
  return surface.shading_normal.dot(surface.geometric_normal) < kSensible ? surface.geometric_normal
                                                                          : surface.shading_normal;
}

/// Part of a lobe as far as it is open: how much of it, and towards where.
struct OpenPart {
  float share = 0.0f;
  Eigen::Vector3f towards;  ///< as MirrorLobe::towards
};

/// What is hidden is often the brightest: the sky above the horizon. So the open rest of a part has its own
/// direction. `below` is what a direction below the horizon counts: on level ground nothing, as no part of a
/// lobe lies there.
OpenPart openPart(const MirrorPlaces& sky, std::uint16_t place, const Eigen::Vector3f& towards,
                  const OpenPatches& open, float below) {
  Eigen::Array4f all = Eigen::Array4f::Zero(), seen = Eigen::Array4f::Zero();  // the fourth counts
  for (const std::uint8_t patch : sky.patches[place]) {
    all += open.known[patch] * sky.means[patch];
    seen += open.share[patch] * sky.means[patch];
  }
  if (!(seen[3] > 0.0f)) return {0.0f, towards};
  const float count = all[3] + below * static_cast<float>(sky.patches_below[place]);
  return {seen[3] / count, towards + (seen.head<3>() / seen[3] - all.head<3>() / all[3]).matrix()};
}

/// The parts of a surface's lobe as MirrorLobe::towards, in `map`.
using Parts = std::array<Eigen::Vector3f, MirrorView::kParts>;
Parts partsOf(const Surface& surface, float roughness) {
  const Eigen::Vector3f& normal = surface.shading_normal;
  const float n_v = normal.dot(surface.to_eye);
  const MirrorLobe lobe = mirrorLobe(roughness, n_v);
  Eigen::Vector3f along = n_v * normal - surface.to_eye;
  const float length = along.norm();
  along = length > 1e-4f ? Eigen::Vector3f(along / length) : normal.unitOrthogonal();
  const Eigen::Vector3f left = normal.cross(along);
  Parts parts;
  for (std::size_t k = 0; k < parts.size(); ++k) {
    const Eigen::Vector3f& t = lobe.towards[k];
    parts[k] = t.x() * along + t.y() * left + t.z() * normal;
  }
  return parts;
}

/// mirrorPlace() of all of them at once.
SUNLIT_VECTOR_CLONES
void findPlaces(const Parts& parts, std::array<std::uint16_t, MirrorView::kParts>* places) {
  constexpr int kCount = MirrorLobe::kParts;
  const float* const coordinates = parts[0].data();
  float x[kCount], y[kCount], z[kCount];
  for (int k = 0; k < kCount; ++k) {
    x[k] = coordinates[3 * k];
    y[k] = coordinates[3 * k + 1];
    z[k] = coordinates[3 * k + 2];
  }
  std::int32_t place[kCount];
  for (int k = 0; k < kCount; ++k) place[k] = mirrorPlace(x[k], y[k], z[k]);
  std::uint16_t* const to = places->data();
  for (int k = 0; k < kCount; ++k) to[k] = static_cast<std::uint16_t>(place[k]);
}

std::uint8_t inWhole(float share) {
  return static_cast<std::uint8_t>(255.0f * std::min(share, 1.0f) + 0.5f);
}

/// Among leaves, which mirror little, each elsewhere than its neighbour: by the sectors of the sky.
MirrorView findLeafView(float roughness, const Surface& surface) {
  const MirrorPlaces& sky = mirrorPlaces();
  MirrorView view;
  findPlaces(partsOf(surface, roughness), &view.place);
  for (std::size_t k = 0; k < MirrorView::kParts; ++k) {
    int open = 0;
    for (const std::uint8_t patch : sky.patches[view.place[k]]) {
      if (patch != SkyPatches::kBelow) open += surface.sky.open[sky.sectors[patch]];
    }
    view.open[k] = static_cast<std::uint8_t>(open / static_cast<int>(kProbes));
  }
  return view;
}

MirrorView findView(const TransportData& data, const scene::Material& material, const Surface& surface) {
  if (surface.sky.known) return findLeafView(material.roughness, surface);
  const MirrorPlaces& sky = mirrorPlaces();
  // Leaves mirror little, each elsewhere than its neighbour, and hide the sky by chance: one patch says as
  // much about them as several.
  const bool leaf = material.transmission > 0.0f;
  const SampleRows samples(data, surface, material.transmission);
  const Eigen::Vector3f normal = leaf ? surface.shading_normal : bakedNormal(surface);
  const OpenPatches open = openPatches(samples, normal, sky.middles);
  const float below = 1.0f - std::abs(normal.z());
  Parts parts = partsOf(surface, material.roughness);
  std::array<float, MirrorView::kParts> shares;
  MirrorView view;
  findPlaces(parts, &view.place);
  for (std::size_t k = 0; k < parts.size(); ++k) {
    if (leaf) {
      shares[k] = open.share[sky.patches[view.place[k]][0]];
    } else if (surface.geometric_normal.dot(parts[k]) <= 0.0f) {
      shares[k] = 1.0f;
      parts[k] = -Eigen::Vector3f::UnitZ();  // into the surface itself: nothing is seen, as of no sky
    } else {
      const OpenPart part = openPart(sky, view.place[k], parts[k], open, below);
      shares[k] = part.share;
      parts[k] = part.towards;
    }
  }
  if (!leaf) findPlaces(parts, &view.place);
  for (std::size_t k = 0; k < parts.size(); ++k) view.open[k] = inWhole(shares[k]);
  return view;
}

/// What surfaces of a tile mirror, found once for all that are alike.
class ViewsOfTile {
 public:
  ViewsOfTile(int picture_width, Tile* tile) : picture_width_(picture_width), tile_(*tile) {}

  /// A surface that mirrors what `surface` does, or null.
  const Surface* like(const Surface& surface, bool leaf) {
    const Surface* const of_triangle = *triangle(surface);
    if (of_triangle && of_triangle->triangle == surface.triangle && near(*of_triangle, surface) &&
        alike(*of_triangle, surface, leaf))
      return of_triangle;
    if (surface.sky.known) return nullptr;  // differs from leaf to leaf
    const Surface* const of_block = *block(surface);
    if (!of_block || !alike(*of_block, surface, leaf)) return nullptr;
    return *triangle(surface) = of_block;
  }
  void keep(const Surface& surface) { *triangle(surface) = *block(surface) = &surface; }

 private:
  static constexpr int kAcross = 4, kDown = 2;  ///< pixels of a block
  static constexpr int kReach = 4;              ///< pixels between surfaces of one triangle

  static bool alike(const Surface& a, const Surface& b, bool leaf) {
    constexpr float kSameView = 0.9995f;    // 1.8°
    constexpr float kSameNormal = 0.9995f;  // the mirror turns by twice that
    constexpr float kSameLeaf = 0.98f;      // 11°: their lobes are wider than twice that
    return a.material == b.material &&
           a.shading_normal.dot(b.shading_normal) > (leaf ? kSameLeaf : kSameNormal) &&
           a.to_eye.dot(b.to_eye) > kSameView;
  }
  int x(const Surface& surface) const { return static_cast<int>(surface.pixel) % picture_width_ - tile_.x; }
  int y(const Surface& surface) const { return static_cast<int>(surface.pixel) / picture_width_ - tile_.y; }
  bool near(const Surface& a, const Surface& b) const {
    return std::abs(x(a) - x(b)) < kReach && std::abs(y(a) - y(b)) < kReach;
  }
  const Surface** triangle(const Surface& surface) {
    return &of_triangle_[(surface.triangle * 0x9e3779b1u) >> 24];
  }
  const Surface** block(const Surface& surface) {
    return &of_block_[static_cast<std::size_t>(y(surface) / kDown * (Surfaces::kTileSize / kAcross) +
                                               x(surface) / kAcross)];
  }

  const int picture_width_;
  const Tile& tile_;
  /// The one found last.
  std::array<const Surface*, 256> of_triangle_{};  ///< by a hash of its triangle
  std::array<const Surface*, Surfaces::kTileSize * Surfaces::kTileSize / (kAcross * kDown)> of_block_{};
};

}  // namespace

void findMirrorViews(const TransportData& data, const scene::Scene& scene, int picture_width, Tile* tile) {
  tile->views.clear();
  ViewsOfTile views(picture_width, tile);
  for (Surface& surface : tile->surfaces) {
    if (!surface.light.known()) continue;
    const scene::Material& material = scene.materials[static_cast<std::size_t>(surface.material)];
    const Surface* const like = views.like(surface, material.transmission > 0.0f);
    if (like) {
      surface.view = like->view;
      continue;
    }
    surface.view = static_cast<std::uint16_t>(tile->views.size());
    tile->views.push_back(findView(data, material, surface));
    views.keep(surface);
  }
}

}  // namespace sunlit::light
