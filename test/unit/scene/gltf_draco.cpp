// Primitives of glTF files that Draco packs. The library's own packer makes them here.
#include <draco/compression/encode.h>
#include <draco/mesh/mesh.h>
#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "support/base64.h"
#include "unit/scene/measure.h"
#include "unit/scene/scene_files.h"

namespace sunlit::scene {
namespace {

/// A square of 2 m, of `cells` × `cells` squares of two triangles, with one colour.
struct Parts {
  std::uint32_t cells = 2;
  std::string components = "5125";  ///< of the indices
  std::size_t more_vertices = 0;    ///< told, and not there
  std::size_t cut_bytes = 0;
  std::string color_id = "1";

  std::uint32_t vertices() const { return (cells + 1) * (cells + 1); }
};

template <typename Value>
void addAttribute(draco::Mesh& mesh, draco::GeometryAttribute::Type type, draco::DataType components,
                  const std::vector<Value>& values) {
  draco::GeometryAttribute told;
  told.Init(type, nullptr, 3, components, components == draco::DT_UINT8, sizeof(Value), 0);
  const int id = mesh.AddAttribute(told, true, static_cast<std::uint32_t>(values.size()));
  for (std::uint32_t i = 0; i < values.size(); ++i)
    mesh.attribute(id)->SetAttributeValue(draco::AttributeValueIndex(i), values[i].data());
}

std::string packed(const Parts& parts) {
  const std::uint32_t row = parts.cells + 1;
  draco::Mesh mesh;
  mesh.set_num_points(parts.vertices());
  std::vector<std::array<float, 3>> positions;
  for (std::uint32_t i = 0; i < parts.vertices(); ++i)
    positions.push_back({2.0f * static_cast<float>(i % row) / static_cast<float>(parts.cells),
                         2.0f * static_cast<float>(i / row) / static_cast<float>(parts.cells), 0.0f});
  addAttribute(mesh, draco::GeometryAttribute::POSITION, draco::DT_FLOAT32, positions);
  addAttribute(mesh, draco::GeometryAttribute::COLOR, draco::DT_UINT8,
               std::vector<std::array<std::uint8_t, 3>>(parts.vertices(), {51, 102, 255}));
  for (std::uint32_t i = 0; i < parts.vertices(); ++i) {
    if (i % row == parts.cells || i / row == parts.cells) continue;
    const draco::PointIndex a(i), b(i + 1), c(i + row), d(i + row + 1);
    mesh.AddFace({a, b, c});
    mesh.AddFace({c, b, d});
  }
  draco::Encoder encoder;
  encoder.SetAttributeQuantization(draco::GeometryAttribute::POSITION, 16);
  draco::EncoderBuffer buffer;
  EXPECT_TRUE(encoder.EncodeMeshToBuffer(mesh, &buffer).ok());
  return {buffer.data(), buffer.size() - parts.cut_bytes};
}

std::string gltf(const Parts& parts) {
  const std::string data = packed(parts), length = std::to_string(data.size()),
                    vertices = std::to_string(parts.vertices() + parts.more_vertices);
  return R"({"asset":{"version":"2.0"},"extensionsUsed":["KHR_draco_mesh_compression"],"extensionsRequired":
["KHR_draco_mesh_compression"],"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],"materials":[{"name":"m"}],
"meshes":[{"primitives":[{"material":0,"indices":2,"attributes":{"POSITION":0,"COLOR_0":1},"extensions":
{"KHR_draco_mesh_compression":{"bufferView":0,"attributes":{"POSITION":0,"COLOR_0":)" +
         parts.color_id + R"(}}}}]}],"accessors":[{"componentType":5126,"count":)" + vertices +
         R"(,"type":"VEC3","min":[0,0,0],"max":[2,2,0]},{"componentType":5121,"normalized":true,"count":)" +
         vertices + R"(,"type":"VEC3"},{"componentType":)" + parts.components + R"(,"count":)" +
         std::to_string(6 * parts.cells * parts.cells) +
         R"(,"type":"SCALAR"}],"bufferViews":[{"buffer":0,"byteLength":)" + length +
         R"(}],"buffers":[{"byteLength":)" + length + R"(,"uri":"data:;base64,)" + base64(data) + "\"}]}";
}

class GltfDraco : public SceneFiles {
 protected:
  std::string errorOfParts(const Parts& parts) const { return errorOf(write("t.gltf", gltf(parts))); }
  void expectWhole(const Parts& parts) const {
    const Scene scene = load(write("t.gltf", gltf(parts)), {});
    EXPECT_TRUE(scene.warnings.empty()) << scene.warnings[0];
    ASSERT_EQ(scene.triangleCount(), std::size_t{2} * parts.cells * parts.cells);
    EXPECT_LT((boundsOf(scene).max() - Eigen::Vector3f(2, 0, 2)).norm(), 1e-4f);  // glTF's y is up
    EXPECT_NEAR(areaOf(scene.meshes[0]), 4.0, 1e-3);
    ASSERT_FALSE(scene.meshes[0].colors.empty());
    for (const Eigen::Array3f& color : scene.meshes[0].colors)
      ASSERT_LT((color - Eigen::Array3f(0.2f, 0.4f, 1.0f)).abs().maxCoeff(), 1e-5f);
  }
};

TEST_F(GltfDraco, PrimitivesAreUnpackedWhateverTheirIndices) {
  for (const char* const components : {"5121", "5123", "5125"}) {
    Parts parts;
    parts.components = components;
    expectWhole(parts);
  }
}

TEST_F(GltfDraco, PrimitivesMayHaveMoreThan65535Vertices) {
  Parts parts;
  parts.cells = 300;
  expectWhole(parts);
}

TEST_F(GltfDraco, PrimitivesThatAreCutOffAreNamed) {
  Parts parts;
  parts.cut_bytes = 20;
  const std::string error = errorOfParts(parts);
  EXPECT_EQ(error.find(pathOf("t.gltf") + ": KHR_draco_mesh_compression: mesh 0: cannot be unpacked: "), 0u)
      << error;
}

TEST_F(GltfDraco, PrimitivesThatLackWhatTheFileTellsAreNamed) {
  const std::string place = pathOf("t.gltf") + ": KHR_draco_mesh_compression: mesh 0: ";
  Parts parts;
  parts.more_vertices = 1;
  EXPECT_EQ(errorOfParts(parts), place + "has 9 vertices, where the file tells 10");
  parts = {};
  parts.color_id = "7";
  EXPECT_EQ(errorOfParts(parts), place + "there is no attribute 7 for COLOR_0");
}

}  // namespace
}  // namespace sunlit::scene
