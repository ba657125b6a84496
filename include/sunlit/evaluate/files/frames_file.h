/// frames.csv: every value of every pair of every pose. It is what survives a crash, and all statistics come
/// from it.
#pragma once

#include <algorithm>
#include <cstdint>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "sunlit/evaluate/differences/difference_value.h"
#include "sunlit/evaluate/statistics.h"

namespace sunlit::evaluate {

/// All values of one kind of one pair of one pose.
template <typename Value>
struct PairValues {
  std::int64_t pose = 0;      ///< index along the path
  std::int64_t stamp_ns = 0;  ///< of both images
  std::size_t pair = 0;       ///< index into FramesLayout::pairs
  std::vector<Value> values;  ///< in the order of FramesLayout::differences
};
using PairRecord = PairValues<DifferenceValue>;

/// What the rows are about.
struct FramesLayout {
  std::vector<std::pair<std::string, std::string>> pairs;  ///< names of the streams a, b
  std::vector<std::string> differences;                    ///< by name
};

/// What a frames.csv holds.
template <typename Value>
struct LoadedValues {
  std::vector<PairValues<Value>> records;
  std::size_t dropped_lines = 0;  ///< of a torn end: a line cut short, or a pair whose rows are not all there
};
using LoadedFrames = LoadedValues<DifferenceValue>;

/// The header line and rows of frames.csv.
std::string framesHeader();
std::string framesText(const FramesLayout& layout, const PairRecord& record);

/// Records of an earlier run; none where there is no file. Throws std::runtime_error, with path and line, for
/// anything but a torn end: a foreign pair or difference, or a field that cannot be read.
LoadedFrames loadFrames(const std::string& path, const FramesLayout& layout);

/// Sorts by pose, then pair; of two records of one pose and pair, that of the earlier stamp is kept.
template <typename Value>
void sortRecords(std::vector<PairValues<Value>>& records) {
  using Record = PairValues<Value>;
  std::stable_sort(records.begin(), records.end(), [](const Record& l, const Record& r) {
    return std::tie(l.pose, l.pair, l.stamp_ns) < std::tie(r.pose, r.pair, r.stamp_ns);
  });
  const auto is_same = [](const Record& l, const Record& r) { return l.pose == r.pose && l.pair == r.pair; };
  records.erase(std::unique(records.begin(), records.end(), is_same), records.end());
}
/// Values of each pair of the layout, in the order of the records.
template <typename Value>
std::vector<std::vector<const std::vector<Value>*>> valuesByPair(
    const FramesLayout& layout, const std::vector<PairValues<Value>>& records) {
  std::vector<std::vector<const std::vector<Value>*>> values(layout.pairs.size());
  for (const auto& record : records) values.at(record.pair).push_back(&record.values);
  return values;
}
/// Writes all of frames.csv in one step, in the order given.
void writeFrames(const std::string& path, const FramesLayout& layout, const std::vector<PairRecord>& records);

/// One row of summary.csv.
struct SummaryRow {
  std::string a;
  std::string b;
  std::string difference;
  Statistics statistics;        ///< of the paper's D
  Statistics symmetric;         ///< see DifferenceValue; without an interval, as the next
  Statistics one_to_one;        ///< see DifferenceValue
  std::size_t overmatched = 0;  ///< values for which DifferenceValue::isOvermatched()
};
/// Statistics of sorted records, for each pair and difference of the layout. A pair without records has n 0.
/// In parallel; the result does not depend on the number of threads.
std::vector<SummaryRow> summarise(const FramesLayout& layout, const std::vector<PairRecord>& sorted_records);
/// Writes all columns but the intervals of the latter two in one step.
void writeSummary(const std::string& path, const std::vector<SummaryRow>& rows);

}  // namespace sunlit::evaluate
