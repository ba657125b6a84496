#include "light/mirror_sky.h"

#include <tbb/parallel_for.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "light/angles.h"
#include "light/mirror_lobe.h"
#include "sunlit/sky/octahedral.h"

namespace sunlit::light {
namespace {

/// One table of the sky.
struct Level {
  int side;           ///< cells an axis of the map
  float radius_rad;   ///< of the caps
  std::size_t first;  ///< of its cells
  std::size_t cells() const { return static_cast<std::size_t>(side * side); }
};
constexpr std::array<Level, 5> kLevels = {
    {{128, 0.02f, 0}, {64, 0.14f, 16384}, {64, 0.26f, 20480}, {64, 0.45f, 24576}, {64, 0.75f, 28672}}};
constexpr std::size_t kPlaces = kLevels.back().first + 64 * 64;
static_assert(kPlaces <= 65536, "places are 16-bit numbers");
static_assert(MirrorView::kParts == static_cast<std::size_t>(MirrorLobe::kParts), "one direction a part");

Eigen::Vector3f directionOf(const Level& level, std::size_t cell) {
  const auto side = static_cast<std::size_t>(level.side);
  const float x = (2.0f * static_cast<float>(cell % side) + 1.0f) / static_cast<float>(level.side) - 1.0f;
  const float y = (2.0f * static_cast<float>(cell / side) + 1.0f) / static_cast<float>(level.side) - 1.0f;
  return sky::octahedralDirection(x, y);
}

/// The cap, evenly filled, whose mean direction has a length (1 + cos radius) / 2: number of its level.
inline std::int32_t levelFor(float squared_length) {
  // Halfway between the squares of neighbouring radii, by 1 − length ≈ radius² / 4.
  constexpr auto kShorter = [](float missing) { return (1.0f - missing) * (1.0f - missing); };
  return (squared_length < kShorter(0.0025f) ? 1 : 0) + (squared_length < kShorter(0.0109f) ? 1 : 0) +
         (squared_length < kShorter(0.0338f) ? 1 : 0) + (squared_length < kShorter(0.0956f) ? 1 : 0);
}

/// Cell of a map of `side` cells an axis: sky::octahedralPlace() without a branch, so that compilers may
/// treat several directions at once.
inline std::int32_t cellIn(std::int32_t side, float x, float y, float z) {
  const float scale = 1.0f / (std::abs(x) + std::abs(y) + std::abs(z));
  x *= scale;
  y *= scale;
  const float folded_x = std::copysign(1.0f - std::abs(y), x),
              folded_y = std::copysign(1.0f - std::abs(x), y);
  x = z < 0.0f ? folded_x : x;
  y = z < 0.0f ? folded_y : y;
  const auto step = [&](float at) {
    const auto i = static_cast<std::int32_t>((at + 1.0f) * (0.5f * static_cast<float>(side)));
    return i < 0 ? 0 : i > side - 1 ? side - 1 : i;
  };
  return step(y) * side + step(x);
}

/// Place of a direction whose length tells the level.
inline std::int32_t placeIn(float x, float y, float z) {
  const std::int32_t level = levelFor(x * x + y * y + z * z);
  // kLevels by arithmetic: all but the first are alike.
  constexpr auto kFirst = static_cast<std::int32_t>(kLevels[1].first);
  constexpr auto kStep = static_cast<std::int32_t>(kLevels[2].first - kLevels[1].first);
  const std::int32_t side = level == 0 ? kLevels[0].side : kLevels[1].side;
  const std::int32_t first = level == 0 ? 0 : kFirst + (level - 1) * kStep;
  return first + cellIn(side, x, y, z);
}

/// Points evenly spread over a cap.
template <std::size_t kCount>
std::array<Eigen::Vector3f, kCount> capAround(const Eigen::Vector3f& middle, float radius_rad) {
  const float depth = 1.0f - std::cos(radius_rad);
  const Eigen::Vector3f right = middle.unitOrthogonal(), up = middle.cross(right);
  std::array<Eigen::Vector3f, kCount> points;
  for (std::size_t i = 0; i < kCount; ++i) {
    const float cosine = 1.0f - depth * (static_cast<float>(i) + 0.5f) / static_cast<float>(kCount);
    const float sine = std::sqrt(1.0f - cosine * cosine);
    const auto turn = static_cast<float>(kGoldenAngle * static_cast<double>(i));
    points[i] = cosine * middle + sine * (std::cos(turn) * right + std::sin(turn) * up);
  }
  return points;
}

constexpr std::size_t kTaps = 16;   ///< cells of a table that one of the next is made of
constexpr std::size_t kProbes = 8;  ///< patches that tell how much of a cap is open
constexpr float kNarrowest_rad =
    0.12f;  ///< cap that they are looked for in: half a patch, so that none is missed

/// The patch that a direction above the horizon lies in, or kBelow.
std::uint8_t patchOf(const Eigen::Vector3f& towards) {
  if (towards.z() < 0.0f) return SkyPatches::kBelow;
  const auto shares = SkyPatches::around(towards);
  const auto largest =
      std::max_element(shares.begin(), shares.end(),
                       [](const PatchShare& a, const PatchShare& b) { return a.share < b.share; });
  return static_cast<std::uint8_t>(largest->patch);
}

/// What is the same for every sky: which patches and cells belong to each place, and where the patches lie.
struct Places {
  std::array<bool, kPlaces> below;
  /// For a place of any table but the first those in the table before it that it is the mean of.
  std::array<std::array<std::uint16_t, kTaps>, kPlaces> taps;
  std::array<std::array<std::uint8_t, kProbes>, kPlaces> patches;
  std::array<Eigen::Vector3f, SkyPatches::kAbove> middles;  ///< as long as the patch's solid angle
  std::array<float, SkyPatches::kAbove> solid_angles;
  std::array<Eigen::Vector3f, SkyPatches::kAbove> means;  ///< of its unit vectors
  Places() {
    for (std::size_t level = 0; level < kLevels.size(); ++level) {
      for (std::size_t cell = 0; cell < kLevels[level].cells(); ++cell) fill(level, cell);
    }
    for (int patch = 0; patch < SkyPatches::kAbove; ++patch)
      solid_angles[static_cast<std::size_t>(patch)] = SkyPatches::solidAngle(patch);
    middles.fill(Eigen::Vector3f::Zero());
    const SkyPatches fine(8);
    for (const SkyPatches::Ray& ray : fine.rays()) {
      if (ray.patch < SkyPatches::kAbove)
        middles[static_cast<std::size_t>(ray.patch)] += ray.towards * ray.solid_angle;
    }
    for (std::size_t patch = 0; patch < means.size(); ++patch)
      means[patch] = middles[patch] / solid_angles[patch];
  }

