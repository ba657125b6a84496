/// Places on a scene's surfaces at which light is wanted.
#pragma once

#include <cstdint>
#include <unordered_map>
#include <vector>

#include "light/bake/samples/probe.h"
#include "light/bake/samples/transport_data.h"

namespace sunlit::light {

/// Nodes so near to a sheet lie on it, and are on either side of it: see SheetSides.
constexpr float kOnIt_m = 1e-3f;

/// A point at which light is wanted, and what is found there on first sight.
struct MeshNode {
  Eigen::Vector3f position;
  Eigen::Vector3f normal;                             ///< unit, on the lit side
  Eigen::Vector3f face;                               ///< Receiver::face
  Eigen::Vector3f inwards = Eigen::Vector3f::Zero();  ///< sum of vectors to middles of cells around
  float pulled = 0.0f;                                ///< sum of their lengths
  Eigen::Vector3f aside = Eigen::Vector3f::Zero();    ///< off a sheet that it stands on, if any
  float room_m = 1e9f;                                ///< on that way, up to a wall
  float reach_m = 0.0f;                               ///< harmonic mean distance of what is seen
  float nearest_m = 0.0f;                             ///< the closest of it that is not as level as the place
  /// Share of an even sphere's light, by cosine, that nothing hides; before it, times its mean direction.
  Eigen::Vector4f open = Eigen::Vector4f::Zero();
  float shone_lx = 0.0f;  ///< by surfaces that are bright
  float bright_m = 1e9f;  ///< how far off those are, as AreaLights tells
  bool valid = true;      ///< not where no camera looks

  /// A cell that it is a corner of has its middle there. `counts`: the length of the vector to it.
  void pullTowards(const Eigen::Vector3f& middle, float counts = 1.0f);
  /// Forgets the cells around.
  void pullNoMore();
  Receiver receiver() const;
  /// A little over bumps of the ground, where walls are looked for.
  Eigen::Vector3f aboveBumps() const;
  /// Of the surface, whatever it is shaded by.
  const Eigen::Vector3f& flat() const { return face.isZero() ? normal : face; }
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

/// Of a leaf: the mean of its corners.
Eigen::Vector3f middleOf(const LightMesh::Cell& leaf, const std::vector<MeshNode>& nodes);
float longestEdge(const LightMesh::Cell& leaf, const std::vector<MeshNode>& nodes);
/// Whether anything is near enough to stand on a leaf, as far as its corners see.
bool mayCarry(const LightMesh::Cell& leaf, const std::vector<MeshNode>& nodes);

/// A leaf and one of its corners; in order of the nodes.
struct CellAround {
  std::uint32_t node, cell;
  bool operator<(const CellAround& other) const {
    return node != other.node ? node < other.node : cell < other.cell;
  }
};

}  // namespace sunlit::light
