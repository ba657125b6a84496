/// Names of nodes, topics and namespaces among the renderer's parameters.
#pragma once

#include <string>

#include "ros/render/options.h"
#include "sunlit/ros/parameter_reader.h"

namespace sunlit::ros_interface {

/// Throws std::invalid_argument with the parameter's name where one cannot be such a name: what roscpp says
/// when it is used comes after the bake, and without it.
void requireNames(const ParameterReader& parameters, const RenderNodeOptions& options);

}  // namespace sunlit::ros_interface
