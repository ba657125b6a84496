/// Features that were found once, on disk, for all runs and programs.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <string>

#include "sunlit/evaluate/features/features.h"
#include "sunlit/image/cache_folder.h"
#include "sunlit/quantity/field.h"

namespace sunlit::evaluate {

/// What they are kept under: the picture as the detector sees it, CV_8UC1; what Detector::identity() says;
/// this library to the byte; OpenCV's version, how it was built, and what the processor can, since sums may
/// round otherwise on another.
/// 32 hexadecimal digits.
std::string featureKey(const std::string& identity, const cv::Mat& seen);

/// A folder of them, shared with other processes. Thread-safe.
///
/// Beyond a limit those go that have not been used for longest, but none that this object has read or
/// written: a run that finds more than there is room for keeps what it found first, so that the same run
/// again finds it there. What does not go as it should is told by one line each, files that cannot be read by
/// one for the first, tenth, hundredth …, and never stops anybody.
class FeatureCache {
 public:
  using Log = image::CacheFolder::Log;

  /// `folder` is made where it is not there; where it cannot be, or not be written, nothing is kept from then
  /// on. `log` may be called from any thread that uses this, one at a time; may be empty.
  FeatureCache(const std::string& folder, std::uintmax_t limit_bytes, Log log = nullptr);
  ~FeatureCache();
  FeatureCache(const FeatureCache&) = delete;
  FeatureCache& operator=(const FeatureCache&) = delete;

  /// The one that programs share, in image::usualCacheFolder(); null, none, where the limit is 0.
  static std::shared_ptr<FeatureCache> usual(double limit_gb, Log log);

  /// The same bits that were kept; nothing where there are none, or none whole.
  std::optional<Features> find(const std::string& key);
  void keep(const std::string& key, const Features& features);

  std::size_t found() const { return found_; }  ///< how often find() had them

 private:
  void say(const std::string& line);
  void sayUnreadable(const std::string& why);
  void stopKeeping(const std::string& why);
  /// False where there is no room for so many more.
  bool takeRoom(std::uintmax_t bytes);

  image::CacheFolder folder_;
  std::uintmax_t limit_bytes_;
  Log log_;
  std::mutex log_mutex_;
  std::filesystem::file_time_type start_;
  std::atomic<bool> is_keeping_{true};
  std::mutex room_mutex_;
  std::atomic<std::uintmax_t> bytes_{0};  ///< of the folder, by what is known here
  std::atomic<std::size_t> found_{0}, unreadable_{0};
};

constexpr double kUsualFeaturesCache_gb = 2.0;
/// `features_cache_limit`.
Field featuresCacheRow(double* limit_gb);

}  // namespace sunlit::evaluate
