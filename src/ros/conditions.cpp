#include "sunlit/ros/conditions.h"

#include <ros/this_node.h>

#include <cctype>
#include <set>
#include <stdexcept>

namespace sunlit::ros_interface {

using XmlRpc::XmlRpcValue;

namespace {

void requireName(const std::string& name, const std::string& parameter) {
  bool good = !name.empty() && std::isalpha(static_cast<unsigned char>(name.front())) != 0;
  for (const char c : name) good = good && (std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_');
  if (!good) {
    throw std::invalid_argument(
        "parameter " + parameter + " has the name \"" + name +
        "\", but a condition must be called by letters, digits and _, a letter first");
  }
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
  XmlRpcValue value = parameters.value("conditions");
  const std::string parameter = parameters.fullName("conditions");
  if (!value.valid()) return {Condition{"", parameters}};

  std::vector<Condition> conditions;
  std::set<std::string> names;
  const auto add = [&](const std::string& name, const XmlRpcValue& overrides) {
    requireName(name, parameter);
    if (!names.insert(name).second) {
      throw std::invalid_argument("parameter " + parameter + " names \"" + name + "\" twice");
    }
    conditions.push_back({name, parameters.withOverrides(overrides, parameter + "/" + name)});
  };
  if (value.getType() == XmlRpcValue::TypeArray) {
    for (int i = 0; i < value.size(); ++i) {
      if (value[i].getType() != XmlRpcValue::TypeString) {
        throw std::invalid_argument("parameter " + parameter + " must be a list of names, [morning, noon]");
      }
      add(static_cast<std::string>(value[i]), XmlRpcValue());
    }
  } else if (value.getType() == XmlRpcValue::TypeStruct) {
    for (auto& member : value) add(member.first, member.second);
  }
  if (conditions.empty()) {
    throw std::invalid_argument(
        "parameter " + parameter +
        " must be a list of names, [morning, noon], or a map from names to what differs, "
        "{h04: {hour: 4}, h12: {hour: 12}}");
  }
  return conditions;
}

}  // namespace sunlit::ros_interface
