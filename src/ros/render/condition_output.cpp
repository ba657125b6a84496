#include "ros/render/condition_output.h"

#include <limits>

#include "ros/conversions/geometry.h"
#include "ros/conversions/images.h"
#include "ros/conversions/time.h"
#include "sunlit/Capture.h"
#include "sunlit/ros/topic_names.h"

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

ConditionOutput::ConditionOutput(const ros::NodeHandle& node, const OutputOptions& options)
    : options_(options),
      images_(pictureOutput(node, topics::kImage, {options.queue_size, options.compressed})),
      capture_(HeardTopic::of<Capture>(node, topics::kCapture, options.queue_size)) {
  if (options.right) stereo_.emplace(node, options);
}

void ConditionOutput::publish(const Photograph& photograph, const SkyMoment& sky) const {
  const std_msgs::Header header = headerOf(options_.frames.optical, photograph.stamp);
  Capture capture;
  capture.header = header;
  if (sky.bodies.time.utc) capture.utc = toUtc(*sky.bodies.time.utc);
  capture.pose_index = static_cast<std::uint32_t>(photograph.pose_index);
  capture.ev100 = photograph.ev100;
  capture.exposure_mode = photograph.exposure_mode;
  capture.sun_azimuth = sky.bodies.sun->apparent.azimuth().rad();
  capture.sun_elevation = sky.bodies.sun->apparent.elevation().rad();
  fillMoon(sky.bodies.moon, &capture);
  capture.scene_illuminance = static_cast<double>(sky.light.groundIlluminance().luminance());
  // Before the image: who has that can expect it.
  capture_.publisher.publish(capture);
  const sensor_msgs::CameraInfo info = toCameraInfo(options_.camera, header);
  OutgoingPicture picture(photograph.picture, header);
  std::visit([&](const auto& images) { images.publish(&picture, info); }, images_);
  if (stereo_) stereo_->publish(photograph, &picture);
}

std::string ConditionOutput::lonelyTopic(const WantedSubscribers& wanted) const {
  const auto lonely = [&](const CameraAudience& both) {
    return std::visit([&](const auto& images) { return images.lonelyTopic(both); }, images_);
  };
  std::string topic = lonely({wanted.audience(wanted.images), {}});
  if (topic.empty()) topic = capture_.ifLonely(wanted.audience(wanted.images));
  if (topic.empty()) topic = lonely({{}, wanted.audience(wanted.ofTruth())});
  if (!topic.empty() || !stereo_) return topic;
  return stereo_->lonelyTopic(wanted.audience(wanted.left), wanted.audience(wanted.right));
}

}  // namespace sunlit::ros_interface
