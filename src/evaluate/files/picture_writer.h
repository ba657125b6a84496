/// PNG files of the images that a run keeps.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <mutex>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace sunlit::evaluate {

/// Writes `<folder>/<stream>/<pose as %06d>.png`. A file is there whole or not at all. Thread-safe.
class PictureWriter {
 public:
  explicit PictureWriter(const std::string& folder) : folder_(folder) {}
  /// Makes the picture of a stream and pose that of this stamp, and returns true: it is to be written. One
  /// that is there already, or is another stamp's, only gives way to an image that is evaluated.
  bool claim(const std::string& stream, std::int64_t pose, std::int64_t stamp_ns, bool is_evaluated);
  /// Returns when the file is on the disk; nothing is written where another stamp made the claim since.
  /// Throws std::runtime_error naming the file.
  void write(const std::string& stream, std::int64_t pose, std::int64_t stamp_ns, const cv::Mat& rgb);
  /// Removes a picture, where it is there.
  void remove(const std::string& stream, std::int64_t pose);
  /// The same of one that is that of this stamp by claim().
  void removeOf(const std::string& stream, std::int64_t pose, std::int64_t stamp_ns);
  /// Poses of which a stream has a picture.
  std::vector<std::int64_t> posesOf(const std::string& stream) const;
  /// The poses of all claims until now turned out to be mere numbers: these are free for others, and the
  /// pictures wait for give(). Once.
  void setAside();
  /// What is set aside of this stamp is of this pose, of which the picture of the earliest stamp is kept.
  void give(std::int64_t stamp_ns, std::int64_t pose);
  /// Gives pictures their final number, and removes those that are set aside still.
  void finish(const std::function<std::int64_t(std::int64_t stamp_ns, std::int64_t pose)>& settled_pose);

 private:
  /// A picture that is, or was, set aside.
  struct Aside {
    std::int64_t number = 0;
    std::optional<std::int64_t> pose;  ///< by give()
  };
  std::string pathOf(const std::string& stream, std::int64_t pose) const;
  std::string pathOf(const std::string& stream, const Aside& aside) const;
  bool isClaimedBy(const std::string& stream, std::int64_t pose, std::int64_t stamp_ns);

  std::string folder_;
  std::mutex files_mutex_;   // held while a file is written, which no claim should wait for
  std::mutex stamps_mutex_;  // taken after it, where both are
  std::map<std::pair<std::string, std::int64_t>, std::int64_t> stamps_;  // by stream and pose
  std::map<std::pair<std::int64_t, std::string>, Aside> aside_;  // by stamp and stream; under files_mutex_
};

}  // namespace sunlit::evaluate
