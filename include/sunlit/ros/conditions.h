/// Conditions: the named suns that one process serves.
#pragma once

#include <ros/node_handle.h>

#include <string>
#include <vector>

#include "sunlit/ros/parameter_reader.h"

namespace sunlit::ros_interface {

/// One named sun, such as `h12`. The only condition of a node may be unnamed: its names then stand without a
/// prefix.
struct Condition {
  std::string name;            ///< letters, digits and _, or empty
  ParameterReader parameters;  ///< the node's own, with what differs in this condition

  /// Topics of this condition: `h12/…`.
  ros::NodeHandle node() const;
  /// Services of this condition and this node: `h12/<node name>/…`.
  ros::NodeHandle privateNode() const;
  /// TF names are global: `h12/sun`.
  std::string frame(const std::string& name_of_frame) const;
};

/// From `~conditions`: a list of names, or a map from name to what differs ({h04: {hour: 4}, h12: {hour:
/// 12}}), an empty text where nothing does; one unnamed condition where it is absent. Throws
/// std::invalid_argument for an empty or repeated name, or one that ROS would refuse.
std::vector<Condition> readConditions(const ParameterReader& parameters);

}  // namespace sunlit::ros_interface
