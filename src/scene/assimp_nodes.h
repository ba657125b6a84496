/// Where nodes of an Assimp scene stand.
#pragma once

#include <assimp/scene.h>

#include <Eigen/Geometry>

namespace sunlit::scene {

inline Eigen::Affine3d toEigen(const aiMatrix4x4& matrix) {
  Eigen::Affine3d affine = Eigen::Affine3d::Identity();
  affine.matrix() << matrix.a1, matrix.a2, matrix.a3, matrix.a4, matrix.b1, matrix.b2, matrix.b3, matrix.b4,
      matrix.c1, matrix.c2, matrix.c3, matrix.c4, 0.0, 0.0, 0.0, 1.0;
  return affine;
}

inline Eigen::Affine3d fileFromNode(const aiNode& of) {
  Eigen::Affine3d file_from_node = Eigen::Affine3d::Identity();
  for (const aiNode* node = &of; node != nullptr; node = node->mParent)
    file_from_node = toEigen(node->mTransformation) * file_from_node;
  return file_from_node;
}

}  // namespace sunlit::scene
