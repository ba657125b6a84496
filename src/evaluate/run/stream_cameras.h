/// Which camera took a picture, by its stamp.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <set>
#include <utility>

#include "evaluate/run/recent.h"
#include "sunlit/evaluate/run/told.h"
#include "sunlit/evaluate/view_camera.h"

namespace sunlit::evaluate {

/// The cameras of one stream. Each is that of its own stamp; but one alone, as a sender that latches it
/// sends, is that of all. In the order of their stamps, as they are sent.
class StreamCameras {
 public:
  using Camera = Told<ViewCamera>;

  /// `is_wanted`: its image may still come, or wait.
  void add(std::int64_t stamp_ns, const Camera& camera, bool is_wanted = true) {
    if (Camera* held = waiting_.find(stamp_ns)) {  // sent twice
      *held = camera;
      if (only_) only_ = camera;
      return;
    }
    if (only_ && stamp_ns == newest_ns_) {
      only_ = camera;
      return;
    }
    ++count_;
    is_latched_ = false;
    lacking_.clear();
    only_ = count_ == 1 ? std::optional<Camera>(camera) : std::nullopt;
    newest_ns_ = count_ == 1 ? stamp_ns : std::max(newest_ns_, stamp_ns);
    if (is_wanted) waiting_.add(stamp_ns, camera);
  }
  /// An image came. True where it is the first to show that one camera is that of all: it and those before it
  /// lack one of their own.
  bool noteImage(std::int64_t stamp_ns) {
    if (count_ != 1 || is_latched_ || waiting_.find(stamp_ns) != nullptr) return false;
    lacking_.insert(stamp_ns);
    is_latched_ = lacking_.size() >= kLacking;
    return is_latched_;
  }
  /// Nothing more will come for this stamp.
  bool isReady(std::int64_t stamp_ns) {
    return is_latched_ || waiting_.find(stamp_ns) != nullptr || (count_ > 1 && newest_ns_ > stamp_ns);
  }
  /// That of a stamp, which is forgotten; none, where it has not come.
  Camera take(std::int64_t stamp_ns) {
    std::optional<Camera> own = waiting_.take(stamp_ns);
    if (own) return std::move(*own);
    return only_.value_or(Camera());
  }

 private:
  /// So many images may be ahead of their cameras, or lack one, before a single camera is taken for that of
  /// all.
  static constexpr std::size_t kLacking = 3;

  std::size_t count_ = 0;       ///< stamps that came
  std::optional<Camera> only_;  ///< of one alone
  std::int64_t newest_ns_ = 0;
  std::set<std::int64_t> lacking_;  ///< stamps of images, as long as there is one camera
  bool is_latched_ = false;
  Recent<Camera> waiting_;
};

}  // namespace sunlit::evaluate
