/// Simple solids to build with.
#pragma once

#include <vector>

#include "scene/race_track/assembly.h"

namespace sunlit::scene::race_track {

using Point = Eigen::Vector3f;
using Frame = Eigen::Isometry3f;  ///< map_from_part

/// Corners counter-clockwise from the lower left as seen from the front.
using Corners = std::array<Point, 4>;

void addTriangle(Assembly& assembly, const Paint& paint, const std::array<Point, 3>& corners);
void addQuad(Assembly& assembly, const Paint& paint, const Corners& corners, const PictureRect& rect = {});
/// As addQuad, with normals of one's own for shading (leaves, blades).
struct Card {
  Corners corners;
  PictureRect rect;
  Corners normals;  ///< unit, one a corner
};
/// The same normal at all corners.
inline Corners even(const Point& normal) {
  return {normal, normal, normal, normal};
}
void addCard(Assembly& assembly, const Paint& paint, const Card& card);

/// Standing on the origin of `frame`, centred in x and y. Every face shows the whole picture.
void addBox(Assembly& assembly, const Paint& paint, const Frame& frame, const Point& size);

struct Ring {
  Point centre;
  float radius;
};
/// A round pipe through the rings, `sides` ≥ 3, smooth; closed by a cap at the end.
void addTube(Assembly& assembly, const Paint& paint, const std::vector<Ring>& rings, int sides);
/// A straight bar between two points.
void addBar(Assembly& assembly, const Paint& paint, const Ring& from, const Ring& to);
/// A lumpy ball (rock, bush core).
struct Lump {
  Point centre;
  Point radii;
  float roughness;  ///< of the shape, relative
  std::uint32_t seed;
};
void addLump(Assembly& assembly, const Paint& paint, const Lump& lump);

/// A random horizontal offset, of standard deviation `spread` along either axis, m.
Point sway(float spread, Random& random);
/// A frame standing at `place`, its x axis turned by `yaw` from east.
Frame standing(const Point& place, float yaw);
/// `frame` moved by `offset` in its own axes.
Frame shifted(const Frame& frame, const Point& offset);

}  // namespace sunlit::scene::race_track
