#include "sunlit/evaluate/comparisons/comparisons.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <set>
#include <utility>

#include "evaluate/comparisons/pairing.h"
#include "evaluate/files/files.h"
#include "sunlit/image/files.h"
#include "sunlit/quantity/range.h"

namespace sunlit::evaluate {
namespace {

using Group = std::vector<const Measured*>;  // of one metric
using Pair = std::pair<const Measured*, const Measured*>;

std::vector<Group> byMetric(const std::vector<Measured>& measured) {
  std::vector<Group> groups;
  for (const Measured& one : measured) {
    const auto found = std::find_if(groups.begin(), groups.end(),
                                    [&](const Group& group) { return group.front()->metric == one.metric; });
    Group& group = found == groups.end() ? groups.emplace_back() : *found;
    group.push_back(&one);
  }
  return groups;
}

template <typename Wanted>
std::vector<Pair> pairsOf(const Group& group, const Wanted& wanted) {
  std::vector<Pair> pairs;
  for (std::size_t i = 0; i < group.size(); ++i) {
    for (std::size_t j = i + 1; j < group.size(); ++j) {
      if (wanted(*group[i], *group[j])) pairs.emplace_back(group[i], group[j]);
    }
  }
  return pairs;
}

std::vector<Pair> pairsOfMethods(const Group& group) {
  return pairsOf(group, [](const Measured& a, const Measured& b) {
    return a.is_of_features && b.is_of_features && a.hours == b.hours && a.method != b.method;
  });
}

bool has(const Measured& measured, const std::string& stream) {
  return std::count(measured.streams.begin(), measured.streams.end(), stream) > 0;
}

bool shareStream(const Measured& a, const Measured& b) {
  return std::any_of(a.streams.begin(), a.streams.end(),
                     [&](const std::string& stream) { return has(b, stream); });
}

std::string leftOut(std::size_t count, const std::string& metric, const std::string& between) {
  return "comparisons.csv: " + std::to_string(count) + " comparisons of " + metric + " between " + between +
         " were left out, since of more than " + std::to_string(kMostCompared) +
         " together none could be told from chance";
}

std::vector<Pair> pairsOfHours(const Group& group, const std::vector<std::string>& references,
                               std::vector<std::string>* left_out) {
  const auto isOfOneMethod = [](const Measured& a, const Measured& b) {
    return a.method == b.method && a.hours != b.hours && shareStream(a, b);
  };
  std::vector<Pair> pairs = pairsOf(group, isOfOneMethod);
  if (pairs.size() <= kMostCompared || references.empty()) return pairs;
  const std::vector<Pair> with_reference = pairsOf(group, [&](const Measured& a, const Measured& b) {
    return isOfOneMethod(a, b) &&
           std::any_of(references.begin(), references.end(),
                       [&](const std::string& one) { return has(a, one) && has(b, one); });
  });
  if (with_reference.empty()) return pairs;  // that they are left out is said of them
  left_out->push_back(leftOut(pairs.size() - with_reference.size(), group.front()->metric,
                              "hours that do not share the map"));
  return with_reference;
}

void addFamily(const std::string& name, const std::vector<Pair>& pairs, Comparisons& result) {
  if (pairs.empty()) return;
  const std::string& metric = pairs.front().first->metric;
  if (pairs.size() > kMostCompared) {
    result.left_out.push_back(leftOut(pairs.size(), metric, name));
    return;
  }
  const bool is_of_methods = name == "methods";
  for (const auto& [a, b] : pairs) {
    Comparison row;
    row.metric = metric;
    row.family = name;
    row.same = is_of_methods ? a->hours : a->method;
    row.a = is_of_methods ? a->method : a->hours;
    row.b = is_of_methods ? b->method : b->hours;
    result.rows.push_back(row);
  }
}

/// Once for each two drives' hours: metrics and methods are of the same poses, but where a detector threw.
void tellPairedByPlace(const std::vector<Pair>& compared, Comparisons& result) {
  std::set<std::pair<std::string, std::string>> told;
  for (std::size_t i = 0; i < compared.size(); ++i) {
    const auto& [a, b] = compared[i];
    if (a->drive == b->drive || !told.emplace(a->hours, b->hours).second) continue;
    const Comparison& row = result.rows[i];
    const std::size_t pairs = (a->values.size() + b->values.size() - row.unpaired) / 2;
    result.paired_by_place.push_back(
        "comparisons.csv: " + a->hours + " and " + b->hours +
        " have no common numbers of poses, and were paired by place: " + std::to_string(pairs) + " pairs, " +
        std::to_string(row.unpaired) + " queries without one, nearest to each other within " +
        textOf(kSharedPlace_m) + " m");
  }
}

// Rows of one metric and family lie together.
void adjust(std::vector<Comparison>& rows) {
  for (std::size_t begin = 0, end = 0; begin < rows.size(); begin = end) {
    std::vector<double> p;
    while (end < rows.size() && rows[end].metric == rows[begin].metric &&
           rows[end].family == rows[begin].family)
      p.push_back(rows[end++].test.p);
    const std::vector<double> adjusted = holm(p);
    for (std::size_t i = begin; i < end; ++i) rows[i].p_holm = adjusted[i - begin];
  }
}

}  // namespace

Comparisons comparisonsOf(const std::vector<Measured>& measured, const std::vector<std::string>& references,
                          const StopToken& stop) {
  Comparisons result;
  std::vector<Pair> compared;
  for (const Group& group : byMetric(measured)) {
    for (const auto& [name, pairs] :
         {std::make_pair("methods", pairsOfMethods(group)),
          std::make_pair("hours", pairsOfHours(group, references, &result.left_out))}) {
      const std::size_t before = result.rows.size();
      addFamily(name, pairs, result);
      if (result.rows.size() > before) compared.insert(compared.end(), pairs.begin(), pairs.end());
    }
  }
  tbb::parallel_for(std::size_t{0}, compared.size(), [&](std::size_t i) {
    stop.check();
    const Paired paired = pairedOf(*compared[i].first, *compared[i].second);
    result.rows[i].test = pairedTest(paired.a, paired.b);
    result.rows[i].unpaired = paired.unpaired;
  });
  adjust(result.rows);
  tellPairedByPlace(compared, result);
  return result;
}

void writeComparisons(const std::string& path, const std::vector<Comparison>& rows) {
  std::string text =
      "metric,family,same,a,b,n,undefined,failed,unpaired,mean_difference,low,high,p,p_holm,block_length\n";
  for (const Comparison& row : rows) {
    const PairedTest& test = row.test;
    text += row.metric + "," + row.family;
    for (const std::string& name : {row.same, row.a, row.b}) text += "," + csvField(name);
    for (const std::size_t count : {test.n, test.undefined, test.failed, row.unpaired})
      text += "," + std::to_string(count);
    for (const double number : {test.mean_difference, test.low, test.high, test.p, row.p_holm})
      text += "," + formatNumber(number);
    text += "," + std::to_string(test.block_length) + "\n";
  }
  image::writeFileAtomically(path, text);
}

}  // namespace sunlit::evaluate
