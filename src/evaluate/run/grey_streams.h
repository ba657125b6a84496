/// Which streams are grey, and which in colour.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "sunlit/evaluate/run/evaluation_options.h"

namespace sunlit::evaluate {

/// By what the images came as. A grey picture of a coloured scene differs from a coloured one of the same
/// light in whatever compares colours, and, by the camera's own weights of these, in grey too.
class GreyStreams {
 public:
  using PairStreams = std::vector<std::pair<std::size_t, std::size_t>>;
  /// Keeps references: to the names of streams and pairs, and which streams each pair is of.
  GreyStreams(const EvaluationOptions& options, const PairStreams& pair_streams)
      : options_(options), pair_streams_(pair_streams), are_grey_(options.streams.size()) {}

  /// Of an image of that stream: what a person should know by it, in words, once for each stream that changes
  /// and each pair that is of both.
  std::vector<std::string> add(std::size_t stream, std::int64_t stamp_ns, bool is_grey);

 private:
  const EvaluationOptions& options_;
  const PairStreams& pair_streams_;
  std::vector<std::optional<bool>> are_grey_;  // by stream: its latest image
  std::set<std::size_t> changed_;              // streams
  std::set<std::size_t> are_mixed_;            // pairs
};

}  // namespace sunlit::evaluate
