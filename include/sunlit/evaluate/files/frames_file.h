/// frames.csv: every value of every pair of every pose. It is what survives a crash, and all statistics come
/// from it.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "sunlit/evaluate/differences/difference_value.h"
#include "sunlit/evaluate/statistics.h"

namespace sunlit::evaluate {

/// All differences of one pair of one pose.
struct PairRecord {
  std::int64_t pose = 0;                ///< index along the path
  std::int64_t stamp_ns = 0;            ///< of both images
  std::size_t pair = 0;                 ///< index into FramesLayout::pairs
  std::vector<DifferenceValue> values;  ///< in the order of FramesLayout::differences
};

/// What the rows are about.
struct FramesLayout {
  std::vector<std::pair<std::string, std::string>> pairs;  ///< names of the streams a, b
  std::vector<std::string> differences;                    ///< by name
};

/// What a frames.csv holds.
struct LoadedFrames {
  std::vector<PairRecord> records;
  std::size_t dropped_lines = 0;  ///< of a torn end: a line cut short, or a pair whose rows are not all there
};

/// The header line and rows of frames.csv.
std::string framesHeader();
std::string framesText(const FramesLayout& layout, const PairRecord& record);

/// Records of an earlier run; none where there is no file. Throws std::runtime_error, with path and line, for
/// anything but a torn end: a foreign pair or difference, or a field that cannot be read.
LoadedFrames loadFrames(const std::string& path, const FramesLayout& layout);

/// Sorts by pose, then pair; of two records of one pose and pair, that of the earlier stamp is kept.
void sortRecords(std::vector<PairRecord>& records);
/// Writes all of frames.csv in one step, in the order given.
void writeFrames(const std::string& path, const FramesLayout& layout, const std::vector<PairRecord>& records);

/// One row of summary.csv.
struct SummaryRow {
  std::string a;
  std::string b;
  std::string difference;
  Statistics statistics;        ///< of the paper's D
  Statistics symmetric;         ///< see DifferenceValue
  Statistics one_to_one;        ///< see DifferenceValue
  std::size_t overmatched = 0;  ///< values for which DifferenceValue::isOvermatched()
};
/// Statistics of sorted records, for each pair and difference of the layout. A pair without records has n 0.
std::vector<SummaryRow> summarise(const FramesLayout& layout, const std::vector<PairRecord>& sorted_records);
/// Writes all columns but the intervals of the latter two in one step.
void writeSummary(const std::string& path, const std::vector<SummaryRow>& rows);

}  // namespace sunlit::evaluate
