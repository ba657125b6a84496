/// What localisation at the end of a run needs of each picture, kept as its features are found.
#pragma once

#include <cstddef>
#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <string>
#include <vector>

#include "evaluate/run/ground_truth.h"
#include "sunlit/evaluate/features/features.h"
#include "sunlit/evaluate/localise/observations.h"
#include "sunlit/evaluate/localise/observed_localisation.h"

namespace sunlit::evaluate {

/// The picture of one stream at one stamp.
struct ObservedPicture {
  std::size_t stream = 0;
  std::int64_t pose = 0;
  std::int64_t stamp_ns = 0;
};

/// All but observe() is called by one thread at a time.
class Observer {
 public:
  struct Setup {
    std::vector<std::string> streams;  ///< all of the run
    ObservedStreams roles;
    std::vector<std::string> detectors;
    std::string file;  ///< of observations
  };
  /// Throws as ObservationFile.
  explicit Observer(const Setup& setup);

  GroundTruth& truth() { return truth_; }
  /// Pose and depth of the stamp are here, and its cameras of those streams that are `needed`, or will not
  /// come; or none of them is needed.
  bool isReady(std::int64_t stamp_ns, const std::vector<char>& needed);
  /// Why a picture of this size can be no key frame or query; empty where it can, or need not.
  std::string faultOf(std::size_t stream, const GroundTruth::View& truth, const cv::Size& size) const;
  bool observes(std::size_t stream, const std::string& detector) const;
  /// Keeps what `detector` found in a picture without fault. Thread-safe.
  void observe(const ObservedPicture& picture, const GroundTruth::View& truth, const std::string& detector,
               const Features& features);

  const ObservationFile& observations() const { return file_; }

 private:
  enum class Role { kNone, kMap, kQuery };
  Setup setup_;
  std::vector<Role> roles_;  // by stream
  GroundTruth truth_;
  ObservationFile file_;
};

}  // namespace sunlit::evaluate
