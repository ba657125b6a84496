#include "scene/resource_finder.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <filesystem>
#include <sstream>
#include <utility>

#include "scene/fuel_cache.h"
#include "scene/package_folder.h"
#include "scene/sdf_model_folder.h"
#include "scene/uri_text.h"

namespace sunlit::scene {
namespace fs = std::filesystem;
namespace {

constexpr const char* kPackageScheme = "package://";
constexpr const char* kFileScheme = "file:/";  // and, mostly, another slash
constexpr const char* kNotFetched =
    "; nothing is fetched from the network, `gz fuel download -u ADDRESS` does that";

/// As many a person reads of the places where something was looked for.
constexpr std::size_t kNamedPlaces = 3;

bool isThere(const fs::path& path, Wanted wanted) {
  std::error_code error;
  if (!fs::exists(path, error)) return false;
  return wanted != Wanted::kModel || !modelFileOf(path.string()).empty();
}

/// The entry of `path`'s folder whose name differs from path's in case only.
std::optional<fs::path> inOtherCase(const fs::path& path) {
  std::error_code error;
  const std::string wanted = lowerCase(path.filename().string());
  std::vector<fs::path> matches;
  for (fs::directory_iterator entry(path.parent_path(), error), end; !error && entry != end;
       entry.increment(error)) {
    if (lowerCase(entry->path().filename().string()) == wanted) matches.push_back(entry->path());
  }
  if (matches.empty()) return std::nullopt;
  return *std::min_element(matches.begin(), matches.end());  // folders are listed in no order
}

/// Tries `candidates` as written, then ignoring the case of the file name.
Found firstOf(const std::vector<fs::path>& candidates, Wanted wanted = Wanted::kAnything) {
  Found found;
  for (const fs::path& candidate : candidates) {
    const std::string place = candidate.lexically_normal().string();
    if (std::find(found.tried.begin(), found.tried.end(), place) != found.tried.end()) continue;
    found.tried.push_back(place);
    if (isThere(candidate, wanted)) {
      found.file = place;
      return found;
    }
  }
  for (const std::string& place : found.tried) {
    const auto other = inOtherCase(place);
    if (other && isThere(*other, wanted)) {
      found.file = other->string();
      found.other_case = true;
      return found;
    }
  }
  return found;
}

/// Whether it begins with a scheme, as model://.
bool isAddress(const std::string& text) {
  const std::size_t colon = text.find_first_of(":/");
  return colon != std::string::npos && text.compare(colon, 3, "://") == 0;
}

/// The folder of `file` and all its parents, nearest first. Another address than file:// lies in none.
std::vector<std::string> folderAndParents(const std::string& file) {
  std::vector<std::string> folders;
  if (isAddress(file) && file.rfind(kFileScheme, 0) != 0) return folders;
  std::error_code error;
  const std::string path = file.rfind(kFileScheme, 0) == 0 ? withoutScheme(file) : file;
  fs::path folder = fs::absolute(path, error).lexically_normal().parent_path();
  while (!folder.empty()) {
    folders.push_back(folder.string());
    if (folder == folder.root_path()) break;
    folder = folder.parent_path();
  }
  return folders;
}

/// With / where Windows has \, and without escapes.
std::string plainAddress(const std::string& uri) {
  if (fuelAddress(uri)) return uri;  // which has its own rules
  std::string plain = withoutEscapes(uri);
  std::replace(plain.begin(), plain.end(), '\\', '/');
  return plain;
}

/// Of the two models of Fuel that most worlds of gz-sim begin with: by which name they are kept without it.
std::string stockModel(const FuelAddress& address) {
  if (lowerCase(address.owner) != "openrobotics" || address.kind != "models" || !address.within.empty())
    return "";
  const std::string name = lowerCase(withoutEscapes(address.name));
  return name == "ground plane" ? "ground_plane" : name == "sun" ? "sun" : "";
}

/// "a, b and c".
std::string listed(const std::vector<std::string>& places) {
  std::ostringstream text;
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (i > 0) text << (i + 1 == places.size() ? " and " : ", ");
    text << places[i];
  }
  return text.str();
}

/// That of package://NAME/…; empty for others.
std::string packageOf(const std::string& uri) {
  if (uri.rfind(kPackageScheme, 0) != 0) return {};
  const fs::path path = withoutScheme(uri);
  return path.empty() ? "" : path.begin()->string();
}

/// Of a package that ROS does not know; nothing for none.
std::string noteOf(const std::string& package) {
  if (package.empty()) return package;
  return "; ROS knows no package " + package +
         ", neither below ROS_PACKAGE_PATH nor in /usr/share: is its workspace sourced?";
}

}  // namespace

