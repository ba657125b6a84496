/// check_parameters FILE: whether nodes would take the parameters of an experiment, by what reads them there,
/// before anything is started.
#include <ros/console.h>

#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "ros/evaluator/evaluator_options.h"
#include "ros/render/options.h"
#include "ros/sun_position/options.h"
#include "sunlit/studio/command_line.h"

namespace {

using namespace sunlit;
using ros_interface::ParameterReader;

std::optional<std::string> parse(const std::vector<std::string>& arguments) {
  std::vector<std::string> files;
  studio::CommandLine line(
      "check_parameters: ends with status 1, and what is wrong, where a node would refuse its parameters. "
      "Needs no ROS master.",
      "check_parameters FILE.yaml, with one map a node: sun_position, render, evaluator, self_test/render");
  line.takeWords(&files);
  if (!line.read(arguments)) return std::nullopt;
  if (files.size() != 1) throw std::invalid_argument("there must be one FILE.yaml; see --help");
  return files[0];
}

void checkRenderer(const ParameterReader& parameters) {
  readRenderConditions(parameters, readRenderNodeOptions(parameters).sky);
  parameters.rejectUnknown();
}

void check(const std::string& file) {
  // The nodes give their warnings themselves.
  ros::console::set_logger_level(ROSCONSOLE_DEFAULT_NAME, ros::console::levels::Fatal);
  const ParameterReader all = ros_interface::parametersOfFile(file);
  const auto of = [&](const std::string& node) { return ParameterReader(all.value(node), "/" + node); };
  readSuns(of("sun_position"));
  for (const std::string node : {"render", "self_test/render"})
    if (all.has(node)) checkRenderer(of(node));
  readEvaluatorOptions(of("evaluator"));
}

}  // namespace

int main(int argc, char** argv) {
  return studio::runProgram({"sunlit", argc, argv}, parse, check);
}
