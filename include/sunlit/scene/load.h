/// A scene from a name or a file.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "sunlit/scene/scene.h"

namespace sunlit::scene {

/// The name of the built-in world.
constexpr const char* kRaceTrack = "race_track";

/// What becomes of a model or mesh that is not there, or cannot be read. A missing texture or script of a
/// material is always a line in Scene::warnings and a neutral material.
enum class Missing {
  kStop,  ///< an error: a world without what is in it is another world
  kWarn,  ///< a line in Scene::warnings, and the rest is drawn
};

/// Where model:// and relative file:// addresses are looked for, in this order, after the folder of the file
/// that names them and its parents.
struct SearchPath {
  std::vector<std::string> folders;
  /// The folder of a package, where package://name/… is looked for first; empty text for one that is not
  /// known. Unset: packages are looked for in `folders` alone.
  std::function<std::string(const std::string& package)> package_folder = {};
  Missing missing = Missing::kStop;
  /// Where addresses of Fuel, https://fuel.gazebosim.org/1.0/OWNER/models/NAME, are looked for: folders as
  /// `gz fuel download` makes them. Nothing is fetched from the network.
  std::vector<std::string> fuel_caches = {};
  /// `folders`, then those of the environment variables SUNLIT_MODEL_PATH, GAZEBO_MODEL_PATH,
  /// GAZEBO_RESOURCE_PATH, SDF_PATH, GZ_SIM_RESOURCE_PATH and IGN_GAZEBO_RESOURCE_PATH (colon-separated),
  /// then ~/.gazebo/models, then /usr/share/gazebo-VERSION, then this package's own worlds/models, which has
  /// the `sun` and `ground_plane` that most Gazebo worlds include. Packages are those below the folders in
  /// ROS_PACKAGE_PATH, then Debian's.
  static SearchPath withEnvironment(std::vector<std::string> folders);
};

/// `world` is "race_track" or the path of a file, by its ending: .world .sdf (SDF), .urdf (its joints at
/// rest), .dae, .gltf .glb, .obj; or an address of Fuel, or a folder, with one SDF file in it. Throws
/// std::runtime_error naming the file and place, and for a missing file where it was looked for.
Scene load(const std::string& world, const SearchPath& search_path);

/// The file that load() would read; empty text for "race_track". Throws what load() throws where it finds
/// none by that name, or of no kind that it knows. Takes no time.
std::string requireWorld(const std::string& world, const SearchPath& search_path);

}  // namespace sunlit::scene
