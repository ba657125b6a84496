// Vertices of mesh files: which have a colour of their own, and which way they look.
#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "sunlit/scene/robot.h"
#include "unit/scene/scene_files.h"

namespace sunlit::scene {
namespace {

class MeshVertices : public SceneFiles {
 protected:
  /// The one mesh of a robot that shows `file`.
  Mesh shownBy(const std::string& file) const { return robotOf(file).links.at(0).meshes.at(0); }
  Robot robotOf(const std::string& file) const {
    const std::string robot =
        write("r.urdf", "<robot name='r'><link name='base'><visual><geometry><mesh filename='" + file +
                            "'/></geometry></visual></link></robot>");
    return loadRobot(robot, {});
  }
};

/// The normal that a triangle's corners run around.
Eigen::Vector3f faceNormal(const Mesh& mesh, const std::array<std::uint32_t, 3>& triangle) {
  const Eigen::Vector3f &a = mesh.positions[triangle[0]], &b = mesh.positions[triangle[1]],
                        &c = mesh.positions[triangle[2]];
  return (b - a).cross(c - a).normalized();
}

void expectFlat(const Mesh& mesh) {
  for (const auto& triangle : mesh.triangles) {
    for (const std::uint32_t corner : triangle)
      EXPECT_LT((mesh.normals[corner] - faceNormal(mesh, triangle)).norm(), 1e-6f);  // single precision
  }
}

TEST_F(MeshVertices, KeepTheColoursOfTheirFaceWhereFacesMeet) {
  const std::string file = write("edge.obj",
                                 "v 0 0 0 1 0 0\nv 1 0 0 1 0 0\nv 0 1 0 1 0 0\n"
                                 "v 1 0 0 0 0 1\nv 1 1 0 0 0 1\nv 0 1 0 0 0 1\nf 1 2 3\nf 4 5 6\n");
  const Mesh mesh = load(file, {}).meshes.at(0);
  ASSERT_EQ(mesh.triangles.size(), 2u);
  for (const std::size_t i : {0u, 1u}) {
    const Eigen::Array3f color = i == 0 ? Eigen::Array3f(1, 0, 0) : Eigen::Array3f(0, 0, 1);
    for (const std::uint32_t corner : mesh.triangles[i])
      EXPECT_TRUE((mesh.colors.at(corner) == color).all()) << mesh.colors[corner].transpose();
  }
}

TEST_F(MeshVertices, AreOneWhereNothingOfThemDiffers) {
  const std::string file = write("flat.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3\nf 1 3 4\n");
  EXPECT_EQ(load(file, {}).meshes.at(0).positions.size(), 4u);
}

class GltfVertices : public MeshVertices {
 protected:
  /// Two faces that lean on each other, of four vertices and their indices; a fifth is of no face. Each
  /// vertex has three more numbers, which are an attribute of that name.
  Mesh roof(const std::string& attribute) const {
    const std::vector<float> positions = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 9, 9, 9};
    const std::vector<float> more = {1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 0, 1, 1, 1};
    const std::vector<std::uint16_t> indices = {0, 1, 2, 0, 3, 1};
    const auto bytes = [](const auto& numbers) {
      return std::string(reinterpret_cast<const char*>(numbers.data()), sizeof(numbers[0]) * numbers.size());
    };
    write("n.bin", bytes(positions) + bytes(more) + bytes(indices));
    const std::string text =
        R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],
        "meshes":[{"primitives":[{"attributes":{"POSITION":0,")" +
        attribute + R"(":1},"indices":2}]}],
        "accessors":[{"bufferView":0,"componentType":5126,"count":5,"type":"VEC3","min":[0,0,0],"max":[9,9,9]},
        {"bufferView":1,"componentType":5126,"count":5,"type":"VEC3"},
        {"bufferView":2,"componentType":5123,"count":6,"type":"SCALAR"}],
        "bufferViews":[{"buffer":0,"byteOffset":0,"byteLength":60},{"buffer":0,"byteOffset":60,"byteLength":60},
        {"buffer":0,"byteOffset":120,"byteLength":12}],"buffers":[{"byteLength":132,"uri":"n.bin"}]})";
    return load(write("t.gltf", text), {}).meshes.at(0);
  }
};

