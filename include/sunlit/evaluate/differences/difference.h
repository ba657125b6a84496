/// What every difference between two images can.
#pragma once

#include <memory>
#include <vector>

#include "sunlit/evaluate/differences/difference_value.h"
#include "sunlit/evaluate/features/detector.h"
#include "sunlit/evaluate/features/matching.h"
#include "sunlit/evaluate/picture.h"
#include "sunlit/evaluate/stop_token.h"
#include "sunlit/quantity/field.h"

namespace sunlit::evaluate {

/// One image. The features are those of the difference's own detector; none where it has no detector.
struct View {
  const Picture& picture;
  const Features& features;
};

/// How features of a and b are matched.
struct Matching {
  const BothWays& nearest;  ///< of the features of the two views; empty where the difference has no detector
  RatioTest test;
};

/// One way to tell how far two images of one place differ, with its options.
///
/// To add one: a file like src/evaluate/differences/boolean.cpp, and its row in the table of differences.cpp;
/// then it can be asked for by its name, and its options are parameters. One that only needs another detector
/// is a detector's file, see features/detector.h.
class Difference {
 public:
  virtual ~Difference() = default;
  virtual std::unique_ptr<Difference> clone() const = 0;
  /// Its own options, rows that point into it.
  virtual std::vector<Field> fields() { return {}; }
  /// Whose features it compares; null for one that compares pixels.
  virtual const Detector* detector() const { return nullptr; }
  /// Of two images of equal size. Called from several threads at once, and must not depend on how many there
  /// are. Where it may take seconds it checks `stop` between its steps. Throws std::invalid_argument for
  /// images that it cannot compare.
  virtual DifferenceValue between(const View& a, const View& b, const Matching& matching,
                                  const StopToken& stop) const = 0;
};

/// The value of a difference that is the same both ways and knows no features.
DifferenceValue sameBothWays(double value);

}  // namespace sunlit::evaluate
