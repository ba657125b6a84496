/// A texture as the light that surfaces send on knows it.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "sunlit/scene/scene.h"

namespace sunlit::light {

/// A texture averaged over kMost × kMost squares, or as it is along an axis that has fewer texels: linear
/// light, or numbers 0 … 1 of data.
class Thumbnail {
 public:
  static constexpr int kMost = 32;
  enum class Kind {
    kColor,       ///< all of it
    kSolidColor,  ///< where it cuts out or blends: what is solid
    kData,
  };
  /// Keeps a reference.
  Thumbnail(const scene::Texture& texture, Kind kind);

  enum class Grain { kSquares, kTexels };
  /// r g b, and the share of it that is solid, above 0.
  Eigen::Array4f at(const Eigen::Vector2f& uv, Grain grain) const;
  /// Of the whole.
  Eigen::Array2f size(Grain grain) const;

 private:
  const scene::Texture& texture_;
  Kind kind_;
  int width_, height_;
  std::vector<Eigen::Array4f> squares_;
};

}  // namespace sunlit::light