ResourceFinder::ResourceFinder(const SearchPath& search_path, const std::string& scene_file)
    : roots_(folderAndParents(scene_file)),
      parents_(roots_.size() - std::min<std::size_t>(roots_.size(), 1)),
      package_folder_(search_path.package_folder),
      fuel_caches_(search_path.fuel_caches),
      missing_(search_path.missing) {
  roots_.insert(roots_.end(), search_path.folders.begin(), search_path.folders.end());
}

Found ResourceFinder::find(const std::string& uri, const std::string& from_file, Wanted wanted) const {
  Found found = findAsWritten(uri, from_file, wanted);
  const std::string plain = plainAddress(uri);
  if (found.file || plain == uri) return found;
  const Found meant = findAsWritten(plain, from_file, wanted);
  return meant.file ? meant : found;
}

Found ResourceFinder::findAsWritten(const std::string& uri, const std::string& from_file,
                                    Wanted wanted) const {
  if (const std::optional<FuelAddress> fuel = fuelAddress(uri)) {
    const std::vector<std::string> places = fuelPlaces(*fuel, fuel_caches_);
    Found found = firstOf({places.begin(), places.end()});
    found.of_fuel = true;
    if (found.file || stockModel(*fuel).empty()) return found;
    const Found own = findAsWritten("model://" + stockModel(*fuel), from_file, wanted);
    return own.file ? own : found;
  }
  const fs::path path = withoutScheme(uri);
  if (path.empty()) return {};
  if (path.is_absolute()) return firstOf({path}, wanted);
  const std::vector<std::string> roots = rootsFrom(from_file);
  std::vector<fs::path> candidates;
  const std::string package = packageOf(uri);
  const std::string of_package = package_folder_ && !package.empty() ? package_folder_(package) : "";
  if (!of_package.empty()) candidates.push_back(of_package / path.lexically_relative(package));
  for (const std::string& root : roots) {
    candidates.push_back(fs::path(root) / path);
    candidates.push_back(fs::path(root) / "models" / path);
  }
  Found found = firstOf(candidates, wanted);
  if (package_folder_ && of_package.empty()) found.no_package = package;
  if (found.file) return found;
  // Where Gazebo classic looks besides, and hardly anyone keeps anything: not worth telling.
  std::vector<fs::path> media;
  for (const std::string& root : roots) {
    for (const char* folder : {"media/models", "Media/models"})
      media.push_back(fs::path(root) / folder / path);
  }
  const Found besides = firstOf(media, wanted);
  return besides.file ? besides : found;
}

Found ResourceFinder::findTexture(const std::string& name, const std::string& mesh_file) const {
  if (name.find("://") != std::string::npos && name.rfind(kFileScheme, 0) != 0) {
    Found exact = find(name, mesh_file);
    if (exact.file && !exact.other_case) return exact;
  }
  std::string plain = withoutScheme(name);
  std::replace(plain.begin(), plain.end(), '\\', '/');
  const fs::path folder = fs::absolute(mesh_file).parent_path();
  std::vector<fs::path> candidates;
  for (const fs::path& path : {fs::path(plain), fs::path(withoutEscapes(plain))}) {
    candidates.push_back(folder / path);  // path alone if it is absolute
    for (const char* place : {".", "textures", "../materials/textures", "../textures", "../materials"}) {
      candidates.push_back(folder / place / path.filename());
    }
    if (path.is_absolute()) continue;
    // A mere name means too little to be taken from any folder up to the root of all files.
    const std::size_t parents = path.has_parent_path() ? 0 : parents_;
    for (std::size_t i = 0; i < roots_.size(); ++i)
      if (i == 0 || i > parents) candidates.push_back(fs::path(roots_[i]) / path);
  }
  return firstOf(candidates);
}

