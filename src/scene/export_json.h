/// Numbers and axes as glTF has them.
#pragma once

#include <Eigen/Core>
#include <sstream>
#include <string>

#include "scene/glb_file.h"

namespace sunlit::scene {

/// Enough digits to give a float back unchanged.
inline std::string number(float value) {
  std::ostringstream text;
  text.precision(9);
  text << value;
  return text.str();
}

inline std::string vector3(const Eigen::Array3f& value) {
  return jsonArray({number(value[0]), number(value[1]), number(value[2])});
}

/// +Y up from z up.
inline Eigen::Vector3f yUp(const Eigen::Vector3f& map) {
  return {map.x(), map.z(), -map.y()};
}

}  // namespace sunlit::scene
