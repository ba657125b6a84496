#include "ros/evaluator/bag_views.h"

#include <rosbag/view.h>
#include <sensor_msgs/CameraInfo.h>
#include <sunlit/Capture.h>

#include <algorithm>
#include <boost/algorithm/string/predicate.hpp>
#include <cmath>
#include <cstdio>
#include <iterator>
#include <map>
#include <set>
#include <stdexcept>

#include "ros/conversions/evaluation.h"
#include "ros/conversions/geometry.h"
#include "ros/conversions/images.h"
#include "ros/conversions/received_images.h"
#include "ros/conversions/time.h"
#include "ros/evaluator/bag_message.h"
#include "ros/evaluator/bag_topics.h"
#include "sunlit/evaluate/run/one_sun.h"
#include "sunlit/evaluate/same_place.h"
#include "sunlit/evaluate/trajectory/trajectory.h"
#include "sunlit/quantity/frames.h"
#include "sunlit/ros/frame_names.h"
#include "sunlit/ros/topic_names.h"

namespace sunlit::ros_interface {
namespace {

using rosbag::MessageInstance;
template <typename Value>
using ByStamp = std::map<std::int64_t, Value>;

/// Of a message that begins with one, whatever follows.
std_msgs::Header headerOf(const MessageInstance& instance) {
  std::vector<std::uint8_t> bytes(instance.size());
  ros::serialization::OStream out(bytes.data(), static_cast<std::uint32_t>(bytes.size()));
  instance.write(out);
  std_msgs::Header header;
  ros::serialization::IStream in(bytes.data(), static_cast<std::uint32_t>(bytes.size()));
  ros::serialization::deserialize(in, header);
  return header;
}

/// The nearest to `stamp_ns`, the earlier of two; the end only where there is nothing.
template <typename Value>
typename ByStamp<Value>::const_iterator nearest(const ByStamp<Value>& values, std::int64_t stamp_ns) {
  auto after = values.lower_bound(stamp_ns);
  if (after == values.begin()) return after;
  const auto before = std::prev(after);
  const bool is_after = after != values.end() && after->first - stamp_ns < stamp_ns - before->first;
  return is_after ? after : before;
}

/// What is farther away is not this image's, whatever the tolerance.
constexpr std::int64_t kTellingGap_ns = 500000000;

std::string secondsOf(std::int64_t ns) {
  char text[32];
  std::snprintf(text, sizeof text, "%.4g s", 1e-9 * static_cast<double>(ns));
  return text;
}

template <typename Value>
std::string lackOf(const std::string& topic, const ByStamp<Value>& values, std::int64_t stamp_ns) {
  const std::string lack = "no " + topic + " of this stamp";
  const auto found = nearest(values, stamp_ns);
  if (found == values.end() || std::abs(found->first - stamp_ns) > kTellingGap_ns) return lack;
  return lack + "; the nearest is " + secondsOf(std::abs(found->first - stamp_ns)) +
         " away, see --stamp-tolerance";
}

/// Of an image that is to have its pose from between two.
std::string lackOfPoses(const std::string& topic, const ByStamp<geometry_msgs::Pose>& poses,
                        std::int64_t stamp_ns, double tolerance_s) {
  const std::string none = "no " + topic + " of this stamp";
  const auto found = nearest(poses, stamp_ns);
  if (found == poses.end() || std::abs(found->first - stamp_ns) > kTellingGap_ns) return none;
  const auto after = poses.lower_bound(stamp_ns);
  std::string lack = none + "; the one before ";
  lack +=
      after == poses.begin() ? "is missing" : "is " + secondsOf(stamp_ns - std::prev(after)->first) + " away";
  lack += after == poses.end() ? ", and there is none behind"
                               : ", the one behind " + secondsOf(after->first - stamp_ns);
  char most[64];
  std::snprintf(most, sizeof most, "; each may be %.4g s away at most, see --stamp-tolerance", tolerance_s);
  return lack + most;
}

std::int64_t toleranceOf(const ViewTopics& topics) {
  return static_cast<std::int64_t>(std::llround(1e9 * topics.stamp_tolerance_s));
}

/// Of messages.
using Types = std::set<std::string>;
const Types kCameras = {"sensor_msgs/CameraInfo"}, kDepths = {"sensor_msgs/Image"};

/// As sunlit calls it, if it was not said otherwise.
std::string calledOr(const std::string& said, const char* usual) {
  return said.empty() ? usual : said;
}

/// /camera/color/camera_info of /camera/color/image_raw/compressed.
std::string infosBeside(std::string images) {
  const std::string compressed = kCompressedEnding;
  if (images.size() > compressed.size() &&
      images.compare(images.size() - compressed.size(), std::string::npos, compressed) == 0)
    images.erase(images.size() - compressed.size());
  return images.substr(0, images.rfind('/') + 1) + "camera_info";
}

}  // namespace

struct BagViews::Index {
  rosbag::View view;
  std::map<std::string, std::string> held;  // types by topic
  std::string images_topic, infos_topic, captures_topic, depths_topic, poses_topic;
  std::string images_frame, depths_frame;  // of the first of each
  ByStamp<MessageInstance> images, depths;
  ByStamp<sensor_msgs::CameraInfo> cameras;
  ByStamp<geometry_msgs::Pose> poses;
  ByStamp<std::string> two_places;  // how far apart poses of one stamp are
  ByStamp<evaluate::CaptureRecord> captures;
  ByStamp<std::string> other_suns;  // their faults

