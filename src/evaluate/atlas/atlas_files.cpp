#include "sunlit/evaluate/atlas/atlas_files.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <limits>
#include <numeric>
#include <stdexcept>

#include "evaluate/files/files.h"
#include "evaluate/files/pair_rows.h"
#include "sunlit/image/files.h"

namespace sunlit::evaluate {
namespace {

constexpr const char* kRowsHeader =
    "pose,status,error_m,error_deg,inliers,d,matching_score_3px,precision_3px,ev100";

AtlasRow rowOf(const std::vector<std::string>& fields) {
  AtlasRow row;
  row.pose = static_cast<std::int64_t>(parseCount(fields[0]));
  row.status = statusOf(fields[1]);
  row.error_m = parseNumber(fields[2]);
  row.error_deg = parseNumber(fields[3]);
  row.inliers = parseCount(fields[4]);
  row.difference = parseNumber(fields[5]);
  row.matching_score = parseNumber(fields[6]);
  row.precision = parseNumber(fields[7]);
  row.ev100 = parseNumber(fields[8]);
  return row;
}

std::vector<double> column(const std::vector<AtlasRow>& rows, double AtlasRow::*member) {
  std::vector<double> values;
  for (const AtlasRow& row : rows) values.push_back(row.*member);
  return values;
}

double averageOf(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

/// Infinite where there is no pose.
std::vector<double> errors(const std::vector<AtlasRow>& rows, double AtlasRow::*member) {
  std::vector<double> values;
  for (const AtlasRow& row : rows)
    values.push_back(row.status == LocalisationStatus::kLocalised ? row.*member
                                                                  : std::numeric_limits<double>::infinity());
  return values;
}

/// 1 for each query within reach, else 0.
std::vector<double> hits(const std::vector<AtlasRow>& rows, const Reach& reach) {
  std::vector<double> values;
  for (const AtlasRow& row : rows) {
    LocalisedQuery result;
    result.status = row.status;
    result.error_m = row.error_m;
    result.error_deg = row.error_deg;
    values.push_back(isWithin(result, reach) ? 1.0 : 0.0);
  }
  return values;
}

}  // namespace

AtlasCell cellOf(const AtlasCellKey& key, const std::vector<AtlasRow>& rows) {
  AtlasCell cell;
  cell.key = key;
  cell.n = rows.size();
  cell.failures = static_cast<std::size_t>(std::count_if(rows.begin(), rows.end(), [](const AtlasRow& row) {
    return row.status != LocalisationStatus::kLocalised;
  }));
  const std::vector<double> metres = errors(rows, &AtlasRow::error_m);
  const std::vector<double> degrees = errors(rows, &AtlasRow::error_deg);
  for (std::size_t r = 0; r < kReaches.size(); ++r) cell.within[r] = shareOf(hits(rows, kReaches[r]));
  cell.median_error_m = medianError(metres);
  cell.median_error_deg = medianError(degrees);
  cell.difference = statisticsOf(column(rows, &AtlasRow::difference));
  cell.matching_score = statisticsOf(column(rows, &AtlasRow::matching_score));
  cell.precision = statisticsOf(column(rows, &AtlasRow::precision));
  return cell;
}

void writeAtlasRows(const std::string& path, const std::vector<AtlasRow>& rows) {
  std::string text = std::string(kRowsHeader) + "\n";
  for (const AtlasRow& row : rows) {
    text += std::to_string(row.pose) + "," + wordOf(row.status) + "," + formatNumber(row.error_m) + "," +
            formatNumber(row.error_deg) + "," + std::to_string(row.inliers) + "," +
            formatNumber(row.difference) + "," + formatNumber(row.matching_score) + "," +
            formatNumber(row.precision) + "," + formatNumber(row.ev100) + "\n";
  }
  image::writeFileAtomically(path, text);
}

std::vector<AtlasRow> readAtlasRows(const std::string& path) {
  std::vector<AtlasRow> rows;
  const std::size_t torn =
      forEachCsvRow(path, kRowsHeader, [&](const auto& fields) { rows.push_back(rowOf(fields)); });
  if (torn > 0 || rows.empty()) throw std::runtime_error(path + ": is not whole; remove it");
  return rows;
}

AtlasSummary summariseAtlas(const std::vector<AtlasCellKey>& keys,
                            const std::function<std::string(const AtlasCellKey&)>& file_of) {
  AtlasSummary summary;
  summary.cells.resize(keys.size());
  std::vector<double> ev100(keys.size());
  tbb::parallel_for(std::size_t{0}, keys.size(), [&](std::size_t i) {
    const std::vector<AtlasRow> rows = readAtlasRows(file_of(keys[i]));
    summary.cells[i] = cellOf(keys[i], rows);
    ev100[i] = averageOf(column(rows, &AtlasRow::ev100));
  });
  for (std::size_t i = 0; i < keys.size(); ++i) summary.ev100.emplace(keys[i].query, ev100[i]);
  return summary;
}

void writeAtlas(const std::string& path, const std::vector<AtlasCell>& cells) {
  std::string text = "map,query,method,n,failures" + reachColumns() + ",median_error_m,median_error_deg";
  for (const std::string measure : {"d", "matching_score_3px", "precision_3px"})
    text += "," + measure + "," + measure + "_low," + measure + "_high," + measure + "_undefined";
  text += "\n";
  for (const AtlasCell& cell : cells) {
    text += csvField(cell.key.map) + "," + csvField(cell.key.query) + "," + cell.key.method + "," +
            std::to_string(cell.n) + "," + std::to_string(cell.failures) + withIntervals(cell.within) + "," +
            formatNumber(cell.median_error_m) + "," + formatNumber(cell.median_error_deg);
    for (const Statistics* measure : {&cell.difference, &cell.matching_score, &cell.precision}) {
      for (const double number : {measure->mean, measure->ci_low, measure->ci_high})
        text += "," + formatNumber(number);
      text += "," + std::to_string(measure->undefined);
    }
    text += "\n";
  }
  image::writeFileAtomically(path, text);
}

}  // namespace sunlit::evaluate
