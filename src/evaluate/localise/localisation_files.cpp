#include "sunlit/evaluate/localise/localisation_files.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "evaluate/files/files.h"
#include "evaluate/files/pair_rows.h"
#include "sunlit/evaluate/statistics.h"
#include "sunlit/image/files.h"
#include "sunlit/quantity/eigen_ranges.h"
#include "sunlit/quantity/frames.h"
#include "sunlit/quantity/range.h"

namespace sunlit::evaluate {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

bool isLocalised(const LocalisationRow& row) {
  return row.result.status == LocalisationStatus::kLocalised;
}

/// Rows of one map, query and detector.
LocalisationSummary summaryOf(const std::vector<const LocalisationRow*>& rows) {
  LocalisationSummary summary;
  summary.map = rows.front()->map;
  summary.query = rows.front()->query;
  summary.detector = rows.front()->detector;
  summary.n = rows.size();
  std::vector<double> metres, degrees, relative;
  for (const LocalisationRow* row : rows) {
    const bool is_localised = isLocalised(*row);
    if (!is_localised) ++summary.failures;
    metres.push_back(is_localised ? row->result.error_m : kInfinity);
    degrees.push_back(is_localised ? row->result.error_deg : kInfinity);
    if (row->result.has_baseline) relative.push_back(is_localised ? row->result.relative_deg : kInfinity);
  }
  for (std::size_t r = 0; r < kReaches.size(); ++r) {
    std::vector<double> hits;
    for (const LocalisationRow* row : rows) hits.push_back(isWithin(row->result, kReaches[r]) ? 1.0 : 0.0);
    summary.within[r] = shareOf(hits);
  }
  summary.median_error_m = medianError(metres);
  summary.median_error_deg = medianError(degrees);
  summary.n_relative = relative.size();
  for (std::size_t a = 0; a < kAucAngles_deg.size(); ++a)
    summary.auc[a] = areaUnderRecall(relative, kAucAngles_deg[a]);
  return summary;
}

LocalisationRow localisationRowOf(const std::vector<std::string>& fields) {
  LocalisationRow row;
  row.pose = parseCount(fields[0]);
  row.stamp_ns = parseStamp(fields[1]);
  row.map = fields[2];
  row.query = fields[3];
  row.detector = fields[4];
  row.result.error_m = parseNumber(fields[5]);
  row.result.error_deg = parseNumber(fields[6]);
  row.result.retrieved = parseCount(fields[8]);
  row.result.status = statusOf(fields[9]);
  return row;
}

LocalisationSummary summaryRowOf(const std::vector<std::string>& fields) {
  LocalisationSummary summary;
  std::size_t at = 0;
  const auto text = [&] { return fields.at(at++); };
  const auto count = [&] { return static_cast<std::size_t>(parseCount(text())); };
  const auto number = [&] { return parseNumber(text()); };
  summary.map = text();
  summary.query = text();
  summary.detector = text();
  summary.n = count();
  summary.failures = count();
  for (Statistics& share : summary.within) {
    for (double* const value : {&share.mean, &share.ci_low, &share.ci_high}) *value = number();
  }
  summary.median_error_m = number();
  summary.median_error_deg = number();
  summary.n_relative = count();
  for (double& auc : summary.auc) auc = number();
  return summary;
}

std::string summaryHeader() {
  std::string header =
      "map,query,detector,n,failures" + reachColumns() + ",median_error_m,median_error_deg,n_relative";
  for (const double angle : kAucAngles_deg) header += ",auc_" + textOf(angle) + "deg";
  return header;
}

/// Rows of a file with this header; errors of `of` are those of their line.
template <typename Of>
auto rowsOf(const std::string& path, const std::string& header, const Of& of) {
  std::vector<decltype(of(std::vector<std::string>()))> rows;
  forEachCsvRow(path, header, [&](const std::vector<std::string>& fields) { rows.push_back(of(fields)); });
  return rows;
}

constexpr const char* kHeader = "pose,stamp,map,query,detector,error_m,error_deg,inliers,retrieved,status";

}  // namespace

LocalisationStatus statusOf(const std::string& word) {
  for (const LocalisationStatus status :
       {LocalisationStatus::kLocalised, LocalisationStatus::kNoFeatures, LocalisationStatus::kNotRetrieved,
        LocalisationStatus::kTooFewMatches, LocalisationStatus::kNoPose}) {
    if (wordOf(status) == word) return status;
  }
  throw std::runtime_error("\"" + word + "\" is no status");
}

KeyFrameOrigin originOf(const LocalisedQuery& result, const std::vector<KeyFrameOrigin>& origins) {
  return result.status == LocalisationStatus::kLocalised ? origins.at(result.key_frame) : KeyFrameOrigin{};
}

std::string nameOf(const Reach& reach) {
  return "within_" + textOf(reach.metres) + "m_" + textOf(reach.degrees) + "deg";
}

bool isWithin(const LocalisedQuery& result, const Reach& reach) {
  return result.status == LocalisationStatus::kLocalised && result.error_m <= reach.metres &&
         result.error_deg <= reach.degrees;
}

