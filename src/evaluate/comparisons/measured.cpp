#include "sunlit/evaluate/comparisons/measured.h"

#include <algorithm>
#include <limits>
#include <map>
#include <numeric>
#include <tuple>

#include "evaluate/verify/measures.h"
#include "sunlit/evaluate/files/stream_name.h"

namespace sunlit::evaluate {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
const char* const kVerifiedMetrics[] = {"matching_score_3px", "precision_3px"};

/// One series for each pair and name, of what `of` makes of its values.
template <typename Value, typename Of>
std::vector<Measured> seriesOf(const FramesLayout& layout, const std::vector<PairValues<Value>>& records,
                               const std::string& metric, const Of& of) {
  const std::size_t names = layout.differences.size();
  std::vector<Measured> all(layout.pairs.size() * names);
  for (std::size_t i = 0; i < all.size(); ++i) {
    const auto& pair = layout.pairs[i / names];
    all[i].metric = metric;
    all[i].hours = pair.first + "-" + pair.second;
    all[i].streams = {pair.first, pair.second};
    all[i].method = layout.differences[i % names];
  }
  for (const auto& record : records) {
    for (std::size_t d = 0; d < names; ++d)
      all[record.pair * names + d].values.emplace_back(record.pose, of(record.values.at(d)));
  }
  std::vector<Measured> kept;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const auto& [a, b] = layout.pairs[i / names];
    if (!isSelfTest(a, b)) kept.push_back(std::move(all[i]));
  }
  return kept;
}

const Measure& measureNamed(const std::string& name) {
  return *std::find_if(measures().begin(), measures().end(),
                       [&](const Measure& measure) { return measure.name == name; });
}

/// By rising pose, values with their places.
void sort(Measured& series) {
  std::vector<std::size_t> order(series.values.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t l, std::size_t r) { return series.values[l] < series.values[r]; });
  Measured unsorted = series;
  for (std::size_t i = 0; i < order.size(); ++i) {
    series.values[i] = unsorted.values[order[i]];
    series.places[i] = unsorted.places[order[i]];
  }
}

double errorOf(const LocalisedQuery& result) {
  return result.status == LocalisationStatus::kLocalised ? result.error_m : kInfinity;
}

/// One series for each query and detector, in the order in which they first occur.
template <typename Of>
void addSeries(const std::vector<LocalisationRow>& rows, const std::string& metric, const Of& of,
               std::vector<Measured>& all) {
  std::map<std::tuple<std::string, std::string, std::string>, std::size_t> places;
  for (const LocalisationRow& row : rows) {
    const auto [found, is_new] = places.emplace(std::tie(row.map, row.query, row.detector), all.size());
    if (is_new) {
      Measured series;
      series.metric = metric;
      series.hours = row.query + " in " + row.map;
      series.streams = {row.map};
      series.method = row.detector;
      series.drive = row.drive;
      all.push_back(series);
    }
    Measured& series = all[found->second];
    series.values.emplace_back(static_cast<std::int64_t>(row.pose), of(row.result));
    series.places.push_back({row.truth.translation(), row.truth.linear().col(2)});
  }
}

}  // namespace

std::vector<Measured> measuredOf(const FramesLayout& layout, const std::vector<PairRecord>& sorted_records,
                                 const std::vector<std::string>& detectors) {
  std::vector<Measured> all =
      seriesOf(layout, sorted_records, "d", [](const DifferenceValue& value) { return value.value; });
  for (Measured& one : all)
    one.is_of_features = std::count(detectors.begin(), detectors.end(), one.method) > 0;
  return all;
}

std::vector<Measured> measuredOf(const FramesLayout& layout,
                                 const std::vector<VerifiedRecord>& sorted_records) {
  std::vector<Measured> all;
  for (const char* name : kVerifiedMetrics) {
    const Measure& measure = measureNamed(name);
    for (Measured& one :
         seriesOf(layout, sorted_records, name, [&](const Verified& value) { return measure.of(value); }))
      all.push_back(std::move(one));
  }
  return all;
}

std::vector<Measured> measuredOf(const std::vector<LocalisationRow>& rows) {
  std::vector<Measured> all;
  for (const Reach& reach : kReaches) {
    addSeries(
        rows, nameOf(reach),
        [&](const LocalisedQuery& result) { return isWithin(result, reach) ? 1.0 : 0.0; }, all);
  }
  addSeries(rows, "error_m", errorOf, all);
  for (Measured& one : all) sort(one);
  return all;
}

}  // namespace sunlit::evaluate
