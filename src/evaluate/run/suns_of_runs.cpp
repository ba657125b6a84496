#include "evaluate/run/suns_of_runs.h"

#include <algorithm>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

#include "evaluate/run/record_files.h"
#include "sunlit/evaluate/run/one_sun.h"

namespace sunlit::evaluate {
namespace {

/// By stream.
std::map<std::string, Captures> capturesIn(const std::string& folder) {
  std::map<std::string, Captures> found;
  forEachCapture(folder, [&](const std::string& stream, const CaptureRecord& capture) {
    found[stream].push_back(capture);
  });
  for (auto& [stream, captures] : found)
    std::stable_sort(captures.begin(), captures.end(),
                     [](const auto& l, const auto& r) { return l.stamp_ns < r.stamp_ns; });
  return found;
}

struct Seen {
  std::string folder;
  Captures captures;
};

}  // namespace

// Each stream's sun is that of the first folder that has it: each run has left out what was not of its own.
void requireOneSun(const EvaluationOptions& options) {
  if (options.merge.empty()) return;
  std::vector<std::string> folders = {options.output_dir};
  folders.insert(folders.end(), options.merge.begin(), options.merge.end());
  std::map<std::string, Seen> first;  // by stream
  for (const std::string& folder : folders) {
    for (const auto& [stream, captures] : capturesIn(folder)) {
      const auto [before, is_first] = first.try_emplace(stream, Seen{folder, captures});
      if (is_first) continue;
      const std::string difference =
          differenceOf(before->second.captures, captures, options.frame_rate > 0.0);
      if (!difference.empty())
        throw std::invalid_argument("merge: " + folder + " holds " + stream + " under another sun than " +
                                    before->second.folder + ": " + difference);
    }
  }
}

}  // namespace sunlit::evaluate