 private:
  void fill(std::size_t level, std::size_t cell) {
    const Eigen::Vector3f towards = directionOf(kLevels[level], cell);
    const std::size_t place = kLevels[level].first + cell;
    below[place] = towards.z() < 0.0f;
    const float radius = kLevels[level].radius_rad;
    const auto probes = capAround<kProbes>(towards, std::max(radius, kNarrowest_rad));
    for (std::size_t i = 0; i < kProbes; ++i) patches[place][i] = patchOf(probes[i]);
    if (level == 0) return;
    // Caps of such a size that with those of the level before they make up those of this one.
    const float before = kLevels[level - 1].radius_rad;
    const auto points = capAround<kTaps>(towards, std::sqrt(radius * radius - before * before));
    for (std::size_t i = 0; i < kTaps; ++i) {
      const Eigen::Vector3f& p = points[i];
      taps[place][i] = static_cast<std::uint16_t>(static_cast<std::int32_t>(kLevels[level - 1].first) +
                                                  cellIn(kLevels[level - 1].side, p.x(), p.y(), p.z()));
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
  static constexpr float kMute = -2.0f;

  OpenPatches(const TransportData& data, const Places& sky, const Surface& surface, float transmission)
      : sky_(sky), normal_(transmission > 0.0f ? surface.shading_normal : bakedNormal(surface)) {
    const LightMesh& mesh = data.mesh;
    // Samples of thin sheets take but part of their light from this side.
    const float scale = surface.light.open / (1.0f - std::min(transmission, 0.9f));
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t node = surface.light.node[k];
      for (std::uint32_t s = mesh.first_share[node]; s < mesh.first_share[node + 1]; ++s) {
        if (count_ == rows_.size()) break;  // a node of more samples than this needs no more of them
        const std::uint32_t sample = mesh.shares[s].sample;
        rows_[count_++] = {data.direct.row(sample), scale * surface.light.weight[k] * mesh.shares[s].weight *
                                                        data.direct.scales[sample]};
      }
    }
  }

  /// 0 … 1, or kMute where the surface's samples don't tell.
  float of(std::uint8_t patch) {
    std::uint64_t& known = known_[patch / 64];
    const std::uint64_t bit = std::uint64_t{1} << patch % 64;
    if ((known & bit) == 0) {
      known |= bit;
      open_[patch] = find(patch);
    }
    return open_[patch];
  }
  /// What a direction below the horizon counts: on level ground nothing, as no part of a lobe lies there.
  float sideways() const { return 1.0f - std::abs(normal_.z()); }

 private:
  struct Row {
    const std::uint8_t* values;
    float weight;
  };

  /// The samples' own: as in the bake, normals of the file count where they are sensible.
  static const Eigen::Vector3f& bakedNormal(const Surface& surface) {
    constexpr float kSensible = 0.7f;
    return surface.shading_normal.dot(surface.geometric_normal) < kSensible ? surface.geometric_normal
                                                                            : surface.shading_normal;
  }

  float find(std::uint8_t patch) const {
    const float whole = normal_.dot(sky_.middles[patch]);
    // A patch that the surface's own plane cuts says little.
    if (whole < 0.02f * sky_.solid_angles[patch]) return kMute;
    float sum = 0.0f;
    for (std::size_t i = 0; i < count_; ++i)
      sum += rows_[i].weight * static_cast<float>(rows_[i].values[patch]);
    return std::min(sum / whole, 1.0f);
  }

  const Places& sky_;
  Eigen::Vector3f normal_;
  std::array<Row, 24> rows_;
  std::size_t count_ = 0;
  std::array<std::uint64_t, 3> known_{};  ///< one bit a patch
  std::array<float, SkyPatches::kAbove> open_;
};

/// Part of a lobe as far as it is open: how much of it, and towards where.
struct OpenPart {
  float share = 0.0f;
  Eigen::Vector3f towards;  ///< as MirrorLobe::towards
};

/// What is hidden is often the brightest: the sky above the horizon. So the open rest of a part has its own
/// direction.
OpenPart openPart(const Places& sky, std::uint16_t place, const Eigen::Vector3f& towards, OpenPatches* open) {
  Eigen::Vector3f all = Eigen::Vector3f::Zero(), seen = Eigen::Vector3f::Zero();
  float count = 0.0f, above = 0.0f, sum = 0.0f;
  for (const std::uint8_t patch : sky.patches[place]) {
    if (patch == SkyPatches::kBelow) {
      count += open->sideways();
      continue;
    }
    const float share = open->of(patch);
    if (share == OpenPatches::kMute) continue;
    count += 1.0f;
    all += sky.means[patch];
    seen += share * sky.means[patch];
    above += 1.0f;
    sum += share;
  }
  if (!(sum > 0.0f)) return {0.0f, towards};
  return {sum / count, towards + seen / sum - all / above};
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

/// placeIn() of all of them at once.
std::array<std::uint16_t, MirrorView::kParts> placesOf(const Parts& parts) {
  constexpr std::size_t kCount = MirrorView::kParts;
  std::array<float, kCount> x, y, z;
  for (std::size_t k = 0; k < kCount; ++k) {
    x[k] = parts[k].x();
    y[k] = parts[k].y();
    z[k] = parts[k].z();
  }
  std::array<std::int32_t, kCount> place;
  for (std::size_t k = 0; k < kCount; ++k) place[k] = placeIn(x[k], y[k], z[k]);
  std::array<std::uint16_t, kCount> places;
  for (std::size_t k = 0; k < kCount; ++k) places[k] = static_cast<std::uint16_t>(place[k]);
  return places;
}

void findView(const TransportData& data, const scene::Material& material, Surface* surface) {
  const Places& sky = places();
  OpenPatches open(data, sky, *surface, material.transmission);
  // Leaves mirror little, each elsewhere than its neighbour, and hide the sky by chance: one patch says as
  // much about them as several.
  const bool coarse = material.transmission > 0.0f;
  Parts parts = partsOf(*surface, material.roughness);
  std::array<float, MirrorView::kParts> shares;
  const auto looked = placesOf(parts);
  for (std::size_t k = 0; k < parts.size(); ++k) {
    if (coarse) {
      const std::uint8_t patch = sky.patches[looked[k]][0];
      shares[k] = patch == SkyPatches::kBelow ? 0.0f : std::max(0.0f, open.of(patch));
    } else if (surface->geometric_normal.dot(parts[k]) <= 0.0f) {
      shares[k] = 1.0f;
      parts[k] = -Eigen::Vector3f::UnitZ();  // into the surface itself: nothing is seen, as of no sky
    } else {
      const OpenPart part = openPart(sky, looked[k], parts[k], &open);
      shares[k] = part.share;
      parts[k] = part.towards;
    }
  }
  surface->mirror.place = coarse ? looked : placesOf(parts);
  for (std::size_t k = 0; k < parts.size(); ++k)
    surface->mirror.open[k] = static_cast<std::uint8_t>(255.0f * std::min(shares[k], 1.0f) + 0.5f);
}

bool mirrorAlike(const Surface& a, const Surface& b) {
  constexpr float kSameNormalCosine = 0.9995f;  // 1.8°: the mirror turns by twice that
  constexpr float kSameViewCosine = 0.9995f;
  return a.material == b.material && a.shading_normal.dot(b.shading_normal) > kSameNormalCosine &&
         a.to_eye.dot(b.to_eye) > kSameViewCosine;
}

}  // namespace

MirrorSky::MirrorSky(const sky::Daylight& day) : table_(kPlaces, Eigen::Array4f::Zero()) {
  const Places& sky = places();
  tbb::parallel_for(std::size_t{0}, kLevels[0].cells(), [&](std::size_t place) {
    if (sky.below[place]) return;
    const Eigen::Array3f light = day.skyLuminance(directionOf(kLevels[0], place)).value;
    table_[place] = Eigen::Array4f(light[0], light[1], light[2], 0.0f);
  });
  for (std::size_t level = 1; level < kLevels.size(); ++level) {
    tbb::parallel_for(std::size_t{0}, kLevels[level].cells(), [&](std::size_t cell) {
      const std::size_t place = kLevels[level].first + cell;
      if (sky.below[place]) return;
      Eigen::Array4f sum = Eigen::Array4f::Zero();
      float above = 0.0f;
      for (const std::uint16_t tap : sky.taps[place]) {
        if (sky.below[tap]) continue;
        sum += table_[tap];
        above += 1.0f;
      }
      if (above > 0.0f) table_[place] = sum / above;
    });
  }
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
      findView(data, scene.materials[static_cast<std::size_t>(surface.material)], &surface);
      like = &surface;
    }
  }
}

}  // namespace sunlit::light
