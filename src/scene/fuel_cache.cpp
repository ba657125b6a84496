#include "scene/fuel_cache.h"

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <filesystem>
#include <sstream>

#include "scene/uri_text.h"

namespace sunlit::scene {
namespace {

namespace fs = std::filesystem;

/// Fuel moved from the second to the first; models that were loaded from one lie under its name.
constexpr const char* kServers[] = {"fuel.gazebosim.org", "fuel.ignitionrobotics.org"};

/// The number that all of `text` is; 0 where it is none.
int numberOf(const std::string& text) {
  int number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return error == std::errc() && end == text.data() + text.size() && number > 0 ? number : 0;
}

bool isInterfaceVersion(const std::string& part) {
  return !part.empty() && part.find_first_not_of("0123456789.") == std::string::npos;
}

/// The names of `folder`'s folders that are numbers, the largest.
int newestVersion(const fs::path& folder) {
  int newest = 0;
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error))
    newest = std::max(newest, numberOf(entry->path().filename().string()));
  return newest;
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
    if (!part.empty()) parts.push_back(withoutEscapes(part));
  }
  if (parts.size() > 1 && isInterfaceVersion(parts[1])) parts.erase(parts.begin() + 1);
  if (parts.size() < 4 || (parts[2] != "models" && parts[2] != "worlds")) return std::nullopt;
  if (std::find(parts.begin(), parts.end(), "..") != parts.end()) return std::nullopt;
  FuelAddress address{parts[0], parts[1], parts[2], parts[3]};
  std::size_t next = 4;
  if (next < parts.size() && (parts[next] == "tip" || numberOf(parts[next]) > 0))
    address.version = numberOf(parts[next++]);
  if (next < parts.size() && parts[next] == "files") ++next;
  fs::path within;
  for (; next < parts.size(); ++next) within /= parts[next];
  address.within = within.string();
  return address;
}

std::vector<std::string> fuelPlaces(const FuelAddress& address, const std::vector<std::string>& caches) {
  std::vector<std::string> servers = {address.server};
  if (std::find(std::begin(kServers), std::end(kServers), address.server) != std::end(kServers))
    servers.insert(servers.end(), std::begin(kServers), std::end(kServers));
  std::vector<std::string> places;
  const auto add = [&](const fs::path& model) {
    const int version = address.version > 0 ? address.version : newestVersion(model);
    const fs::path folder = version > 0 ? model / std::to_string(version) : model / "tip";
    const std::string place = (address.within.empty() ? folder : folder / address.within).string();
    if (std::find(places.begin(), places.end(), place) == places.end()) places.push_back(place);
  };
  for (const std::string& cache : caches) {
    for (const std::string& server : servers) {
      add(fs::path(cache) / server / lowerCase(address.owner) / address.kind / lowerCase(address.name));
      add(fs::path(cache) / server / address.owner / address.kind / address.name);
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
