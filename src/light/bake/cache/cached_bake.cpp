// A bake is looked for on disk first, and left there.
#include <cmath>
#include <filesystem>
#include <optional>
#include <stdexcept>
#include <system_error>
#include <utility>

#include "light/bake/cache/cache_file.h"
#include "sunlit/image/cache_folder.h"
#include "sunlit/light/transport.h"
#include "sunlit/quantity/memory.h"

namespace sunlit::light {
namespace {

namespace fs = std::filesystem;
using Log = image::CacheFolder::Log;

constexpr const char* kEnding = ".light";

std::unique_ptr<const TransportData> readIfThere(const fs::path& file, const image::ContentHash& key,
                                                 const Log& log) {
  std::error_code error;
  if (!fs::exists(file, error)) return nullptr;
  try {
    return readBake(file, key);
  } catch (const std::exception& problem) {
    if (log) log("baked light is made anew: " + reasonInWords(problem));
    return nullptr;
  }
}

void tellNotKept(const std::exception& problem, const Log& log) {
  if (log) log(image::notKeptText("baked light is", problem));
}

/// Empty if the folder can't be used.
std::optional<fs::path> usableFolder(const std::string& folder, const Log& log) {
  try {
    fs::create_directories(folder);
    return fs::path(folder);
  } catch (const fs::filesystem_error& problem) {
    tellNotKept(problem, log);
    return std::nullopt;
  }
}

std::optional<image::CacheTurn> turnFor(const fs::path& file, const BakeListener& listener) {
  bool is_noted = false;
  const auto waits = [&](const image::CacheProgress& other) {
    if (listener.note && !std::exchange(is_noted, true))
      listener.note("Another process bakes the light of this world: waiting for " + file.string());
    if (listener.check) listener.check();
    if (listener.progress && !std::isnan(other.share)) listener.progress(other.share, other.seconds_left);
  };
  try {
    return image::CacheTurn::await(file, waits);
  } catch (const std::system_error& problem) {
    tellNotKept(problem, listener.log);
    return std::nullopt;
  }
}

void keep(const fs::path& file, const image::ContentHash& key, const TransportData& data, const Log& log) {
  try {
    writeBake(file, key, data);
  } catch (const std::exception& problem) {
    tellNotKept(problem, log);
  }
}

/// What cached() gives away: as long as it is used, its file stays.
struct KeptTransport {
  std::optional<image::CacheUse> in_use;
  std::shared_ptr<const Transport> transport;
};

}  // namespace

std::uintmax_t BakeCache::usedBytes() const {
  return image::CacheFolder{folder, kEnding}.usedBytes();
}

std::shared_ptr<const Transport> Transport::cached(std::shared_ptr<const Geometry> geometry,
                                                   const TransportOptions& options, const BakeCache& cache,
                                                   const BakeListener& listener) {
  const Log& log = listener.log;
  validate(options);
  const std::optional<fs::path> folder = usableFolder(cache.folder, log);
  if (!folder) return bake(std::move(geometry), options, listener.progress);
  const image::ContentHash key = bakeKey(*geometry, options);
  const fs::path file = *folder / (key.text() + kEnding);
  auto kept = std::make_shared<KeptTransport>();
  kept->in_use.emplace(file);  // from here on nobody removes it
  std::unique_ptr<const TransportData> data = readIfThere(file, key, nullptr);
  std::optional<image::CacheTurn> turn;
  if (!data) {
    turn = turnFor(file, listener);
    if (!turn) return bake(std::move(geometry), options, listener.progress);
    data = readIfThere(file, key, log);  // another process may have finished it meanwhile
  }
  if (!data) {
    const auto progress = [&](double share, double seconds_left) {
      turn->tell({share, seconds_left});
      if (listener.progress) listener.progress(share, seconds_left);
    };
    kept->transport = bake(std::move(geometry), options, progress);
    keep(file, key, *kept->transport->data_, log);
    data = readIfThere(file, key, nullptr);  // whose memory is shared
  }
  if (data) kept->transport = std::make_shared<const Transport>(options, std::move(data));
  kept->in_use.emplace(file);  // which may have come only now
  turn.reset();
  image::CacheFolder{*folder, kEnding}.tidy(cache.limit_bytes, log);
  return {kept, kept->transport.get()};
}

}  // namespace sunlit::light
