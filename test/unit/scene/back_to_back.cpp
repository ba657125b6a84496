// Triangles of a file at one place that look opposite ways.
#include <gtest/gtest.h>

#include <cstddef>
#include <string>

#include "unit/scene/measure.h"
#include "unit/scene/scene_files.h"

namespace sunlit::scene {
namespace {

class BackToBack : public SceneFiles {};

// As SketchUp writes walls; drawn from both sides, either would flicker through the other.
TEST_F(BackToBack, FacesAreOneSided) {
  write("m.mtl", "newmtl a\nKd 1 0 0\nnewmtl b\nKd 0 1 0\n");
  const std::string points = "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n";
  const Scene scene = load(write("w.obj", points + "usemtl a\nf 1 2 3\nf 1 2 4\nusemtl b\nf 2 1 3\n"), {});
  ASSERT_EQ(scene.meshes.size(), 3u);
  EXPECT_EQ(scene.triangleCount(), 3u);
  for (const Mesh& mesh : scene.meshes) {
    ASSERT_EQ(mesh.triangles.size(), 1u);
    const bool lone = boundsOf(mesh).max().z() > 0.0f;
    EXPECT_EQ(scene.materials[static_cast<std::size_t>(mesh.material)].double_sided, lone);
  }
  // The same way round is no back.
  const Scene twice = load(write("w.obj", points + "usemtl a\nf 1 2 3\nusemtl b\nf 2 3 1\n"), {});
  for (const Material& material : twice.materials) EXPECT_TRUE(material.double_sided) << material.name;
}

TEST_F(BackToBack, SheetsOfTwoSidesAreOneWhereTheyAreSeenThrough) {
  writeTexture("t.png", 2);
  const std::string points =
      "mtllib m.mtl\nusemtl a\nv 0 0 0\nv 1 0 0\nv 1 0 1\nv 0 0 1\nv 0 1 0\n"
      "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nvn 0 -1 0\nvn 0 1 0\nvn 0 0.6 0.8\n";
  const std::string sheet = points + "f 1/1/1 2/2/1 3/3/1 4/4/1\n";
  const std::string twin = sheet + "f 3/3/2 2/2/2 1/1/2 4/4/2\n";
  const auto expectTriangles = [&](const std::string& object, std::size_t count, bool both) {
    const Scene scene = load(write("w.obj", object), {});
    EXPECT_EQ(scene.triangleCount(), count) << object;
    for (const Mesh& mesh : scene.meshes)
      EXPECT_EQ(scene.materials[static_cast<std::size_t>(mesh.material)].double_sided, both) << object;
  };
  for (const std::string look : {"d 0.5", "map_Kd t.png"}) {
    write("m.mtl", "newmtl a\n" + look + "\n");
    const Scene one = load(write("w.obj", sheet), {}), two = load(write("v.obj", twin), {});
    ASSERT_EQ(two.meshes.size(), 1u) << look;
    EXPECT_EQ(two.meshes[0].triangles, one.meshes[0].triangles);
    EXPECT_EQ(two.meshes[0].positions, one.meshes[0].positions);
    EXPECT_EQ(two.meshes[0].normals, one.meshes[0].normals);
    EXPECT_EQ(two.meshes[0].texture_coordinates, one.meshes[0].texture_coordinates);
    const auto materialOf = [](const Scene& scene) {
      return scene.materials[static_cast<std::size_t>(scene.meshes[0].material)];
    };
    EXPECT_TRUE(materialOf(two).double_sided);
    EXPECT_EQ(materialOf(two).alpha, materialOf(one).alpha);
    EXPECT_EQ(materialOf(two).alpha_mode, materialOf(one).alpha_mode);
    expectTriangles(twin + "f 1/1/1 2/2/1 5/3/1\n", 3, true);
    expectTriangles(sheet + "f 3/3/3 2/2/3 1/1/3 4/4/3\n", 4, false);  // lit otherwise
  }
  expectTriangles(sheet + "f 3/2/2 2/2/2 1/1/2 4/4/2\n", 4, false);  // cut out otherwise
  write("m.mtl", "newmtl a\nd 0.5\n");
  expectTriangles(sheet + "f 3/2/2 2/2/2 1/1/2 4/4/2\n", 2, true);  // which no picture is on
  write("m.mtl", "newmtl a\nKd 1 1 1\n");
  expectTriangles(twin, 4, false);
}

}  // namespace
}  // namespace sunlit::scene
