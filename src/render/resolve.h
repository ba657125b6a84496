/// From the geometry buffer to surfaces that can be lit, and to depth.
#pragma once

#include <vector>

#include "render/packed_sample.h"
#include "render/view.h"
#include "sunlit/image/images.h"
#include "sunlit/light/geometry.h"
#include "sunlit/light/surfaces.h"
#include "sunlit/light/visibility.h"

namespace sunlit::render {

/// A geometry buffer with what it was drawn from.
struct Seen {
  const View& view;
  const light::Geometry& geometry;
  const std::vector<PackedSample>& samples;

  const PackedSample& sample(int column, int row) const {
    return samples[static_cast<std::size_t>(row) *
                       static_cast<std::size_t>(view.camera.width * view.supersampling) +
                   static_cast<std::size_t>(column)];
  }
};

/// Depth along `ray` (see View::ray) at which it meets the plane of `triangle`; not finite if it runs within
/// it.
double planeDepth(const Seen& seen, std::uint32_t triangle, const Eigen::Vector3d& ray);

/// Samples of a pixel that look alike become one surface. Reuses the memory of `surfaces`.
void resolveSurfaces(const Seen& seen, light::Surfaces* surfaces);

/// Depth at the pixel centres, where no sample lies if supersampling is even: of the nearest triangle among
/// those that the pixel's samples see and that contains the centre; if none does, of what a ray through the
/// centre meets first.
image::DepthImage resolveDepth(const Seen& seen, const light::Visibility& visibility);

}  // namespace sunlit::render
