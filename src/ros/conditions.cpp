#include "sunlit/ros/conditions.h"

#include <ros/this_node.h>

#include <cctype>
#include <set>

#include "sunlit/ros/node_rows.h"

namespace sunlit::ros_interface {

using XmlRpc::XmlRpcValue;

namespace {

void requireName(const std::string& name, const std::string& parameter) {
  bool good = !name.empty() && std::isalpha(static_cast<unsigned char>(name.front())) != 0;
  for (const char c : name) good = good && (std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_');
  if (!good)
    refuse("a name in parameter " + parameter, '"' + name + '"', "letters, digits and _, a letter first");
}

/// The parameter server keeps no empty map from a launch file, so an empty text stands for one.
bool differsInNothing(const XmlRpcValue& overrides) {
  return overrides.getType() == XmlRpcValue::TypeString &&
         static_cast<std::string>(XmlRpcValue(overrides)).empty();
}

}  // namespace

ros::NodeHandle Condition::node() const {
  return name.empty() ? ros::NodeHandle() : ros::NodeHandle(name);
}

ros::NodeHandle Condition::privateNode() const {
  if (name.empty()) return ros::NodeHandle("~");
  const std::string& node_name = ros::this_node::getName();
  return ros::NodeHandle(ros::NodeHandle(name), node_name.substr(node_name.rfind('/') + 1));
}

std::string Condition::frame(const std::string& name_of_frame) const {
  return name.empty() ? name_of_frame : name + "/" + name_of_frame;
}

std::vector<Condition> readConditions(const ParameterReader& parameters) {
  const Field row = conditionsRow();
  XmlRpcValue value = parameters.value(row.key);
  const std::string parameter = parameters.fullName(row.key);
  if (!value.valid()) return {Condition{"", parameters}};

  std::vector<Condition> conditions;
  std::set<std::string> names;
  const auto refuseAll = [&](const std::string& allowed) {
    refuse("parameter " + parameter, plainText(value), allowed);
  };
  const auto add = [&](const std::string& name, const XmlRpcValue& overrides) {
    requireName(name, parameter);
    if (!names.insert(name).second) refuseAll("without \"" + name + "\" twice");
    const XmlRpcValue differing = differsInNothing(overrides) ? XmlRpcValue() : overrides;
    conditions.push_back({name, parameters.withOverrides(differing, parameter + "/" + name)});
  };
  if (value.getType() == XmlRpcValue::TypeArray) {
    for (int i = 0; i < value.size(); ++i) {
      if (value[i].getType() != XmlRpcValue::TypeString) refuseAll(row.allowed());
      add(static_cast<std::string>(value[i]), XmlRpcValue());
    }
  } else if (value.getType() == XmlRpcValue::TypeStruct) {
    for (auto& member : value) add(member.first, member.second);
  }
  if (conditions.empty()) refuseAll(row.allowed() + notAsText(value));
  return conditions;
}

}  // namespace sunlit::ros_interface
