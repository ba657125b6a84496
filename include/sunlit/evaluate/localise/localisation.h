/// Pictures of one light found in a map of another, by several detectors at once.
#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "sunlit/evaluate/differences/comparer.h"
#include "sunlit/evaluate/features/feature_cache.h"
#include "sunlit/evaluate/localise/localiser.h"
#include "sunlit/evaluate/posed_view.h"
#include "sunlit/quantity/field.h"

namespace sunlit::evaluate {

struct LocalisationOptions {
  Differences known;  ///< whose detectors are used, with their parameters
  std::vector<std::string> detectors = usualDetectors(ComparerOptions());
  double map_every_m = 5.0;  ///< for KeyFrameSpacing, which is whoever's that brings the views
  LocaliserOptions localiser;
  std::shared_ptr<FeatureCache> cache;  ///< of features; null: none are kept
};

/// "map_every".
Field mapEveryRow(double* map_every_m);
/// Without the parameters of detectors.
std::vector<Field> fieldsOf(LocalisationOptions& options);

/// One of options.detectors. Throws std::invalid_argument for a name that there is not, or that finds no
/// features.
const Detector& detectorOf(const LocalisationOptions& options, const std::string& name);

/// What a map holds of one detector.
struct MapSize {
  std::string detector;
  std::size_t key_frames = 0;
  std::size_t points = 0;
  std::size_t bytes = 0;
};

/// What detectors threw, "sift: …", by view and detector: it costs that view of that detector alone.
using DetectorFaults = std::map<std::pair<std::size_t, std::size_t>, std::string>;

/// What came of views that were to become key frames.
struct AddedKeyFrames {
  DetectorFaults faults;
  /// By view and detector: key frames without a point, since nothing was found whose place depth tells.
  std::set<std::pair<std::size_t, std::size_t>> empty;
};

/// Of each query: [query][detector], in the order of LocalisationOptions::detectors; of no use where there is
/// a fault.
struct LocalisedQueries {
  std::vector<std::vector<LocalisedQuery>> results;
  DetectorFaults faults;
};

/// A map, and queries found in it. Results are the same to the bit for any number of threads.
class Localisation {
 public:
  /// Throws std::invalid_argument for an option out of range, and for a detector that there is not.
  explicit Localisation(const LocalisationOptions& options);
  ~Localisation();
  Localisation(const Localisation&) = delete;
  Localisation& operator=(const Localisation&) = delete;

  const LocalisationOptions& options() const { return options_; }
  /// Each view becomes a key frame of every detector, in their order, but of those that throw. Of a view
  /// features with their points stay, no pixels. Runs in parallel. Throws std::invalid_argument for what
  /// requireWhole() refuses, and for a view without depth.
  AddedKeyFrames addKeyFrames(const std::vector<PosedView>& views);
  /// Needed once, behind the last key frame and before the first query.
  void finishMap();
  std::vector<MapSize> mapSizes() const;
  /// Depth of queries is not used. Runs in parallel. Throws std::invalid_argument for what requireWhole()
  /// refuses.
  LocalisedQueries localise(const std::vector<PosedView>& queries) const;

 private:
  struct PerDetector;
  LocalisationOptions options_;
  std::vector<std::unique_ptr<PerDetector>> detectors_;
};

}  // namespace sunlit::evaluate
