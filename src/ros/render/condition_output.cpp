#include "ros/render/condition_output.h"

#include <limits>

#include "ros/render/messages.h"
#include "sunlit/Capture.h"

namespace sunlit::ros_interface {

namespace {

void fillMoon(const std::optional<sky::MoonInSky>& moon, Capture* capture) {
  constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();
  capture->moon_azimuth = moon ? moon->apparent.azimuth().rad() : kNothing;
  capture->moon_elevation = moon ? moon->apparent.elevation().rad() : kNothing;
  // Meeus, eq. 48.1.
  capture->moon_illuminated_fraction = moon ? 0.5 * (1.0 + cos(moon->phase_angle)) : kNothing;
}

}  // namespace

ConditionOutput::ConditionOutput(const ros::NodeHandle& node, const image::PinholeCamera& camera,
                                 std::uint32_t queue_size)
    : camera_(camera), transport_(node), image_(transport_.advertise("camera/image_raw", queue_size)) {
  ros::NodeHandle advertiser(node);
  camera_info_ = advertiser.advertise<sensor_msgs::CameraInfo>("camera/camera_info", queue_size);
  capture_ = advertiser.advertise<Capture>("camera/capture", queue_size);
}

void ConditionOutput::publish(const Photograph& photograph, const SkyMoment& sky) const {
  const std_msgs::Header header = opticalHeader(photograph.stamp);
  Capture capture;
  capture.header = header;
  capture.pose_index = static_cast<std::uint32_t>(photograph.pose_index);
  capture.ev100 = photograph.ev100;
  capture.sun_azimuth = sky.bodies.sun->apparent.azimuth().rad();
  capture.sun_elevation = sky.bodies.sun->apparent.elevation().rad();
  fillMoon(sky.bodies.moon, &capture);
  capture.scene_illuminance = static_cast<double>(sky.light.groundIlluminance().luminance());
  // The image last: who has it can expect the others.
  capture_.publish(capture);
  camera_info_.publish(toCameraInfo(camera_, header));
  image_.publish(sensor_msgs::ImageConstPtr(toImageMessage(photograph.picture, header)));
}

std::string ConditionOutput::lonelyTopic(const WantedSubscribers& wanted) const {
  if (static_cast<int>(image_.getNumSubscribers()) < wanted.images) return image_.getTopic();
  if (static_cast<int>(capture_.getNumSubscribers()) < wanted.images) return capture_.getTopic();
  if (static_cast<int>(camera_info_.getNumSubscribers()) < wanted.others) return camera_info_.getTopic();
  return std::string();
}

}  // namespace sunlit::ros_interface
