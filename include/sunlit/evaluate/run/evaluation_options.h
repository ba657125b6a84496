/// What an evaluation can be told; config/evaluator.yaml is its manual.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "sunlit/evaluate/differences/comparer.h"
#include "sunlit/evaluate/run/localisation_of_run.h"
#include "sunlit/evaluate/run/pose_range.h"
#include "sunlit/quantity/field.h"

namespace sunlit::evaluate {

/// Two streams to compare; the first gives the queries of the matching.
struct PairSpec {
  std::string a;
  std::string b;
  int every = 1;  ///< only poses 0, every, 2·every, … are compared; ≥ 1; see thinnedPair()
  /// "a-b"
  std::string name() const { return a + "-" + b; }
};

/// Which images are kept as PNG, for reports.
enum class KeptImages { kNone, kSamples, kAll };

struct EvaluationOptions {
  std::vector<std::string> streams;  ///< distinct names, each isStreamName()
  std::vector<PairSpec> pairs;       ///< of streams; empty: all
  ComparerOptions comparer;
  /// Those of the compared differences whose matches are checked against the truth; nothing given: sift and
  /// orb, where they are among them. See verifiedDetectors().
  std::optional<std::vector<std::string>> verify;
  LocalisationOfRun localisation;
  std::string output_dir;  ///< made where it does not exist
  PoseRange poses;         ///< those expected; what comes of others is counted, named and left out
  /// `poses` are all that there are, so that nobody will merge others with them: once they are evaluated,
  /// what merging needs (observations.bin, lost_features.bin) is removed.
  bool is_whole_path = false;
  KeptImages images =
      KeptImages::kSamples;  ///< samples: five evenly spread poses, or every 200th of an unknown number
  double frame_rate = 0.0;   ///< Hz; 0: poses are numbered by captures, or else by the order of the stamps
  std::int64_t stamp_start_ns = 0;  ///< stamp of pose 0, where a frame rate is given
  /// Bytes of images that wait for a partner or for being compared, at 3 a pixel, ≥ 1. A stamp that waits
  /// counts as if all streams had come. Beyond, a stamp is given up, counted and named: the newest while what
  /// is being compared will make room, else the oldest. Stamps that wait for nothing but what they are
  /// localised by are compared without it once they take half of that.
  std::size_t memory_limit_bytes = 1000000000;
  std::vector<std::string>
      merge;  ///< folders of other runs with the same settings, whose values are taken over
  std::vector<std::pair<std::string, std::string>> about;  ///< of the experiment, for run.yaml and reports
};

/// What `verify` comes to.
std::vector<std::string> verifiedDetectors(const EvaluationOptions& options);

/// The first pair that is not compared at each pose; null: there is none. Where there is one, a frame rate or
/// captures must tell the poses, since their order is known when all have come.
const PairSpec* thinnedPair(const EvaluationOptions& options);

/// Of a stream's pictures features are found where they are compared, so that without a pair it is neither
/// map nor query.
bool isInPair(const EvaluationOptions& options, const std::string& stream);
/// What `localisation.queries` come to.
std::vector<std::string> queriesOf(const EvaluationOptions& options);

/// All ordered pairs of streams (first before second), each pose.
std::vector<PairSpec> allPairs(const std::vector<std::string>& streams);

/// Rows of what decides the values, but `about`: a folder holds values of one set of them.
std::vector<Field> decidingFieldsOf(EvaluationOptions& options);
/// Those and the others; but memory_limit_bytes, which people type in GB, and merge.
std::vector<Field> fieldsOf(EvaluationOptions& options);

}  // namespace sunlit::evaluate
