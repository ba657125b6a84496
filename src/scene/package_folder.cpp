#include "scene/package_folder.h"

#include <tinyxml.h>

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <mutex>
#include <set>
#include <sstream>
#include <vector>

namespace sunlit::scene {
namespace {

namespace fs = std::filesystem;

constexpr const char* kManifest = "package.xml";

/// Empty for a folder that is no package.
std::string packageNameOf(const fs::path& folder) {
  std::error_code error;
  TiXmlDocument manifest;
  if (!fs::is_regular_file(folder / kManifest, error) || !manifest.LoadFile((folder / kManifest).c_str()))
    return {};
  const TiXmlElement* name =
      TiXmlHandle(&manifest).FirstChildElement("package").FirstChildElement("name").ToElement();
  std::string text = name != nullptr && name->GetText() != nullptr ? name->GetText() : "";
  const auto isSpace = [](unsigned char letter) { return std::isspace(letter) != 0; };
  text.erase(std::remove_if(text.begin(), text.end(), isSpace), text.end());
  return text;
}

/// The package `name` at or below `folder`; empty if there is none. `seen`: folders that need no second look,
/// as links may lead anywhere.
std::string findBelow(const fs::path& folder, const std::string& name, std::set<fs::path>* seen) {
  std::error_code error;
  if (!seen->insert(fs::canonical(folder, error)).second || error) return {};
  if (packageNameOf(folder) == name) return folder.string();
  if (fs::exists(folder / kManifest, error) || fs::exists(folder / "CATKIN_IGNORE", error)) return {};
  std::vector<fs::path> below;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
    std::error_code unknown;  // a link that leads nowhere
    if (entry->is_directory(unknown) && entry->path().filename().string()[0] != '.')
      below.push_back(entry->path());
  }
  std::sort(below.begin(), below.end());  // folders are listed in no order
  for (const fs::path& next : below) {
    std::string found = findBelow(next, name, seen);
    if (!found.empty()) return found;
  }
  return {};
}

std::string search(const std::string& name) {
  const char* roots = std::getenv("ROS_PACKAGE_PATH");
  std::istringstream list(roots == nullptr ? "" : roots);
  std::set<fs::path> seen;
  for (std::string root; std::getline(list, root, ':');) {
    std::string found = root.empty() ? root : findBelow(root, name, &seen);
    if (!found.empty()) return found;
  }
  const fs::path of_debian = fs::path("/usr/share") / name;
  return packageNameOf(of_debian) == name ? of_debian.string() : std::string();
}

}  // namespace

std::string packageFolder(const std::string& name) {
  static std::map<std::string, std::string> known;
  static std::mutex mutex;
  if (name.empty()) return {};
  const std::lock_guard<std::mutex> lock(mutex);
  const auto entry = known.find(name);
  return entry != known.end() ? entry->second : known[name] = search(name);
}

}  // namespace sunlit::scene
