/// A texture that says something else than what is solid, at all its sizes.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "render/texture_area.h"
#include "sunlit/scene/scene.h"

namespace sunlit::render {

class MapPyramid {
 public:
  /// What its texels mean.
  enum class Kind {
    kData,     ///< four linear numbers
    kColor,    ///< colour, averaged in linear light
    kNormals,  ///< x, y, z: unit vectors, whose means are the shorter the more they differ
  };
  MapPyramid(const scene::Texture& texture, Kind kind);

  Eigen::Array2f size() const { return size_; }

  /// The mean over an area: 0 … 1, of normals −1 … 1.
  Eigen::Array4f mean(const TextureArea& area) const;
  /// About one place, in the size nearest to `level`.
  Eigen::Array4f at(const Eigen::Array2f& at, float level) const;

 private:
  struct Level {
    int width, height;
    std::vector<std::uint16_t> texels;  ///< four a texel, 65535 for 1; of normals (n + 1) / 2
  };
  static Level halved(const Level& larger);
  Eigen::Array4f texel(const Level& level, int x, int y) const;
  Eigen::Array4f bilinear(const Level& level, const Eigen::Array2f& at) const;

  std::vector<Level> levels_;
  Eigen::Array2f size_;
  scene::Wrap wrap_u_, wrap_v_;
  Kind kind_;
};

}  // namespace sunlit::render
