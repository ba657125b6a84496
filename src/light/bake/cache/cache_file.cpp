#include "light/bake/cache/cache_file.h"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <stdexcept>
#include <system_error>

#include "sunlit/image/files.h"

namespace sunlit::light {
namespace {

namespace fs = std::filesystem;
using Number = image::ContentHash::Number;

constexpr char kMagic[8] = {'s', 'u', 'n', 'l', 'i', 't', 'T', '\n'};

struct Header {
  char magic[8];
  std::uint32_t version;
  std::uint32_t patches;
  Number key;
  std::array<std::uint64_t, 31> counts;  ///< of the arrays, in the order of visitArrays()
  Number checksum;                       ///< of all that follows
};
static_assert(sizeof(Header) == 296, "no padding goes to the file");

[[noreturn]] void fail(const fs::path& file, const std::string& what) {
  throw std::runtime_error(file.string() + ": " + what);
}

template <typename Data, typename Visit>
void visitArrays(Data& data, const Visit& visit) {
  visit(data.mesh.roots);
  visit(data.mesh.cells);
  visit(data.mesh.first_share);
  visit(data.mesh.shares);
  visit(data.direct.rows);
  visit(data.direct.scales);
  for (auto* part : {&data.above, &data.below}) {
    visit(part->coefficients.rows);
    visit(part->coefficients.scales);
    visit(part->tints);
    visit(part->glows);
    visit(part->hides);
  }
  visit(data.leaves.first);
  visit(data.leaves.grids);
  visit(data.lamps.first);
  visit(data.lamps.blocks);
  visit(data.lamps.light);
  visit(data.rooms.samples);
  visit(data.rooms.first);
  visit(data.rooms.below);
  visit(data.rooms.scales);
  visit(data.rooms.links);
  visit(data.rooms.mirrored.rows);
  visit(data.rooms.mirrored.scales);
  visit(data.rooms.sources);
  visit(data.rooms.points);
  visit(data.rooms.glossy);
}

}  // namespace

std::unique_ptr<TransportData> readBake(const fs::path& file, const image::ContentHash& key) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream) fail(file, "cannot be read");
  Header header;
  if (!stream.read(reinterpret_cast<char*>(&header), sizeof(header)) ||
      std::memcmp(header.magic, kMagic, sizeof(kMagic)) != 0)
    fail(file, "is no baked light");
  if (header.version != kBakeVersion || header.patches != SkyPatches::kCount)
    fail(file, "is of another version");
  if (header.key != key.number()) fail(file, "is of another scene");
  auto data = std::make_unique<TransportData>();
  const std::uint64_t size = fs::file_size(file);
  std::uint64_t expected = sizeof(header);
  std::size_t array = 0;
  visitArrays(*data, [&](auto& values) {
    const std::uint64_t count = header.counts.at(array++);
    if (count >> 40 != 0) fail(file, "is damaged");  // and the sum of sizes would overflow
    expected += count * sizeof(values[0]);
  });
  if (size != expected) fail(file, size < expected ? "is cut short" : "is longer than it should be");
  image::ContentHash checksum;
  array = 0;
  visitArrays(*data, [&](auto& values) {
    values.resize(header.counts.at(array++));
    stream.read(reinterpret_cast<char*>(values.data()),
                static_cast<std::streamsize>(values.size() * sizeof(values[0])));
    checksum.add(values);
  });
  if (!stream) fail(file, "cannot be read to its end");
  if (checksum.number() != header.checksum) fail(file, "is damaged");
  return data;
}

void writeBake(const fs::path& file, const image::ContentHash& key, const TransportData& data) {
  Header header{};
  std::memcpy(header.magic, kMagic, sizeof(kMagic));
  header.version = kBakeVersion;
  header.patches = SkyPatches::kCount;
  header.key = key.number();
  image::ContentHash checksum;
  std::size_t array = 0;
  visitArrays(data, [&](const auto& values) {
    header.counts.at(array++) = values.size();
    checksum.add(values);
  });
  header.checksum = checksum.number();
  const fs::path unfinished = file.string() + "." + std::to_string(getpid()) + ".part";
  errno = 0;
  std::ofstream stream(unfinished, std::ios::binary | std::ios::trunc);
  stream.write(reinterpret_cast<const char*>(&header), sizeof(header));
  visitArrays(data, [&](const auto& values) {
    stream.write(reinterpret_cast<const char*>(values.data()),
                 static_cast<std::streamsize>(values.size() * sizeof(values[0])));
  });
  stream.close();
  std::error_code ignored;
  if (!stream) {
    const std::string reason = errno != 0 ? ": " + image::reasonOf(errno) : "";
    fs::remove(unfinished, ignored);
    fail(file, "cannot be written" + reason);
  }
  try {
    image::moveIntoPlace(unfinished, file);
  } catch (const std::runtime_error&) {
    fs::remove(unfinished, ignored);
    throw;
  }
}

}  // namespace sunlit::light
