/// Detectors that other packages bring, by pluginlib.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "sunlit/evaluate/features/detector.h"

namespace sunlit::ros_interface {

/// A package and a class, "example_detectors/Corners": what no built-in type is called.
bool isPluginName(const std::string& type);
/// All that the packages on ROS_PACKAGE_PATH declare.
std::vector<std::string> pluginNames();
/// With its usual parameters. Throws std::invalid_argument naming what cannot be loaded, and why.
std::unique_ptr<evaluate::Detector> loadDetector(const std::string& type);

}  // namespace sunlit::ros_interface
