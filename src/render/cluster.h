/// Samples of a pixel that are shaded together.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <cstdint>

#include "render/seen_triangle.h"

namespace sunlit::render {

inline constexpr float kSameNormalCosine =
    0.985f;  ///< 10°: shading changes by little more than its cosine, 1.5 %
inline constexpr float kSameDepthRatio = 0.1f;
inline constexpr std::size_t kMostSamples = 16;  ///< of a pixel

/// What some samples of a pixel see of one triangle.
struct Seeing {
  std::uint32_t triangle;
  std::int32_t material;
  Eigen::Vector3f geometric_normal, shading_normal;
  Eigen::Array3f albedo;
  float depth;             ///< of the first sample
  float footprint = 0.0f;  ///< of one sample, longer side, m; of materials with detail
  float shorter_m = 0.0f;  ///< likewise
  std::uint32_t samples = 0;
  bool mapped = false;
  Finish finish;                     ///< of materials with maps
  const Eigen::Vector3f* relatives;  ///< where its samples are: to the camera, along the axes of `map`
};

/// Alike parts of a pixel.
struct Cluster {
  Seeing first;
  Eigen::Vector3f shading_normal;  ///< sum over the samples, and later unit
  Eigen::Array3f albedo;           ///< sum over the samples
  Finish finish;                   ///< sum over the samples, of materials with maps
  bool mapped = false;
  /// Sum over the samples of what is seen of them; where anything is seen through.
  Eigen::Array3f unveiled = Eigen::Array3f::Zero();
  std::uint32_t samples = 0;
  std::array<Eigen::Vector3f, kMostSamples> relatives;

  bool alike(const Seeing& s) const {
    return s.material == first.material &&
           s.geometric_normal.dot(first.geometric_normal) > kSameNormalCosine &&
           s.shading_normal.dot(first.shading_normal) > kSameNormalCosine &&
           std::abs(s.depth - first.depth) < kSameDepthRatio * first.depth;
  }
  void start(const Seeing& s) {
    first = s;
    shading_normal.setZero();
    albedo.setZero();
    if (s.mapped) finish = Finish();
    mapped = s.mapped;
    unveiled.setZero();
    samples = 0;
    add(s);
  }
  void add(const Seeing& s) {
    shading_normal += static_cast<float>(s.samples) * s.shading_normal;
    albedo += static_cast<float>(s.samples) * s.albedo;
    if (mapped) finish.add(static_cast<float>(s.samples), s.finish);
    for (std::uint32_t i = 0; i < s.samples; ++i) relatives[samples++] = s.relatives[i];
  }
};

/// The triangles that were looked at last.
class TriangleCache {
 public:
  void forget() { numbers_.fill(kNone); }
  const SeenTriangle& at(const Seen& seen, std::uint32_t number) {
    const std::size_t slot = number % kSlots;
    if (numbers_[slot] != number) {
      numbers_[slot] = number;
      triangles_[slot] = SeenTriangle(seen, number);
    }
    return triangles_[slot];
  }

 private:
  static constexpr std::size_t kSlots = 64;
  static constexpr std::uint32_t kNone = 0xffffffffu;
  std::array<std::uint32_t, kSlots> numbers_;
  std::array<SeenTriangle, kSlots> triangles_;
};

}  // namespace sunlit::render
