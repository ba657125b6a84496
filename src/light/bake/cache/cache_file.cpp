#include "light/bake/cache/cache_file.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <stdexcept>
#include <type_traits>
#include <utility>

#include "light/bake/samples/transport_arrays.h"
#include "sunlit/image/file_bytes.h"
#include "sunlit/image/kept_array.h"
#include "sunlit/image/unfinished_file.h"

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
  std::array<std::uint64_t, 35> counts;  ///< of the arrays, in the order of visitArrays()
  Number checksum;                       ///< of all that follows
};
static_assert(sizeof(Header) == 328, "no padding goes to the file");

[[noreturn]] void fail(const fs::path& file, const std::string& what) {
  throw std::runtime_error(file.string() + ": " + what);
}

template <typename Array>
void addTo(const Array& values, image::ContentHash* checksum) {
  checksum->add(static_cast<std::uint64_t>(values.size()));
  checksum->addBytes(values.data(), values.size() * sizeof(values[0]));
}

/// The header, if the file is as long as it says.
Header checkedHeader(const fs::path& file, const image::FileBytes& bytes, const image::ContentHash& key) {
  Header header;
  if (bytes.size() < sizeof(header)) fail(file, "is no baked light");
  std::memcpy(&header, bytes.data(), sizeof(header));
  if (std::memcmp(header.magic, kMagic, sizeof(kMagic)) != 0) fail(file, "is no baked light");
  if (header.version != kBakeVersion || header.patches != SkyPatches::kCount)
    fail(file, "is of another version");
  if (header.key != key.number()) fail(file, "is of another scene");
  std::size_t expected = sizeof(header), array = 0;
  const TransportData empty;
  visitArrays(empty, [&](const auto& values) {
    const std::uint64_t count = header.counts.at(array++);
    if (count >> 40 != 0) fail(file, "is damaged");  // and the sum of sizes would overflow
    expected = image::aligned(expected) + count * sizeof(values[0]);
  });
  if (bytes.size() != expected)
    fail(file, bytes.size() < expected ? "is cut short" : "is longer than it should be");
  return header;
}

}  // namespace

std::unique_ptr<const TransportData> readBake(const fs::path& file, const image::ContentHash& key) {
  const auto bytes = std::make_shared<const image::FileBytes>(file);
  const Header header = checkedHeader(file, *bytes, key);
  auto data = std::make_unique<TransportData>();
  image::ContentHash checksum;
  std::size_t offset = sizeof(header), array = 0;
  visitArrays(*data, [&](auto& values) {
    using Array = std::remove_reference_t<decltype(values)>;
    using Value = std::remove_cv_t<std::remove_reference_t<decltype(values[0])>>;
    const std::uint64_t count = header.counts.at(array++);
    offset = image::aligned(offset);
    values = Array(reinterpret_cast<const Value*>(bytes->data() + offset), count, bytes);
    offset += count * sizeof(Value);
    addTo(std::as_const(values), &checksum);
    std::as_const(values).letGo(0, count);
  });
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
    addTo(values, &checksum);
  });
  header.checksum = checksum.number();
  image::UnfinishedFile unfinished(file);
  unfinished.write(&header, sizeof(header));
  visitArrays(data, [&](const auto& values) {
    constexpr char kZeros[image::kKeptAlignment] = {};
    unfinished.write(kZeros, image::aligned(unfinished.size()) - unfinished.size());
    unfinished.write(values.data(), values.size() * sizeof(values[0]));
  });
  unfinished.keep();
}

}  // namespace sunlit::light
