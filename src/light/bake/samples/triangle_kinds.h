/// What the bake must know about each triangle.
#pragma once

#include <cstdint>
#include <vector>

#include "light/bake/samples/bake_rays.h"
#include "light/bake/samples/work_done.h"
#include "sunlit/light/geometry.h"

namespace sunlit::light {

enum class TriangleKind : std::uint8_t {
  kLarge,    ///< gets a tree of cells of its own
  kSmall,    ///< shares samples with its neighbours
  kFoliage,  ///< small and cut out: shares coarser samples
  kSpray,    ///< a leaf card as large as a twig: what hides it differs from card to card, so each has its own
  kCanopy,   ///< a larger one, of distant trees: likewise
};

inline bool isLeaf(TriangleKind kind) {
  return kind >= TriangleKind::kFoliage;
}

/// By size and material.
TriangleKind triangleKind(const Geometry& geometry, std::uint32_t triangle);

struct TriangleTraits {
  TriangleKind kind = TriangleKind::kLarge;
  bool solid = false;  ///< part of a closed body: whatever sees its back is inside
  /// By side, front first: false where it can't be seen, only faces the void, or is sealed.
  bool used[2] = {true, true};
  /// By side: whether it lies within a closed body.
  bool sealed[2] = {false, false};
};

/// What a bake works on.
struct BakeScene {
  const Geometry& geometry;
  const BakeRays& rays;
  const std::vector<TriangleTraits>& traits;
};

/// Parallel; the same for any number of threads.
std::vector<TriangleTraits> triangleTraits(const Geometry& geometry, const BakeRays& rays,
                                           const Progress& progress = nullptr);

/// Normal of a side: 0 front, 1 back.
inline Eigen::Vector3f sideNormal(const Geometry& geometry, std::uint32_t triangle, int side) {
  const Eigen::Vector3f& front = geometry.planes[triangle].normal;
  return side == 0 ? front : Eigen::Vector3f(-front);
}

}  // namespace sunlit::light
