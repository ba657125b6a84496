/// How well queries were found, and the files that tell of it.
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "sunlit/evaluate/localise/localiser.h"
#include "sunlit/evaluate/statistics.h"

namespace sunlit::evaluate {

/// A query and what became of it.
struct LocalisationRow {
  std::size_t pose = 0;
  std::int64_t stamp_ns = 0;
  std::string map;  ///< what is called so, as the query; of any characters
  std::string query;
  std::string detector;
  LocalisedQuery result;
  Eigen::Isometry3d truth = Eigen::Isometry3d::Identity();  ///< map_from_optical
  KeyFrameOrigin key_frame;  ///< that with the most inliers; none unless localised
  std::string drive = {};    ///< rows of one drive have the same place at the same pose; in no file
};

/// Of LocalisedQuery::key_frame; none unless localised. `origins` of all key frames of the map, one by one.
KeyFrameOrigin originOf(const LocalisedQuery& result, const std::vector<KeyFrameOrigin>& origins);

/// The other way from wordOf(). Throws std::runtime_error for another word.
LocalisationStatus statusOf(const std::string& word);

/// An image that could be used neither for the map nor as a query, or that a detector is blind to; or what is
/// to be known of its pose.
struct LocalisationProblem {
  std::string stream;
  bool is_of_map = false;
  std::int64_t stamp_ns = 0;
  std::string fault;     ///< in words
  bool is_used = false;  ///< all the same, as what tells what light does to a detector
};

/// A query is within reach where neither error is more.
struct Reach {
  double metres;
  double degrees;
};
/// Those of visuallocalization.net (T. Sattler et al., CVPR 2018).
constexpr std::array<Reach, 3> kReaches = {{{0.25, 2.0}, {0.5, 5.0}, {5.0, 10.0}}};
/// "within_0.25m_2deg", the name of a column.
std::string nameOf(const Reach& reach);
/// False for a query without a pose.
bool isWithin(const LocalisedQuery& result, const Reach& reach);
constexpr std::array<double, 3> kAucAngles_deg = {5.0, 10.0, 20.0};

/// Infinite where half of them are. One or more.
double medianError(std::vector<double> errors);

/// ",within_0.25m_2deg,within_0.25m_2deg_low,within_0.25m_2deg_high,…" of all reaches, and their values.
std::string reachColumns();
std::string withIntervals(const std::array<Statistics, kReaches.size()>& within);

/// Queries of one stream by one detector. A query without a pose is a failure: within no reach, and its
/// errors are infinite.
struct LocalisationSummary {
  std::string map;
  std::string query;
  std::string detector;
  std::size_t n = 0;  ///< the denominator of all shares
  std::size_t failures = 0;
  std::array<Statistics, kReaches.size()> within;  ///< of 0 and 1; the mean is the share, with its interval
  double median_error_m = 0.0;                     ///< of all n; infinite where half of them are failures
  double median_error_deg = 0.0;
  std::size_t n_relative = 0;  ///< queries with LocalisedQuery::has_baseline
  /// (1/T) ∫₀ᵀ recall(e) de over LocalisedQuery::relative_deg, recall rising in straight lines from error to
  /// error and then staying, as P.-E. Sarlin's Glue Factory has it; of n_relative, NaN where that is 0.
  std::array<double, kAucAngles_deg.size()> auc{};
};

/// One for each map, query and detector, in the order in which they first occur.
std::vector<LocalisationSummary> summariesOf(const std::vector<LocalisationRow>& rows);

/// Area under the recall curve up to `largest`, as above; `errors` ≥ 0, infinite for failures.
double areaUnderRecall(std::vector<double> errors, double largest);

/// localisation.csv: pose,stamp,map,query,detector,error_m,error_deg,inliers,retrieved,status. Numbers with
/// 17 digits, "nan" where there is no pose; retrieved: key frames matched. In one step.
void writeLocalisation(const std::string& path, const std::vector<LocalisationRow>& rows);
/// localisation_poses.csv: pose,stamp,map,query,detector,x,y,z,qx,qy,qz,qw,true_x,true_y,true_z, a line for
/// each of localisation.csv: where camera_link was found in `map`, "nan" where it was not, and where it was.
/// In one step.
void writeLocalisationPoses(const std::string& path, const std::vector<LocalisationRow>& rows);
/// Its rows, of which results have what the columns tell: status, errors and key frames; no estimate. Throws
/// std::runtime_error with path and line.
std::vector<LocalisationRow> loadLocalisation(const std::string& path);

/// localisation_summary.csv: map,query,detector,n,failures, of each reach within_0.25m_2deg with
/// …_low and …_high (its 95 % interval), median_error_m,median_error_deg,n_relative,auc_5deg,auc_10deg,
/// auc_20deg. In one step.
void writeLocalisationSummary(const std::string& path, const std::vector<LocalisationSummary>& summaries);

/// Its rows, of whose shares only mean and interval are there. Throws std::runtime_error with path and line.
std::vector<LocalisationSummary> loadLocalisationSummary(const std::string& path);

/// localisation_problems.csv: stream,role,stamp,fault, role being map or query. In one step.
void writeLocalisationProblems(const std::string& path, const std::vector<LocalisationProblem>& problems);

}  // namespace sunlit::evaluate
