/// CSV files in which each pair of each pose has one row for each of several names, and which survive a
/// crash.
#pragma once

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "evaluate/files/files.h"
#include "sunlit/evaluate/files/frames_file.h"
#include "sunlit/image/files.h"

namespace sunlit::evaluate {

/// How one value stands in its row, behind pose, stamp, a, b and name.
template <typename Value>
struct ValueColumns {
  std::string header;  ///< of the whole file
  std::string called;  ///< what the names are of, such as "difference"
  std::function<std::string(const Value&)> text;
  std::function<Value(const std::vector<std::string>& fields)> parse;  ///< throws std::runtime_error
};

/// Fields of all rows stand before those of the value.
constexpr std::size_t kFieldsBeforeValue = 5;

std::uint32_t parseCount(const std::string& text);

/// What every row begins with.
struct PairRow {
  std::int64_t pose;
  std::int64_t stamp_ns;
  std::size_t pair;
  std::size_t column;  ///< index of the name
};
PairRow pairRowOf(const FramesLayout& layout, const std::vector<std::string>& fields,
                  const std::string& called);

template <typename Value>
std::string rowsOf(const FramesLayout& layout, const PairValues<Value>& record,
                   const ValueColumns<Value>& columns) {
  const auto& pair = layout.pairs.at(record.pair);
  const std::string start = std::to_string(record.pose) + "," + formatStamp(record.stamp_ns) + "," +
                            pair.first + "," + pair.second + ",";
  std::string text;
  for (std::size_t d = 0; d < layout.differences.size(); ++d)
    text += start + layout.differences[d] + "," + columns.text(record.values.at(d)) + "\n";
  return text;
}

/// Rows of one pose and pair, some of which a torn end may have taken.
template <typename Value>
struct PartialValues {
  PairValues<Value> record;
  std::vector<char> has_value;
  std::size_t rows = 0;

  void add(const PairRow& row, std::size_t names, Value value) {
    has_value.resize(names, 0);
    record.values.resize(names);
    record.pose = row.pose;
    record.stamp_ns = row.stamp_ns;
    record.pair = row.pair;
    record.values[row.column] = std::move(value);
    has_value[row.column] = 1;
    ++rows;
  }
  bool isWhole() const { return std::count(has_value.begin(), has_value.end(), 0) == 0; }
};

/// Records of an earlier run; none where there is no file. Throws as loadFrames().
template <typename Value>
LoadedValues<Value> loadValues(const std::string& path, const FramesLayout& layout,
                               const ValueColumns<Value>& columns) {
  LoadedValues<Value> loaded;
  std::map<std::pair<std::int64_t, std::size_t>, PartialValues<Value>> partial;
  loaded.dropped_lines = forEachCsvRow(path, columns.header, [&](const std::vector<std::string>& fields) {
    const PairRow row = pairRowOf(layout, fields, columns.called);
    partial[{row.stamp_ns, row.pair}].add(row, layout.differences.size(), columns.parse(fields));
  });
  for (auto& [key, entry] : partial) {
    if (entry.isWhole()) {
      loaded.records.push_back(std::move(entry.record));
    } else {
      loaded.dropped_lines += entry.rows;
    }
  }
  return loaded;
}

template <typename Value>
void writeValues(const std::string& path, const FramesLayout& layout,
                 const std::vector<PairValues<Value>>& records, const ValueColumns<Value>& columns) {
  constexpr std::size_t kRecordsAtOnce = 1000;
  std::vector<std::string> parts((records.size() + kRecordsAtOnce - 1) / kRecordsAtOnce);
  tbb::parallel_for(std::size_t{0}, parts.size(), [&](std::size_t p) {
    for (std::size_t i = p * kRecordsAtOnce; i < std::min((p + 1) * kRecordsAtOnce, records.size()); ++i)
      parts[p] += rowsOf(layout, records[i], columns);
  });
  std::string text = columns.header + "\n";
  for (const std::string& part : parts) text += part;
  image::writeFileAtomically(path, text);
}

}  // namespace sunlit::evaluate
