/// Simple solids as meshes: centred on the origin, outward normals, textures lying as in Gazebo, whose worlds
/// and models they are drawn for (gz-common's MeshManager): upright on the sides of boxes, their top to +x on
/// top and to −x below; turned by 180° around cylinders, from +y on; on spheres from pole to pole along y.
#pragma once

#include <Eigen/Core>

#include "sunlit/scene/scene.h"

namespace sunlit::scene {

/// Lengths in m, all above zero; the axis of round solids is z.
Mesh makeBox(const Eigen::Vector3d& size);
Mesh makeEllipsoid(const Eigen::Vector3d& radii);
Mesh makeCylinder(double radius, double length);
/// Its tip is up.
Mesh makeCone(double radius, double length);
/// A cylinder of `length` with a half sphere on each end.
Mesh makeCapsule(double radius, double length);
/// A rectangle through the origin facing `normal`, which need not be of length 1.
Mesh makePlane(const Eigen::Vector2d& size, const Eigen::Vector3d& normal);

}  // namespace sunlit::scene
