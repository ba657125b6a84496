/// Shadows within the crown of a tree, or of a few: which of their leaves light from afar reaches.
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "light/geometry/cutout.h"
#include "light/geometry/ray_list.h"
#include "sunlit/light/geometry.h"
#include "sunlit/light/visibility.h"

namespace sunlit::light {

/// Points on the leaves of a crown, all asked for one direction at a time. Instead of a ray for each, every
/// triangle among them is met with those points that it may shade: they are many, and lie close together.
class CrownShadows {
 public:
  /// What stands around.
  struct World {
    const Geometry& geometry;
    const Cutouts& cutouts;        ///< of `geometry`
    const Visibility& visibility;  ///< of `geometry`
  };
  /// A place on a leaf.
  struct Point {
    Eigen::Vector3f position, normal;  ///< m in `map`; unit
  };

  /// All of `world` is kept by reference. What stands outside the box around the points is looked up once for
  /// each square of `cell_m`, > 0, or of 1/512 of the box's diagonal if that is more, across the direction.
  CrownShadows(const World& world, std::vector<Point> points, float cell_m);

  /// For each point whether light from far off in the direction `towards`, a unit vector, gets there: 1, or 0
  /// where something stands in its way.
  const std::vector<std::uint8_t>& open(const Eigen::Vector3f& towards);

 private:
  static constexpr std::int32_t kOpaque = -1;
  struct Blocker {
    std::array<Eigen::Vector3f, 3> corners;  ///< from middle_
    float area;                              ///< twice its own
    std::int32_t masked;                     ///< index into Cutouts::maskedTriangles(), or kOpaque
  };
  struct Shadow;
  struct Arrays;
  static bool meet(const Shadow& shadow, const Arrays& points, std::size_t count, std::uint8_t* hit);

  void addBlockers();
  void project(const Eigen::Vector3f& towards);
  void sortIntoCells();
  void shade(const Blocker& blocker);
  void shade(const Shadow& shadow, std::size_t begin, std::size_t end);
  void dropShaded();
  void lookBeyond(const Eigen::Vector3f& towards);

  World world_;
  std::vector<Point> points_;
  float cell_m_;
  Eigen::AlignedBox3f box_;
  Eigen::Vector3f middle_;
  std::vector<Blocker> blockers_;

  // All below is of the direction that is asked for. It is looked along: a grid of cells lies across it.
  Eigen::Vector3f across_, up_, towards_;                         ///< axes of the grid, and the direction
  std::vector<float> unsorted_x_, unsorted_y_, unsorted_height_;  ///< of points_, along these axes
  std::vector<std::uint32_t> unsorted_cell_;                      ///< of points_
  std::vector<std::uint32_t> point_;   ///< index into points_, by cells, row after row
  std::vector<float> x_, y_, height_;  ///< of each of point_
  std::vector<std::uint32_t> first_;   ///< index into point_ of each cell, and one more
  std::vector<std::uint8_t> hit_;      ///< of each point of a segment: 1 where a triangle lies before it
  std::vector<std::uint32_t> met_;     ///< index into point_ of those that a triangle lies before
  std::vector<float> u_, v_;           ///< shares of that triangle's corners, at each of met_
  std::vector<std::uint8_t> solid_;    ///< whether that triangle has no hole there, of each of met_
  float low_x_ = 0.0f, low_y_ = 0.0f;  ///< where the grid begins
  float lowest_ = 0.0f;                ///< height of the lowest point
  int columns_ = 0, rows_ = 0;         ///< cells of the grid
  RayList beyond_;                     ///< one a cell, from where the box around the points ends
  std::vector<std::uint8_t> blocked_;  ///< of each ray of beyond_
  std::vector<std::uint8_t> open_;     ///< of each of points_: the answer
};

}  // namespace sunlit::light
