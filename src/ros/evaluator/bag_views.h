/// Images of a bag together with what is known of where they were taken.
#pragma once

#include <rosbag/bag.h>

#include <Eigen/Geometry>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "ros/evaluator/bag_streams.h"
#include "ros/evaluator/bag_trajectory.h"
#include "ros/evaluator/image_intake.h"
#include "ros/evaluator/pose_frames.h"
#include "ros/evaluator/view_topics.h"
#include "sunlit/evaluate/posed_view.h"
#include "sunlit/image/camera.h"

namespace sunlit::ros_interface {

/// Images of one stream, told apart by stamps. camera_info belongs to the stream, camera/pose (of
/// camera_link, in `map`) and camera/depth/image_raw to all streams of the bag; what has an image's stamp
/// belongs to it, to the nanosecond, or as ViewTopics::stamp_tolerance_s says. The only camera_info of a bag
/// belongs to all images.
class BagViews {
 public:
  /// What a bag holds of one image, but pixels.
  struct Entry {
    std::int64_t stamp_ns = 0;
    /// As camera/capture numbers them where it does so for all, rising; else by rising stamp from 0.
    std::size_t pose = 0;
    evaluate::ViewCamera camera;
    Eigen::Isometry3d map_from_optical = Eigen::Isometry3d::Identity();
    /// Of camera, pose or sun, "no camera_info of this stamp"; empty where it can be used.
    std::string fault;
    std::optional<std::int64_t> depth_stamp_ns;
  };

  /// Reads the bag once, keeping no pixels. Of several images, or other messages, of one stamp the first
  /// counts; poses of it that are two places make a fault, and so does a capture under another sun than the
  /// stream's first. Throws std::runtime_error for a bag that cannot be
  /// read, that holds no image of the stream, or whose messages are of another kind.
  BagViews(const BagStream& stream, const ViewTopics& topics, const IntakeOptions& intake);
  ~BagViews();

  const BagStream& stream() const { return stream_; }
  const std::vector<Entry>& entries() const { return entries_; }  ///< by rising stamp
  /// Of which pictures have one place at one number: the bag, or the stream where captures do not number it.
  const std::string& drive() const { return drive_; }
  /// Of images left out: of a stamp that was there.
  const std::vector<std::int64_t>& repeated() const { return repeated_; }
  std::size_t repeatedDepths() const { return repeated_depths_; }  ///< likewise
  /// Of poses, each once, in the order in which they first come; with the stamp of the first.
  const std::vector<std::pair<std::string, std::int64_t>>& frames() const { return frames_; }
  std::string posesTopic() const;
  /// Where poses, or depth where it `wants_depth`, are of another frame than the images: in words, a line
  /// each.
  std::vector<std::string> framesApart(bool wants_depth) const;
  /// "no camera/depth/image_raw of this stamp", or that the bag holds none, and what could take its place.
  std::string lackOfDepth(const Entry& entry) const;

  /// The picture of an entry without fault; depth too where `wants_depth`. Or why it could not be had.
  struct Read {
    evaluate::PosedView view;
    std::string fault;
  };
  Read read(std::size_t entry, bool wants_depth) const;

 private:
  struct Index;
  void readIndex();
  void addPose(const PoseMessage& message);
  void findOtherSuns();
  void makeEntries();
  Entry entryOf(std::int64_t stamp_ns) const;
  evaluate::ViewCamera cameraAt(std::int64_t stamp_ns) const;
  Eigen::Isometry3d poseAt(std::int64_t stamp_ns) const;
  std::string readDepth(const Entry& entry, cv::Mat* depth) const;
  Read readWhole(std::size_t entry, bool wants_depth) const;

  BagStream stream_;
  ViewTopics topics_;
  IntakeOptions intake_;
  std::unique_ptr<rosbag::Bag> bag_;
  std::unique_ptr<Index> index_;
  std::vector<Entry> entries_;
  std::string drive_;
  std::vector<std::int64_t> repeated_;
  std::size_t repeated_depths_ = 0;
  std::vector<std::pair<std::string, std::int64_t>> frames_;
  PoseBody body_;
};

}  // namespace sunlit::ros_interface
