// Parameters of renderer and evaluator in YAML.
#include "fuzz/reader.h"
#include "ros/evaluator/evaluator_options.h"
#include "ros/render/options.h"
#include "support/temporary_folder.h"

namespace sunlit::fuzz {

std::vector<std::string> seeds() {
  std::vector<std::string> files;
  for (const char* name : {"render.yaml", "evaluator.yaml"})
    files.push_back(contentOf(std::string(SUNLIT_SOURCE_DIR "/config/") + name));
  files.emplace_back(
      "camera: {width: 320, height: 240, rasterizer: builtin}\natmosphere: {ground_albedo: auto}\n"
      "robot: {file: a.urdf, place: [0, 1, 2, 0, 0, 0]}\nlamps_off: [a, 'b']\nnoise: {seed: 3}\n");
  files.emplace_back(
      "streams: [h04, h12]\noutput_dir: out\npairs: [{a: h04, b: h12, every: 2}]\nfeatures: {mine: "
      "{type: sift, preprocessing: gamma}}\ndifferences: [orb, mine]\nlocalisation: {map: h12}\n");
  return files;
}

void read(const std::string& input) {
  setContent("./input.yaml", input);
  const ros_interface::ParameterReader parameters = ros_interface::parametersOfFile("input.yaml");
  if (("\n" + input).find("\nstreams:") == std::string::npos) {
    ros_interface::readRenderNodeOptions(parameters);
  } else {
    ros_interface::readEvaluatorOptions(parameters);
  }
}

std::string named() {
  return "";  // each of them names the parameter
}

}  // namespace sunlit::fuzz
