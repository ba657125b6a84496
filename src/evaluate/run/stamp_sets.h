/// Images of equal stamp, brought together.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <string>
#include <unordered_set>
#include <vector>

namespace sunlit::evaluate {

/// What one stream delivered for one stamp.
struct Arrival {
  bool has_come = false;
  cv::Mat rgb;        ///< empty where the image could not be used
  std::string fault;  ///< why it could not
};

inline std::size_t bytesOf(const cv::Mat& image) {
  return image.total() * image.elemSize();
}

/// Everything of one stamp.
struct StampSet {
  std::int64_t stamp_ns = 0;
  std::vector<Arrival> streams;
};

/// Sets that wait for more. A set is open from its first image until it is taken; nothing is ever dropped by
/// itself.
class StampSets {
 public:
  enum class Outcome {
    kKept,
    kDuplicate,  ///< this stream already delivered this stamp; the first stays
    kReplaced,   ///< the same, but the first was unusable and still waited: this one stays
    kClosed      ///< the set was taken before
  };

  explicit StampSets(std::size_t stream_count);
  Outcome add(std::size_t stream, std::int64_t stamp_ns, Arrival arrival);
  /// True where an earlier stamp of this stream came after a later one. Call before add().
  bool isOutOfOrder(std::size_t stream, std::int64_t stamp_ns) const;
  /// That all images of a stream have, where it is one alone.
  std::optional<std::int64_t> onlyStamp(std::size_t stream) const;
  /// An image of that stream did, usable or not, whatever became of its set.
  bool hasCome(std::size_t stream, std::int64_t stamp_ns) const {
    return seen_.at(stream).count(stamp_ns) != 0;
  }
  bool isTaken(std::int64_t stamp_ns) const { return taken_.count(stamp_ns) != 0; }
  const StampSet* find(std::int64_t stamp_ns) const;
  StampSet take(std::int64_t stamp_ns);
  std::vector<std::int64_t> openStamps() const;
  std::optional<std::int64_t> oldest() const;
  std::size_t waitingImages() const { return waiting_images_; }
  /// What the open sets hold once all their streams have come, at the size of the largest image of each.
  std::size_t reservedBytes() const { return reserved_bytes_; }

 private:
  std::map<std::int64_t, StampSet> open_;
  std::unordered_set<std::int64_t> taken_;
  std::vector<std::unordered_set<std::int64_t>> seen_;  // per stream
  std::vector<std::optional<std::int64_t>> newest_;     // per stream
  std::size_t waiting_images_ = 0;
  std::size_t reserved_bytes_ = 0;
};

}  // namespace sunlit::evaluate
