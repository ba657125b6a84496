// What is not evaluated although all of it came: pictures of two places, or under another sun than that of
// their condition.
#include <string>
#include <vector>

#include "evaluate/run/evaluation_state.h"
#include "sunlit/evaluate/same_place.h"

namespace sunlit::evaluate {

// Counts and names it where it is. A stream is where it is itself.
bool Evaluation::State::isOfTwoPlaces(std::int64_t stamp_ns, std::optional<std::int64_t> pose,
                                      std::size_t pair) {
  const std::string fault = places_.fault(stamp_ns);
  if (isSelfTested(pair) || fault.empty()) return false;
  ++counts_.pairs[pair].two_places;
  report({kTwoPlaces, pose, stamp_ns, options_.pairs[pair].name(), fault});
  return true;
}

// Counts it. Its captures are named by nameOtherSuns().
bool Evaluation::State::isOfOtherSun(std::int64_t stamp_ns, std::size_t pair) {
  const PairSpec& streams = options_.pairs[pair];
  if (!suns_.isOther(streams.a, stamp_ns) && !suns_.isOther(streams.b, stamp_ns)) return false;
  ++counts_.pairs[pair].other_sun;
  return true;
}

bool Evaluation::State::isLeftOut(std::int64_t stamp_ns, std::optional<std::int64_t> pose, std::size_t pair) {
  return isOfTwoPlaces(stamp_ns, pose, pair) || isOfOtherSun(stamp_ns, pair);
}

// What was evaluated before that was known. What earlier runs evaluated is not of this run's images.
void Evaluation::State::separate(std::int64_t stamp_ns) {
  std::vector<PairRecord> evaluated;
  for (const PairRecord& record : records_) {
    if (record.stamp_ns == stamp_ns && held_.count({record.pose, record.pair}) == 0)
      evaluated.push_back(record);
  }
  for (const PairRecord& record : evaluated) {
    if (isLeftOut(stamp_ns, record.pose, record.pair)) withdraw(stamp_ns, record.pair);
  }
}

void Evaluation::State::nameOtherSuns(std::size_t stream, const std::vector<OtherSun>& others) {
  StreamCounts& counts = counts_.streams[stream];
  for (const OtherSun& other : others) {
    const std::optional<std::int64_t> pose = poses_.known(other.stamp_ns);
    report({kOtherSun, pose, other.stamp_ns, options_.streams[stream], other.fault});
    separate(other.stamp_ns);
    if (++counts.other_sun > 1) continue;
    counts.other_sun_fault =
        (pose ? "pose " + std::to_string(*pose) : formatStamp(other.stamp_ns)) + ": " + other.fault;
    if (callbacks_.note) callbacks_.note(options_.streams[stream] + ": " + counts.other_sun_fault);
  }
}

}  // namespace sunlit::evaluate
