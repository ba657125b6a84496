/// What libsunlit_encodings.so, which links to cv_bridge, has for libsunlit_ros.so, which does not.
#pragma once

#include "ros/conversions/encodings.h"

namespace sunlit::ros_interface {

struct Encodings {
  decltype(&typeOf) type_of;
  decltype(&pixelsOf) pixels_of;
  decltype(&recoded) recode;
};

}  // namespace sunlit::ros_interface

extern "C" const sunlit::ros_interface::Encodings* sunlitEncodings();
