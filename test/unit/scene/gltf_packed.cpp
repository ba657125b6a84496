// Views of glTF files that are packed (EXT_meshopt_compression). The library's own packer makes them here.
#include <gtest/gtest.h>
#include <meshoptimizer.h>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "support/base64.h"
#include "unit/scene/measure.h"
#include "unit/scene/scene_files.h"

namespace sunlit::scene {
namespace {

std::string shortened(const std::vector<unsigned char>& bytes, std::size_t length) {
  return {bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(length)};
}

std::string packedAttributes(const void* elements, std::size_t count, std::size_t stride) {
  std::vector<unsigned char> bytes(meshopt_encodeVertexBufferBound(count, stride));
  const std::size_t length = meshopt_encodeVertexBuffer(bytes.data(), bytes.size(), elements, count, stride);
  return shortened(bytes, length);
}

std::string packedTriangles(const std::vector<unsigned>& corners) {
  std::vector<unsigned char> bytes(meshopt_encodeIndexBufferBound(corners.size(), corners.size()));
  const std::size_t length =
      meshopt_encodeIndexBuffer(bytes.data(), bytes.size(), corners.data(), corners.size());
  return shortened(bytes, length);
}

std::string packedSequence(const std::vector<unsigned>& corners) {
  std::vector<unsigned char> bytes(meshopt_encodeIndexSequenceBound(corners.size(), corners.size()));
  const std::size_t length =
      meshopt_encodeIndexSequence(bytes.data(), bytes.size(), corners.data(), corners.size());
  return shortened(bytes, length);
}

/// Of a view in a buffer that is nowhere.
struct View {
  std::string packed;
  std::size_t stride, count;
  std::string mode, filter = "NONE";
};

/// Two triangles, 3 m wide and 2 m high.
struct Parts {
  std::vector<float> positions = {0, 0, 0, 3, 0, 0, 0, 2, 0, 3, 2, 0};
  std::vector<unsigned> corners = {0, 1, 2, 2, 1, 3};
  bool as_sequence = false;
  std::string more_of_positions;  ///< of the extension's words
  std::string buffers_end;        ///< instead of the buffer that is nowhere
  std::size_t cut_bytes = 0;
  std::string extension = "EXT_meshopt_compression";
};

std::string wordsOf(const View& view, std::size_t from, std::size_t to, const std::string& more) {
  const auto text = [](std::size_t number) { return std::to_string(number); };
  const std::string length = text(view.stride * view.count);
  return R"({"buffer":1,"byteOffset":)" + text(to) + R"(,"byteLength":)" + length +
         (view.mode == "ATTRIBUTES" ? R"(,"byteStride":)" + text(view.stride) : "") +
         R"(,"extensions":{"EXT_meshopt_compression":{"buffer":0,"byteOffset":)" + text(from) +
         R"(,"byteLength":)" + text(view.packed.size()) + R"(,"byteStride":)" + text(view.stride) +
         R"(,"count":)" + text(view.count) + R"(,"mode":")" + view.mode + R"(","filter":")" + view.filter +
         "\"" + more + "}}}";
}

/// In its words, as the other extension has them.
std::string gltfOfExt(const Parts& parts) {
  // Normals towards the viewer, octahedral in 8 bits.
  const std::array<float, 16> towards = {0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0};
  std::array<std::int8_t, 16> normals{};
  meshopt_encodeFilterOct(normals.data(), 4, 4, 8, towards.data());
  const std::vector<View> views = {
      {packedAttributes(parts.positions.data(), 4, 12), 12, 4, "ATTRIBUTES"},
      {packedAttributes(normals.data(), 4, 4), 4, 4, "ATTRIBUTES", "OCTAHEDRAL"},
      {parts.as_sequence ? packedSequence(parts.corners) : packedTriangles(parts.corners), 2, 6,
       parts.as_sequence ? "INDICES" : "TRIANGLES"}};
  std::string bytes, words;
  std::size_t to = 0;
  for (std::size_t i = 0; i < views.size(); ++i) {
    words += (i > 0 ? "," : "") + wordsOf(views[i], bytes.size(), to, i == 0 ? parts.more_of_positions : "");
    bytes += views[i].packed;
    to += views[i].stride * views[i].count;
  }
  const std::string end =
      parts.buffers_end.empty()
          ? R"({"byteLength":76,"extensions":{"EXT_meshopt_compression":{"fallback":true}}})"
          : parts.buffers_end;
  bytes.resize(bytes.size() - parts.cut_bytes);
  return R"({"asset":{"version":"2.0"},"extensionsRequired":["EXT_meshopt_compression"],
"extensionsUsed":["EXT_meshopt_compression"],"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],
"materials":[{"name":"m"}],"meshes":[{"primitives":[{"material":0,"indices":2,"attributes":{"POSITION":0,"NORMAL":1}}]}],
"accessors":[{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3","min":[0,0,0],"max":[3,2,0]},
{"bufferView":1,"componentType":5120,"normalized":true,"count":4,"type":"VEC3"},
{"bufferView":2,"componentType":5123,"count":6,"type":"SCALAR"}],"bufferViews":[)" +
         words + R"(],"buffers":[{"byteLength":)" + std::to_string(bytes.size()) +
         R"(,"uri":"data:;base64,)" + base64(bytes) + "\"}," + end + "]}";
}

std::string gltf(const Parts& parts) {
  const std::string ext = "EXT_meshopt_compression";
  std::string text = gltfOfExt(parts);
  for (std::size_t at = text.find(ext); at != std::string::npos; at = text.find(ext, at + 1))
    text.replace(at, ext.size(), parts.extension);
  return text;
}

class GltfPacked : public SceneFiles {
 protected:
  void expectWhole(const Parts& parts) const {
    const Scene scene = load(write("t.gltf", gltf(parts)), {});
    EXPECT_TRUE(scene.warnings.empty());
    ASSERT_EQ(scene.triangleCount(), 2u);
    EXPECT_EQ(boundsOf(scene).min(), Eigen::Vector3f(0, 0, 0));
    EXPECT_EQ(boundsOf(scene).max(), Eigen::Vector3f(3, 0, 2));  // glTF's y is up
    EXPECT_NEAR(areaOf(scene.meshes[0]), 6.0, 1e-6);
    for (const Eigen::Vector3f& normal : scene.meshes[0].normals)
      EXPECT_LT((normal - Eigen::Vector3f(0, -1, 0)).norm(), 0.01f);
  }
  std::string errorOfParts(const Parts& parts) const { return errorOf(write("t.gltf", gltf(parts))); }
};

TEST_F(GltfPacked, ViewsAreUnpacked) {
  expectWhole({});
}

TEST_F(GltfPacked, ViewsAreUnpackedByKhronossNameToo) {
  Parts parts;
  parts.extension = "KHR_meshopt_compression";
  expectWhole(parts);
  parts.more_of_positions = R"(,"filter":"COLOR")";
  EXPECT_EQ(errorOfParts(parts),
            pathOf("t.gltf") +
                ": KHR_meshopt_compression: view 0: filter COLOR is not known for ATTRIBUTES of 12 bytes");
}

TEST_F(GltfPacked, BuffersThatAreNowhereElseAreNamedByTheirExtension) {
  Parts parts;
  parts.buffers_end = R"({"byteLength":76,"extensions":{"EXT_meshopt_compression":{"fallback":false}}})";
  EXPECT_EQ(
      errorOfParts(parts),
      pathOf("t.gltf") +
          ": EXT_meshopt_compression: buffer 1 is nowhere but in packed views, which were not unpacked");
}

TEST_F(GltfPacked, CornersOfAnyOrderAreASequence) {
  Parts parts;
  parts.as_sequence = true;
  expectWhole(parts);
}

// What stands there unpacked, too, is for readers like any other.
TEST_F(GltfPacked, WhereABufferIsThereItIsTaken) {
  Parts parts;
  const auto bytesOf = [](const auto& numbers) {
    return std::string(reinterpret_cast<const char*>(numbers.data()), sizeof(numbers[0]) * numbers.size());
  };
  std::string normals;
  for (int i = 0; i < 4; ++i) normals += std::string("\0\0\x7f\0", 4);
  const std::vector<std::uint16_t> corners(parts.corners.begin(), parts.corners.end());
  const std::string whole = bytesOf(parts.positions) + normals + bytesOf(corners);
  parts.buffers_end = R"({"byteLength":76,"uri":"data:;base64,)" + base64(whole) +
                      R"(","extensions":{"EXT_meshopt_compression":{"fallback":true}}})";
  parts.cut_bytes = 10;  // which nobody looks at
  expectWhole(parts);
}

