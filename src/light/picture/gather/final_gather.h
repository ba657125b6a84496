/// Looks closer at the sky where the bake is too coarse: final gathering.
#pragma once

#include <cstddef>
#include <memory>

#include "light/picture/outlook/outlook.h"
#include "sunlit/light/geometry.h"
#include "sunlit/light/surfaces.h"
#include "sunlit/light/visibility.h"

namespace sunlit::light {

/// Baked light is kept at nodes, some decimetres apart. Leaves, twigs, wires and blades of grass shade each
/// other within centimetres, so each of their surfaces that a camera sees looks closer at which of the sky is
/// open: by rays from nodes of a grid on its triangle, about as far apart as the picture's pixels. What nodes
/// found is kept for the next poses, which see most of them again. Large triangles are left to the bake,
/// which is as good there.
///
/// What surfaces pass on still comes from the bake. What is open hangs on triangles alone, so that one serves
/// all states of their surfaces, and all cameras.
class FinalGather {
 public:
  /// Keeps all that it is given. `rays_per_patch`, 1 … PicturePreparer::kMostRays: of each of the sky's 175
  /// patches, from each node of the grids; a surface lies between three nodes, which aim at different points
  /// of a patch.
  FinalGather(std::shared_ptr<const Geometry> geometry, std::shared_ptr<const Visibility> visibility,
              int rays_per_patch);
  ~FinalGather();
  FinalGather(const FinalGather&) = delete;
  FinalGather& operator=(const FinalGather&) = delete;

  /// Sets TileOutlooks::gathered, and Outlook::gathered of leaves and of surfaces on triangles up to half as
  /// large as a square of 2 m, where Outlook::light is known. Parallel; the same bits for any number of
  /// threads and whatever was looked at before. One thread after another, however many call.
  void look(const Surfaces& surfaces, Outlooks* outlooks);

  /// Whether one of `geometry`, with so many rays, would find the same.
  bool finds(const Geometry& geometry, int rays_per_patch) const;

  /// Nodes that the last look() needed, those of them that it had to cast rays for, and these rays.
  std::size_t nodesSeen() const;
  std::size_t nodesCast() const;
  std::size_t raysCast() const;
  /// Nodes that are kept, some 220 bytes each: at most six times those of the largest of the last poses.
  std::size_t nodesKept() const;

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace sunlit::light
