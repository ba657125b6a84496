// How the links of URDF robots look: by Gazebo's elements, and where their meshes bring no material.
#include <gtest/gtest.h>

#include <string>

#include "sunlit/scene/robot.h"
#include "support/needs.h"
#include "unit/scene/scene_files.h"

namespace sunlit::scene {
namespace {

const std::string kBox = "<box size='1 1 1'/>";

class RobotLooks : public SceneFiles {
 protected:
  /// With visuals of this on its one link, and what else is within <robot>.
  Robot robot(const std::string& visual, const std::string& more) const {
    return loadRobot(
        write("robot/r.urdf", "<robot name='r'><link name='base'>" + visual + "</link>" + more + "</robot>"),
        {});
  }
  static std::string visual(const std::string& geometry, const std::string& material = "") {
    return "<visual><geometry>" + geometry + "</geometry>" + material + "</visual>";
  }
  static const Material& materialOf(const Robot& robot) {
    return robot.materials.at(static_cast<std::size_t>(robot.links.at(0).meshes.at(0).material));
  }
};

std::string gazebo(const std::string& material) {
  return "<gazebo reference='base'><visual><material>" + material + "</material></visual></gazebo>";
}

const std::string kRed = "<material name='red'><color rgba='1 0 0 1'/></material>";

TEST_F(RobotLooks, AreThoseThatGazebosVisualsGiveTheirLink) {
  SKIP_WITHOUT_SDF();
  const Robot blue = robot(visual(kBox), gazebo("<diffuse>0 0 1 1</diffuse>"));
  EXPECT_TRUE((materialOf(blue).base_color.value == Eigen::Array3f(0, 0, 1)).all());
  EXPECT_TRUE(blue.warnings.empty()) << blue.warnings[0];

  writeTexture("robot/paint.png");
  const std::string pbr =
      "<diffuse>1 1 1 1</diffuse><pbr><metal><albedo_map>paint.png</albedo_map><roughness>0.3</roughness>"
      "</metal></pbr>";
  const Robot painted = robot(visual(kBox) + visual(kBox), gazebo(pbr));
  ASSERT_TRUE(painted.warnings.empty()) << painted.warnings[0];
  EXPECT_EQ(painted.materials.size(), 1u);
  ASSERT_EQ(painted.textures.size(), 1u);
  EXPECT_EQ(painted.textures[0].rgba[0], 200);
  EXPECT_EQ(materialOf(painted).base_texture, 0);
  EXPECT_FLOAT_EQ(materialOf(painted).roughness, 0.3f);

  const Robot scripted = robot(visual(kBox), gazebo("<script><name>Gazebo/Blue</name></script>"));
  EXPECT_EQ(materialOf(scripted).name, "Gazebo/Blue");
}

TEST_F(RobotLooks, AreThoseOfScriptsInMediaByTheirName) {
  SKIP_WITHOUT_SDF();
  write("media/materials/scripts/own.material",
        "material My/Green\n{ technique { pass { diffuse 0 1 0 } } }\n");
  const Robot green = robot(visual(kBox), "<gazebo reference='base'><material>My/Green</material></gazebo>");
  EXPECT_TRUE(green.warnings.empty()) << green.warnings[0];
  EXPECT_TRUE((materialOf(green).base_color.value == Eigen::Array3f(0, 1, 0)).all());
}

TEST_F(RobotLooks, OfScriptsAreLookedForOnceWhateverTheirName) {
  SKIP_WITHOUT_SDF();
  write("media/materials/scripts/own.material", "material A<B\n{ technique { pass { diffuse 0 1 0 } } }\n");
  const auto two = [&](const std::string& name) {
    return robot(visual(kBox) + visual(kBox),
                 "<gazebo reference='base'><material>" + name + "</material></gazebo>");
  };
  const Robot green = two("A&lt;B");
  EXPECT_TRUE(green.warnings.empty()) << green.warnings[0];
  EXPECT_EQ(green.materials.size(), 1u);
  EXPECT_TRUE((materialOf(green).base_color.value == Eigen::Array3f(0, 1, 0)).all());
  const Robot none = two("My/None");  // each visual counts
  ASSERT_EQ(none.warnings.size(), 1u);
  EXPECT_EQ(none.warnings[0].find("2 materials do not exist"), 0u) << none.warnings[0];
}

TEST_F(RobotLooks, AreNamedWhereGazebosAreNotShown) {
  const std::string blue = "<gazebo reference='base'><material>Gazebo/Blue</material></gazebo>";
  const Robot own = robot(visual(kBox, kRed), gazebo("<diffuse>0 0 1 1</diffuse>"));
  EXPECT_EQ(materialOf(own).base_color.value[0], 1.0f);
  ASSERT_EQ(own.warnings.size(), 1u);
  EXPECT_NE(own.warnings[0].find("<gazebo> material within <visual> of "), std::string::npos)
      << own.warnings[0];

  write("robot/m.mtl", "newmtl paint\nKd 1 0 0\nnewmtl rust\nKd 1 1 0\n");
  write("robot/m.obj",
        "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nusemtl paint\nf 1 2 3\nusemtl rust\nf 1 2 4\n");
  const Robot mesh = robot(visual("<mesh filename='m.obj'/>"), blue);
  EXPECT_EQ(materialOf(mesh).base_color.value[2], 0.0f);
  ASSERT_EQ(mesh.warnings.size(), 1u);
  EXPECT_EQ(mesh.warnings[0].find("1 "), 0u) << mesh.warnings[0];
  EXPECT_NE(mesh.warnings[0].find("<gazebo> material Gazebo/Blue of "), std::string::npos);
  EXPECT_NE(mesh.warnings[0].find("whose mesh has its own"), std::string::npos) << mesh.warnings[0];
}

TEST_F(RobotLooks, OfAMeshWithoutMaterialsAreThoseOfTheUrdf) {
  const float positions[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
  write("robot/n.bin", {reinterpret_cast<const char*>(positions), sizeof(positions)});
  const auto gltf = [](const std::string& material, const std::string& use) {
    return R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],)" +
           material + R"("meshes":[{"primitives":[{"attributes":{"POSITION":0})" + use + R"(}]}],
      "accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,1,0]}],
      "bufferViews":[{"buffer":0,"byteLength":36}],"buffers":[{"byteLength":36,"uri":"n.bin"}]})";
  };
  write("robot/m.gltf", gltf("", ""));
  const std::string mesh = visual("<mesh filename='m.gltf'/>", kRed);
  EXPECT_EQ(materialOf(robot(mesh, "")).name, "red");
  // Its y stays y, as in RViz; of the file alone it is up.
  const auto top = [](const std::vector<Mesh>& meshes) { return meshes.at(0).positions.at(2); };
  EXPECT_LT((top(robot(mesh, "").links.at(0).meshes) - Eigen::Vector3f(0, 1, 0)).norm(), 1e-6f);
  EXPECT_LT((top(load(pathOf("robot/m.gltf"), {}).meshes) - Eigen::Vector3f(0, 0, 1)).norm(), 1e-6f);
  // One that is called as what Assimp calls none is one.
  write("robot/m.gltf", gltf(R"("materials":[{"name":"DefaultMaterial"}],)", R"(,"material":0)"));
  EXPECT_NE(materialOf(robot(mesh, "")).name, "red");
}

