#include "evaluate/run/grey_streams.h"

#include "evaluate/files/files.h"

namespace sunlit::evaluate {
namespace {

constexpr const char* kCompared = ": differences contain what that changed";

std::string kindOf(bool is_grey) {
  return is_grey ? "grey" : "in colour";
}

}  // namespace

std::vector<std::string> GreyStreams::add(const EvaluationOptions& options, std::size_t stream,
                                          std::int64_t stamp_ns, bool is_grey) {
  are_grey_.resize(options.streams.size());
  std::optional<bool>& was_grey = are_grey_[stream];
  if (was_grey == is_grey) return {};
  std::vector<std::string> notes;
  const std::string& name = options.streams[stream];
  if (was_grey && changed_.insert(stream).second)
    notes.push_back(name + ": images are " + kindOf(is_grey) + " from stamp " + formatStamp(stamp_ns) +
                    " on, and were " + kindOf(*was_grey) + " before" + kCompared);
  was_grey = is_grey;
  for (const PairSpec& pair : options.pairs) {
    if (pair.a != name && pair.b != name) continue;
    const std::string& other = pair.a == name ? pair.b : pair.a;
    for (std::size_t s = 0; s < options.streams.size(); ++s) {
      if (options.streams[s] != other || !are_grey_[s] || are_grey_[s] == is_grey) continue;
      if (!are_mixed_.emplace(pair.a, pair.b).second) continue;
      notes.push_back(pair.name() + ": images of " + name + " are " + kindOf(is_grey) + ", those of " +
                      other + " " + kindOf(*are_grey_[s]) + kCompared);
    }
  }
  return notes;
}

}  // namespace sunlit::evaluate
