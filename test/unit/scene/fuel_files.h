/// Models as Gazebo's tools keep what they have downloaded from Fuel, for tests.
#pragma once

#include <string>

#include "unit/scene/measure.h"
#include "unit/scene/scene_files.h"

namespace sunlit::scene {

/// Worlds that take models from a cache folder of Fuel, "fuel".
class FuelFiles : public SceneFiles {
 protected:
  /// A model whose mesh is a triangle at x = 0 to `width`, at the address' place in the cache folder "fuel".
  void keep(const std::string& place, int width) const {
    const std::string folder = "fuel/" + place;
    write(folder + "/model.config",
          "<?xml version='1.0'?><model><name>m</name><sdf version='1.6'>model.sdf</sdf></model>");
    // Meshes by addresses of Fuel, as its server writes them into models that are downloaded, and beside
    // them.
    write(folder + "/model.sdf",
          "<?xml version='1.0'?><sdf version='1.6'><model name='m'><link name='l'><visual "
          "name='v'><geometry><mesh><uri>meshes/t.obj</uri></mesh></geometry></visual></link></model></sdf>");
    write(folder + "/meshes/t.obj", "v 0 0 0\nv " + std::to_string(width) + " 0 0\nv 0 1 0\nf 1 2 3\n");
  }
  std::string worldOf(const std::string& content) const {
    return write("test.world",
                 "<?xml version='1.0'?><sdf version='1.9'><world name='w'>" + content + "</world></sdf>");
  }
  std::string including(const std::string& address) const {
    return worldOf("<include><uri>" + address + "</uri></include>");
  }
  SearchPath cached() const {
    SearchPath path;
    path.fuel_caches = {pathOf("fuel")};
    return path;
  }
  /// East of what the address gives.
  float widthOf(const std::string& address) const {
    return boundsOf(load(including(address), cached())).max().x();
  }
};

}  // namespace sunlit::scene
