/// What a run measured, in the one form in which methods and hours are compared.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "sunlit/evaluate/files/frames_file.h"
#include "sunlit/evaluate/localise/localisation_files.h"
#include "sunlit/evaluate/verify/verified_file.h"

namespace sunlit::evaluate {

/// Where a value was measured.
struct MeasuredPlace {
  Eigen::Vector3d position;   ///< of the camera in `map`, m
  Eigen::Vector3d direction;  ///< of its axis there, of length 1
};

/// One metric of one method between the same hours, along the path.
struct Measured {
  std::string metric;                ///< name of a column of a result file
  std::string hours;                 ///< "h04-h12" of a pair of streams, "h04 in h12" of a query in a map
  std::vector<std::string> streams;  ///< that it can be compared by with other hours: of the pair, or the map
  std::string method;
  bool is_of_features = true;  ///< a difference of pixels is no method to localise by
  std::vector<std::pair<std::int64_t, double>> values;  ///< by rising pose; NaN undefined, infinite failed
  std::string drive = {};  ///< of which the values are: those of one have the same poses at the same numbers
  std::vector<MeasuredPlace> places = {};  ///< one a value, of queries; else none, and all is of one drive
};

/// "d", of the records that writeFrames() takes. `detectors` are those of the differences that match
/// features. A stream and its second rendering, which the experiment calls self_test/NAME, make no series.
std::vector<Measured> measuredOf(const FramesLayout& layout, const std::vector<PairRecord>& sorted_records,
                                 const std::vector<std::string>& detectors);
/// "matching_score_3px" and "precision_3px".
std::vector<Measured> measuredOf(const FramesLayout& layout,
                                 const std::vector<VerifiedRecord>& sorted_records);
/// "within_0.25m_2deg" and so on, 1 or 0, and "error_m", infinite for a query without a pose.
std::vector<Measured> measuredOf(const std::vector<LocalisationRow>& rows);

}  // namespace sunlit::evaluate
