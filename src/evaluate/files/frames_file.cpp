#include "sunlit/evaluate/files/frames_file.h"

#include <tbb/parallel_for.h>

#include "evaluate/files/pair_rows.h"

namespace sunlit::evaluate {
namespace {

DifferenceValue parseValue(const std::vector<std::string>& fields) {
  DifferenceValue value;
  value.value = parseNumber(fields[5]);
  value.features_a = parseCount(fields[6]);
  value.features_b = parseCount(fields[7]);
  value.matches = parseCount(fields[8]);
  value.zero_second = parseCount(fields[9]);
  value.symmetric = parseNumber(fields[10]);
  value.one_to_one = parseNumber(fields[11]);
  value.matches_back = parseCount(fields[12]);
  value.matches_one_to_one = parseCount(fields[13]);
  return value;
}

std::string valueText(const DifferenceValue& value) {
  return formatNumber(value.value) + "," + std::to_string(value.features_a) + "," +
         std::to_string(value.features_b) + "," + std::to_string(value.matches) + "," +
         std::to_string(value.zero_second) + "," + formatNumber(value.symmetric) + "," +
         formatNumber(value.one_to_one) + "," + std::to_string(value.matches_back) + "," +
         std::to_string(value.matches_one_to_one);
}

const ValueColumns<DifferenceValue>& frameColumns() {
  static const ValueColumns<DifferenceValue> all{framesHeader(), "difference", valueText, parseValue};
  return all;
}

}  // namespace

std::string framesHeader() {
  return "pose,stamp,a,b,difference,value,features_a,features_b,matches,zero_second,symmetric,one_to_one,"
         "matches_back,matches_one_to_one";
}

std::string framesText(const FramesLayout& layout, const PairRecord& record) {
  return rowsOf(layout, record, frameColumns());
}

LoadedFrames loadFrames(const std::string& path, const FramesLayout& layout) {
  return loadValues(path, layout, frameColumns());
}

void writeFrames(const std::string& path, const FramesLayout& layout,
                 const std::vector<PairRecord>& records) {
  writeValues(path, layout, records, frameColumns());
}

namespace {

SummaryRow summaryOf(const std::vector<const std::vector<DifferenceValue>*>& values, std::size_t difference) {
  SummaryRow row;
  const auto series = [&](double DifferenceValue::*member) {
    std::vector<double> one;
    for (const auto* of_pose : values) one.push_back(of_pose->at(difference).*member);
    return one;
  };
  row.statistics = statisticsOf(series(&DifferenceValue::value));
  row.symmetric = momentsOf(series(&DifferenceValue::symmetric));
  row.one_to_one = momentsOf(series(&DifferenceValue::one_to_one));
  row.overmatched =
      static_cast<std::size_t>(std::count_if(values.begin(), values.end(), [&](const auto* of_pose) {
        return of_pose->at(difference).isOvermatched();
      }));
  return row;
}

}  // namespace

std::vector<SummaryRow> summarise(const FramesLayout& layout, const std::vector<PairRecord>& sorted_records) {
  const std::size_t differences = layout.differences.size();
  const auto values = valuesByPair(layout, sorted_records);
  std::vector<SummaryRow> rows(layout.pairs.size() * differences);
  tbb::parallel_for(std::size_t{0}, rows.size(), [&](std::size_t i) {
    const std::size_t p = i / differences;
    rows[i] = summaryOf(values[p], i % differences);
    rows[i].a = layout.pairs[p].first;
    rows[i].b = layout.pairs[p].second;
    rows[i].difference = layout.differences[i % differences];
  });
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
