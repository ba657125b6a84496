#include "evaluate/comparisons/pairing.h"

#include <cmath>
#include <optional>

#include "sunlit/evaluate/comparisons/comparisons.h"
#include "sunlit/evaluate/localise/localiser.h"
#include "sunlit/quantity/angle.h"

namespace sunlit::evaluate {
namespace {

using Places = std::vector<MeasuredPlace>;

Paired byNumber(const Measured& first, const Measured& second) {
  Paired paired;
  auto a = first.values.begin();
  auto b = second.values.begin();
  while (a != first.values.end() && b != second.values.end()) {
    if (a->first == b->first) {
      paired.a.push_back(a++->second);
      paired.b.push_back(b++->second);
    } else {
      a->first < b->first ? ++a : ++b;
    }
  }
  return paired;
}

/// Of each of `from` the place among `to`.
std::vector<std::optional<std::size_t>> nearestOf(const Places& from, const Places& to) {
  const double same_way = std::cos(kSameWay_deg * kRadPerDeg);
  std::vector<std::optional<std::size_t>> nearest(from.size());
  for (std::size_t i = 0; i < from.size(); ++i) {
    double least = kSharedPlace_m * kSharedPlace_m * (1.0 + kLengthRounding);
    for (std::size_t j = 0; j < to.size(); ++j) {
      const double squared = (from[i].position - to[j].position).squaredNorm();
      if (squared >= least || from[i].direction.dot(to[j].direction) <= same_way) continue;
      least = squared;
      nearest[i] = j;
    }
  }
  return nearest;
}

Paired byPlace(const Measured& first, const Measured& second) {
  const auto there = nearestOf(first.places, second.places);
  const auto back = nearestOf(second.places, first.places);
  Paired paired;
  for (std::size_t i = 0; i < there.size(); ++i) {
    if (!there[i] || back[*there[i]] != i) continue;
    paired.a.push_back(first.values[i].second);
    paired.b.push_back(second.values[*there[i]].second);
  }
  return paired;
}

}  // namespace

Paired pairedOf(const Measured& first, const Measured& second) {
  Paired paired = first.drive == second.drive ? byNumber(first, second) : byPlace(first, second);
  paired.unpaired = first.values.size() + second.values.size() - 2 * paired.a.size();
  return paired;
}

}  // namespace sunlit::evaluate
