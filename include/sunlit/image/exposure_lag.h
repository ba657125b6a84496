/// An automatic exposure that takes its time.
#pragma once

#include <cstdint>
#include <deque>

#include "sunlit/image/exposure.h"

namespace sunlit::image {

/// From picture to picture the exposure goes by `adaptation` of what is left towards what was metered `delay`
/// pictures ago: EV += adaptation · (metered − EV), as cameras do. What it was before is forgotten once it
/// counts for less than a hundredth of a stop in three, after memory() pictures: there EV stood at what was
/// metered. So a picture depends on those memory() before it alone, wherever a run begins.
class ExposureLag {
 public:
  /// None, memory() 0, of a fixed exposure.
  explicit ExposureLag(const ExposureOptions& options);

  int memory() const { return memory_; }
  /// The first picture before number `index`, ≥ 0, that must be added before it; `index` itself where none is
  /// missing.
  std::int64_t firstMissing(std::int64_t index) const;
  /// What was metered of picture `index`; those from firstMissing(index) on are there.
  void add(std::int64_t index, double metered_ev100);
  /// That the picture added last is exposed with.
  double ev100() const;

 private:
  double adaptation_;
  int delay_;
  int memory_;
  std::int64_t last_ = -1;      ///< picture that was added last
  std::deque<double> metered_;  ///< of it, and of those before it that are remembered; the last is its
};

}  // namespace sunlit::image
