/// What was found in the pictures of a drive, on disk until the map is whole.
#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <mutex>
#include <opencv2/core/mat.hpp>
#include <set>
#include <string>
#include <tuple>
#include <vector>

#include "sunlit/evaluate/features/features.h"
#include "sunlit/evaluate/localise/map.h"
#include "sunlit/image/camera.h"

namespace sunlit::evaluate {

/// Which picture, and which detector.
struct ObservationKey {
  std::string stream;
  std::string detector;
  std::int64_t pose = 0;
  std::int64_t stamp_ns = 0;
};

/// What a detector found in a picture of which it is known where it was taken: enough to be a key frame of a
/// map, if the places of its features are known, or to be looked for in one.
struct Observation {
  image::PinholeCamera camera;
  Eigen::Isometry3d map_from_optical = Eigen::Isometry3d::Identity();
  Features features;                    ///< of key points their places and responses alone
  std::vector<Eigen::Vector3d> points;  ///< in `map`, m, one a feature, NaN where unknown; or none at all
  double ev100 = std::numeric_limits<double>::quiet_NaN();  ///< of the picture; NaN where nobody knows
};

/// What of an observation is known without reading its features.
struct ObservationHead {
  image::PinholeCamera camera;
  Eigen::Isometry3d map_from_optical = Eigen::Isometry3d::Identity();
  double ev100 = std::numeric_limits<double>::quiet_NaN();
};

/// What a file of observations is opened for.
enum class ObservationUse {
  kGrow,  ///< it is made where it does not exist, and a torn end is cut off
  kRead   ///< it is there and whole, and stays as it is
};

/// Observations in one file that only grows, each added by one write: what a killed process left is whole but
/// for its end, which is cut off as it is opened. Thread-safe.
class ObservationFile {
 public:
  /// Throws std::runtime_error with path and reason, of a torn end too where it is only to be read.
  explicit ObservationFile(const std::string& path, ObservationUse use = ObservationUse::kGrow);
  ~ObservationFile();
  ObservationFile(const ObservationFile&) = delete;
  ObservationFile& operator=(const ObservationFile&) = delete;

  /// Throws std::runtime_error with path and reason, such as that the disk is full; then nothing was added.
  void add(const ObservationKey& key, const Observation& observation);
  /// Those in the file, in the order in which they came.
  std::vector<ObservationKey> keys() const;
  /// Whether there is one of this picture and detector, whatever its stamp.
  bool holds(const std::string& stream, const std::string& detector, std::int64_t pose) const;
  /// The one of keys()[index].
  Observation read(std::size_t index) const;
  /// Of the same, for few hundred bytes of reading.
  ObservationHead head(std::size_t index) const;
  /// Of all records.
  std::uint64_t bytes() const;
  /// Bytes that opening cut off.
  std::size_t torn() const { return torn_; }

 private:
  struct Entry {
    ObservationKey key;
    std::uint64_t offset = 0;  // of the record
    std::uint64_t bytes = 0;   // of its payload
  };
  bool readAt(void* data, std::size_t bytes, std::uint64_t offset) const;
  void scan();
  void append(const Entry& entry);
  void cutOff(std::uint64_t size);
  Entry entryAt(std::size_t index) const;
  std::string payload(const Entry& entry, std::uint64_t beginning) const;

  std::string path_;
  ObservationUse use_;
  int descriptor_ = -1;
  std::size_t torn_ = 0;
  mutable std::mutex mutex_;
  std::uint64_t end_ = 0;
  std::vector<Entry> entries_;
  std::set<std::tuple<std::string, std::string, std::int64_t>> held_;  // stream, detector, pose of entries_
};

}  // namespace sunlit::evaluate
