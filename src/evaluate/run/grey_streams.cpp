#include "evaluate/run/grey_streams.h"

#include "evaluate/files/files.h"

namespace sunlit::evaluate {
namespace {

constexpr const char* kCompared = ": differences contain what that changed";

std::string kindOf(bool is_grey) {
  return is_grey ? "grey" : "in colour";
}

}  // namespace

std::vector<std::string> GreyStreams::add(std::size_t stream, std::int64_t stamp_ns, bool is_grey) {
  std::optional<bool>& was_grey = are_grey_.at(stream);
  if (was_grey == is_grey) return {};
  std::vector<std::string> notes;
  const std::string& name = options_.streams[stream];
  if (was_grey && changed_.insert(stream).second)
    notes.push_back(name + ": images are " + kindOf(is_grey) + " from stamp " + formatStamp(stamp_ns) +
                    " on, and were " + kindOf(*was_grey) + " before" + kCompared);
  was_grey = is_grey;
  for (std::size_t p = 0; p < pair_streams_.size(); ++p) {
    const auto& [a, b] = pair_streams_[p];
    if (a != stream && b != stream) continue;
    const std::size_t other = a == stream ? b : a;
    if (!are_grey_[other] || are_grey_[other] == is_grey || !are_mixed_.insert(p).second) continue;
    notes.push_back(options_.pairs[p].name() + ": images of " + name + " are " + kindOf(is_grey) +
                    ", those of " + options_.streams[other] + " " + kindOf(*are_grey_[other]) + kCompared);
  }
  return notes;
}

}  // namespace sunlit::evaluate
