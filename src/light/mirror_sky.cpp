#include "light/mirror_sky.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "light/mirror_lobe.h"

namespace sunlit::light {
namespace {

constexpr int kSide = 128;
constexpr std::size_t kPlaces = static_cast<std::size_t>(kSide * kSide);
static_assert(MirrorView::kParts == static_cast<std::size_t>(MirrorLobe::kParts), "one direction a part");

Eigen::Vector3f directionOf(int column, int row) {
  const float x = (2.0f * static_cast<float>(column) + 1.0f) / kSide - 1.0f;
  const float y = (2.0f * static_cast<float>(row) + 1.0f) / kSide - 1.0f;
  Eigen::Vector3f n(x, y, 1.0f - std::abs(x) - std::abs(y));
  if (n.z() < 0.0f) {
    n.x() = std::copysign(1.0f - std::abs(y), x);
    n.y() = std::copysign(1.0f - std::abs(x), y);
  }
  return n.normalized();
}

/// Patches about each place of the table, and where the patches lie.
struct Places {
  std::array<std::array<PatchShare, 4>, kPlaces> shares;
  std::array<bool, kPlaces> below;
  std::array<Eigen::Vector3f, SkyPatches::kAbove> middles;  ///< as long as the patch's solid angle
  std::array<float, SkyPatches::kAbove> solid_angles;
  Places() {
    for (int row = 0; row < kSide; ++row) {
      for (int column = 0; column < kSide; ++column) {
        const Eigen::Vector3f towards = directionOf(column, row);
        const auto place = static_cast<std::size_t>(row * kSide + column);
        shares[place] = SkyPatches::around(towards);
        below[place] = towards.z() < 0.0f;
      }
    }
    for (int patch = 0; patch < SkyPatches::kAbove; ++patch)
      solid_angles[static_cast<std::size_t>(patch)] = SkyPatches::solidAngle(patch);
    middles.fill(Eigen::Vector3f::Zero());
    const SkyPatches patches(8);
    for (const SkyPatches::Ray& ray : patches.rays()) {
      if (ray.patch < SkyPatches::kAbove)
        middles[static_cast<std::size_t>(ray.patch)] += ray.towards * ray.solid_angle;
    }
  }
};

const Places& places() {
  static const Places made;
  return made;
}

/// How much of each patch is open at a surface, found when first asked for.
class OpenPatches {
 public:
  OpenPatches(const TransportData& data, const Surface& surface) : normal_(surface.shading_normal) {
    open_.fill(kUnknown);
    const LightMesh& mesh = data.mesh;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t node = surface.light.node[k];
      for (std::uint32_t s = mesh.first_share[node]; s < mesh.first_share[node + 1]; ++s) {
        if (count_ == rows_.size()) break;  // a node of more samples than this needs no more of them
        const std::uint32_t sample = mesh.shares[s].sample;
        rows_[count_++] = {data.direct.row(sample),
                           surface.light.weight[k] * mesh.shares[s].weight * data.direct.scales[sample]};
      }
    }
  }

  float of(int patch) {
    float& open = open_[static_cast<std::size_t>(patch)];
    if (open == kUnknown) open = find(patch);
    return open;
  }

 private:
  static constexpr float kUnknown = -1.0f;
  struct Row {
    const std::uint8_t* values;
    float weight;
  };

  float find(int patch) const {
    const float whole = normal_.dot(places().middles[static_cast<std::size_t>(patch)]);
    // A patch that the surface's own plane cuts says little.
    if (whole < 0.03f * places().solid_angles[static_cast<std::size_t>(patch)]) return 0.0f;
    float sum = 0.0f;
    for (std::size_t i = 0; i < count_; ++i)
      sum += rows_[i].weight * static_cast<float>(rows_[i].values[patch]);
    return std::min(sum / whole, 1.0f);
  }

