#include "scene/mesh_rest.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "scene/assimp_nodes.h"
#include "scene/cofactors.h"

namespace sunlit::scene {
namespace {

Eigen::Vector3f vectorOf(const aiVector3D& vector) {
  return {vector.x, vector.y, vector.z};
}

/// Of each vertex: where its bones hold it, by their weights.
std::vector<Eigen::Matrix4d> fileFromVertices(const aiMesh& source, const aiScene& scene) {
  std::vector<Eigen::Matrix4d> poses(source.mNumVertices, Eigen::Matrix4d::Zero());
  for (unsigned i = 0; i < source.mNumBones; ++i) {
    const aiBone& bone = *source.mBones[i];
    const aiNode* const joint = scene.mRootNode->FindNode(bone.mName);
    if (joint == nullptr) continue;
    const Eigen::Matrix4d file_from_mesh = (fileFromNode(*joint) * toEigen(bone.mOffsetMatrix)).matrix();
    for (unsigned k = 0; k < bone.mNumWeights; ++k) {
      const aiVertexWeight& weight = bone.mWeights[k];
      if (weight.mVertexId < poses.size()) poses[weight.mVertexId] += weight.mWeight * file_from_mesh;
    }
  }
  return poses;
}

std::size_t timesOf(const aiString& name, const aiNode& node) {
  std::size_t times = node.mName == name ? 1 : 0;
  for (unsigned i = 0; i < node.mNumChildren; ++i) times += timesOf(name, *node.mChildren[i]);
  return times;
}

/// Swaps two corners of triangles that most of their vertices mirror, so that their front stays outside.
void turnMirrored(const std::vector<bool>& mirrored, Mesh& mesh) {
  for (auto& triangle : mesh.triangles) {
    if (std::count_if(triangle.begin(), triangle.end(), [&](auto corner) { return mirrored[corner]; }) >= 2)
      std::swap(triangle[1], triangle[2]);
  }
}

}  // namespace

void blendTargets(const aiMesh& source, Mesh& mesh) {
  for (unsigned k = 0; k < source.mNumAnimMeshes; ++k) {
    const aiAnimMesh& target = *source.mAnimMeshes[k];
    const float weight = target.mWeight;
    if (weight == 0.0f || !std::isfinite(weight) || target.mNumVertices != source.mNumVertices) continue;
    for (unsigned i = 0; i < source.mNumVertices; ++i) {
      if (target.HasPositions())
        mesh.positions[i] += weight * vectorOf(target.mVertices[i] - source.mVertices[i]);
      if (target.HasNormals() && source.HasNormals())
        mesh.normals[i] += weight * vectorOf(target.mNormals[i] - source.mNormals[i]);
    }
  }
}

bool hasItsJoints(const aiMesh& source, const aiScene& scene) {
  for (unsigned i = 0; i < source.mNumBones; ++i) {
    if (timesOf(source.mBones[i]->mName, *scene.mRootNode) != 1) return false;
  }
  return true;
}

bool standOnBones(const aiMesh& source, const aiScene& scene, Mesh& mesh) {
  if (!source.HasBones()) return false;
  const std::vector<Eigen::Matrix4d> poses = fileFromVertices(source, scene);
  std::vector<bool> mirrored(poses.size(), false);
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const double total = poses[i](3, 3);
    if (!(total > 1e-6)) continue;  // no bone holds it
    const Eigen::Matrix4d pose = poses[i] / total;
    const Eigen::Matrix3d linear = pose.topLeftCorner<3, 3>();
    mesh.positions[i] =
        (linear * mesh.positions[i].cast<double>() + pose.topRightCorner<3, 1>()).cast<float>();
    mirrored[i] = linear.determinant() < 0.0;
    const double hand = mirrored[i] ? -1.0 : 1.0;
    if (i < mesh.normals.size())
      mesh.normals[i] = (hand * cofactors(linear) * mesh.normals[i].cast<double>()).cast<float>();
    if (i < mesh.tangents.size()) {
      mesh.tangents[i].head<3>() =
          (linear * mesh.tangents[i].head<3>().cast<double>()).normalized().cast<float>();
      mesh.tangents[i].w() *= static_cast<float>(hand);
    }
  }
  turnMirrored(mirrored, mesh);
  return true;
}

}  // namespace sunlit::scene
