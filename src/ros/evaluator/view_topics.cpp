#include "ros/evaluator/view_topics.h"

namespace sunlit::ros_interface {

Field bodyRow(const std::string& key, PosesOf* place) {
  return {key,
          choiceOf(place, {"link", "optical"}),
          "",
          {},
          "the body that the poses are of: link has x forward, optical z forward and x right"};
}

std::vector<Field> fieldsOf(ViewTopics& topics) {
  return {{"images",
           &topics.images,
           "",
           {},
           "topic of images, raw or compressed (/compressed may be left out), in bags that do not call it "
           "<stream>/camera/image_raw; such "
           "a bag "
           "has this stream alone"},
          {"camera_info",
           &topics.camera_info,
           "",
           {},
           "likewise instead of <stream>/camera/camera_info; without it that beside --images"},
          {"depth", &topics.depth, "", {}, "likewise instead of camera/depth/image_raw"},
          {"poses",
           &topics.poses,
           "",
           {},
           "likewise instead of camera/pose: PoseStamped, PoseWithCovarianceStamped, Odometry or "
           "TransformStamped, "
           "of the camera in a frame that stands still"},
          bodyRow("poses_of", &topics.poses_of),
          {"stamp_tolerance",
           &topics.stamp_tolerance_s,
           "s",
           {0, 10},
           "what lies so near to an image's stamp belongs to it: depth and camera_info the nearest, a pose "
           "between "
           "the one before and the one behind; 0: of its stamp only"}};
}

}  // namespace sunlit::ros_interface
