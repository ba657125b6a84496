#include "ros/evaluator/detector_plugins.h"

#include <pluginlib/class_loader.hpp>
#include <stdexcept>

#include "sunlit/evaluate/features/detector_plugin.h"

namespace sunlit::ros_interface {
namespace {

using evaluate::DetectorPlugin;
using Loader = pluginlib::ClassLoader<DetectorPlugin>;

/// One for the process, up to its end: class_loader's own tables may be gone by the time statics are
/// destroyed.
Loader& loader() {
  static auto* const loader = new Loader("sunlit", "sunlit::evaluate::DetectorPlugin");
  return *loader;
}

/// The first line: what follows in such messages are places that were looked at.
std::string lineOf(const std::string& text) {
  return text.substr(0, text.find('\n'));
}

}  // namespace

bool isPluginName(const std::string& type) {
  return type.find('/') != std::string::npos;
}

std::vector<std::string> pluginNames() {
  try {
    return loader().getDeclaredClasses();
  } catch (const pluginlib::PluginlibException& error) {
    throw std::invalid_argument("detectors of other packages cannot be looked for: " + lineOf(error.what()));
  }
}

std::unique_ptr<evaluate::Detector> loadDetector(const std::string& type) {
  return evaluate::makePluginDetector(
      type, [type] { return std::shared_ptr<DetectorPlugin>(loader().createUniqueInstance(type)); });
}

}  // namespace sunlit::ros_interface
