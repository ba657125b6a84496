#include "sunlit/evaluate/files/frames_file.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>
#include <tuple>

#include "evaluate/files/files.h"
#include "sunlit/image/files.h"

namespace sunlit::evaluate {
namespace {

std::uint32_t parseCount(const std::string& text) {
  const double value = parseNumber(text);
  if (!(value >= 0.0 && value <= 4294967295.0) || value != std::floor(value)) {
    throw std::runtime_error("\"" + text + "\" is not a count");
  }
  return static_cast<std::uint32_t>(value);
}

std::int64_t parsePose(const std::string& text) {
  const double value = parseNumber(text);
  constexpr double kExact = 9007199254740992.0;  // 2⁵³: doubles beyond are not all the whole numbers
  if (!(std::abs(value) <= kExact) || value != std::floor(value)) {
    throw std::runtime_error("\"" + text + "\" is not a pose number");
  }
  return static_cast<std::int64_t>(value);
}

std::size_t pairNamed(const FramesLayout& layout, const std::string& a, const std::string& b) {
  const auto found = std::find(layout.pairs.begin(), layout.pairs.end(), std::make_pair(a, b));
  if (found == layout.pairs.end())
    throw std::runtime_error("the pair " + a + ", " + b + " is not one of this run");
  return static_cast<std::size_t>(found - layout.pairs.begin());
}

std::size_t columnOf(const FramesLayout& layout, const std::string& name) {
  for (std::size_t d = 0; d < layout.differences.size(); ++d) {
    if (layout.differences[d] == name) return d;
  }
  throw std::runtime_error("the difference " + name + " is not one of this run");
}

// Rows of one pose and pair, some of which a torn end may have taken.
struct PartialRecord {
  PairRecord record;
  std::vector<char> has_value;
  std::size_t rows = 0;
};

using PartialRecords = std::map<std::pair<std::int64_t, std::size_t>, PartialRecord>;

void addRow(const FramesLayout& layout, const std::vector<std::string>& fields, PartialRecords& partial) {
  const std::size_t pair = pairNamed(layout, fields[2], fields[3]);
  const std::size_t column = columnOf(layout, fields[4]);
  const auto stamp = parseStamp(fields[1]);
  PartialRecord& entry = partial[{stamp, pair}];
  if (entry.has_value.empty()) {
    entry.has_value.assign(layout.differences.size(), 0);
    entry.record.values.resize(layout.differences.size());
  }
  entry.record.pose = parsePose(fields[0]);
  entry.record.stamp_ns = stamp;
  entry.record.pair = pair;
  DifferenceValue& value = entry.record.values[column];
  value.value = parseNumber(fields[5]);
  value.features_a = parseCount(fields[6]);
  value.features_b = parseCount(fields[7]);
  value.matches = parseCount(fields[8]);
  value.zero_second = parseCount(fields[9]);
  value.symmetric = parseNumber(fields[10]);
  value.one_to_one = parseNumber(fields[11]);
  value.matches_back = parseCount(fields[12]);
  value.matches_one_to_one = parseCount(fields[13]);
  entry.has_value[column] = 1;
  ++entry.rows;
}

}  // namespace

std::string framesHeader() {
  return "pose,stamp,a,b,difference,value,features_a,features_b,matches,zero_second,symmetric,one_to_one,"
         "matches_back,matches_one_to_one";
}

std::string framesText(const FramesLayout& layout, const PairRecord& record) {
  const auto& pair = layout.pairs.at(record.pair);
  const std::string start = std::to_string(record.pose) + "," + formatStamp(record.stamp_ns) + "," +
                            pair.first + "," + pair.second + ",";
  std::string text;
  for (std::size_t d = 0; d < layout.differences.size(); ++d) {
    const DifferenceValue& value = record.values.at(d);
    text += start + layout.differences[d] + "," + formatNumber(value.value) + "," +
            std::to_string(value.features_a) + "," + std::to_string(value.features_b) + "," +
            std::to_string(value.matches) + "," + std::to_string(value.zero_second) + "," +
            formatNumber(value.symmetric) + "," + formatNumber(value.one_to_one) + "," +
            std::to_string(value.matches_back) + "," + std::to_string(value.matches_one_to_one) + "\n";
  }
  return text;
}

LoadedFrames loadFrames(const std::string& path, const FramesLayout& layout) {
  const CsvLines lines = readCsv(path, framesHeader());
  LoadedFrames loaded;
  loaded.dropped_lines = lines.torn;
  PartialRecords partial;
  for (std::size_t i = 0; i < lines.rows.size(); ++i) {
    try {
      addRow(layout, lines.rows[i], partial);
    } catch (const std::exception& error) {
      throw std::runtime_error(path + ":" + std::to_string(i + 2) + ": " + error.what());
    }
  }
  for (auto& item : partial) {
    PartialRecord& entry = item.second;
    const bool is_whole = std::count(entry.has_value.begin(), entry.has_value.end(), 1) ==
                          static_cast<std::ptrdiff_t>(entry.has_value.size());
    if (is_whole) {
      loaded.records.push_back(std::move(entry.record));
    } else {
      loaded.dropped_lines += entry.rows;
    }
  }
  return loaded;
}

void sortRecords(std::vector<PairRecord>& records) {
  std::stable_sort(records.begin(), records.end(), [](const PairRecord& l, const PairRecord& r) {
    return std::tie(l.pose, l.pair, l.stamp_ns) < std::tie(r.pose, r.pair, r.stamp_ns);
  });
  const auto is_same = [](const PairRecord& l, const PairRecord& r) {
    return l.pose == r.pose && l.pair == r.pair;
  };
  records.erase(std::unique(records.begin(), records.end(), is_same), records.end());
}

void writeFrames(const std::string& path, const FramesLayout& layout,
                 const std::vector<PairRecord>& records) {
  std::string text = framesHeader() + "\n";
  for (const PairRecord& record : records) text += framesText(layout, record);
  image::writeFileAtomically(path, text);
}

namespace {

SummaryRow summaryOf(const std::vector<const DifferenceValue*>& values) {
  SummaryRow row;
  std::vector<double> series;
  const auto statistics = [&](double DifferenceValue::*member) {
    series.clear();
    for (const DifferenceValue* value : values) series.push_back(value->*member);
    return statisticsOf(series);
  };
  row.statistics = statistics(&DifferenceValue::value);
  row.symmetric = statistics(&DifferenceValue::symmetric);
  row.one_to_one = statistics(&DifferenceValue::one_to_one);
  row.overmatched = static_cast<std::size_t>(
      std::count_if(values.begin(), values.end(), [](const auto* value) { return value->isOvermatched(); }));
  return row;
}

}  // namespace

std::vector<SummaryRow> summarise(const FramesLayout& layout, const std::vector<PairRecord>& sorted_records) {
  std::vector<SummaryRow> rows;
  for (std::size_t p = 0; p < layout.pairs.size(); ++p) {
    for (std::size_t d = 0; d < layout.differences.size(); ++d) {
      std::vector<const DifferenceValue*> values;
      for (const PairRecord& record : sorted_records) {
        if (record.pair == p) values.push_back(&record.values.at(d));
      }
      SummaryRow row = summaryOf(values);
      row.a = layout.pairs[p].first;
      row.b = layout.pairs[p].second;
      row.difference = layout.differences[d];
      rows.push_back(row);
    }
  }
  return rows;
}

void writeSummary(const std::string& path, const std::vector<SummaryRow>& rows) {
  std::string text =
      "a,b,difference,n,undefined,mean,sd,ci_low,ci_high,symmetric_mean,symmetric_sd,one_to_one_mean,"
      "one_to_one_sd,overmatched\n";
  for (const SummaryRow& row : rows) {
    const Statistics& s = row.statistics;
    text += row.a + "," + row.b + "," + row.difference + "," + std::to_string(s.n) + "," +
            std::to_string(s.undefined);
    for (const double value : {s.mean, s.sd, s.ci_low, s.ci_high, row.symmetric.mean, row.symmetric.sd,
                               row.one_to_one.mean, row.one_to_one.sd})
      text += "," + formatNumber(value);
    text += "," + std::to_string(row.overmatched) + "\n";
  }
  image::writeFileAtomically(path, text);
}

}  // namespace sunlit::evaluate
