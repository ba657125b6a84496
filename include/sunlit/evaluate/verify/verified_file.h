/// verified.csv: what features of pairs of pictures are worth.
#pragma once

#include <string>
#include <vector>

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

}  // namespace sunlit::evaluate
