#include "ros/render/stereo_output.h"

#include "ros/conversions/geometry.h"
#include "ros/conversions/images.h"
#include "sunlit/ros/topic_names.h"

namespace sunlit::ros_interface {

StereoOutput::StereoOutput(const ros::NodeHandle& node, const OutputOptions& options)
    : options_(options),
      left_(pictureOutput(node, topics::kLeftImage, {options.queue_size, options.compressed})),
      right_(pictureOutput(node, topics::kRightImage, {options.queue_size, options.compressed})) {}

void StereoOutput::publish(const Photograph& photograph, OutgoingPicture* left) const {
  // Both of the left frame, which P of the right one speaks of: image_geometry, and with it all of
  // stereo_image_proc, ends where the frames of a pair differ.
  const std_msgs::Header header = headerOf(options_.frames.optical, photograph.stamp);
  const sensor_msgs::CameraInfo left_info = toCameraInfo(options_.camera, header),
                                right_info = toCameraInfo(options_.right->calibration, header);
  std::visit(
      [&](const auto& images) {
        if (images.isHeard()) images.publish(left, left_info);
      },
      left_);
  OutgoingPicture right(photograph.right.value(), header);
  std::visit([&](const auto& images) { images.publish(&right, right_info); }, right_);
}

std::string StereoOutput::lonelyTopic(const Audience& left, const Audience& right) const {
  const auto lonely = [](const PictureOutput& side, const Audience& wanted) {
    return std::visit([&](const auto& images) { return images.lonelyTopic({wanted, wanted}); }, side);
  };
  const std::string topic = lonely(left_, left);
  return topic.empty() ? lonely(right_, right) : topic;
}

}  // namespace sunlit::ros_interface
