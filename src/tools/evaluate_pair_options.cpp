#include "tools/evaluate_pair_options.h"

#include <stdexcept>

#include "sunlit/studio/command_line.h"
#include "tools/detector_arguments.h"
#include "tools/output_folder.h"

namespace sunlit::tools {

std::optional<EvaluatePairOptions> parseEvaluatePairOptions(const std::vector<std::string>& arguments) {
  EvaluatePairOptions options;
  std::vector<std::string> pictures;
  studio::CommandLine line(
      "evaluate_pair: which features of two pictures are found again and match rightly. Needs no ROS master.",
      "evaluate_pair --out DIR A B [options]");
  line.takeWords(&pictures);
  line.group("What is compared: the pictures A and B, 8-bit PNG, JPEG, PPM, BMP, TIFF or WebP");
  const std::vector<Field> rows = fieldsOf(options);
  line.add("--out DIR", fieldOf(rows, "out"));
  line.add("--features-cache-limit GB", fieldOf(rows, "features_cache_limit"));
  line.add("--homography FILE", fieldOf(rows, "homography")).withoutDefault();
  addMatching(&line, &options.verify);
  addDetectors(&line, &options.verify);
  if (!line.read(arguments)) return std::nullopt;
  if (!line.has("--out")) throw std::invalid_argument("--out DIR is missing; --help lists all options");
  if (pictures.size() != 2) {
    throw std::invalid_argument("pictures named: " + std::to_string(pictures.size()) +
                                ", but must be two: evaluate_pair --out DIR A B");
  }
  options.a = pictures[0];
  options.b = pictures[1];
  requireFolderCanBeMade(options.output);
  return options;
}

}  // namespace sunlit::tools
