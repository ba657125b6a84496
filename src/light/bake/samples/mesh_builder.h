/// Refines large triangles until light may be interpolated between their nodes.
#pragma once

#include <cstdint>
#include <unordered_map>
#include <vector>

#include "light/bake/samples/area_lights.h"
#include "light/bake/samples/mesh_nodes.h"
#include "light/bake/samples/occupancy.h"
#include "light/bake/samples/transport_data.h"
#include "light/bake/samples/triangle_kinds.h"
#include "light/bake/samples/work_done.h"

namespace sunlit::light {

struct RefineLimits {
  float finest_m;     ///< longest edge of a cell where light changes fastest
  std::size_t nodes;  ///< at most about as many where a camera may look
};

class MeshBuilder {
 public:
  /// Keeps references.
  MeshBuilder(const BakeScene& scene, const AreaLights& bright);

  void refine(const RefineLimits& limits, const Progress& progress);

  /// Cells and roots; roots of other than large triangles are no cells.
  LightMesh mesh;
  NodeIndex index;
  /// For each node the ends of the undivided edge that it lies in the middle of, or kNone.
  std::vector<std::array<std::uint32_t, 2>> hangs_between;

 private:
  /// What is done of the work, about: once cells are halved, once they are cut at walls, and at sheets.
  static constexpr double kHalved = 0.55, kWalls = 0.7, kCut = 0.75;
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
  void lookAround(const std::vector<std::uint32_t>& nodes);
  void lookAroundAgain(const std::vector<std::uint32_t>& nodes, const Progress& progress);
  void findRoom(const std::uint32_t* from, int count);
  void lookAroundFromNew();
  float variation(const LightMesh::Cell& cell) const;
  float shoneUnevenly(const LightMesh::Cell& cell) const;
  float urgency(const LightMesh::Cell& cell, float finest_m, Pass pass) const;
  void halveMostUrgent(const RefineLimits& limits, Pass pass);
  bool cut(const LightMesh::Cell& cell, float finest_m) const;
  void split(std::uint32_t cell);
  std::uint32_t middle(std::uint32_t a, std::uint32_t b);
  void separateSides(const Progress& progress);
  void pullByOwnCells(const std::vector<std::uint32_t>& nodes);
  void hang(std::uint32_t a, std::uint32_t b, const Eigen::Vector3f& middle);
  bool isBehindASheet(const MeshNode& node, const Eigen::Vector3f& middle) const;
  void findHanging();

  const Geometry& geometry_;
  const BakeRays& rays_;
  const std::vector<TriangleTraits>& traits_;
  const AreaLights& bright_;
  Occupancy occupied_;
  std::vector<SkyPatches::Ray> directions_;                   ///< in which nodes look around
  std::unordered_map<std::uint64_t, std::uint32_t> middles_;  ///< of halved edges
  std::vector<std::uint32_t> active_;                         ///< leaves that may still be halved
  std::vector<std::uint32_t> left_;       ///< leaves that were not halved in the first pass
  std::vector<std::uint32_t> originals_;  ///< of each node: itself, or SheetSides::Side::original
  std::vector<bool> has_sides_;           ///< of each original
  std::size_t looked_ = 0;                ///< how many nodes have looked around
  std::size_t valid_ = 0;                 ///< how many of those that have looked around a camera may see
};

}  // namespace sunlit::light
