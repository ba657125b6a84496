/// Which triangles of a scene get a texture of their own, and where on its pages.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "sunlit/render/baked_looks.h"
#include "sunlit/scene/scene.h"

namespace sunlit::render {

/// One triangle, or two that share an edge and lie in a plane, on a rectangle of texels.
struct Chart {
  std::uint32_t mesh = 0, triangle = 0, count = 1;
  Eigen::Vector3f origin = Eigen::Vector3f::Zero(), right = origin,
                  up = origin;  ///< of its rectangle: unit axes, m in `map`
  Eigen::Array2f extent_m = Eigen::Array2f::Zero();
  double texel_m = 0.0;                          ///< that it is to have
  Eigen::Array2i size = Eigen::Array2i::Ones();  ///< texels, without gutters
  int page = 0, x = 0, y = 0;                    ///< of its gutter's corner

  Eigen::Array2i room = Eigen::Array2i::Ones();  ///< with its gutters and what else is free beside it

  /// Texels at least on each side that go on as the edge does: the smaller sizes of a page that a far camera
  /// sees mix neighbours, the more so the more texels there are to shrink.
  static constexpr int kWidestGutter = 8;
  int gutter() const {
    const int across = size.minCoeff();
    return across >= 128 ? kWidestGutter : across >= 32 ? 4 : 2;
  }
  Eigen::Array2f on(const Eigen::Vector3f& point) const {
    return {(point - origin).dot(right), (point - origin).dot(up)};
  }
  Eigen::Array2f step_m() const { return extent_m / size.cast<float>(); }
};

/// Nothing is cut out of it and nothing seen through it.
bool canBePainted(const scene::Material& material);

/// What becomes of the colours and the detail of a mesh.
enum class Look { kAsItIs, kTinted, kPainted };
Look lookOf(const scene::Mesh& mesh, const scene::Material& material);

/// Those of all meshes that are to be painted, in their order.
std::vector<Chart> chartsOf(const scene::Scene& scene);

/// Width and height of each page, with a place for each of `charts`, whose size is known.
std::vector<Eigen::Array2i> packed(std::vector<Chart>* charts);

}  // namespace sunlit::render
