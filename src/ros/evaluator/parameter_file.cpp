#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "ros/evaluator/evaluator_options.h"

namespace sunlit::ros_interface {
namespace {

using XmlRpc::XmlRpcValue;

// As rosparam reads it: only text without quotes may be a number or a truth value.
XmlRpcValue valueOfText(const YAML::Node& node) {
  const std::string plain = "?";  // yaml-cpp's tag of such text
  if (int whole = 0; node.Tag() == plain && YAML::convert<int>::decode(node, whole)) return whole;
  if (double number = 0.0; node.Tag() == plain && YAML::convert<double>::decode(node, number)) return number;
  if (bool flag = false; node.Tag() == plain && YAML::convert<bool>::decode(node, flag)) return flag;
  return node.Scalar();
}

/// Anchors let a few lines stand for any number of values, and hold themselves.
class Values {
 public:
  XmlRpcValue of(const YAML::Node& node, int depth = 0) {
    constexpr int kDeepest = 50;
    constexpr std::size_t kMost = 1000000;
    if (depth > kDeepest || ++count_ > kMost)
      throw YAML::Exception(node.Mark(), "more than " + std::to_string(depth > kDeepest ? kDeepest : kMost) +
                                             (depth > kDeepest ? " values within each other" : " values") +
                                             "; does an anchor (&) hold itself?");
    if (node.IsScalar()) return valueOfText(node);
    XmlRpcValue value;
    if (node.IsSequence()) {
      value.setSize(static_cast<int>(node.size()));
      int i = 0;
      for (const YAML::Node& element : node) value[i++] = of(element, depth + 1);
    } else if (node.IsMap()) {
      for (const auto& member : node) {
        const auto key = member.first.as<std::string>();
        if (value.hasMember(key)) throw YAML::Exception(member.first.Mark(), key + " is given twice");
        value[key] = of(member.second, depth + 1);
      }
    }
    return value;
  }

 private:
  std::size_t count_ = 0;
};

}  // namespace

ParameterReader parametersOfFile(const std::string& path) {
  std::ifstream file(path);
  if (!file) throw std::runtime_error(path + ": cannot be opened");
  const auto fail = [&](const YAML::Mark& mark, const std::string& reason) {
    throw std::runtime_error(path + ":" + std::to_string(std::max(mark.line, 0) + 1) +
                             ": is not a YAML map of parameters: " + reason);
  };
  XmlRpcValue tree;
  try {
    const std::vector<YAML::Node> documents = YAML::LoadAll(file);
    if (documents.size() > 1) fail(documents[1].Mark(), "there are several documents");
    const YAML::Node root = documents.empty() ? YAML::Node() : documents[0];
    if (!root.IsMap()) fail(root.Mark(), "there are no keys");
    tree = Values().of(root);
  } catch (const YAML::Exception& error) {
    fail(error.mark, error.msg);
  }
  return ParameterReader(tree, path);
}

}  // namespace sunlit::ros_interface