/// A triangle; what each vertex and the face have more, and a further element.
std::string ply(const std::string& vertex = "", const std::string& color = "", const std::string& more = "",
                const std::string& element = "") {
  return "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n" +
         vertex + "element face 1\nproperty list uchar int vertex_indices\n" + more + "end_header\n" +
         "0 0 0" + color + "\n1 0 0" + color + "\n0 1 0" + color + "\n3 0 1 2\n" + element;
}

TEST_F(RobotLooks, OfAPlyWithoutAMaterialAreThoseOfTheUrdf) {
  const std::string mesh = "<mesh filename='m.ply'/>";
  const auto isAll = [&](float value) {
    return (materialOf(robot(visual(mesh), "")).base_color.value - value).abs().maxCoeff() < 1e-4f;
  };
  write("robot/m.ply", ply());
  EXPECT_EQ(materialOf(robot(visual(mesh, kRed), "")).name, "red");
  EXPECT_TRUE(isAll(0.18f));

  write("robot/m.ply", ply("property uchar red\nproperty uchar green\nproperty uchar blue\n", " 9 9 9"));
  EXPECT_TRUE(isAll(1.0f));

  write("robot/m.ply", ply("", "",
                           "element material 1\nproperty uchar diffuse_red\nproperty uchar diffuse_green\n"
                           "property uchar diffuse_blue\n",
                           "255 255 255\n"));
  EXPECT_NE(materialOf(robot(visual(mesh, kRed), "")).name, "red");
  EXPECT_TRUE(isAll(1.0f));
}

}  // namespace
}  // namespace sunlit::scene
