/// Normals and tangents of meshes.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>

#include "sunlit/scene/scene.h"

namespace sunlit::scene {

/// Normal to a triangle of `mesh`, as long as twice its area.
Eigen::Vector3d faceVector(const Mesh& mesh, const std::array<std::uint32_t, 3>& triangle);

/// Where `linear` takes the tangents of `mesh`. Without all of them if one is broken: those that follow from
/// the coordinates are better than some.
void turnTangents(const Eigen::Matrix3d& linear, Mesh& mesh);

/// Normals that are missing, zero or not finite are replaced by the mean of the adjoining faces.
void repairNormals(Mesh& mesh);

}  // namespace sunlit::scene