double medianError(std::vector<double> errors) {
  std::sort(errors.begin(), errors.end());
  const std::size_t half = errors.size() / 2;
  if (errors.size() % 2 == 1) return errors[half];
  return std::isinf(errors[half]) ? kInfinity : (errors[half - 1] + errors[half]) / 2.0;
}

std::string reachColumns() {
  std::string columns;
  for (const Reach& reach : kReaches) {
    for (const char* part : {"", "_low", "_high"}) columns += "," + nameOf(reach) + part;
  }
  return columns;
}

std::string withIntervals(const std::array<Statistics, kReaches.size()>& within) {
  std::string numbers;
  for (const Statistics& share : within) {
    for (const double number : {share.mean, share.ci_low, share.ci_high})
      numbers += "," + formatNumber(number);
  }
  return numbers;
}

std::vector<LocalisationSummary> summariesOf(const std::vector<LocalisationRow>& rows) {
  std::vector<std::vector<const LocalisationRow*>> groups;
  for (const LocalisationRow& row : rows) {
    const auto found = std::find_if(groups.begin(), groups.end(), [&](const auto& group) {
      const LocalisationRow& other = *group.front();
      return other.map == row.map && other.query == row.query && other.detector == row.detector;
    });
    if (found == groups.end()) {
      groups.push_back({&row});
    } else {
      found->push_back(&row);
    }
  }
  std::vector<LocalisationSummary> summaries;
  for (const auto& group : groups) summaries.push_back(summaryOf(group));
  return summaries;
}

double areaUnderRecall(std::vector<double> errors, double largest) {
  if (errors.empty()) return kNaN;
  std::sort(errors.begin(), errors.end());
  const auto all = static_cast<double>(errors.size());
  double area = 0.0;
  double before = 0.0;
  double recall = 0.0;
  for (std::size_t i = 0; i < errors.size() && errors[i] < largest; ++i) {
    const double next = static_cast<double>(i + 1) / all;
    area += (errors[i] - before) * (recall + next) / 2.0;
    before = errors[i];
    recall = next;
  }
  return (area + (largest - before) * recall) / largest;
}

void writeLocalisation(const std::string& path, const std::vector<LocalisationRow>& rows) {
  std::string text = std::string(kHeader) + "\n";
  for (const LocalisationRow& row : rows) {
    const LocalisedQuery& result = row.result;
    text += std::to_string(row.pose) + "," + formatStamp(row.stamp_ns) + "," + csvField(row.map) + "," +
            csvField(row.query) + "," + row.detector + "," + formatNumber(result.error_m) + "," +
            formatNumber(result.error_deg) + "," + std::to_string(result.estimate.inliers.size()) + "," +
            std::to_string(result.retrieved) + "," + wordOf(result.status) + "\n";
  }
  image::writeFileAtomically(path, text);
}

void writeLocalisationPoses(const std::string& path, const std::vector<LocalisationRow>& rows) {
  std::string text = "pose,stamp,map,query,detector,x,y,z,qx,qy,qz,qw,true_x,true_y,true_z\n";
  for (const LocalisationRow& row : rows) {
    text += std::to_string(row.pose) + "," + formatStamp(row.stamp_ns) + "," + csvField(row.map) + "," +
            csvField(row.query) + "," + row.detector;
    const Eigen::Isometry3d link = row.result.estimate.map_from_optical * linkFromOptical().inverse();
    const Eigen::Quaterniond turned(link.rotation());
    const bool is_localised = isLocalised(row);
    for (const double number : {link.translation().x(), link.translation().y(), link.translation().z(),
                                turned.x(), turned.y(), turned.z(), turned.w()})
      text += "," + (is_localised ? formatNumber(number) : "nan");
    const Eigen::Vector3d truth = row.truth.translation();
    for (const double number : truth) text += "," + formatNumber(number);
    text += "\n";
  }
  image::writeFileAtomically(path, text);
}

std::vector<LocalisationRow> loadLocalisation(const std::string& path) {
  return rowsOf(path, kHeader, localisationRowOf);
}

void writeLocalisationSummary(const std::string& path, const std::vector<LocalisationSummary>& summaries) {
  std::string text = summaryHeader() + "\n";
  for (const LocalisationSummary& s : summaries) {
    text += csvField(s.map) + "," + csvField(s.query) + "," + s.detector + "," + std::to_string(s.n) + "," +
            std::to_string(s.failures) + withIntervals(s.within);
    text += "," + formatNumber(s.median_error_m) + "," + formatNumber(s.median_error_deg) + "," +
            std::to_string(s.n_relative);
    for (const double auc : s.auc) text += "," + formatNumber(auc);
    text += "\n";
  }
  image::writeFileAtomically(path, text);
}

std::vector<LocalisationSummary> loadLocalisationSummary(const std::string& path) {
  return rowsOf(path, summaryHeader(), summaryRowOf);
}

void writeLocalisationProblems(const std::string& path, const std::vector<LocalisationProblem>& problems) {
  std::string text = "stream,role,stamp,fault\n";
  for (const LocalisationProblem& problem : problems) {
    text += csvField(problem.stream) + (problem.is_of_map ? ",map," : ",query,") +
            formatStamp(problem.stamp_ns) + "," + csvField(problem.fault) + "\n";
  }
  image::writeFileAtomically(path, text);
}

}  // namespace sunlit::evaluate
