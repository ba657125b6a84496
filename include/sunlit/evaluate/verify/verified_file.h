/// verified.csv: what features of pairs of pictures are worth.
#pragma once

#include <string>
#include <vector>

#include "sunlit/evaluate/files/frames_file.h"
#include "sunlit/evaluate/stop_token.h"
#include "sunlit/evaluate/verify/verify.h"

namespace sunlit::evaluate {

/// One pair and detector.
struct VerifiedRow {
  std::string a;  ///< names of the pictures, of any characters
  std::string b;
  std::string detector;
  Verified verified;
};

/// Columns `a,b,detector,features_a,features_b,repeatability,matching_score_3px,mma_1px,…,mma_10px,
/// mutual_matches,ratio_matches,precision_3px,recall_3px,average_precision_3px,d,d_symmetric,d_one_to_one`;
/// numbers with 17 digits, `nan` where undefined, as in frames.csv. Leaves the whole file or what was there.
/// Throws std::runtime_error with path and reason.
void writeVerified(const std::string& path, const std::vector<VerifiedRow>& rows);
/// Throws std::invalid_argument, naming it, where `path` is the verified.csv of a run, see below, of this
/// version or another: writeVerified() would put its rows in the place of those.
void requireNoneOfRun(const std::string& path);

/// Of one pair of one pose, by detector; FramesLayout::differences are the names of the detectors.
using VerifiedRecord = PairValues<Verified>;
using LoadedVerified = LoadedValues<Verified>;

/// The verified.csv of a run: `pose,stamp` before the columns above. As the functions of frames_file.h; what
/// has no column (common points, correspondences) is 0 where it is loaded.
std::string verifiedHeader();
std::string verifiedText(const FramesLayout& layout, const VerifiedRecord& record);
LoadedVerified loadVerified(const std::string& path, const FramesLayout& layout);
void writeVerifiedRecords(const std::string& path, const FramesLayout& layout,
                          const std::vector<VerifiedRecord>& records);

/// One row of verified_summary.csv.
struct VerifiedSummaryRow {
  std::string a;
  std::string b;
  std::string detector;
  std::string measure;  ///< name of a column of verified.csv
  Statistics statistics;
};
/// Statistics of sorted records, for each pair, detector and measure. In parallel; the result does not depend
/// on the number of threads. Throws Stopped.
std::vector<VerifiedSummaryRow> summariseVerified(const FramesLayout& layout,
                                                  const std::vector<VerifiedRecord>& sorted_records,
                                                  const StopToken& stop = {});
/// Columns `a,b,detector,measure,n,undefined,mean,sd,ci_low,ci_high`, in one step.
void writeVerifiedSummary(const std::string& path, const std::vector<VerifiedSummaryRow>& rows);

}  // namespace sunlit::evaluate
