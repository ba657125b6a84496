/// What a camera sees, ready to be lit: independent of sun and sky, made once per pose.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <memory>
#include <variant>
#include <vector>

namespace sunlit::light {

/// Where a surface finds its sky light and bounced light: the weighted mean of three nodes of the Transport.
struct LightPlace {
  static constexpr std::uint32_t kNowhere = 0xffffffffu;
  std::array<std::uint32_t, 3> node = {kNowhere, kNowhere, kNowhere};  ///< all or none kNowhere
  std::array<float, 3> weight = {1.0f, 0.0f, 0.0f};                    ///< sum 1; 0 in a closed body

  bool known() const { return node[0] != kNowhere; }
};

/// How much of the sky a point sees, by sectors of it: for leaves, which differ within less than the distance
/// of nodes.
struct SkyOpenness {
  static constexpr std::size_t kSectors = 24;    ///< SkySectors tells where they lie
  std::array<std::uint8_t, kSectors> open = {};  ///< share that is not hidden, 255 for all
  bool known = false;                            ///< else the nodes tell
  /// Where it is on its triangle: barycentric coordinates, for those who ask by finer parts of the sky.
  std::array<float, 3> within = {};
};

/// How much of each patch of the sky is seen where FinalGather looked, or between such places.
struct GatheredSky {
  static constexpr std::size_t kPatches = 176;   ///< SkyPatches tells where they lie
  std::array<std::uint8_t, kPatches> open = {};  ///< 255 for all; of a patch that the surface's own plane
                                                 ///< cuts, of the part before it
};

/// What a smooth surface mirrors: parts of its lobe of equal weight, each about one direction.
struct SmoothMirror {
  static constexpr std::size_t kParts = 16;
  std::array<std::uint16_t, kParts> place = {};  ///< the direction, as an index into MirrorSky
  std::array<std::uint8_t, kParts> open = {};    ///< how much of the sky there is not hidden, 255 for all
  float hidden_below = 0.0f;                     ///< share of the lobe that is hidden and below the horizon
};

/// What a rough surface mirrors: how much of its lobe looks at each patch of the sky.
struct RoughMirror {
  static constexpr std::size_t kPatches = 176;  ///< SkyPatches tells where they lie
  std::array<std::uint8_t, kPatches> share =
      {};  ///< of the lobe, in parts of `scale`, where nothing hides it
  float scale = 0.0f;
  /// Share of the lobe that other surfaces hide, 0 … 1: of those above the horizon and those below.
  float hidden_above = 0.0f, hidden_below = 0.0f;
};

/// What a surface mirrors.
using Mirror = std::variant<SmoothMirror, RoughMirror>;

/// How far off its triangle a ray starts, m, at `position` in `map` and `distance_m` from where it is seen:
/// above what single precision does to the point and to the distance that a ray query computes, and well
/// below what could let light through a wall.
inline float rayClearance_m(const Eigen::Vector3f& position, float distance_m) {
  return 2e-4f + 5e-7f * position.cwiseAbs().maxCoeff() + 1e-6f * distance_m;
}

/// One surface within one pixel: the part of the pixel's samples that look alike, and are shaded together.
struct Surface {
  Eigen::Vector3f position;          ///< mean of its samples, m in `map`
  Eigen::Vector3f to_eye;            ///< unit vector from there to the camera
  Eigen::Vector3f geometric_normal;  ///< unit, of the triangle, on the side of the camera
  Eigen::Vector3f shading_normal;    ///< unit, interpolated, in the hemisphere of geometric_normal
  Eigen::Array3f albedo;             ///< linear base colour, 0 … 1
  Eigen::Array3f emission = Eigen::Array3f::Zero();  ///< luminance of its own, cd/m²
  float roughness = 1.0f;                            ///< perceptual, scene::Material::kSmoothest … 1
  float metalness = 0.0f;                            ///< 0 … 1
  float cavity = 1.0f;  ///< share of the ambient light that the material's own map of occlusion leaves, 0 … 1
  /// Of its samples' light that it sends, by channel: what is not hidden, or coloured, by what one sees
  /// through.
  Eigen::Array3f share = Eigen::Array3f::Ones();
  float clearance_m = 0.0f;        ///< how far off its triangle its rays start, along geometric_normal
  std::int32_t material = 0;       ///< index into Scene::materials
  std::uint32_t pixel = 0;         ///< y · width + x
  std::uint32_t first_sample = 0;  ///< into Tile::origin_x …
  std::uint32_t samples = 0;       ///< how many of the pixel's samples see it, > 0
  std::uint32_t triangle = 0;  ///< one that it lies on: index into Geometry::triangles, beyond them bodies
  std::uint16_t mirror = 0;    ///< what it mirrors: index into Tile::mirrors, where `light` is known
  LightPlace light;            ///< set by Transport::locate()
  LightPlace behind;           ///< of the other side of a thin sheet; set by Transport::locate()
  SkyOpenness sky;             ///< of leaves; set by Transport::locate()
  static constexpr std::uint32_t kNotGathered = 0xffffffffu;
  std::uint32_t gathered = kNotGathered;  ///< index into Tile::gathered; set by FinalGather
  static constexpr std::int32_t kNoBody = -1;
  std::int32_t body = kNoBody;  ///< that moves, which it belongs to; set by BodyLight::hide()
  float unhidden = 1.0f;  ///< share of the light from all around that bodies leave to it; 0 … 1, as above
};

/// A square of neighbouring pixels: the unit of parallel work. Always the same pixels, so that no result
/// depends on the number of threads.
struct Tile {
  int x = 0, y = 0;               ///< top left pixel
  int width = 0, height = 0;      ///< px
  std::vector<Surface> surfaces;  ///< in pixel order
  /// Where each sample's rays start, m in `map`: on the visible side of the triangle, clear of rounding.
  std::vector<float> origin_x, origin_y, origin_z;
  std::vector<Mirror> mirrors;        ///< of its surfaces; set by Transport::locate()
  std::vector<GatheredSky> gathered;  ///< of its surfaces; empty unless FinalGather set it
  std::vector<std::uint8_t> sky;      ///< samples of each pixel of the tile (row-major) that see no surface
  /// Of each pixel, what part of those samples' sky is seen through what blends; empty: all.
  std::vector<Eigen::Array3f> sky_share;

  /// What was gathered for one of `surfaces`; null: nothing.
  const GatheredSky* gatheredFor(const Surface& surface) const {
    return surface.gathered == Surface::kNotGathered ? nullptr : &gathered[surface.gathered];
  }
};

class LightTable;
struct Reflections;

struct Surfaces {
  static constexpr int kTileSize = 16;  ///< px

  int width = 0, height = 0;  ///< px
  int samples_per_pixel = 1;  ///< > 0
  /// Pixel (u, v) looks along pixel_origin + u · pixel_right + v · pixel_down in `map`, of depth 1 m.
  Eigen::Vector3f pixel_origin, pixel_right, pixel_down;
  Eigen::Vector3f eye = Eigen::Vector3f::Zero();  ///< the camera, m in `map`
  std::vector<Tile> tiles;
  std::shared_ptr<const Reflections> reflections;  ///< what smooth ones mirror; set by reflect(); null: none
  std::shared_ptr<const LightTable> table;         ///< set by prepare(); null: made anew for each light
};

}  // namespace sunlit::light
