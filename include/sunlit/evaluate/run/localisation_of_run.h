/// A run whose streams are looked for in a map made of one of them.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sunlit/evaluate/differences/comparer.h"
#include "sunlit/evaluate/localise/localisation.h"
#include "sunlit/quantity/field.h"

namespace sunlit::evaluate {

struct LocalisationOfRun {
  /// Stream whose images make the map, or several, "h04+h12"; empty: nothing is localised.
  std::string map;
  std::vector<std::string> queries;  ///< streams; empty: all others that are in a pair
  /// Some of the compared differences; nothing given: sift and orb, where they are among them.
  std::optional<std::vector<std::string>> detectors;
  double map_every_m = 5.0;
  LocaliserOptions localiser;
};

/// Rows "localisation/…"; the choice of detectors is among those of `comparer`, which must outlive the rows.
std::vector<Field> fieldsOf(LocalisationOfRun& options, const ComparerOptions& comparer);

/// What `detectors` and `map` come to; of `queries` see queriesOf().
std::vector<std::string> localisingDetectors(const LocalisationOfRun& options,
                                             const ComparerOptions& comparer);
std::vector<std::string> mapStreamsOf(const LocalisationOfRun& options);

}  // namespace sunlit::evaluate
