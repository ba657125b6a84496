#include "scene/fuel_cache.h"

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <filesystem>
#include <sstream>

#include "scene/sdf_model_folder.h"
#include "scene/uri_text.h"

namespace sunlit::scene {
namespace {

namespace fs = std::filesystem;

/// Fuel moved from the second to the first; models that were loaded from one lie under its name.
constexpr const char* kServers[] = {"fuel.gazebosim.org", "fuel.ignitionrobotics.org"};

/// The number that all of `text` is; 0 where it is none.
int versionOf(const std::string& text) {
  int number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return error == std::errc() && end == text.data() + text.size() && number > 0 ? number : 0;
}

bool isInterfaceVersion(const std::string& part) {
  return !part.empty() && part.find_first_not_of("0123456789.") == std::string::npos;
}

/// Whether all of a version is there that was to be: an interrupted download leaves an empty folder, or one
/// without the file that is unpacked last.
bool isComplete(const fs::path& version, const std::string& kind) {
  std::error_code error;
  return kind == "models" ? !modelFileOf(version.string()).empty() : !fs::is_empty(version, error) && !error;
}

/// The names of `folder`'s folders that are numbers, the largest of those that are complete.
int newestVersion(const fs::path& folder, const std::string& kind) {
  int newest = 0;
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
    const int version = versionOf(entry->path().filename().string());
    if (version > newest && isComplete(entry->path(), kind)) newest = version;
  }
  return newest;
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
    text.replace(at, from.size(), to);
  return text;
}

/// How a part of an address may be spelt on disk: some tools decode it, some keep it, some encode blanks.
std::string spelt(const std::string& part, int way) {
  if (way == 1) return part;
  const std::string decoded = withoutEscapes(part);
  return way == 0 ? decoded : replaced(decoded, " ", "%20");
}
constexpr int kWays = 3;

/// Whether a part of an address, decoded, is one name of a file or folder.
bool isName(const std::string& part) {
  return part != "." && part != ".." && part.find_first_of(std::string("/\0", 2)) == std::string::npos;
}

/// The folders of a server: Fuel's have two names, and some tools encode the colon before a port.
std::vector<std::string> foldersOf(const std::string& server) {
  std::vector<std::string> folders = {server};
  if (std::find(std::begin(kServers), std::end(kServers), server) != std::end(kServers))
    folders.insert(folders.end(), std::begin(kServers), std::end(kServers));
  folders.push_back(replaced(server, ":", "%3A"));
  return folders;
}

}  // namespace

std::optional<FuelAddress> fuelAddress(const std::string& uri) {
  const std::size_t scheme = uri.find("://");
  if (scheme == std::string::npos ||
      (uri.compare(0, scheme, "https") != 0 && uri.compare(0, scheme, "http") != 0))
    return std::nullopt;
  std::vector<std::string> parts;
  std::istringstream rest(uri.substr(scheme + 3));
  for (std::string part; std::getline(rest, part, '/');) {
    if (part.empty()) continue;
    if (!isName(withoutEscapes(part))) return std::nullopt;
    parts.push_back(part);
  }
  if (parts.size() > 1 && isInterfaceVersion(parts[1])) parts.erase(parts.begin() + 1);
  if (parts.size() < 4 || (parts[2] != "models" && parts[2] != "worlds")) return std::nullopt;
  FuelAddress address{withoutEscapes(parts[0]), parts[1], parts[2], parts[3]};
  std::size_t next = 4;
  if (next < parts.size() && (parts[next] == "tip" || versionOf(parts[next]) > 0))
    address.version = versionOf(parts[next++]);
  if (next < parts.size() && parts[next] == "files") ++next;
  fs::path within;
  for (; next < parts.size(); ++next) within /= parts[next];
  address.within = within.string();
  return address;
}

std::vector<std::string> fuelPlaces(const FuelAddress& address, const std::vector<std::string>& caches) {
  std::vector<std::string> places;
  const auto add = [&](const fs::path& model) {
    const int version = address.version > 0 ? address.version : newestVersion(model, address.kind);
    const fs::path folder = version > 0 ? model / std::to_string(version) : model / "tip";
    for (const std::string& within : {withoutEscapes(address.within), address.within}) {
      const std::string place = (within.empty() ? folder : folder / within).string();
      if (std::find(places.begin(), places.end(), place) == places.end()) places.push_back(place);
    }
  };
  for (const std::string& cache : caches) {
    for (const std::string& server : foldersOf(address.server)) {
      for (int way = 0; way < kWays; ++way) {
        const std::string owner = spelt(address.owner, way), name = spelt(address.name, way);
        add(fs::path(cache) / server / lowerCase(owner) / address.kind / lowerCase(name));
        add(fs::path(cache) / server / owner / address.kind / name);
      }
    }
  }
  return places;
}

std::vector<std::string> fuelCachesOfEnvironment() {
  std::vector<std::string> caches;
  for (const char* variable : {"GZ_FUEL_CACHE_PATH", "IGN_FUEL_CACHE_PATH"}) {
    const char* value = std::getenv(variable);
    if (value != nullptr && *value != '\0') caches.emplace_back(value);
  }
  if (const char* home = std::getenv("HOME")) {
    for (const char* folder : {"/.gz/fuel", "/.ignition/fuel"}) caches.push_back(std::string(home) + folder);
  }
  return caches;
}

}  // namespace sunlit::scene
