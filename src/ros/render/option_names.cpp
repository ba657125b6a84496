#include "ros/render/option_names.h"

#include <ros/names.h>

#include <stdexcept>
#include <string>

namespace sunlit::ros_interface {

void requireName(const std::string& parameter, const std::string& name, const std::string& what) {
  std::string reason = name.empty() ? "it is empty" : "~ stands for this node";
  const bool is_one = !name.empty() && name[0] != '~' && ros::names::validate(name, reason);
  if (!is_one)
    throw std::invalid_argument("parameter " + parameter + " has '" + name + "', which is no " + what +
                                "'s name: " + reason);
}

void requireNames(const ParameterReader& parameters, const RenderNodeOptions& options) {
  for (const std::string& topic : options.pacing.wait_for)
    requireName(parameters.fullName("wait_for"), topic, "topic");
  if (!options.path.topic.empty())
    requireName(parameters.fullName("path/topic"), options.path.topic, "topic");
  if (!options.sun_namespace.empty())
    requireName(parameters.fullName("sun_namespace"), options.sun_namespace, "namespace");
}

void nameFilesWholly(RenderNodeOptions* options) {
  for (std::string* file : {&options->path.file, &options->camera.calibration_file,
                            &options->camera.right_calibration_file, &options->output_dir})
    *file = wholeName(*file);
}

}  // namespace sunlit::ros_interface
