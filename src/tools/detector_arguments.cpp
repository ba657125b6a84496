#include "tools/detector_arguments.h"

#include <algorithm>

namespace sunlit::tools {

std::string optionOf(const std::string& key) {
  std::string option = "--" + key.substr(key.find('/') + 1);
  std::replace_if(
      option.begin(), option.end(), [](char c) { return c == '/' || c == '_'; }, '-');
  return option;
}

void addMatching(studio::CommandLine* line, evaluate::VerifyOptions* options) {
  line->add("--detectors LIST", fieldOf(fieldsOf(*options), "detectors"));
  const std::vector<Field> test = fieldsOf(options->ratio_test);
  line->add("--ratio SHARE", fieldOf(test, "ratio"));
  line->add("--inclusive true|false", fieldOf(test, "inclusive"));
}

void addDetectors(studio::CommandLine* line, evaluate::VerifyOptions* options) {
  line->group("Detectors");
  for (const Field& row : options->known.fieldsOf(evaluate::detectorTypes()))
    line->add(optionOf(row.key) + " VALUE", row);
  line->group("Preprocessing, of the detectors that are named with one, such as sift+clahe");
  for (const Field& row : under("preprocessing", options->preprocessings.fields()))
    line->add(optionOf(row.key) + " VALUE", row);
}

}  // namespace sunlit::tools
