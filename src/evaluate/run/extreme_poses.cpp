#include "evaluate/run/extreme_poses.h"

#include <algorithm>
#include <cmath>

namespace sunlit::evaluate {
namespace {

using Ranked = std::map<std::pair<std::int64_t, std::int64_t>, std::int64_t>;

bool ranks(const Ranked& ranked, std::int64_t by, std::int64_t stamp_ns) {
  return ranked.size() < kExtremePoses || std::make_pair(by, stamp_ns) < ranked.rbegin()->first;
}

void rank(Ranked& ranked, std::int64_t by, std::int64_t stamp_ns, std::int64_t pose) {
  ranked[{by, stamp_ns}] = pose;
  if (ranked.size() > kExtremePoses) ranked.erase(std::prev(ranked.end()));
}

bool isIn(const Ranked& ranked, std::int64_t pose) {
  return std::any_of(ranked.begin(), ranked.end(), [&](const auto& one) { return one.second == pose; });
}

}  // namespace

std::int64_t rightMatches(const Verified& verified) {
  if (std::isnan(verified.precision)) return 0;
  return std::llround(verified.precision * static_cast<double>(verified.difference.matches));
}

bool ExtremePoses::takes(std::int64_t right, std::int64_t stamp_ns) const {
  return ranks(fewest_, right, stamp_ns) || ranks(most_, -right, stamp_ns);
}

void ExtremePoses::add(std::int64_t right, std::int64_t stamp_ns, std::int64_t pose) {
  rank(fewest_, right, stamp_ns, pose);
  rank(most_, -right, stamp_ns, pose);
}

bool ExtremePoses::has(std::int64_t pose) const {
  return isIn(fewest_, pose) || isIn(most_, pose);
}

std::set<std::int64_t> ExtremePoses::poses() const {
  std::set<std::int64_t> all;
  for (const Ranked* ranked : {&fewest_, &most_}) {
    for (const auto& one : *ranked) all.insert(one.second);
  }
  return all;
}

}  // namespace sunlit::evaluate
