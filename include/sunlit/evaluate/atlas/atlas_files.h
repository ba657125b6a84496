/// The files of an atlas: of each cell its queries, one a line, and of all cells what they come to.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "sunlit/evaluate/atlas/atlas.h"
#include "sunlit/evaluate/localise/localisation_files.h"
#include "sunlit/evaluate/statistics.h"

namespace sunlit::evaluate {

/// All queries of one map, condition and method. A query without a pose is a failure: within no reach, and
/// its error is infinite.
struct AtlasCell {
  AtlasCellKey key;
  std::size_t n = 0;  ///< the denominator of all shares
  std::size_t failures = 0;
  std::array<Statistics, kReaches.size()> within;  ///< of 0 and 1; the mean is the share, with its interval
  double median_error_m = 0.0;                     ///< of all n; infinite where half of them are failures
  double median_error_deg = 0.0;
  Statistics difference;
  Statistics matching_score;
  Statistics precision;
};

/// `rows`, one or more, in the order of the path.
AtlasCell cellOf(const AtlasCellKey& key, const std::vector<AtlasRow>& rows);

/// pose,status,error_m,error_deg,inliers,d,matching_score_3px,precision_3px,ev100; numbers with 17 digits,
/// "nan" where undefined. In one step.
void writeAtlasRows(const std::string& path, const std::vector<AtlasRow>& rows);
/// Throws std::runtime_error with path and line for what writeAtlasRows() does not write.
std::vector<AtlasRow> readAtlasRows(const std::string& path);

/// All cells, and with which exposure the pictures of each condition were taken on average.
struct AtlasSummary {
  std::vector<AtlasCell> cells;         ///< as the keys
  std::map<std::string, double> ev100;  ///< by condition
};

/// Of the cells whose rows are in the files that `file_of` names. In parallel; the result does not depend on
/// the number of threads. Throws as readAtlasRows().
AtlasSummary summariseAtlas(const std::vector<AtlasCellKey>& keys,
                            const std::function<std::string(const AtlasCellKey&)>& file_of);

/// atlas.csv: map,query,method,n,failures, of each reach within_0.25m_2deg with …_low and …_high (its 95 %
/// interval), median_error_m,median_error_deg, and d, matching_score_3px, precision_3px, each a mean with
/// …_low, …_high and …_undefined. In one step.
void writeAtlas(const std::string& path, const std::vector<AtlasCell>& cells);

}  // namespace sunlit::evaluate