  void name(const BagStream& stream, const ViewTopics& topics, const std::string& transport);
  std::string lackOfAny(const std::string& topic, const std::string& option, const Types& types) const;
};

// A bag may call some of its topics as sunlit does, and others not.
void BagViews::Index::name(const BagStream& stream, const ViewTopics& topics, const std::string& transport) {
  const std::string root = rootOf(topics.name_space);
  std::set<std::string> topics_held;
  for (const auto& [topic, type] : held) topics_held.insert(topic);
  const auto choose = [&](const std::string& said, const std::string& usual) {
    return held.count(said) > 0 ? said : usual;
  };
  const std::string foreign = heldImages(topics.images, topics_held);
  const bool is_foreign = !foreign.empty();
  images_topic = is_foreign ? foreign : imageTopic(root, stream.stream, transport, topics_held);
  infos_topic = choose(topics.camera_info, is_foreign ? infosBeside(topics.images)
                                                      : topicOf(root, stream.stream, topics::kCameraInfo));
  captures_topic = topicOf(root, stream.stream, topics::kCapture);
  depths_topic = choose(topics.depth, root + topics::kDepth);
  poses_topic = choose(topics.poses, root + topics::kPose);
}

// What could take its place is of these types.
std::string BagViews::Index::lackOfAny(const std::string& topic, const std::string& option,
                                       const Types& types) const {
  std::set<std::string> others;
  std::string packed;  // depth, or poses, that nobody here unpacks
  for (const auto& [name, type] : held) {
    if (types.count(type) > 0 && name != images_topic) others.insert(name);
    if (name == topic + "/compressedDepth")
      packed = "; " + name + " is not read: rosrun image_transport republish compressedDepth makes it raw";
    if (type == "tf2_msgs/TFMessage" && types == typesOfPoses())
      packed = "; " + name + " is not read: record the camera's pose of it as geometry_msgs/PoseStamped";
  }
  return "the bag holds no " + topic + ", see " + option + packed +
         (others.empty() ? "" : "; of this kind it holds " + topicsInWords(others));
}

BagViews::BagViews(const BagStream& stream, const ViewTopics& topics, const IntakeOptions& intake)
    : stream_(stream),
      topics_(topics),
      intake_(intake),
      bag_(openBag(stream.bag)),
      index_(std::make_unique<Index>()) {
  index_->held = typesOfTopics(*bag_);
  index_->name(stream, topics, intake.transport);
  readingBag(stream.bag, [&] { readIndex(); });
  findOtherSuns();
  makeEntries();
}

BagViews::~BagViews() = default;

void BagViews::readIndex() {
  Index& index = *index_;
  const std::vector<std::string> wanted = {index.images_topic, index.infos_topic, index.captures_topic,
                                           index.depths_topic, index.poses_topic};
  index.view.addQuery(*bag_, topicQuery(wanted));
  for (const MessageInstance& instance : index.view) {
    const std::string topic = withSlash(instance.getTopic());
    if (topic == index.poses_topic) {  // before all that it may have been named instead of
      addPose(poseMessageOf(instance));
    } else if (topic == index.images_topic) {
      requireImage(instance.getTopic(), instance.getDataType(), true);
      const std_msgs::Header header = headerOf(instance);
      const std::int64_t stamp_ns = nanosecondsOf(header.stamp);
      if (index.images.empty()) index.images_frame = withoutSlash(header.frame_id);
      if (!index.images.emplace(stamp_ns, instance).second) repeated_.push_back(stamp_ns);
    } else if (topic == index.depths_topic) {
      requireImage(instance.getTopic(), instance.getDataType(), false);
      const std_msgs::Header header = headerOf(instance);
      if (index.depths.empty()) index.depths_frame = withoutSlash(header.frame_id);
      if (!index.depths.emplace(nanosecondsOf(header.stamp), instance).second) ++repeated_depths_;
    } else if (topic == index.infos_topic) {
      const auto message = messageOf<sensor_msgs::CameraInfo>(instance);
      index.cameras.emplace(nanosecondsOf(message->header.stamp), *message);
    } else {
      const evaluate::CaptureRecord capture = captureOf(*messageOf<Capture>(instance));
      index.captures.emplace(capture.stamp_ns, capture);
    }
  }
}

void BagViews::addPose(const PoseMessage& message) {
  body_.require(message.body, {index_->poses_topic, stream_.bag});
  const auto is_its = [&](const auto& frame) { return frame.first == message.frame; };
  if (std::none_of(frames_.begin(), frames_.end(), is_its))
    frames_.emplace_back(message.frame, message.stamp_ns);
  const auto [first, is_first] = index_->poses.emplace(message.stamp_ns, message.pose);
  if (is_first) return;
  try {
    const std::string apart = evaluate::twoPlaces(fromPose(first->second), fromPose(message.pose));
    if (!apart.empty()) index_->two_places.emplace(message.stamp_ns, apart);
  } catch (const std::invalid_argument&) {
    // One that is none: the first is asked for what it is.
  }
}

void BagViews::findOtherSuns() {
  evaluate::Suns suns;
  const auto note = [&](const std::vector<evaluate::OtherSun>& others) {
    for (const evaluate::OtherSun& other : others)
      index_->other_suns.emplace(other.stamp_ns, evaluate::kOtherSun + (": " + other.fault));
  };
  for (const auto& [stamp_ns, capture] : index_->captures) note(suns.add(stream_.stream, capture));
  note(suns.finish(stream_.stream));
}

void BagViews::makeEntries() {
  bool are_numbered = true;
  for (const auto& [stamp_ns, image] : index_->images) {
    Entry entry = entryOf(stamp_ns);
    const auto capture = index_->captures.find(stamp_ns);
    const bool is_numbered = capture != index_->captures.end();
    if (is_numbered) entry.pose = static_cast<std::size_t>(capture->second.pose);
    are_numbered = are_numbered && is_numbered && (entries_.empty() || entries_.back().pose < entry.pose);
    entries_.push_back(entry);
  }
  drive_ = stream_.bag;
  if (are_numbered) return;
  drive_ += ":" + stream_.stream;
  for (std::size_t i = 0; i < entries_.size(); ++i) entries_[i].pose = i;
}

BagViews::Entry BagViews::entryOf(std::int64_t stamp_ns) const {
  Entry entry;
  entry.stamp_ns = stamp_ns;
  const auto depth = nearest(index_->depths, stamp_ns);
  if (depth != index_->depths.end() && std::abs(depth->first - stamp_ns) <= toleranceOf(topics_))
    entry.depth_stamp_ns = depth->first;
  try {
    entry.camera = cameraAt(stamp_ns);
    const Eigen::Isometry3d pose = poseAt(stamp_ns);
    entry.map_from_optical = topics_.poses_of == PosesOf::kOptical ? pose : pose * linkFromOptical();
  } catch (const std::invalid_argument& error) {
    entry.fault = error.what();
  }
  const auto other_sun = index_->other_suns.find(stamp_ns);
  if (entry.fault.empty() && other_sun != index_->other_suns.end()) entry.fault = other_sun->second;
  return entry;
}

evaluate::ViewCamera BagViews::cameraAt(std::int64_t stamp_ns) const {
  const ByStamp<sensor_msgs::CameraInfo>& cameras = index_->cameras;
  if (cameras.empty())
    throw std::invalid_argument(index_->lackOfAny(index_->infos_topic, "--camera-info", kCameras));
  const auto found = nearest(cameras, stamp_ns);
  const bool is_near = std::abs(found->first - stamp_ns) <= toleranceOf(topics_);
  if (!is_near && cameras.size() != 1)
    throw std::invalid_argument(lackOf(calledOr(topics_.camera_info, "camera_info"), cameras, stamp_ns));
  const image::Calibration read = fromCameraInfo(found->second, index_->images_topic);
  return {read.camera, read.distortion};
}

Eigen::Isometry3d BagViews::poseAt(std::int64_t stamp_ns) const {
  const ByStamp<geometry_msgs::Pose>& poses = index_->poses;
  if (poses.empty())
    throw std::invalid_argument(index_->lackOfAny(index_->poses_topic, "--poses", typesOfPoses()));
  const auto requireOnePlace = [&](std::int64_t pose_ns) {
    const auto apart = index_->two_places.find(pose_ns);
    if (apart == index_->two_places.end()) return;
    const std::string beside =
        pose_ns == stamp_ns ? "" : "beside it, at " + textOfStamp(timeOf(pose_ns)) + ": ";
    throw std::invalid_argument(evaluate::kTwoPlaces + (": " + beside) + apart->second);
  };
  const auto after = poses.lower_bound(stamp_ns);
  if (after != poses.end() && after->first == stamp_ns) {
    requireOnePlace(stamp_ns);
    return fromPose(after->second);
  }
  const std::int64_t tolerance_ns = toleranceOf(topics_);
  const bool is_between = after != poses.begin() && after != poses.end() &&
                          after->first - stamp_ns <= tolerance_ns &&
                          stamp_ns - std::prev(after)->first <= tolerance_ns;
  if (!is_between)
    throw std::invalid_argument(
        lackOfPoses(calledOr(topics_.poses, topics::kPose), poses, stamp_ns, topics_.stamp_tolerance_s));
  const auto stamped = [&](const auto& entry) {
    requireOnePlace(entry.first);
    const Eigen::Isometry3d pose = fromPose(entry.second);
    return evaluate::StampedPose{entry.first, pose.translation(), Eigen::Quaterniond(pose.linear())};
  };
  const evaluate::StampedPose pose = interpolated(stamped(*std::prev(after)), stamped(*after), stamp_ns);
  return Eigen::Translation3d(pose.position) * pose.orientation;
}

std::string BagViews::posesTopic() const {
  return index_->poses_topic;
}

// Whoever names a camera's body as one is believed: camera_link is that of camera_optical_frame.
std::vector<std::string> BagViews::framesApart(bool wants_depth) const {
  const std::string& images = index_->images_frame;
  const std::string beside = ", images of " + images + " (" + stream_.bag + "): ";
  std::vector<std::string> lines;
  if (images.empty()) return lines;
  const std::string& depths = index_->depths_frame;
  if (wants_depth && !depths.empty() && depths != images)
    lines.push_back(index_->depths_topic + " is of " + depths + beside +
                    "taken as registered to the images; depth_image_proc/register makes it so");
  const std::string& body = body_.name();
  const bool is_camera = boost::algorithm::icontains(body, "cam") || body == images;
  if (!body.empty() && !is_camera)
    lines.push_back(
        "poses of " + index_->poses_topic + " are of " + body + beside +
        "taken as those of the camera, x forward unless --poses-of says otherwise; tf tells where "
        "it sits on " +
        body);
  return lines;
}

std::string BagViews::lackOfDepth(const Entry& entry) const {
  if (index_->depths.empty()) return index_->lackOfAny(index_->depths_topic, "--depth", kDepths);
  return lackOf(calledOr(topics_.depth, topics::kDepth), index_->depths, entry.stamp_ns);
}

std::string BagViews::readDepth(const Entry& entry, cv::Mat* depth) const {
  if (!entry.depth_stamp_ns) return lackOfDepth(entry);
  DecodedDepth decoded = decodeDepth(*messageOf<sensor_msgs::Image>(index_->depths.at(*entry.depth_stamp_ns)),
                                     intake_.max_pixels);
  *depth = decoded.metres;
  return decoded.fault;
}

BagViews::Read BagViews::read(std::size_t number, bool wants_depth) const {
  Read result;
  try {
    readingBag(stream_.bag, [&] { result = readWhole(number, wants_depth); });
  } catch (const std::runtime_error& error) {
    result.fault = error.what();
  }
  return result;
}

BagViews::Read BagViews::readWhole(std::size_t number, bool wants_depth) const {
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
