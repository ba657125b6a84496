/// Finds the files that scene files name.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "sunlit/scene/load.h"

namespace sunlit::scene {

/// Where something was found, and the places that were tried.
struct Found {
  std::optional<std::string> file;
  std::vector<std::string> tried;
  bool other_case = false;      ///< found only by ignoring upper and lower case
  std::string no_package = {};  ///< the package of the address, where ROS knows none of that name
  bool of_fuel = false;         ///< the address is one of Fuel
};

/// What is looked for. A folder of that name may well be something else.
enum class Wanted {
  kAnything,
  kModel,  ///< a file, or a folder that has one of a model
};

class ResourceFinder {
 public:
  /// `scene_file` is the file that is loaded; its folder and that folder's parents are looked through as
  /// well. An address, but for file://, has none.
  ResourceFinder(const SearchPath& search_path, const std::string& scene_file);

  /// What `uri` means where it is written in `from_file`: model://name/…, file://…, package://name/… or a
  /// plain path. A relative one is looked for in from_file's folder and its parents, beside the scene file
  /// and its parents, and in the search path, each with and without a "models" folder. An address of Fuel,
  /// http(s)://SERVER/…/models/NAME/…, is looked for in Fuel's caches alone, but for "Ground Plane" and "Sun"
  /// of OpenRobotics, which are model://ground_plane and model://sun besides. Where nothing is found, \ is
  /// taken for / and escapes (%20) for what they stand for.
  Found find(const std::string& uri, const std::string& from_file, Wanted wanted = Wanted::kAnything) const;

  /// The picture that the mesh in `mesh_file` calls `name`: at that address, if it is one of a model, package
  /// or Fuel; else beside the mesh, in the textures folders that models usually have, then as find() does,
  /// but a mere name in none of the folders above the scene's. The folder part of a path from another machine
  /// is dropped if need be.
  Found findTexture(const std::string& name, const std::string& mesh_file) const;

  /// The folders media/materials/PART (or Media/…), of Gazebo classic, that are there in the folders that
  /// find() goes through for what is written in `from_file`, in that order.
  std::vector<std::string> mediaFolders(const std::string& part, const std::string& from_file) const;

  /// The folders that find() goes through for what the scene file names: "a, b and c".
  std::string roots() const;
  /// Those that find() goes through for `uri` there; of an address of Fuel also that nothing is fetched, and
  /// of a package that ROS does not know, this.
  std::string rootsOf(const std::string& uri) const;
  /// What is to become of a model or mesh that is not found.
  Missing missing() const { return missing_; }

 private:
  Found findAsWritten(const std::string& uri, const std::string& from_file, Wanted wanted) const;

  std::vector<std::string> rootsFrom(const std::string& from_file) const;
  /// The name of the package that `uri` is of, where there is none of that name; else empty.
  std::string unknownPackage(const std::string& uri) const;

  std::vector<std::string> roots_;  ///< the scene's folder, those above it, and those that were named
  std::size_t parents_;             ///< how many are above it
  std::function<std::string(const std::string& package)> package_folder_;
  std::vector<std::string> fuel_caches_;
  Missing missing_;
};

/// "it was looked for as a, b and c", the first few, which package ROS does not know, and that nothing of
/// Fuel is fetched.
std::string placesTried(const Found& found);

/// Ends the error of a model or mesh that is not there: what draws a world without it.
constexpr const char* kDrawTheRest =
    "; --missing warn (of launch files missing:=warn, of nodes missing: warn) draws the rest";

/// Where versions of Gazebo classic keep their models and media: the folders gazebo-VERSION in `share`,
/// newest first.
std::vector<std::string> gazeboFolders(const std::string& share);

}  // namespace sunlit::scene
