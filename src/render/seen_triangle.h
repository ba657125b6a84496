/// A triangle as a camera at one place sees it.
#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "render/resolve.h"

namespace sunlit::render {

/// How far the point seen moves on the triangle's plane from one sample to the next, m. Seen exactly from the
/// side it is not finite.
struct Footprint {
  Eigen::Vector3f right, down;
};

/// Points are counted from the camera, along the axes of `map`.
class SeenTriangle {
 public:
  SeenTriangle() = default;
  SeenTriangle(const Seen& seen, std::uint32_t number);

  std::int32_t material() const { return material_; }
  /// Towards the camera.
  const Eigen::Vector3f& geometricNormal() const { return normal_; }

  /// Shares of the second and the third corner.
  Eigen::Array2f sharesAt(const Eigen::Vector3f& point) const;
  /// Unit, in the hemisphere of geometricNormal(): files get the side of normals wrong, and the side that is
  /// seen is the one to light.
  Eigen::Vector3f shadingNormal(const Eigen::Array2f& shares) const {
    return flat_ ? flat_normal_
                 : normalFrom((1.0f - shares.sum()) * normal_a_ + shares[0] * normal_b_ +
                              shares[1] * normal_c_);
  }
  /// `right` and `down` lead to the neighbouring samples at depth 1 m.
  Footprint footprint(const Eigen::Vector3f& point, float depth, const Eigen::Vector3f& right,
                      const Eigen::Vector3f& down) const;
  /// Linear, 0 … 1: the mean over the area that `step`, such as a footprint, spans. What is `small`, as the
  /// quarter of a pixel, is looked up in one size of the texture, not between two.
  Eigen::Array3f albedo(const Seen& seen, const Eigen::Array2f& shares, const Footprint& step,
                        bool small) const;

  /// Where it is on the textures of a material that has maps: over the area that `step` spans.
  SurfaceMaps::Place placeOnMaps(const Seen& seen, const Eigen::Array2f& shares, const Footprint& step,
                                 bool small) const;
  /// Turns a shading normal as the mean of a map of normals says. Gives the length of that mean, at most 1.
  float mapNormal(const Seen& seen, const Eigen::Array2f& shares, const Eigen::Vector3f& mapped,
                  Eigen::Vector3f* normal) const;

 private:
  /// Of its first corner; of the others less that.
  struct CornerCoordinates {
    bool known = false;
    Eigen::Array2f a = Eigen::Array2f::Zero(), b = Eigen::Array2f::Zero(), c = Eigen::Array2f::Zero();
  };
  CornerCoordinates coordinates(const Seen& seen, int set) const;
  /// To the right of the map of normals; its top is cross(normal of the front, this) · hand.
  Eigen::Vector3f tangent(const Seen& seen, const Eigen::Array2f& shares, float* hand) const;
  Eigen::Vector3f normalFrom(const Eigen::Vector3f& sum) const;

  std::uint32_t number_ = 0;
  std::int32_t material_ = 0;
  bool from_behind_ = false;
  Eigen::Vector3f normal_, corner_;
  Eigen::Vector3f towards_b_, towards_c_;  ///< (point − corner) · these are the shares
  Eigen::Vector3f normal_a_, normal_b_, normal_c_;
  bool flat_ = false;  ///< the same shading normal everywhere
  Eigen::Vector3f flat_normal_;
  Eigen::Array3f color_a_, color_b_, color_c_;  ///< with the material's; b and c less a
  Eigen::Array2f texture_a_, texture_b_, texture_c_;
};

// What every pixel asks for.
inline Eigen::Array2f SeenTriangle::sharesAt(const Eigen::Vector3f& point) const {
  const Eigen::Vector3f from_corner = point - corner_;
  Eigen::Array2f shares(from_corner.dot(towards_b_), from_corner.dot(towards_c_));
  shares = shares.max(0.0f).min(1.0f);  // a sample may lie a rounding error beside it
  const float sum = shares.sum();
  if (sum > 1.0f) shares /= sum;
  return shares;
}

inline Eigen::Vector3f SeenTriangle::normalFrom(const Eigen::Vector3f& sum) const {
  const float length = sum.norm();
  if (!(length > 1e-6f)) return normal_;  // the file gave none
  return sum * ((sum.dot(normal_) < 0.0f ? -1.0f : 1.0f) / length);
}

inline Footprint SeenTriangle::footprint(const Eigen::Vector3f& point, float depth,
                                         const Eigen::Vector3f& right, const Eigen::Vector3f& down) const {
  const Eigen::Vector3f along = point / normal_.dot(point);
  const auto moved = [&](const Eigen::Vector3f& step) {
    const Eigen::Vector3f across = step * depth;
    return Eigen::Vector3f(across - along * normal_.dot(across));
  };
  return {moved(right), moved(down)};
}

}  // namespace sunlit::render
