#include "tools/evaluate_pair_options.h"

#include <algorithm>
#include <stdexcept>

#include "sunlit/studio/command_line.h"
#include "tools/output_folder.h"

namespace sunlit::tools {

namespace {

/// "--sift-n-features" of the row "features/sift/n_features", "--clahe-tiles" of "preprocessing/clahe/tiles".
std::string optionOf(const std::string& key) {
  std::string option = "--" + key.substr(key.find('/') + 1);
  std::replace_if(
      option.begin(), option.end(), [](char c) { return c == '/' || c == '_'; }, '-');
  return option;
}

}  // namespace

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
  line.add("--homography FILE", fieldOf(rows, "homography")).withoutDefault();
  line.add("--detectors LIST", fieldOf(fieldsOf(options.verify), "detectors"));
  const std::vector<Field> test = fieldsOf(options.verify.ratio_test);
  line.add("--ratio SHARE", fieldOf(test, "ratio"));
  line.add("--inclusive true|false", fieldOf(test, "inclusive"));
  line.group("Detectors");
  for (const Field& row : options.verify.known.fieldsOf(evaluate::detectorTypes()))
    line.add(optionOf(row.key) + " VALUE", row);
  line.group("Preprocessing, of the detectors that are named with one, such as sift+clahe");
  for (const Field& row : under("preprocessing", options.verify.preprocessings.fields()))
    line.add(optionOf(row.key) + " VALUE", row);
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
