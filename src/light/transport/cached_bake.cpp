// A bake is looked for on disk first, and left there.
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <stdexcept>

#include "light/transport/cache_file.h"
#include "light/transport/cache_folder.h"
#include "sunlit/light/transport.h"

namespace sunlit::light {
namespace {

namespace fs = std::filesystem;
using Log = std::function<void(const std::string&)>;

std::unique_ptr<TransportData> readIfThere(const fs::path& file, const scene::ContentHash& key,
                                           const Log& log) {
  std::error_code error;
  if (!fs::exists(file, error)) return nullptr;
  try {
    return readBake(file, key);
  } catch (const std::exception& problem) {
    if (log) log(std::string("baked light is made anew: ") + problem.what());
    return nullptr;
  }
}

/// Empty if the folder can't be used.
std::optional<fs::path> usableFolder(const std::string& folder, const Log& log) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (!error) return fs::path(folder);
  if (log) log("baked light is not kept: " + folder + ": " + error.message());
  return std::nullopt;
}

std::optional<BakeTurn> turnFor(const fs::path& file, const Log& log) {
  try {
    return BakeTurn::await(file);
  } catch (const std::exception& problem) {
    if (log) log(std::string("baked light is not kept: ") + problem.what());
    return std::nullopt;
  }
}

void keep(const fs::path& file, const scene::ContentHash& key, const TransportData& data, const Log& log) {
  try {
    writeBake(file, key, data);
  } catch (const std::exception& problem) {
    if (log) log(std::string("baked light is not kept: ") + problem.what());
  }
}

/// What cached() gives away: as long as it is used, its file stays.
struct KeptTransport {
  std::optional<BakeInUse> in_use;
  std::shared_ptr<const Transport> transport;
};

}  // namespace

std::string Transport::usualFolder() {
  const auto value = [](const char* name) {
    return std::getenv(name) ? std::string(std::getenv(name)) : std::string();
  };
  if (!value("SUNLIT_CACHE_DIR").empty()) return value("SUNLIT_CACHE_DIR");
  if (!value("XDG_CACHE_HOME").empty()) return fs::path(value("XDG_CACHE_HOME")) / "sunlit";
  if (!value("HOME").empty()) return fs::path(value("HOME")) / ".cache" / "sunlit";
  return fs::temp_directory_path() / "sunlit";
}

std::shared_ptr<const Transport> Transport::cached(std::shared_ptr<const Geometry> geometry,
                                                   const TransportOptions& options, const BakeCache& cache,
                                                   const BakeListener& listener) {
  const auto& [progress, log] = listener;
  validate(options);
  const std::optional<fs::path> folder = usableFolder(cache.folder, log);
  if (!folder) return bake(std::move(geometry), options, progress);
  const scene::ContentHash key = bakeKey(*geometry, options);
  const fs::path file = *folder / (key.text() + ".light");
  auto kept = std::make_shared<KeptTransport>();
  kept->in_use.emplace(file);  // from here on nobody removes it
  std::unique_ptr<TransportData> data = readIfThere(file, key, nullptr);
  std::optional<BakeTurn> turn;
  if (!data) {
    turn = turnFor(file, log);
    if (!turn) return bake(std::move(geometry), options, progress);
    data = readIfThere(file, key, log);  // another process may have finished it meanwhile
  }
  if (data) {
    kept->transport = std::make_shared<const Transport>(std::move(geometry), options, std::move(data));
  } else {
    kept->transport = bake(std::move(geometry), options, progress);
    keep(file, key, *kept->transport->data_, log);
  }
  kept->in_use.emplace(file);  // which may have come only now
  turn.reset();
  tidyCache(*folder, cache.limit_bytes, log);
  return {kept, kept->transport.get()};
}

}  // namespace sunlit::light
