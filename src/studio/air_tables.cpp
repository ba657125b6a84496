#include "studio/air_tables.h"

#include <cstring>
#include <stdexcept>
#include <string>
#include <system_error>
#include <vector>

#include "studio/tell.h"
#include "sunlit/image/cache_folder.h"
#include "sunlit/image/content_hash.h"
#include "sunlit/image/file_bytes.h"
#include "sunlit/image/files.h"

namespace sunlit::studio {
namespace {

namespace fs = std::filesystem;

constexpr const char* kEnding = ".air";
constexpr std::uintmax_t kLimit_bytes = 100'000'000;

/// What a file holds: the numbers, and behind them what tells whether they are whole and of this name.
image::ContentHash::Number sealOf(const std::string& name, const std::vector<float>& numbers) {
  image::ContentHash hash;
  hash.addBytes(name.data(), name.size());
  hash.add(numbers);
  return hash.number();
}

fs::path fileOf(const fs::path& folder, const std::string& name) {
  image::ContentHash hash;
  hash.addBytes(name.data(), name.size());
  return folder / (hash.text() + kEnding);
}

std::vector<float> read(const fs::path& folder, const std::string& name) {
  const fs::path file = fileOf(folder, name);
  std::error_code none;
  if (!fs::exists(file, none)) return {};
  const image::CacheUse in_use(file);
  const image::FileBytes bytes(file);
  image::ContentHash::Number seal{};
  if (bytes.size() < sizeof(seal) || (bytes.size() - sizeof(seal)) % sizeof(float) != 0) return {};
  std::vector<float> numbers((bytes.size() - sizeof(seal)) / sizeof(float));
  std::memcpy(numbers.data(), bytes.data(), bytes.size() - sizeof(seal));
  std::memcpy(&seal, bytes.data() + bytes.size() - sizeof(seal), sizeof(seal));
  return seal == sealOf(name, numbers) ? numbers : std::vector<float>();
}

void write(const fs::path& folder, const std::string& name, const std::vector<float>& numbers) {
  fs::create_directories(folder);
  const fs::path file = fileOf(folder, name);
  const image::CacheTurn turn = image::CacheTurn::await(file);
  const image::ContentHash::Number seal = sealOf(name, numbers);
  std::string bytes(reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(float));
  bytes.append(reinterpret_cast<const char*>(&seal), sizeof(seal));
  image::writeFileAtomically(file, bytes);
}

}  // namespace

sky::TableStore airTablesIn(const fs::path& folder, const Reports& reports) {
  const auto warn = [reports](const std::string& line) { tell(reports.warning, line); };
  // What was left by a process that was killed goes, also where all tables are there.
  image::CacheFolder{folder, kEnding}.tidy(kLimit_bytes, nullptr);
  sky::TableStore store;
  store.find = [folder](const std::string& name) -> std::vector<float> {
    try {
      return read(folder, name);
    } catch (const std::exception&) {
      return {};  // keeping them anew will say what is amiss
    }
  };
  store.keep = [folder, warn](const std::string& name, const std::vector<float>& numbers) {
    try {
      write(folder, name, numbers);
      image::CacheFolder{folder, kEnding}.tidy(kLimit_bytes, warn);
    } catch (const std::exception& problem) {
      warn(std::string("tables of the air are not kept: ") + problem.what());
    }
  };
  return store;
}

}  // namespace sunlit::studio
