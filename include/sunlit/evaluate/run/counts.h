/// What became of the images and pairs of a run, in numbers.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace sunlit::evaluate {

struct StreamCounts {
  std::size_t received = 0;
  std::size_t duplicate = 0;     ///< stamp had come before
  std::size_t out_of_order = 0;  ///< used all the same
  std::size_t undecodable = 0;
  std::size_t late = 0;     ///< came after its stamp had been given up
  std::size_t dropped = 0;  ///< given up to bound the memory, or since the run was broken off
  std::size_t lost = 0;  ///< or left out by a throttle, as far as told by addLost(); not among the received
  std::size_t unexpected = 0;   ///< of a pose that is not one of those expected
  std::size_t lossy = 0;        ///< compressed with loss
  std::size_t no_features = 0;  ///< a detector found nothing in it; once for each that did not
  std::size_t unlocalised = 0;  ///< could be neither key frame nor query, or not for all detectors
  std::size_t other_sun = 0;    ///< captures under another sun than the first
  std::string other_sun_fault;  ///< of the first of them, in words
  std::optional<std::int64_t> only_stamp_ns;  ///< that all of them have, where they have one alone
  /// Most were left out, as those of a driver that sets no stamps are: what was evaluated is not what was
  /// sent.
  bool isMostlyDuplicate() const { return duplicate > received - duplicate; }
};

/// evaluated + resumed + the others = pairs asked for.
struct PairCounts {
  std::size_t evaluated = 0;        ///< in this run; undefined values included
  std::size_t resumed = 0;          ///< taken over from an earlier run
  std::size_t missing_partner = 0;  ///< one image never came, or both
  std::size_t undecodable = 0;
  std::size_t size_mismatch = 0;
  std::size_t dropped = 0;     ///< given up to bound the memory, or since the run was broken off
  std::size_t failed = 0;      ///< the comparison itself failed
  std::size_t unplaced = 0;    ///< no capture said which pose it is, or the stamp lies before the first
  std::size_t duplicate = 0;   ///< an earlier stamp is of the same pose; that one counts
  std::size_t other_sun = 0;   ///< one image was taken under another sun than the first of its stream
  std::size_t two_places = 0;  ///< poses of its stamp differ: its images may be of two recordings
  std::size_t notEvaluated() const {
    return missing_partner + undecodable + size_mismatch + dropped + failed + unplaced + duplicate +
           other_sun + two_places;
  }
};

struct Counts {
  std::vector<StreamCounts> streams;  ///< in the order of the options
  std::vector<PairCounts> pairs;
  std::size_t completed_poses = 0;   ///< all their pairs are accounted for; unexpected ones included
  std::size_t passed_poses = 0;      ///< of them: that a sender may count as done, see EvaluationCallbacks
  std::size_t unexpected_poses = 0;  ///< of them: not among those expected
  std::size_t waiting_images = 0;    ///< for a partner
  std::size_t queued_poses = 0;      ///< whole, but not compared yet
  std::size_t after_end = 0;         ///< images that came after finish(), and were left out
  std::size_t bytes = 0;             ///< of what waits, as the memory limit counts them
  std::vector<std::size_t> awaited_streams;  ///< that the oldest waiting stamp lacks
  bool awaits_truth = false;  ///< it has all streams, but lacks the pose, depth or camera to localise by

  /// Completed poses that were not left out as unexpected.
  std::size_t evaluatedPoses() const { return completed_poses - unexpected_poses; }
};

}  // namespace sunlit::evaluate
