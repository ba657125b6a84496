/// PNG files off the critical path.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <mutex>
#include <opencv2/core/mat.hpp>
#include <string>
#include <thread>
#include <utility>

namespace sunlit::evaluate {

/// Writes `<folder>/<stream>/<pose as %06d>.png`, one after the other on its own thread. A file is there
/// whole or not at all, and one that is there already is not written again.
class PictureWriter {
 public:
  explicit PictureWriter(const std::string& folder);
  ~PictureWriter();
  /// Blocks while 64 pictures wait, so that memory stays bounded.
  void write(const std::string& stream, std::int64_t pose, std::int64_t stamp_ns, const cv::Mat& rgb);
  /// Waits until all is written, and gives pictures their final number. Throws what stopped the writing,
  /// naming the file.
  void finish(const std::function<std::int64_t(std::int64_t stamp_ns, std::int64_t pose)>& settled_pose);

 private:
  struct Task {
    std::string path;
    cv::Mat rgb;
  };
  std::string pathOf(const std::string& stream, std::int64_t pose) const;
  void run();

  std::string folder_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<Task> tasks_;
  std::map<std::pair<std::string, std::int64_t>, std::int64_t> stamps_;  // by stream and pose
  std::string fault_;
  bool is_closed_ = false;
  std::thread thread_;
};

}  // namespace sunlit::evaluate
