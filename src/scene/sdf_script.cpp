#include "scene/sdf_script.h"

#include <algorithm>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "sunlit/image/files.h"
#include "sunlit/quantity/utf8.h"

namespace sunlit::scene {
namespace {

namespace fs = std::filesystem;

/// The .material files that `place` means: itself, or all in that folder and its scripts.
std::vector<std::string> scriptFiles(const std::string& place) {
  std::vector<std::string> files;
  std::error_code error;
  if (fs::is_regular_file(place, error)) files.push_back(place);
  for (const char* folder : {".", "scripts", "materials/scripts"}) {
    for (fs::directory_iterator entry(fs::path(place) / folder, error), end; !error && entry != end;
         entry.increment(error)) {
      std::error_code unknown;
      const bool is_hidden = entry->path().filename().string().front() == '.';  // as macOS leaves its own
      if (!is_hidden && entry->path().extension() == ".material" && entry->is_regular_file(unknown))
        files.push_back(entry->path().lexically_normal().string());
    }
  }
  std::sort(files.begin(), files.end());
  return files;
}

void append(const std::vector<std::string>& more, std::vector<std::string>& files) {
  files.insert(files.end(), more.begin(), more.end());
}

}  // namespace

std::optional<ScriptMaterial> MaterialScripts::find(const ScriptUse& use) {
  Files files;
  for (const std::string& uri : use.uris) {
    const Found found = finder_.find(uri, use.from_file);
    if (found.file) append(scriptFiles(*found.file), files);
  }
  for (const std::string& folder : finder_.mediaFolders("scripts", use.from_file))
    append(scriptFiles(folder), files);
  std::set<std::string> open;
  return materialIn(files, use.name, open);
}

/// `open` has the names of the materials that are on their way to inherit from this one.
std::optional<ScriptMaterial> MaterialScripts::materialIn(const Files& files, const std::string& name,
                                                          std::set<std::string>& open) {
  if (!open.insert(name).second) return std::nullopt;
  std::optional<ScriptMaterial> found;
  for (std::size_t i = 0; i < files.size() && !found; ++i) {
    const std::string& text = textOf(files[i]);
    if (text.find(name) == std::string::npos) continue;
    found = parseMaterialScript(text, name, [&](const std::string& parent) {
      Files nearest_first = scriptFiles(fs::path(files[i]).parent_path().string());
      append(files, nearest_first);
      return materialIn(nearest_first, parent, open);
    });
    if (found && found->texture && found->texture_from.empty()) found->texture_from = files[i];
  }
  open.erase(name);
  return found;
}

std::optional<std::string> MaterialScripts::texture(const ScriptMaterial& material,
                                                    const ScriptUse& use) const {
  // Files that the picture may stand beside; that of a folder need not be there.
  std::vector<std::string> neighbours{material.texture_from};
  const auto addFolder = [&](const std::string& folder) {
    neighbours.push_back((fs::path(folder) / "script").string());
  };
  for (const std::string& uri : use.uris) {
    const Found found = finder_.find(uri, use.from_file);
    std::error_code error;
    if (!found.file) continue;
    if (fs::is_directory(*found.file, error))
      addFolder(*found.file);
    else
      neighbours.push_back(*found.file);
  }
  for (const std::string& folder : finder_.mediaFolders("textures", use.from_file)) addFolder(folder);
  std::optional<std::string> in_other_case;
  for (const std::string& neighbour : neighbours) {
    const Found found = finder_.findTexture(*material.texture, neighbour);
    if (found.file && !found.other_case) return found.file;
    if (!in_other_case) in_other_case = found.file;
  }
  return in_other_case ? in_other_case : finder_.find(*material.texture, material.texture_from).file;
}

const std::string& MaterialScripts::textOf(const std::string& file) {
  const auto [place, is_new] = texts_.try_emplace(file);
  if (!is_new) return place->second;
  try {
    image::requireContent(file);
    std::ifstream stream(file, std::ios::binary);
    place->second = utf8Of({std::istreambuf_iterator<char>(stream), {}}, file);
  } catch (const image::ContentMissing& error) {
    builder_.warn("material scripts are missing", error.what());
  } catch (const std::exception& error) {
    builder_.warn("material scripts cannot be read", error.what());
  }
  return place->second;
}

}  // namespace sunlit::scene
