/// How the pictures in a folder were made, so that none that are made otherwise are added to them.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "sunlit/studio/command_line.h"
#include "sunlit/studio/world.h"

namespace sunlit::tools {

/// What options mean to a recipe; the others stand in it as they were typed.
struct RecipeOptions {
  std::set<std::string> of_no_picture;  ///< do not change what pictures look like, and are left out
  std::set<std::string> files;          ///< take the name of a file, whose content counts
};

/// What `line` was given, an option a line, sorted by options; one that may be repeated keeps its order. With
/// what tells the contents of `options.files` and of the file of `world` apart from other ones of that name.
/// Throws std::runtime_error where one cannot be read.
std::vector<std::string> recipeOf(const studio::CommandLine& line, const RecipeOptions& options,
                                  const studio::WorldOptions& world);

/// Beside the pictures, in a file called after the tool: FOLDER/timelapse.txt.
class FolderRecipe {
 public:
  /// Throws std::runtime_error where the folder has another recipe, was made by a sunlit of other pictures
  /// (studio::pictureMaker()), or cannot be made.
  FolderRecipe(const std::string& folder, const std::string& tool, std::vector<std::string> recipe);

  /// Throws std::runtime_error where the folder has no recipe, but a file called `stranger`, by nobody knows
  /// whom. Nothing is called "".
  void requireNoStranger(const std::string& stranger) const;
  /// Makes the folder, if there is none, and notes the recipe in it, if it is not, with the `fingerprint` of
  /// the world as it was read: one of its textures or meshes may change while the world's own file stays.
  /// Throws as the constructor.
  void note(const std::string& fingerprint) const;

 private:
  std::string file() const { return folder_ + '/' + tool_ + ".txt"; }

  std::string folder_, tool_, made_by_;
  std::vector<std::string> recipe_;
};

}  // namespace sunlit::tools