TEST_F(GltfPacked, WhatCannotBeUnpackedIsNamed) {
  const std::string view = pathOf("t.gltf") + ": EXT_meshopt_compression: view ";
  Parts parts;
  parts.cut_bytes = 4;
  EXPECT_EQ(errorOfParts(parts), view + "2: reaches beyond its buffer");
  // The later of two equal words counts.
  parts = Parts();
  parts.more_of_positions = R"(,"count":5)";
  EXPECT_EQ(errorOfParts(parts), view + "0: has 48 bytes, but its packed elements come to 5 × 12");
  parts.more_of_positions = R"(,"mode":"TRIANGLES")";
  EXPECT_EQ(errorOfParts(parts), view + "0: indices must have 2 or 4 bytes, not 12");
  parts.more_of_positions = R"(,"mode":"MESHES")";
  EXPECT_EQ(errorOfParts(parts), view + "0: its mode must be ATTRIBUTES, TRIANGLES or INDICES, not MESHES");
  parts.more_of_positions = R"(,"filter":"QUATERNION")";
  EXPECT_EQ(errorOfParts(parts), view + "0: filter QUATERNION is not known for ATTRIBUTES of 12 bytes");
  parts.more_of_positions = R"(,"byteStride":6,"count":8)";
  EXPECT_EQ(errorOfParts(parts), view + "0: elements of attributes must have 4, 8, … 256 bytes, not 6");
  parts.more_of_positions = R"(,"byteLength":20)";
  EXPECT_EQ(
      errorOfParts(parts),
      view + "0: cannot be unpacked: its bytes are cut off, not what its mode says, or of a later version");
  parts = Parts();
  parts.buffers_end =
      R"({"byteLength":4294967295,"extensions":{"EXT_meshopt_compression":{"fallback":true}}})";
  EXPECT_EQ(errorOfParts(parts), pathOf("t.gltf") + ": buffer 1 is packed, and of more than 1 GiB");
}

}  // namespace
}  // namespace sunlit::scene
