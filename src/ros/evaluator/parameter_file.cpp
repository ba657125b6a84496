#include <fstream>
#include <opencv2/core/persistence.hpp>
#include <sstream>
#include <stdexcept>

#include "ros/evaluator/evaluator_options.h"

namespace sunlit::ros_interface {
namespace {

using XmlRpc::XmlRpcValue;

XmlRpcValue valueOf(const cv::FileNode& node) {
  if (node.isInt()) return XmlRpcValue(static_cast<int>(node));
  if (node.isReal()) return XmlRpcValue(static_cast<double>(node));
  XmlRpcValue value;
  if (node.isString()) {
    const auto text = static_cast<std::string>(node);
    if (text == "true" || text == "false") return XmlRpcValue(text == "true");
    return XmlRpcValue(text);
  }
  if (node.isSeq()) {
    value.setSize(static_cast<int>(node.size()));
    int i = 0;
    for (const cv::FileNode& element : node) value[i++] = valueOf(element);
    return value;
  }
  for (const std::string& key : node.keys()) value[key] = valueOf(node[key]);
  return value;
}

}  // namespace

ParameterReader parametersOfFile(const std::string& path) {
  std::ifstream file(path);
  if (!file) throw std::runtime_error(path + ": cannot be opened");
  std::stringstream content;
  content << "%YAML:1.0\n---\n" << file.rdbuf();  // OpenCV's reader wants this start
  try {
    const cv::FileStorage storage(content.str(), cv::FileStorage::READ | cv::FileStorage::MEMORY);
    return ParameterReader(valueOf(storage.root()), path);
  } catch (const cv::Exception& error) {
    throw std::runtime_error(path + ": is not a YAML map of parameters: " + error.err);
  }
}

}  // namespace sunlit::ros_interface
