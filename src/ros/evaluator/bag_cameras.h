/// The cameras of recordings that are evaluated together.
#pragma once

#include <string>
#include <vector>

namespace sunlit::ros_interface {

/// Throws std::runtime_error where two of `bags` tell different cameras at one stamp on one of `topics`
/// (sensor_msgs/CameraInfo): which of two pictures of that stamp counts would be chance. Bags without such
/// messages tell none.
void requireOneCamera(const std::vector<std::string>& bags, const std::vector<std::string>& topics);

}  // namespace sunlit::ros_interface
