/// Triangles on their way from the scene to the samples of a picture.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "render/texture_pyramid.h"
#include "render/view.h"
#include "sunlit/light/geometry.h"

namespace sunlit::render {

/// A linear function of the sample's column and row.
struct Linear {
  double at_origin = 0.0, per_column = 0.0, per_row = 0.0;
  double operator()(double column, double row) const {
    return at_origin + per_column * column + per_row * row;
  }
};

/// Where a masked triangle shows its texture: coordinate = eye + depth · per_depth.
struct MaskPlanes {
  const TexturePyramid* texture = nullptr;
  float u_eye = 0.0f, v_eye = 0.0f;
  Linear u_per_depth, v_per_depth;
};

/// A triangle, or what clipping left of one, in units of samples; sample (column, row) lies at whole numbers.
struct ScreenTriangle {
  static constexpr int kSteps = 256;  ///< places a sample and axis that corners are rounded to
  /// Samples beyond the picture that corners may lie: so few that nearness at the corners is not much greater
  /// than what is seen, of which single precision would lose the digits; more than what rounding moves them.
  /// Products of two coordinates in steps stay exact in double precision.
  static constexpr int kReach = 16;
  static constexpr std::int32_t kNoMask = -1;

  std::array<std::int32_t, 3> x, y;         ///< corners, in steps; x to y turns from right to down
  int left, right, top, bottom;             ///< the samples, inclusive, that it may cover; within the picture
  std::uint32_t number;                     ///< of the triangle, plus 1
  std::int32_t mask = kNoMask;              ///< index into ScreenTriangles::masks
  float nearness_least, nearness_greatest;  ///< of its corners, 1/m
  Linear nearness;                          ///< 1 / depth
};

struct ScreenTriangles {
  std::vector<ScreenTriangle> triangles;
  std::vector<MaskPlanes> masks;
  void clear() {
    triangles.clear();
    masks.clear();
  }
};

/// Projects triangles, leaves out those that no sample can see, and clips those that reach behind the camera.
class ScreenProjection {
 public:
  explicit ScreenProjection(const View& view);

  /// Appends triangles `first` to `first + count` of `geometry`, which all have `material`. The first
  /// triangle of `geometry` has number `first_number`.
  struct Batch {
    const light::Geometry& geometry;
    std::uint32_t first, count;
    const scene::Material& material;
    std::uint32_t first_number;
    const TexturePyramid* texture;  ///< of the material; null if it has none
  };
  void append(const Batch& batch, ScreenTriangles* triangles) const;

 private:
  using Polygon = std::vector<Eigen::Vector3f>;

  Eigen::Vector3f toScreen(const Eigen::Vector3f& position) const;
  void appendClipped(const std::array<Eigen::Vector3f, 3>& corners, const ScreenTriangle& common,
                     std::vector<ScreenTriangle>* triangles) const;
  bool placeCorners(const std::array<Eigen::Vector3f, 3>& corners, ScreenTriangle* triangle) const;
  Linear alongRays(const Eigen::Vector3d& vector) const;
  MaskPlanes maskPlanes(const Batch& batch, std::uint32_t triangle) const;

  int columns_, rows_;
  float near_m_, far_m_;
  Eigen::Vector3d eye_;
  Eigen::Vector3f eye_high_, eye_low_;  ///< whose sum is the eye
  /// To column · depth, row · depth and depth, from a position counted from the eye.
  Eigen::Matrix3f screen_from_map_;
  Eigen::Vector3d ray_, ray_per_column_, ray_per_row_;  ///< of depth 1 m
};

}  // namespace sunlit::render
