#include "tools/recipe.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <utility>

#include "sunlit/image/content_hash.h"
#include "sunlit/image/files.h"
#include "sunlit/studio/picture_maker.h"
#include "tools/output_folder.h"

namespace sunlit::tools {

namespace {

/// A file may change while its name stays.
std::string contentOf(const std::string& what, const std::string& file) {
  image::ContentHash print;
  if (!print.addFile(file)) throw std::runtime_error(file + ": cannot be read");
  return what + ' ' + print.text();
}

/// Before the fingerprint of the world as it was read, which is known once it has been.
const std::string kAsRead = "world as it was read ";

/// Before studio::pictureMaker().
const std::string kMadeBy = "sunlit ";

bool beginsWith(const std::string& line, const std::string& words) {
  return line.compare(0, words.size(), words) == 0;
}

struct Noted {
  std::string made_by;  ///< empty: nobody noted it, as before pictures had a version
  std::vector<std::string> recipe;
  std::string as_read;  ///< empty: nobody noted it
};

Noted notedIn(const std::string& file) {
  std::ifstream in(file);
  Noted noted;
  for (std::string line; std::getline(in, line);) {
    if (beginsWith(line, kAsRead))
      noted.as_read = line;
    else if (beginsWith(line, kMadeBy))
      noted.made_by = line;
    else if (line.empty() || line[0] != '#')
      noted.recipe.push_back(line);
  }
  return noted;
}

/// The first line of `a` that `b` lacks; empty if there is none.
std::string missing(const std::vector<std::string>& a, const std::vector<std::string>& b) {
  const auto lacks = [&](const std::string& line) { return std::find(b.begin(), b.end(), line) == b.end(); };
  const auto found = std::find_if(a.begin(), a.end(), lacks);
  return found == a.end() ? std::string() : *found;
}

/// How `before` differs from `now`, in words.
std::string difference(const std::vector<std::string>& before, const std::vector<std::string>& now) {
  const std::string was = missing(before, now), is = missing(now, before);
  if (!was.empty()) return "with " + was;
  return is.empty() ? "in another order" : "without " + is;
}

}  // namespace

std::vector<std::string> recipeOf(const studio::CommandLine& line, const RecipeOptions& options,
                                  const studio::WorldOptions& world) {
  auto sorted = line.given();
  std::stable_sort(sorted.begin(), sorted.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<std::string> recipe;
  for (const auto& [option, value] : sorted) {
    if (options.of_no_picture.count(option) == 1) continue;
    recipe.push_back(option + ' ' + value);
    if (options.files.count(option) == 1)
      recipe.push_back(contentOf("content of the " + option.substr(2), value));
  }
  const std::string file = studio::requireWorld(world);
  if (!file.empty()) recipe.push_back(contentOf("content of the world", file));
  return recipe;
}

FolderRecipe::FolderRecipe(const std::string& folder, const std::string& tool,
                           std::vector<std::string> recipe)
    : folder_(folder), tool_(tool), made_by_(kMadeBy + studio::pictureMaker()), recipe_(std::move(recipe)) {
  requireFolderCanBeMade(folder_);
  if (!std::filesystem::exists(file())) return;
  const Noted before = notedIn(file());
  if (before.made_by != made_by_)
    throw std::runtime_error(folder_ + ": its pictures were made by " +
                             (before.made_by.empty() ? "an older sunlit" : before.made_by) + ", and " +
                             made_by_ + " may make others; take another folder");
  if (before.recipe == recipe_) return;
  throw std::runtime_error(folder_ + ": its pictures were made with other options (" +
                           difference(before.recipe, recipe_) + "); take another folder");
}

void FolderRecipe::requireNoStranger(const std::string& stranger) const {
  if (stranger.empty() || std::filesystem::exists(file())) return;
  throw std::runtime_error(folder_ + ": holds " + stranger + ", but no " + tool_ +
                           ".txt that says how it was made; take another folder");
}

void FolderRecipe::note(const std::string& fingerprint) const {
  const std::string as_read = kAsRead + fingerprint;
  if (std::filesystem::exists(file())) {
    const std::string before = notedIn(file()).as_read;
    if (before.empty() || before == as_read) return;
    throw std::runtime_error(
        folder_ +
        ": its pictures show another world: a file that this one is made of, as a mesh or "
        "a texture, or sunlit itself has changed; take another folder");
  }
  image::makeFolder(folder_);
  std::string text =
      "# How these pictures were made. " + tool_ + " adds to them only with the same options and version.\n";
  text += made_by_ + '\n';
  for (const std::string& line : recipe_) text += line + '\n';
  text += as_read + '\n';
  image::writeFileAtomically(file(), text);
}

}  // namespace sunlit::tools
