#include "scene/export_losses.h"

#include <algorithm>

namespace sunlit::scene {

void ExportLosses::add(const std::string& what, const std::string& where) {
  constexpr std::size_t kExamples = 3;
  auto kind =
      std::find_if(kinds_.begin(), kinds_.end(), [&](const Kind& known) { return known.what == what; });
  if (kind == kinds_.end()) kind = kinds_.insert(kinds_.end(), Kind{what, {}, 0});
  ++kind->count;
  std::vector<std::string>& examples = kind->examples;
  const bool known = std::find(examples.begin(), examples.end(), where) != examples.end();
  if (examples.size() < kExamples && !known) examples.push_back(where);
}

std::vector<std::string> ExportLosses::lines() const {
  std::vector<std::string> lines;
  for (const Kind& kind : kinds_) {
    std::string line = std::to_string(kind.count) + ' ' + kind.what + ": ";
    for (std::size_t i = 0; i < kind.examples.size(); ++i) line += (i == 0 ? "" : ", ") + kind.examples[i];
    lines.push_back(line + (kind.count > kind.examples.size() ? ", …" : ""));
  }
  return lines;
}

}  // namespace sunlit::scene
