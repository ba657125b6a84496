// Baked light on disk, as it stands and with a checksum that is right for what it holds.
#include <cstring>

#include "fuzz/reader.h"
#include "light/bake/cache/cache_file.h"
#include "sunlit/image/content_hash.h"
#include "support/temporary_folder.h"

namespace sunlit::fuzz {

std::vector<std::string> seeds() {
  const TemporaryFolder folder;
  light::TransportData data;
  data.mesh.roots.own() = {{0, light::LightMesh::kNone}};
  data.mesh.cells.resize(1);
  data.mesh.first_share.own() = {0, 1, 2, 3};
  data.mesh.shares.own() = {{0, 1.0f}, {0, 1.0f}, {0, 1.0f}};
  data.direct.resize(1);
  data.above.resize(1);
  data.below.resize(1);
  image::ContentHash key;
  light::writeBake(folder.file("seed"), key, data);
  return {contentOf(folder.file("seed"))};
}

void read(const std::string& input) {
  setContent("./input.bake", input);
  image::ContentHash key;
  light::readBake("input.bake", key);
}

std::string named() {
  return "input.bake";
}

}  // namespace sunlit::fuzz
