#include "sunlit/evaluate/verify/verified_file.h"

#include "evaluate/files/files.h"
#include "sunlit/image/files.h"

namespace sunlit::evaluate {
namespace {

std::string header() {
  std::string accuracies;
  for (std::size_t t = 1; t <= kAccuracySteps; ++t) accuracies += "mma_" + std::to_string(t) + "px,";
  return "a,b,detector,features_a,features_b,repeatability,matching_score_3px," + accuracies +
         "mutual_matches,ratio_matches,precision_3px,recall_3px,average_precision_3px,d,d_symmetric,"
         "d_one_to_one\n";
}

std::string lineOf(const VerifiedRow& row) {
  const Verified& v = row.verified;
  const DifferenceValue& d = v.difference;
  std::string line = csvField(row.a) + "," + csvField(row.b) + "," + row.detector + "," +
                     std::to_string(d.features_a) + "," + std::to_string(d.features_b) + "," +
                     formatNumber(v.repeatability) + "," + formatNumber(v.matching_score);
  for (const double accuracy : v.matching_accuracy) line += "," + formatNumber(accuracy);
  line += "," + std::to_string(v.mutual_matches) + "," + std::to_string(d.matches);
  for (const double number : {v.precision, v.recall, v.average_precision, d.value, d.symmetric, d.one_to_one})
    line += "," + formatNumber(number);
  return line + "\n";
}

}  // namespace

void writeVerified(const std::string& path, const std::vector<VerifiedRow>& rows) {
  std::string text = header();
  for (const VerifiedRow& row : rows) text += lineOf(row);
  image::writeFileAtomically(path, text);
}

}  // namespace sunlit::evaluate
