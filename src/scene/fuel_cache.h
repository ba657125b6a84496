/// What Gazebo's tools have downloaded from Fuel, its server of models, read where they keep it.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace sunlit::scene {

/// An address such as https://fuel.gazebosim.org/1.0/OpenRobotics/models/Ambulance/2/files/meshes/a.dae.
struct FuelAddress {
  std::string server;    ///< without the scheme
  std::string owner;     ///< as written, with %20 and its like
  std::string kind;      ///< "models" or "worlds"
  std::string name;      ///< as written
  int version = 0;       ///< > 0; 0: "tip" or none, the newest that is there
  std::string within{};  ///< below the model's folder, as written; empty: the folder itself
};

/// None unless `uri` is an http or https address of that form, the version of the interface (1.0) and all
/// after the name left out or not, and each part of it, decoded, is a name and no way out of its folder.
std::optional<FuelAddress> fuelAddress(const std::string& uri);

/// Where the address may lie below the cache folders `caches`, each with SERVER/OWNER/KIND/NAME/VERSION as
/// `gz fuel` and `ign fuel` make it: names of owners and models decoded, as written, or with %20 for blanks,
/// each in lower case or as it is; of either of Fuel's servers, the address' own first; a port behind : or
/// %3A. Of the newest version there are only those that are there, a model with its SDF file.
std::vector<std::string> fuelPlaces(const FuelAddress& address, const std::vector<std::string>& caches);

/// GZ_FUEL_CACHE_PATH and IGN_FUEL_CACHE_PATH, those that are set, then ~/.gz/fuel and ~/.ignition/fuel.
std::vector<std::string> fuelCachesOfEnvironment();

}  // namespace sunlit::scene
