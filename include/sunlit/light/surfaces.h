/// What a camera sees, as geometry finds it: independent of sun and sky, made once per pose. What light makes
/// of it: picture.h.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <vector>

#include "sunlit/light/pixel_rays.h"

namespace sunlit::light {

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
  float film = 0.0f;    ///< share under a film of water, scene::Weathering::Look, 0 … 1
  float cavity = 1.0f;  ///< share of the ambient light that the material's own map of occlusion leaves, 0 … 1
  /// Of its samples' light that it sends, by channel: what is not hidden, or coloured, by what one sees
  /// through.
  Eigen::Array3f share = Eigen::Array3f::Ones();
  /// Of its samples, what part of the light behind it does not come past it, by channel: what lies behind
  /// glass brings the air before the glass along. Else as `share`.
  Eigen::Array3f air_share = Eigen::Array3f::Ones();
  float clearance_m = 0.0f;        ///< how far off its triangle its rays start, along geometric_normal
  std::int32_t material = 0;       ///< index into Scene::materials
  std::uint32_t pixel = 0;         ///< y · width + x
  std::uint32_t first_sample = 0;  ///< into Tile::origin_x …
  /// How many of the pixel's samples see it, > 0; in mirrors, each of its sheets counts.
  std::uint32_t samples = 0;
  std::uint32_t triangle = 0;  ///< one that it lies on: index into Geometry::triangles, beyond them bodies
};

/// A square of neighbouring pixels: the unit of parallel work. Always the same pixels, so that no result
/// depends on the number of threads.
struct Tile {
  int x = 0, y = 0;               ///< top left pixel
  int width = 0, height = 0;      ///< px
  std::vector<Surface> surfaces;  ///< in pixel order
  /// Where each sample's rays start, m in `map`: on the visible side of the triangle, clear of rounding.
  std::vector<float> origin_x, origin_y, origin_z;
  std::vector<std::uint8_t> sky;  ///< samples of each pixel of the tile (row-major) that see no surface
  /// Of each pixel, what part of those samples' sky is seen through what blends; empty: all.
  std::vector<Eigen::Array3f> sky_share;
};

struct Surfaces {
  static constexpr int kTileSize = 16;  ///< px

  int width = 0, height = 0;  ///< px
  int samples_per_pixel = 1;  ///< > 0
  /// Pixel (u, v) looks along pixel_origin + u · pixel_right + v · pixel_down in `map`, of depth 1 m.
  Eigen::Vector3f pixel_origin = Eigen::Vector3f::Zero();
  Eigen::Vector3f pixel_right = Eigen::Vector3f::Zero(), pixel_down = Eigen::Vector3f::Zero();
  Eigen::Vector3f eye = Eigen::Vector3f::Zero();  ///< the camera, m in `map`
  /// Of a lens that bends, along whose rays pixels look; then the three say it of the middle alone. Else
  /// null.
  std::shared_ptr<const PixelRays> bent;
  Eigen::Matrix3d map_from_optical = Eigen::Matrix3d::Identity();  ///< that `bent` is turned by
  std::vector<Tile> tiles;

  /// Where (x, y) looks, unit.
  Eigen::Vector3f towards(float x, float y) const;
};

}  // namespace sunlit::light