TEST_F(GltfVertices, WithoutNormalsAreFlat) {
  const Mesh mesh = roof("COLOR_0");
  ASSERT_EQ(mesh.triangles.size(), 2u);
  EXPECT_EQ(mesh.positions.size(), 6u);
  expectFlat(mesh);
  // z up: the file's z runs towards −y.
  EXPECT_LT((mesh.positions[mesh.triangles[1][1]] - Eigen::Vector3f(0, -1, 0)).norm(), 1e-6f);
  EXPECT_TRUE((mesh.colors.at(mesh.triangles[1][1]) == Eigen::Array3f(1, 1, 0)).all());
}

TEST_F(GltfVertices, WithNormalsAreThoseThatFacesUse) {
  const Mesh mesh = roof("NORMAL");
  ASSERT_EQ(mesh.positions.size(), 4u);
  EXPECT_LT((mesh.normals[mesh.triangles[1][2]] - Eigen::Vector3f(0, 0, 1)).norm(), 1e-6f);
}

// Exporters of STL leave normals to their reader by writing none of any length.
TEST_F(MeshVertices, OfStlWithoutNormalsHaveEdges) {
  const std::vector<std::array<int, 3>> corners = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},
                                                   {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
  const std::vector<std::array<std::size_t, 4>> sides = {{3, 2, 1, 0}, {4, 5, 6, 7}, {0, 1, 5, 4},
                                                         {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};
  std::string text = "solid box\n";
  for (const auto& side : sides) {
    for (const std::array<std::size_t, 3>& triangle :
         {std::array{side[0], side[1], side[2]}, std::array{side[0], side[2], side[3]}}) {
      text += "facet normal 0 0 0\nouter loop\n";
      for (const std::size_t i : triangle) {
        text += "vertex";
        for (const int number : corners[i]) text += " " + std::to_string(number);
        text += "\n";
      }
      text += "endloop\nendfacet\n";
    }
  }
  const std::string file = write("box.stl", text + "endsolid box\n");
  EXPECT_EQ(robotOf(file).materials.at(0).base_color.value[0], 0.18f);  // as a box without a material
  const Mesh mesh = shownBy(file);
  EXPECT_EQ(mesh.triangles.size(), 12u);
  expectFlat(mesh);
}

/// A triangle of binary STL, with these two bytes behind it.
std::string binaryStl(std::string header, std::uint16_t attribute) {
  header.resize(80);
  const std::uint32_t count = 1;
  const std::array<float, 12> numbers = {0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0};
  const auto append = [&header](const void* from, std::size_t bytes) {
    header.append(static_cast<const char*>(from), bytes);
  };
  append(&count, sizeof(count));
  append(numbers.data(), sizeof(numbers));
  append(&attribute, sizeof(attribute));
  return header;
}

// Programs mean different things by these bytes, and by a colour in the header, and Gazebo none. Bit 15 is a
// colour to some, to others that of the header.
TEST_F(MeshVertices, OfStlHaveNoColours) {
  for (const std::string header : {"Exported", "COLOR=\x80\x80\x80\xff, Materialise"}) {
    for (const std::uint16_t attribute : {0x0000, 0x8000, 0xfc00}) {
      const std::string file = write("part.stl", binaryStl(header, attribute));
      EXPECT_TRUE(shownBy(file).colors.empty()) << header << attribute;
      EXPECT_EQ(robotOf(file).materials.at(0).base_color.value[0], 0.18f) << header << attribute;
    }
  }
}

TEST_F(MeshVertices, OfStlAreAsManyAsItCounts) {
  const std::string whole = binaryStl("solid", 0);
  for (const std::string& tail : {std::string("COLOR=1"), std::string(50, '\0'), std::string(1, '\0')}) {
    const std::string file = write("part.stl", whole + tail);
    EXPECT_EQ(shownBy(file).triangles.size(), 1u) << tail.size();
  }
  const std::string file = write("part.stl", whole.substr(0, whole.size() - 1));
  EXPECT_EQ(messageOf<std::runtime_error>([&] { robotOf(file); }),
            file + ": this STL file is cut short: it counts 1 faces, and has 0");
}

}  // namespace
}  // namespace sunlit::scene
