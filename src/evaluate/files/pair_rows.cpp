#include "evaluate/files/pair_rows.h"

#include <algorithm>
#include <cmath>

namespace sunlit::evaluate {
namespace {

std::size_t pairNamed(const FramesLayout& layout, const std::string& a, const std::string& b) {
  const auto found = std::find(layout.pairs.begin(), layout.pairs.end(), std::make_pair(a, b));
  if (found == layout.pairs.end())
    throw std::runtime_error("the pair " + a + ", " + b + " is not one of this run");
  return static_cast<std::size_t>(found - layout.pairs.begin());
}

std::size_t columnOf(const FramesLayout& layout, const std::string& name, const std::string& called) {
  for (std::size_t d = 0; d < layout.differences.size(); ++d) {
    if (layout.differences[d] == name) return d;
  }
  throw std::runtime_error("the " + called + " " + name + " is not one of this run");
}

}  // namespace

std::uint32_t parseCount(const std::string& text) {
  const double value = parseNumber(text);
  if (!(value >= 0.0 && value <= 4294967295.0) || value != std::floor(value)) {
    throw std::runtime_error("\"" + text + "\" is not a count");
  }
  return static_cast<std::uint32_t>(value);
}

PairRow pairRowOf(const FramesLayout& layout, const std::vector<std::string>& fields,
                  const std::string& called) {
  return {parsePose(fields[0]), parseStamp(fields[1]), pairNamed(layout, fields[2], fields[3]),
          columnOf(layout, fields[4], called)};
}

}  // namespace sunlit::evaluate
