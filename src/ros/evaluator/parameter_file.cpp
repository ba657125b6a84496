#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <cctype>
#include <fstream>
#include <iterator>
#include <regex>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "ros/evaluator/evaluator_options.h"
#include "sunlit/quantity/utf8.h"

namespace sunlit::ros_interface {
namespace {

using XmlRpc::XmlRpcValue;

/// Of YAML 1.1 (PyYAML's resolver), where yaml-cpp takes 1e1 and 08, too.
bool isNumber(const std::string& text) {
  static const std::regex form(
      "[-+]?(0[0-7]*|[1-9][0-9]*|0x[0-9a-fA-F]+)|([-+]?[0-9]+\\.[0-9]*|\\.[0-9]+)([eE][-+][0-9]+)?|"
      "[-+]?\\.(inf|Inf|INF)|\\.(nan|NaN|NAN)");
  constexpr std::size_t kLongest = 100;  // std::regex needs stack for each letter
  return text.size() <= kLongest && std::regex_match(text, form);
}

// As rosparam reads it: only text without quotes may be a number or a truth value, and y and n are texts.
XmlRpcValue valueOfText(const YAML::Node& node) {
  const std::string plain = "?";  // yaml-cpp's tag of such text
  const std::string& text = node.Scalar();
  if (node.Tag() != plain) return text;
  if (isNumber(text)) {
    if (int whole = 0; YAML::convert<int>::decode(node, whole)) return whole;
    if (double number = 0.0; YAML::convert<double>::decode(node, number)) return number;
  }
  if (bool flag = false; text.size() > 1 && YAML::convert<bool>::decode(node, flag)) return flag;
  return text;
}

/// Anchors let a few lines stand for any number of values, and hold themselves.
class Values {
 public:
  XmlRpcValue of(const YAML::Node& node, int depth = 0) {
    constexpr int kDeepest = 50;
    constexpr std::size_t kMost = 1000000;
    if (depth > kDeepest) refuseMore(node, std::to_string(kDeepest) + " values within each other");
    if (++count_ > kMost) refuseMore(node, std::to_string(kMost) + " values");
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
  [[noreturn]] static void refuseMore(const YAML::Node& node, const std::string& than) {
    throw YAML::Exception(node.Mark(), "more than " + than + "; does an anchor (&) hold itself?");
  }
  std::size_t count_ = 0;
};

/// The line, from 0, of the mark behind which a second document begins; −1: there is none. YAML::LoadAll()
/// knows them too, but finds no end of documents in ",]".
int secondDocument(const std::string& text) {
  std::istringstream lines(text);
  bool begun = false;
  int number = 0;
  for (std::string line; std::getline(lines, line); ++number) {
    const bool marks = line.compare(0, 3, "---") == 0 &&
                       (line.size() == 3 || std::isspace(static_cast<unsigned char>(line[3])));
    if (marks && begun) return number;
    const std::size_t first = line.find_first_not_of(" \t\r", marks ? 3 : 0);
    begun |= first != std::string::npos && line[first] != '#' && line[0] != '%';
  }
  return -1;
}

}  // namespace

XmlRpcValue readParameterFile(const std::string& path) {
  std::ifstream file(path);
  if (!file) throw std::runtime_error(path + ": cannot be opened");
  const std::string text = utf8Of({std::istreambuf_iterator<char>(file), {}}, path);
  const auto fail = [&](int line, const std::string& reason) {
    throw std::runtime_error(path + ":" + std::to_string(std::max(line, 0) + 1) +
                             ": is not a YAML map of parameters: " + reason);
  };
  XmlRpcValue tree;
  try {
    if (const int line = secondDocument(text); line >= 0) fail(line, "there are several documents");
    const YAML::Node root = YAML::Load(text);
    if (!root.IsMap()) fail(root.Mark().line, "there are no keys");
    tree = Values().of(root);
  } catch (const YAML::Exception& error) {
    fail(error.mark.line, error.msg);
  }
  return tree;
}

}  // namespace sunlit::ros_interface
