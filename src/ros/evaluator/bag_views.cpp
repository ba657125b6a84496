#include "ros/evaluator/bag_views.h"

#include <geometry_msgs/PoseStamped.h>
#include <rosbag/view.h>
#include <sensor_msgs/CameraInfo.h>
#include <sunlit/Capture.h>

#include <map>
#include <stdexcept>

#include "ros/conversions/geometry.h"
#include "ros/conversions/images.h"
#include "ros/conversions/received_images.h"
#include "ros/evaluator/bag_topics.h"
#include "sunlit/quantity/frames.h"
#include "sunlit/ros/topic_names.h"

namespace sunlit::ros_interface {
namespace {

using rosbag::MessageInstance;
template <typename Value>
using ByStamp = std::map<std::int64_t, Value>;

/// Of a message that begins with a header, whatever follows.
std::int64_t stampOf(const MessageInstance& instance) {
  std::vector<std::uint8_t> bytes(instance.size());
  ros::serialization::OStream out(bytes.data(), static_cast<std::uint32_t>(bytes.size()));
  instance.write(out);
  std_msgs::Header header;
  ros::serialization::IStream in(bytes.data(), static_cast<std::uint32_t>(bytes.size()));
  ros::serialization::deserialize(in, header);
  return nanosecondsOf(header.stamp);
}

void requireImage(const MessageInstance& instance, bool may_be_compressed) {
  if (instance.isType<sensor_msgs::Image>()) return;
  if (may_be_compressed && instance.isType<sensor_msgs::CompressedImage>()) return;
  throw std::runtime_error(instance.getTopic() + " is " + instance.getDataType() + ", not sensor_msgs/Image" +
                           (may_be_compressed ? " or sensor_msgs/CompressedImage" : ""));
}

template <typename Message>
boost::shared_ptr<Message> messageOf(const MessageInstance& instance) {
  if (auto message = instance.instantiate<Message>()) return message;
  throw std::runtime_error(instance.getTopic() + " is " + instance.getDataType() + ", not " +
                           ros::message_traits::DataType<Message>::value());
}

}  // namespace

const char* const BagViews::kNoDepth = "no camera/depth/image_raw of this stamp";

struct BagViews::Index {
  rosbag::View view;
  ByStamp<MessageInstance> images, depths;
  ByStamp<sensor_msgs::CameraInfo> cameras;
  ByStamp<geometry_msgs::Pose> poses;
  ByStamp<std::size_t> numbers;
};

BagViews::BagViews(const BagStream& stream, const std::string& name_space, const IntakeOptions& intake)
    : stream_(stream), intake_(intake), bag_(openBag(stream.bag)), index_(std::make_unique<Index>()) {
  const std::string root = rootOf(name_space);
  const std::string images = imageTopic(root, stream.stream, intake.transport, topicsIn({stream.bag}));
  const std::string infos = topicOf(root, stream.stream, topics::kCameraInfo);
  const std::string captures = topicOf(root, stream.stream, topics::kCapture);
  const std::string depths = root + topics::kDepth;
  const std::string poses = root + topics::kPose;
  const std::vector<std::string> wanted = {images, infos, captures, depths, poses};
  index_->view.addQuery(*bag_, rosbag::TopicQuery(wanted));
  for (const MessageInstance& instance : index_->view) {
    const std::string& topic = instance.getTopic();
    if (topic == images || topic == depths) requireImage(instance, topic == images);
    if (topic == images) {
      if (!index_->images.emplace(stampOf(instance), instance).second) ++repeated_;
    } else if (topic == depths) {
      index_->depths.emplace(stampOf(instance), instance);
    } else if (topic == infos) {
      const auto message = messageOf<sensor_msgs::CameraInfo>(instance);
      index_->cameras.emplace(nanosecondsOf(message->header.stamp), *message);
    } else if (topic == poses) {
      const auto message = messageOf<geometry_msgs::PoseStamped>(instance);
      index_->poses.emplace(nanosecondsOf(message->header.stamp), message->pose);
    } else if (const auto message = instance.instantiate<Capture>()) {
      index_->numbers.emplace(nanosecondsOf(message->header.stamp), message->pose_index);
    }
  }
  makeEntries();
}

BagViews::~BagViews() = default;

void BagViews::makeEntries() {
  bool are_numbered = true;
  for (const auto& [stamp_ns, image] : index_->images) {
    Entry entry;
    entry.stamp_ns = stamp_ns;
    entry.has_depth = index_->depths.count(stamp_ns) > 0;
    const auto camera = index_->cameras.find(stamp_ns);
    const auto pose = index_->poses.find(stamp_ns);
    try {
      if (camera == index_->cameras.end()) throw std::invalid_argument("no camera_info of this stamp");
      entry.camera = fromCameraInfo(camera->second);
      if (pose == index_->poses.end()) throw std::invalid_argument("no camera/pose of this stamp");
      entry.map_from_optical = fromPose(pose->second) * linkFromOptical();
    } catch (const std::invalid_argument& error) {
      entry.fault = error.what();
    }
    const auto number = index_->numbers.find(stamp_ns);
    if (number != index_->numbers.end()) entry.pose = number->second;
    are_numbered = are_numbered && number != index_->numbers.end() &&
                   (entries_.empty() || entries_.back().pose < entry.pose);
    entries_.push_back(entry);
  }
  if (are_numbered) return;
  for (std::size_t i = 0; i < entries_.size(); ++i) entries_[i].pose = i;
}

std::string BagViews::readDepth(const Entry& entry, cv::Mat* depth) const {
  const auto found = index_->depths.find(entry.stamp_ns);
  if (found == index_->depths.end()) return kNoDepth;
  DecodedDepth decoded = decodeDepth(*messageOf<sensor_msgs::Image>(found->second), intake_.max_pixels);
  *depth = decoded.metres;
  return decoded.fault;
}

BagViews::Read BagViews::read(std::size_t number, bool wants_depth) const {
  const Entry& entry = entries_.at(number);
  const MessageInstance& instance = index_->images.at(entry.stamp_ns);
  const DecodedImage decoded =
      instance.isType<sensor_msgs::CompressedImage>()
          ? decode(*messageOf<sensor_msgs::CompressedImage>(instance), intake_.max_pixels)
          : decode(*messageOf<sensor_msgs::Image>(instance), intake_.max_pixels);
  Read result;
  result.fault = decoded.fault;
  if (!result.fault.empty()) return result;
  result.view.picture = evaluate::makePicture(decoded.rgb);
  result.view.camera = entry.camera;
  result.view.map_from_optical = entry.map_from_optical;
  if (wants_depth) result.fault = readDepth(entry, &result.view.depth);
  if (!result.fault.empty()) return result;
  try {
    requireWhole(result.view);
  } catch (const std::invalid_argument& error) {
    result.fault = error.what();
  }
  return result;
}

}  // namespace sunlit::ros_interface