std::vector<std::string> ResourceFinder::rootsFrom(const std::string& from_file) const {
  std::vector<std::string> roots = folderAndParents(from_file);
  roots.insert(roots.end(), roots_.begin(), roots_.end());
  return roots;
}

std::vector<std::string> ResourceFinder::mediaFolders(const std::string& part,
                                                      const std::string& from_file) const {
  std::vector<std::string> folders;
  for (const std::string& root : rootsFrom(from_file)) {
    for (const char* media : {"media", "Media"}) {
      const std::string folder = (fs::path(root) / media / "materials" / part).lexically_normal().string();
      std::error_code error;
      if (fs::is_directory(folder, error) &&
          std::find(folders.begin(), folders.end(), folder) == folders.end())
        folders.push_back(folder);
    }
  }
  return folders;
}

std::string ResourceFinder::roots() const {
  return listed(roots_);
}

std::string ResourceFinder::unknownPackage(const std::string& uri) const {
  const std::string package = packageOf(uri);
  return package_folder_ && !package.empty() && package_folder_(package).empty() ? package : "";
}

std::string ResourceFinder::rootsOf(const std::string& uri) const {
  if (!fuelAddress(uri)) return roots() + noteOf(unknownPackage(uri));
  return "Fuel's cache" + (fuel_caches_.empty() ? ", which has no folder" : " in " + listed(fuel_caches_)) +
         kNotFetched;
}

std::string placesTried(const Found& found) {
  std::vector<std::string> named = found.tried;
  named.resize(std::min(named.size(), kNamedPlaces));
  const bool all = named.size() == found.tried.size();
  if (!all) named.back() += " … (" + std::to_string(found.tried.size()) + " in all)";
  const std::string places =
      named.empty() ? "there is no folder to look for it in" : "it was looked for as " + listed(named);
  return places + noteOf(found.no_package) + (found.of_fuel ? kNotFetched : "");
}

std::vector<std::string> gazeboFolders(const std::string& share) {
  const std::string start = "gazebo-";
  std::vector<std::pair<double, std::string>> versions;
  std::error_code error;
  for (fs::directory_iterator entry(share, error), end; !error && entry != end; entry.increment(error)) {
    const std::string name = entry->path().filename().string();
    if (name.rfind(start, 0) == 0 && entry->is_directory(error))
      versions.emplace_back(-std::atof(name.c_str() + start.size()), entry->path().string());
  }
  std::sort(versions.begin(), versions.end());
  std::vector<std::string> folders;
  for (const auto& version : versions) folders.push_back(version.second);
  return folders;
}

SearchPath SearchPath::withEnvironment(std::vector<std::string> folders) {
  SearchPath search_path{std::move(folders)};
  constexpr std::array<const char*, 6> kVariables = {"SUNLIT_MODEL_PATH",    "GAZEBO_MODEL_PATH",
                                                     "GAZEBO_RESOURCE_PATH", "SDF_PATH",
                                                     "GZ_SIM_RESOURCE_PATH", "IGN_GAZEBO_RESOURCE_PATH"};
  for (const char* variable : kVariables) {
    const char* value = std::getenv(variable);
    std::istringstream list(value == nullptr ? "" : value);
    for (std::string folder; std::getline(list, folder, ':');) {
      if (!folder.empty()) search_path.folders.push_back(folder);
    }
  }
  if (const char* home = std::getenv("HOME"))
    search_path.folders.push_back(std::string(home) + "/.gazebo/models");
  for (const std::string& folder : gazeboFolders("/usr/share")) search_path.folders.push_back(folder);
  const std::string own = packageFolder("sunlit");
  if (!own.empty()) search_path.folders.push_back(own + "/worlds/models");
  search_path.package_folder = packageFolder;
  search_path.fuel_caches = fuelCachesOfEnvironment();
  return search_path;
}

}  // namespace sunlit::scene
