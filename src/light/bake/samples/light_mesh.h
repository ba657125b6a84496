/// Where on the scene's triangles the bake has light, and between which of its places it is interpolated.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <cstring>
#include <functional>
#include <vector>

#include "sunlit/image/kept_array.h"

namespace sunlit::light {

/// Places on the scene's triangles. Each side of a triangle that can be lit has a tree of cells: the
/// triangle, halved again and again at its longest edge, and cut along walls at last. At the corners of the
/// leaves lie nodes, between which light is interpolated; a node's light is that of one or several samples.
struct LightMesh {
  static constexpr std::uint32_t kNone = 0xffffffffu;
  static constexpr std::uint32_t kSealed = 0xfffffffeu;
  static constexpr std::uint32_t kInner = 0x80000000u;

  /// Leaf: three nodes. Inner cell: kInner | first of its two children, which edge was divided (0 … 2, from
  /// that corner to the next), and the bits of the share of it that lies before the dividing point; 0: half.
  struct Cell {
    std::array<std::uint32_t, 3> corner;

    /// Into (from, point, apex) and (point, to, apex); `share` above 0 and below 1.
    static Cell divided(std::uint32_t child, std::size_t edge, float share) {
      Cell cell{{kInner | child, static_cast<std::uint32_t>(edge), 0}};
      if (share != 0.5f) std::memcpy(&cell.corner[2], &share, sizeof share);
      return cell;
    }
    bool inner() const { return (corner[0] & kInner) != 0; }
    std::uint32_t child() const { return corner[0] & ~kInner; }
    std::uint32_t edge() const { return corner[1]; }
    bool halved() const { return corner[2] == 0; }
    float share() const {
      float share = 0.5f;
      if (!halved()) std::memcpy(&share, &corner[2], sizeof share);
      return share;
    }
    /// Where its edge is divided, whose ends are these.
    Eigen::Vector3f point(const Eigen::Vector3f& from, const Eigen::Vector3f& to) const {
      return from + share() * (to - from);
    }
  };
  struct Share {
    std::uint32_t sample;
    float weight;
  };

  /// Of each triangle's front and back: a cell; kNone, if nobody sees it or it sees but the void; kSealed, if
  /// it lies within a closed body, where it is dark.
  image::KeptArray<std::array<std::uint32_t, 2>> roots;
  image::KeptArray<Cell> cells;
  image::KeptArray<std::uint32_t> first_share;  ///< of each node, and the end
  image::KeptArray<Share> shares;               ///< weights of a node sum to 1

  static bool isCell(std::uint32_t root) { return root < kSealed; }
  std::size_t nodeCount() const { return first_share.size() - 1; }

  /// Three nodes and their weights.
  struct Place {
    std::array<std::uint32_t, 3> node;
    std::array<float, 3> weight;
  };
  /// Of a point within the leaf tree of `root`, given by its barycentric coordinates.
  Place locate(std::uint32_t root, std::array<float, 3> barycentric) const;

  /// Whether a sample of no use had better not be as another one.
  using Parted = std::function<bool(std::uint32_t useless, std::uint32_t other)>;
  /// Of each node, the sample that counts most in it among those that are of use; where there is none, that
  /// of the nearest nodes that have one, over a few cells: if any, one that it is not parted from; kNone
  /// beyond.
  std::vector<std::uint32_t> usefulSamples(const std::vector<bool>& useless, const Parted& parted) const;
  /// Takes samples that are of no use out of nodes; those left with none get that of usefulSamples().
  void drop(const std::vector<bool>& useless, const std::vector<std::uint32_t>& useful);
};

}  // namespace sunlit::light
