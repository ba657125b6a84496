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
  /// Looks up the full size in `texture` itself, which must outlive it.
  MapPyramid(const scene::Texture& texture, Kind kind);
  MapPyramid(scene::Texture&&, Kind) = delete;

  Eigen::Array2f size() const { return size_; }

  /// The mean over an area: 0 … 1, of normals −1 … 1.
  Eigen::Array4f mean(const TextureArea& area) const;
  /// About one place, in the size nearest to `level`.
  Eigen::Array4f at(const Eigen::Array2f& at, float level) const;

 private:
  /// A size below the full one: four numbers a texel, 65535 for 1; of normals (n + 1) / 2.
  struct Level {
    int width, height;
    std::vector<std::uint16_t> texels;
  };
  /// As a Level has it, from the bytes of the full size.
  Eigen::Array4f decoded(const std::uint8_t* rgba) const;
  /// About a place in a size whose texel at (column, row) is `texel(column, row)`.
  template <typename Texel>
  Eigen::Array4f bilinear(int width, int height, const Texel& texel, const Eigen::Array2f& at) const;
  /// In size `level`, 0 the full one.
  Eigen::Array4f look(std::size_t level, const Eigen::Array2f& at) const;

  const std::uint8_t* full_;  ///< as scene::Texture
  int width_, height_;        ///< of the full size
  std::vector<Level> smaller_;
  Eigen::Array2f size_;
  scene::Wrap wrap_u_, wrap_v_;
  Kind kind_;
};

}  // namespace sunlit::render
