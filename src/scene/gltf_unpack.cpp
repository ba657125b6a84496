#include "scene/gltf_unpack.h"

#include <meshoptimizer.h>

#include <map>
#include <stdexcept>
#include <string>
#include <utility>

#include "scene/gltf_json.h"

namespace sunlit::scene {
namespace {

using nlohmann::json;

/// Of a packed view: where it is, and what comes of it.
struct Packed {
  std::size_t buffer, begin, length;  ///< bytes
  std::size_t stride, count;          ///< of its elements
  std::string mode, filter;

  std::size_t unpackedBytes() const { return stride * count; }
};

Packed packedOf(const json& words) {
  return {indexOf(words.at("buffer")),     indexOf(words, "byteOffset", 0),
          indexOf(words.at("byteLength")), indexOf(words.at("byteStride")),
          indexOf(words.at("count")),      words.at("mode").get<std::string>(),
          words.value("filter", "NONE")};
}

/// What the library takes for granted. The bytes that a view comes to are known, and few enough, by now.
void require(const Packed& packed) {
  const bool attributes = packed.mode == "ATTRIBUTES", triangles = packed.mode == "TRIANGLES";
  if (!attributes && !triangles && packed.mode != "INDICES")
    throw std::runtime_error("its mode must be ATTRIBUTES, TRIANGLES or INDICES, not " + packed.mode);
  const std::size_t stride = packed.stride;
  if (attributes && (stride == 0 || stride % 4 != 0 || stride > 256))
    throw std::runtime_error("elements of attributes must have 4, 8, … 256 bytes, not " +
                             std::to_string(stride));
  if (!attributes && stride != 2 && stride != 4)
    throw std::runtime_error("indices must have 2 or 4 bytes, not " + std::to_string(stride));
  if (triangles && packed.count % 3 != 0)
    throw std::runtime_error("its triangles must have three corners each");
  if (packed.filter == "NONE") return;
  const bool of_filter = (packed.filter == "OCTAHEDRAL" && (stride == 4 || stride == 8)) ||
                         (packed.filter == "QUATERNION" && stride == 8) || packed.filter == "EXPONENTIAL";
  if (!attributes || !of_filter)
    throw std::runtime_error("filter " + packed.filter + " is not known for " + packed.mode + " of " +
                             std::to_string(stride) + " bytes");
}

std::string unpacked(const Packed& packed, const std::string& bytes) {
  if (packed.begin > bytes.size() || packed.length > bytes.size() - packed.begin)
    throw std::runtime_error("reaches beyond its buffer");
  const auto* const from = reinterpret_cast<const unsigned char*>(bytes.data()) + packed.begin;
  std::string out(packed.unpackedBytes(), '\0');
  int (*unpack)(void*, std::size_t, std::size_t, const unsigned char*, std::size_t) =
      meshopt_decodeVertexBuffer;
  if (packed.mode == "TRIANGLES") unpack = meshopt_decodeIndexBuffer;
  if (packed.mode == "INDICES") unpack = meshopt_decodeIndexSequence;
  if (unpack(out.data(), packed.count, packed.stride, from, packed.length) != 0)
    throw std::runtime_error(
        "cannot be unpacked: its bytes are cut off, not what its mode says, or of a later version");
  if (packed.filter == "OCTAHEDRAL") meshopt_decodeFilterOct(out.data(), packed.count, packed.stride);
  if (packed.filter == "QUATERNION") meshopt_decodeFilterQuat(out.data(), packed.count, packed.stride);
  if (packed.filter == "EXPONENTIAL") meshopt_decodeFilterExp(out.data(), packed.count, packed.stride);
  return out;
}

/// The content of `view`, which is some of the `room` bytes of its own buffer.
std::string unpackedView(const json& view, std::size_t room, GltfBuffers& buffers) {
  const Packed packed = packedOf(extension(view, packingOf(view)));
  const std::size_t length = indexOf(view.at("byteLength")), begin = indexOf(view, "byteOffset", 0);
  if (begin > room || length > room - begin) throw std::runtime_error("reaches beyond its buffer");
  if (packed.stride > length || packed.count > length || packed.unpackedBytes() != length)
    throw std::runtime_error("has " + std::to_string(length) + " bytes, but its packed elements come to " +
                             std::to_string(packed.count) + " × " + std::to_string(packed.stride));
  require(packed);
  return unpacked(packed, buffers.bytes(packed.buffer));
}

/// Buffers that are nowhere, with room for what comes to them.
std::map<std::size_t, std::string> emptyBuffers(const json& root) {
  constexpr std::size_t kMost_bytes = std::size_t{1} << 30;
  std::map<std::size_t, std::string> empty;
  const json& buffers = child(root, "buffers");
  for (std::size_t i = 0; buffers.is_array() && i < buffers.size(); ++i) {
    const char* const packing = packingOf(buffers[i]);
    if (packing == nullptr || buffers[i].contains("uri")) continue;
    if (!extension(buffers[i], packing).value("fallback", false)) continue;
    const std::size_t bytes = indexOf(buffers[i].at("byteLength"));
    if (bytes > kMost_bytes)
      throw std::runtime_error("buffer " + std::to_string(i) + " is packed, and of more than 1 GiB");
    empty[i].resize(bytes);
  }
  return empty;
}

}  // namespace

bool unpacks() {
  return true;
}

bool unpackViews(json& root, GltfBuffers& buffers) {
  std::map<std::size_t, std::string> made = emptyBuffers(root);
  if (made.empty()) return false;
  const json& views = child(root, "bufferViews");
  for (std::size_t i = 0; i < views.size(); ++i) {
    const auto to = made.find(indexOf(views.at(i), "buffer", views.size()));
    const char* const packing = packingOf(views[i]);
    if (to == made.end() || packing == nullptr) continue;
    try {
      const std::string bytes = unpackedView(views[i], to->second.size(), buffers);
      to->second.replace(indexOf(views[i], "byteOffset", 0), bytes.size(), bytes);
    } catch (const std::runtime_error& error) {
      throw std::runtime_error(std::string(packing) + ": view " + std::to_string(i) + ": " + error.what());
    }
  }
  for (auto& [buffer, bytes] : made) buffers.make(buffer, std::move(bytes));
  return true;
}

}  // namespace sunlit::scene
