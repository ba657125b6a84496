// A bake is looked for on disk first, and left there.
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <stdexcept>

#include "light/transport/cache_file.h"
#include "sunlit/light/transport.h"

namespace sunlit::light {
namespace {

namespace fs = std::filesystem;
using Log = std::function<void(const std::string&)>;

std::unique_ptr<TransportData> readIfThere(const fs::path& file, const ContentHash& key, const Log& log) {
  std::error_code error;
  if (!fs::exists(file, error)) return nullptr;
  try {
    return readBake(file, key);
  } catch (const std::exception& problem) {
    if (log) log(std::string("baked light is made anew: ") + problem.what());
    return nullptr;
  }
}

/// The turn of this process; empty if the folder can't be used.
std::optional<fs::path> usableFolder(const std::string& folder, const Log& log) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (!error) return fs::path(folder);
  if (log) log("baked light is not kept: " + folder + ": " + error.message());
  return std::nullopt;
}

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
                                                   const TransportOptions& options, const std::string& folder,
                                                   const BakeProgress& progress, const Log& log) {
  validate(options);
  const std::optional<fs::path> place = usableFolder(folder, log);
  if (!place) return bake(std::move(geometry), options, progress);
  const ContentHash key = bakeKey(*geometry, options);
  const fs::path file = *place / (key.text() + ".light");
  std::unique_ptr<TransportData> data = readIfThere(file, key, nullptr);
  std::unique_ptr<BakeLock> turn;
  if (!data) {
    try {
      turn = std::make_unique<BakeLock>(file.string() + ".lock");
    } catch (const std::exception& problem) {
      if (log) log(std::string("baked light is not kept: ") + problem.what());
      return bake(std::move(geometry), options, progress);
    }
    // Another process may have finished it meanwhile.
    data = readIfThere(file, key, log);
  }
  if (data) return std::make_shared<const Transport>(std::move(geometry), std::move(data));
  std::shared_ptr<const Transport> baked = bake(std::move(geometry), options, progress);
  try {
    writeBake(file, key, *baked->data_);
  } catch (const std::exception& problem) {
    if (log) log(std::string("baked light is not kept: ") + problem.what());
  }
  return baked;
}

}  // namespace sunlit::light