  Eigen::Vector3f normal_;
  std::array<Row, 24> rows_;
  std::size_t count_ = 0;
  std::array<float, SkyPatches::kAbove> open_;
};

void findView(const TransportData& data, float roughness, Surface* surface) {
  const Eigen::Vector3f& normal = surface->shading_normal;
  const float n_v = normal.dot(surface->to_eye);
  const MirrorLobe lobe = mirrorLobe(roughness, n_v);
  Eigen::Vector3f along = n_v * normal - surface->to_eye;
  const float length = along.norm();
  along = length > 1e-4f ? Eigen::Vector3f(along / length) : normal.unitOrthogonal();
  const Eigen::Vector3f left = normal.cross(along);
  OpenPatches open(data, *surface);
  for (std::size_t k = 0; k < MirrorView::kParts; ++k) {
    const Eigen::Vector3f& t = lobe.towards[k];
    const std::uint16_t place = MirrorSky::placeOf(t.x() * along + t.y() * left + t.z() * normal);
    float share = 0.0f;
    if (!places().below[place]) {
      for (const PatchShare& patch : places().shares[place])
        if (patch.share > 0.0f) share += patch.share * open.of(patch.patch);
    }
    surface->mirror.place[k] = place;
    surface->mirror.open[k] = static_cast<std::uint8_t>(255.0f * std::min(share, 1.0f) + 0.5f);
  }
}

bool mirrorAlike(const Surface& a, const Surface& b) {
  constexpr float kSameNormalCosine = 0.9995f;  // 1.8°: the mirror turns by twice that
  constexpr float kSameViewCosine = 0.9995f;
  return a.material == b.material && a.shading_normal.dot(b.shading_normal) > kSameNormalCosine &&
         a.to_eye.dot(b.to_eye) > kSameViewCosine;
}

}  // namespace

MirrorSky::MirrorSky(const sky::Daylight& day) : table_(kPlaces) {
  const auto patches = SkyPatches::luminances(day);
  for (std::size_t place = 0; place < kPlaces; ++place) {
    Eigen::Array3f sum = Eigen::Array3f::Zero();
    for (const PatchShare& share : places().shares[place])
      sum += patches[static_cast<std::size_t>(share.patch)] * share.share;
    table_[place] = Eigen::Array4f(sum[0], sum[1], sum[2], 0.0f);
  }
}

std::uint16_t MirrorSky::placeOf(const Eigen::Vector3f& towards) {
  const float scale = 1.0f / (std::abs(towards.x()) + std::abs(towards.y()) + std::abs(towards.z()));
  float x = towards.x() * scale, y = towards.y() * scale;
  if (towards.z() < 0.0f) {
    const float folded = std::copysign(1.0f - std::abs(y), x);
    y = std::copysign(1.0f - std::abs(x), y);
    x = folded;
  }
  const int column = std::clamp(static_cast<int>((x + 1.0f) * (0.5f * kSide)), 0, kSide - 1);
  const int row = std::clamp(static_cast<int>((y + 1.0f) * (0.5f * kSide)), 0, kSide - 1);
  return static_cast<std::uint16_t>(row * kSide + column);
}

void findMirrorViews(const TransportData& data, const scene::Scene& scene, int picture_width, Tile* tile) {
  // Neighbours of one plane mirror the same: one of a block of 4 by 2 pixels is enough.
  constexpr int kAcross = 4, kDown = 2;
  constexpr std::size_t kBlocks = Surfaces::kTileSize * Surfaces::kTileSize / (kAcross * kDown);
  std::array<const Surface*, kBlocks> found{};
  for (Surface& surface : tile->surfaces) {
    if (!surface.light.known()) continue;
    const int x = static_cast<int>(surface.pixel) % picture_width - tile->x;
    const int y = static_cast<int>(surface.pixel) / picture_width - tile->y;
    const Surface*& like =
        found[static_cast<std::size_t>(y / kDown * (Surfaces::kTileSize / kAcross) + x / kAcross)];
    if (like && mirrorAlike(*like, surface)) {
      surface.mirror = like->mirror;
    } else {
      findView(data, scene.materials[static_cast<std::size_t>(surface.material)].roughness, &surface);
      like = &surface;
    }
  }
}

}  // namespace sunlit::light
