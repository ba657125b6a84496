/// list_parameters: every parameter of the nodes as YAML, with default, unit, range and meaning.
#include <cstdio>
#include <string>
#include <vector>

#include "ros/evaluator/evaluator_options.h"
#include "ros/render/options.h"
#include "ros/sun_position/options.h"
#include "sunlit/quantity/yaml_text.h"
#include "sunlit/ros/node_rows.h"

namespace {

using sunlit::Field;

/// Texts in quotes, all else as YAML reads it, as are forms of their own in brackets or braces.
std::string usual(const Field& field) {
  const Field::Value value = field.value();
  const auto* text = std::get_if<std::string>(&value);
  const bool is_own = std::holds_alternative<sunlit::OwnForm>(field.place);
  if (text == nullptr || (is_own && text->find_first_of("[{") == 0)) return field.text();
  return is_own && text->empty() ? "~" : sunlit::yamlQuoted(*text);
}

void list(const std::string& node, const std::vector<Field>& rows) {
  std::printf("%s:\n", node.c_str());
  for (const Field& row : rows) {
    std::printf("  %s: {default: %s, unit: %s, allowed: %s, doc: %s}\n", row.key.c_str(), usual(row).c_str(),
                sunlit::yamlQuoted(row.unit).c_str(), sunlit::yamlQuoted(row.symbols()).c_str(),
                sunlit::yamlQuoted(row.doc).c_str());
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc > 1) {
    const std::string word = argv[1];
    const bool help = word == "-h" || word == "--help";
    std::fputs(
        "list_parameters: every parameter of the nodes as YAML. Takes no arguments, needs no ROS master.\n",
        help ? stdout : stderr);
    return help ? 0 : 1;
  }
  using namespace sunlit;
  double period_s = 1.0;
  ros_interface::SunPositionOptions sun;
  ros_interface::RenderNodeOptions render;
  ros_interface::EvaluatorOptions evaluator;
  list("sun_position_node", joined({ros_interface::fieldsOfNode(&period_s), fieldsOf(sun)}));
  list("render_node", joined({fieldsOf(render), {ros_interface::conditionsRow()}}));
  evaluate::Preprocessings preprocessings;
  list("evaluator_node", joined({fieldsOf(evaluator), ros_interface::fieldsOfOwnDetector(preprocessings)}));
  return 0;
}
