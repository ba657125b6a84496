#include "light/picture/mirror/find_mirrors.h"

#include <cmath>

#include "light/picture/mirror/open_patches.h"
#include "light/picture/mirror/rough_mirror.h"
#include "light/picture/mirror/smooth_mirror.h"

namespace sunlit::light {
namespace {

/// From here on lobes are so wide that patches tell more about them than sixteen directions: at 0.4 patches
/// are up to 3.2 % off on average and directions 1.9 %, at 0.5 2.1 and 4.2 %.
constexpr float kLeastRough = 0.42f;

Mirror findView(const TransportData& data, const scene::Material& material, const Surface& surface,
                const WholeOutlook& outlook) {
  const bool sheet = material.transmission > 0.0f;
  const OpenPatches open = openPatches(data, surface, outlook, material);
  if (surface.roughness < kLeastRough) return smoothMirror(surface, surface.roughness, sheet, open);
  return roughMirror(surface, material, open, outlook.sheet.sky.known);
}

/// What surfaces of a tile mirror, found once for all that are alike.
class ViewsOfTile {
 public:
  ViewsOfTile(int picture_width, const Tile& tile) : picture_width_(picture_width), tile_(tile) {}

  /// A surface that mirrors what `surface` does, or null.
  const Surface* like(const Surface& surface, const WholeOutlook& outlook, bool leaf) {
    if (outlook.gathered) return nullptr;  // differs from place to place
    const Surface* const of_triangle = *triangle(surface);
    if (of_triangle && of_triangle->triangle == surface.triangle && near(*of_triangle, surface) &&
        alike(*of_triangle, surface, leaf))
      return of_triangle;
    if (outlook.sheet.sky.known) return nullptr;  // differs from leaf to leaf
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
    constexpr float kSameRoughness = 0.02f;
    return a.material == b.material && std::abs(a.roughness - b.roughness) <= kSameRoughness &&
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

void findMirrors(const TransportData& data, const TileToMirror& of, TileOutlooks* outlooks) {
  const std::vector<Surface>& surfaces = of.tile.surfaces;
  outlooks->mirrors.clear();
  ViewsOfTile views(of.picture_width, of.tile);
  for (std::size_t i = 0; i < surfaces.size(); ++i) {
    const Surface& surface = surfaces[i];
    const WholeOutlook outlook = outlooks->whole(i);
    if (!outlook.own.light.known()) continue;
    const scene::Material& material = of.scene.materials[static_cast<std::size_t>(surface.material)];
    const Surface* const like = views.like(surface, outlook, material.transmission > 0.0f);
    std::uint16_t& mirror = outlooks->surfaces[i].mirror;
    if (like) {
      mirror = outlooks->surfaces[static_cast<std::size_t>(like - surfaces.data())].mirror;
      continue;
    }
    mirror = static_cast<std::uint16_t>(outlooks->mirrors.size());
    outlooks->mirrors.push_back(findView(data, material, surface, outlook));
    if (!outlook.gathered) views.keep(surface);
  }
}

}  // namespace sunlit::light
