/// Names of nodes, topics, namespaces and files among the renderer's parameters.
#pragma once

#include <string>

#include "ros/render/options.h"
#include "sunlit/ros/parameter_reader.h"

namespace sunlit::ros_interface {

/// Throws std::invalid_argument where `name`, a value of `parameter`, cannot be that of a `what`: node, topic
/// or namespace. What roscpp says when it is used comes after the bake, and names no parameter.
void requireName(const std::string& parameter, const std::string& name, const std::string& what);

/// The same of all topics and namespaces.
void requireNames(const ParameterReader& parameters, const RenderNodeOptions& options);

/// Whatever is read or written by the name that was typed gets its whole one. World and robot are looked for
/// in several folders, which are told where they are missing.
void nameFilesWholly(RenderNodeOptions* options);

}  // namespace sunlit::ros_interface
