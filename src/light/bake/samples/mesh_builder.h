/// Refines large triangles until light may be interpolated between their nodes.
#pragma once

#include <cstdint>
#include <functional>
#include <unordered_map>
#include <vector>

#include "light/bake/samples/occupancy.h"
#include "light/bake/samples/probe.h"
#include "light/bake/samples/shining_surfaces.h"
#include "light/bake/samples/transport_data.h"
#include "light/bake/samples/triangle_kinds.h"

namespace sunlit::light {

/// A point at which light is wanted, and what is found there on first sight.
struct MeshNode {
  Eigen::Vector3f position;
  Eigen::Vector3f normal;                             ///< unit, on the lit side
  Eigen::Vector3f face;                               ///< Receiver::face
  Eigen::Vector3f inwards = Eigen::Vector3f::Zero();  ///< sum of unit vectors to middles of cells around
  int cells = 0;                                      ///< how many
  float reach_m = 0.0f;                               ///< harmonic mean distance of what is seen
  float nearest_m = 0.0f;                             ///< the closest of it that is not as level as the place
  /// Share of an even sphere's light, by cosine, that nothing hides; before it, times its mean direction.
  Eigen::Vector4f open = Eigen::Vector4f::Zero();
  float shone_lx = 0.0f;   ///< by surfaces that shine
  float shining_m = 1e9f;  ///< how far off those are, as ShiningSurfaces tells
  bool valid = true;       ///< not where no camera looks

  Receiver receiver() const;
};

/// Nodes of equal place, similar normal and the same face are one.
class NodeIndex {
 public:
  /// Index of the node at `position`, made if there is none yet, of a surface with normal `face` that is
  /// shaded by `normal`, both unit.
  std::uint32_t at(const Eigen::Vector3f& position, const Eigen::Vector3f& normal,
                   const Eigen::Vector3f& face);
  std::vector<MeshNode> nodes;

 private:
  std::unordered_map<std::uint64_t, std::uint32_t> first_;  ///< by place
  std::vector<std::uint32_t> next_;                         ///< of the same place
};

struct RefineLimits {
  float finest_m;     ///< longest edge of a cell where light changes fastest
  std::size_t nodes;  ///< at most about as many where a camera may look
};

/// What a bake works on.
struct BakeScene {
  const Geometry& geometry;
  const BakeRays& rays;
  const std::vector<TriangleTraits>& traits;
};

class MeshBuilder {
 public:
  /// Keeps references.
  MeshBuilder(const BakeScene& scene, const ShiningSurfaces& shining);

  /// `progress` gets the share done, 0 … 1, about.
  void refine(const RefineLimits& limits, const std::function<void(double)>& progress);

  /// Cells and roots; roots of other than large triangles are no cells.
  LightMesh mesh;
  NodeIndex index;
  /// For each node the ends of the undivided edge that it lies in the middle of, or kNone.
  std::vector<std::array<std::uint32_t, 2>> hangs_between;

 private:
  /// Where cells that need halving are looked for.
  enum class Pass {
    kVaried,  ///< the first: where light differs between the corners
    kAll      ///< the second: everywhere else
  };
  struct Split {
    std::uint32_t cell;
    float urgency;
  };
  void plant(std::uint32_t triangle, int side);
  void addLeaf(std::uint32_t cell);
  void lookAround();
  float variation(const LightMesh::Cell& cell) const;
  float shoneUnevenly(const LightMesh::Cell& cell) const;
  float urgency(const LightMesh::Cell& cell, float finest_m, Pass pass) const;
  void halveMostUrgent(const RefineLimits& limits, Pass pass);
  bool cut(const LightMesh::Cell& cell, float finest_m) const;
  void split(std::uint32_t cell);
  std::uint32_t middle(std::uint32_t a, std::uint32_t b);
  void hang(std::uint32_t a, std::uint32_t b);
  void findHanging();

  const Geometry& geometry_;
  const BakeRays& rays_;
  const std::vector<TriangleTraits>& traits_;
  const ShiningSurfaces& shining_;
  Occupancy occupied_;
  std::vector<SkyPatches::Ray> directions_;                   ///< in which nodes look around
  std::unordered_map<std::uint64_t, std::uint32_t> middles_;  ///< of halved edges
  std::vector<std::uint32_t> active_;                         ///< leaves that may still be halved
  std::vector<std::uint32_t> left_;  ///< leaves that were not halved in the first pass
  std::size_t looked_ = 0;           ///< how many nodes have looked around
  std::size_t valid_ = 0;            ///< how many of those that have looked around a camera may see
};

}  // namespace sunlit::light
