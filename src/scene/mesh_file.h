/// Mesh files (COLLADA, glTF, OBJ) by Assimp.
#pragma once

#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "scene/resource_finder.h"
#include "scene/scene_builder.h"

namespace sunlit::scene {

/// Who decides which axis of a file is up. An OBJ file says nothing and is taken as z up, as ROS tools do.
enum class UpAxis {
  kAsDeclared,  ///< COLLADA's up_axis; of glTF +Y
  /// Coordinates as they stand, whatever the file declares: what Gazebo does with the meshes of its models,
  /// and RViz of ROS 1, whose users turn their visuals so that it fits.
  kZ,
};

/// How a mesh file is wanted.
struct MeshReading {
  UpAxis up_axis;
  bool looks = true;  ///< that its file gives it; false: whoever wants the parts puts a material on each
};

/// One piece of a mesh file: its triangles in the frame of their node, and where that stands in the file.
struct MeshPart {
  std::string node;      ///< name of its node in the file
  std::string geometry;  ///< name of the mesh in the file
  Mesh mesh;             ///< `material` is an index into the builder's materials, if the looks are wanted
  Eigen::Affine3d file_from_node = Eigen::Affine3d::Identity();  ///< to z up, m
  /// The last of mesh.more_texture_coordinates are the first set as it stands in the file, which its own
  /// material has no use for, and any other wants: see leaveCoordinates().
  bool has_spare = false;
  bool bare = false;  ///< the file gives it no material: the mesh has what its format says of such
};

/// Leaves the mesh the texture coordinates that one kind of material wants: its own, or one that is put on
/// it.
void leaveCoordinates(bool of_own_material, MeshPart& part);

/// The ending of a file's name in lower case, with its dot; empty if it has none.
std::string extensionOf(const std::string& file);
/// Throws std::runtime_error if it is a macro file (.xacro), which is none of a world or robot yet.
void refuseMacros(const std::string& file);

/// Reads `file`; its materials and textures go to `builder`, if they are wanted, with what there is to say of
/// them, and with kAsDeclared, which is for files that are a world of their own, its lights, too. Throws
/// std::runtime_error naming the file and what is wrong.
std::vector<MeshPart> readMeshFile(const std::string& file, const MeshReading& reading,
                                   const ResourceFinder& finder, SceneBuilder& builder);

}  // namespace sunlit::scene
