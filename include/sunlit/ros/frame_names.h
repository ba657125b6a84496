/// Names of TF frames, as parameters tell of them.
#pragma once

#include <string>
#include <vector>

#include "sunlit/quantity/field.h"
#include "sunlit/ros/parameter_reader.h"

namespace sunlit::ros_interface {

constexpr const char* kMapFrame = "map";  ///< ENU, unless parameters say otherwise

/// As TF itself reads names of those who still write a slash in front.
std::string withoutSlash(const std::string& frame);

/// Throws std::invalid_argument unless the texts of all rows can be names of frames of one tree: not empty,
/// without the slash in front that TF refuses, and each its own.
void requireFrameNames(const ParameterReader& parameters, const std::vector<Field>& rows);

}  // namespace sunlit::ros_interface
