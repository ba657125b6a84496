// Lines of OBJ files that Assimp reads otherwise than the format means them.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "unit/scene/measure.h"
#include "unit/scene/scene_files.h"

namespace sunlit::scene {
namespace {

class ObjLines : public SceneFiles {
 protected:
  /// Of one mesh, loaded without a warning.
  Mesh meshOf(const std::string& lines) const {
    const Scene scene = load(write("l.obj", lines), {});
    EXPECT_TRUE(scene.warnings.empty()) << scene.warnings[0];
    return scene.meshes.at(0);
  }
};

TEST_F(ObjLines, NumbersMayBeginWithTheirPoint) {
  const std::string before = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 2 ", behind = " 0\nv 3 0 0\nv 3 1 0\n";
  for (const std::string face : {"f -3 -2 -1\n", "f 5 6 7\n"})
    EXPECT_EQ(meshOf(before + ".5" + behind + face).positions,
              meshOf(before + "0.5" + behind + face).positions);
  const Mesh corners = meshOf("v .25 0 0\nv \\\n.75 0 0\nv 0\t.75 -.5\nf 1 2 3\n");
  EXPECT_EQ(boundsOf(corners).min(), Eigen::Vector3f(0.0f, 0.0f, -0.5f));
  EXPECT_EQ(boundsOf(corners).max(), Eigen::Vector3f(0.75f, 0.75f, 0.0f));
  const Mesh colored = meshOf("v 0 0 0 1 .5 .5\nv 1 0 0 1 .5 .5\nv 0 1 0 1 .5 .5\nf 1 2 3\n");
  ASSERT_EQ(colored.colors.size(), 3u);
  for (const Eigen::Array3f& color : colored.colors) EXPECT_NEAR(color[1], 0.21404f, 1e-5f);
  const Mesh placed = meshOf(
      "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt .1 .2\nvt .9 .2\nvt .1 .8\nvn 0 .6 .8\n"
      "f 1/1/1 2/2/1 3/3/1\n");
  EXPECT_FLOAT_EQ(placed.texture_coordinates.at(0).x(), 0.1f);
  EXPECT_FLOAT_EQ(placed.normals.at(0).y(), 0.6f);
}

TEST_F(ObjLines, TextureCoordinatesMayBeOneNumber) {
  const Mesh mesh = meshOf("v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0\nvt .5 # half\nvt 1\nf 1/1 2/2 3/3\n");
  ASSERT_EQ(mesh.texture_coordinates.size(), 3u);
  EXPECT_EQ(mesh.texture_coordinates[1], Eigen::Vector2f(0.5f, 1.0f));
}

TEST_F(ObjLines, FacesMayNameTextureCoordinatesThatAreNowhere) {
  const Mesh mesh = meshOf("v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0.6 0 0.8\nf 1/1/1 2/2/1 3/3/1\nf 3/1 2/1 1/1\n");
  EXPECT_EQ(mesh.triangles.size(), 2u);
  EXPECT_TRUE(mesh.texture_coordinates.empty());
  EXPECT_FLOAT_EQ(mesh.normals.at(mesh.triangles[0][0]).x(), 0.6f);
}

TEST_F(ObjLines, CommentsMayStandBehindThem) {
  const std::string quad =
      "v 0 0 0 # 1 2 3\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0 # 4\nvn 0 0 1 # 5\n"
      "f 1/1/1 2/1/1 3/1/1 4/1/1 # a quad of 4\n";
  const Mesh mesh = meshOf(quad);
  EXPECT_EQ(mesh.triangles.size(), 2u);
  EXPECT_TRUE(mesh.colors.empty());
  EXPECT_EQ(load(write("e.obj", quad + "l 1 2 # edge\np 1 # 2\n"), {}).triangleCount(), 2u);
}

TEST_F(ObjLines, OfShapesThatAreNotReadAreNamed) {
  const std::string whole = "v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 3\nf 1 \\\n2 \\\n3\n";
  EXPECT_EQ(meshOf(whole).triangles.size(), 2u);
  const Scene scene = load(
      write("l.obj", whole + "f 1 2 # and no 3\ncstype bezier\nsurf 0 1 0 1 1 2 3\n" + "call other.obj\n"),
      {});
  EXPECT_EQ(scene.triangleCount(), 2u);
  ASSERT_FALSE(scene.warnings.empty());
  EXPECT_EQ(scene.warnings[0],
            "3 shapes of OBJ are none of three corners or more, they are left out: a face of 2 at " +
                pathOf("l.obj") + ":8; surf at " + pathOf("l.obj") + ":10; call at " + pathOf("l.obj") +
                ":11");
}

TEST_F(ObjLines, OfLibrariesMayNameSeveral) {
  write("a.mtl", "newmtl a\nKd 1 0 0\n");
  write("b.mtl", "newmtl b\nKd 0 0 1\n");
  write("c 1.mtl", "newmtl c\nKd 0 1 0\n");
  const Scene scene = load(write("m.obj",
                                 "mtllib a.mtl b.mtl\nmtllib c 1.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\n"
                                 "usemtl a\nf 1 2 3\nusemtl b\nf 1 2 3\nusemtl c\nf 1 2 3\n"),
                           {});
  EXPECT_TRUE(scene.warnings.empty()) << scene.warnings[0];
  ASSERT_EQ(scene.materials.size(), 3u);
  Eigen::Array3f sum = Eigen::Array3f::Zero();
  for (const Material& material : scene.materials) sum += material.base_color.value;
  EXPECT_TRUE((sum == 1.0f).all()) << sum.transpose();
}

}  // namespace
}  // namespace sunlit::scene
