#include "sunlit/evaluate/verify/verified_file.h"

#include <tbb/parallel_for.h>

#include <fstream>
#include <stdexcept>

#include "evaluate/files/pair_rows.h"
#include "evaluate/verify/measures.h"
#include "sunlit/image/files.h"

namespace sunlit::evaluate {
namespace {

/// The columns of a run that come before those of a pair.
constexpr const char* kOfRun = "pose,stamp,";
constexpr const char* kOfPair = "a,b,detector";

std::string header() {
  std::string text = kOfPair;
  for (const Measure& measure : measures()) text += "," + measure.name;
  return text;
}

// Counts too come out as they should: 17 digits are more than they have.
std::string numbersOf(const Verified& verified) {
  std::string text;
  for (const Measure& measure : measures()) text += "," + formatNumber(measure.of(verified));
  return text.substr(1);
}

Verified parseVerified(const std::vector<std::string>& fields) {
  Verified verified;
  for (std::size_t m = 0; m < measures().size(); ++m)
    measures()[m].read(fields[kFieldsBeforeValue + m], verified);
  return verified;
}

const ValueColumns<Verified>& columns() {
  static const ValueColumns<Verified> all{verifiedHeader(), "detector", numbersOf, parseVerified};
  return all;
}

}  // namespace

void writeVerified(const std::string& path, const std::vector<VerifiedRow>& rows) {
  std::string text = header() + "\n";
  for (const VerifiedRow& row : rows) {
    text +=
        csvField(row.a) + "," + csvField(row.b) + "," + row.detector + "," + numbersOf(row.verified) + "\n";
  }
  image::writeFileAtomically(path, text);
}

void requireNoneOfRun(const std::string& path) {
  std::ifstream file(path);
  std::string heading;
  // Other versions may have other measures.
  if (!std::getline(file, heading) || heading.rfind(std::string(kOfRun) + kOfPair, 0) != 0) return;
  throw std::invalid_argument(path +
                              ": this is of an evaluation, which would lose it; choose another folder");
}

std::string verifiedHeader() {
  return kOfRun + header();
}

std::string verifiedText(const FramesLayout& layout, const VerifiedRecord& record) {
  return rowsOf(layout, record, columns());
}

LoadedVerified loadVerified(const std::string& path, const FramesLayout& layout) {
  return loadValues(path, layout, columns());
}

void writeVerifiedRecords(const std::string& path, const FramesLayout& layout,
                          const std::vector<VerifiedRecord>& records) {
  writeValues(path, layout, records, columns());
}

std::vector<VerifiedSummaryRow> summariseVerified(const FramesLayout& layout,
                                                  const std::vector<VerifiedRecord>& sorted_records,
                                                  const StopToken& stop) {
  const std::size_t detectors = layout.differences.size();
  const std::size_t rows_of_pair = detectors * measures().size();
  const auto values = valuesByPair(layout, sorted_records);
  std::vector<VerifiedSummaryRow> rows(layout.pairs.size() * rows_of_pair);
  tbb::parallel_for(std::size_t{0}, rows.size(), [&](std::size_t i) {
    stop.check();
    const std::size_t p = i / rows_of_pair;
    const std::size_t d = i % rows_of_pair / measures().size();
    const Measure& measure = measures()[i % measures().size()];
    std::vector<double> series;
    for (const std::vector<Verified>* of_pose : values[p]) series.push_back(measure.of(of_pose->at(d)));
    rows[i] = {layout.pairs[p].first, layout.pairs[p].second, layout.differences[d], measure.name,
               statisticsOf(series)};
  });
  return rows;
}

void writeVerifiedSummary(const std::string& path, const std::vector<VerifiedSummaryRow>& rows) {
  std::string text = "a,b,detector,measure,n,undefined,mean,sd,ci_low,ci_high\n";
  for (const VerifiedSummaryRow& row : rows) {
    const Statistics& s = row.statistics;
    text += row.a + "," + row.b + "," + row.detector + "," + row.measure + "," + std::to_string(s.n) + "," +
            std::to_string(s.undefined);
    for (const double value : {s.mean, s.sd, s.ci_low, s.ci_high}) text += "," + formatNumber(value);
    text += "\n";
  }
  image::writeFileAtomically(path, text);
}

}  // namespace sunlit::evaluate
