#include "ros/evaluator/image_intake.h"

#include <geometry_msgs/PoseStamped.h>
#include <image_transport/exception.h>
#include <ros/console.h>
#include <ros/message_event.h>
#include <sensor_msgs/CompressedImage.h>
#include <sunlit/Capture.h>

#include "ros/conversions/evaluation.h"
#include "ros/conversions/received_images.h"
#include "ros/conversions/time.h"
#include "sunlit/ros/topic_names.h"

namespace sunlit::ros_interface {
namespace {

constexpr std::uint32_t kQueue = 4;  // ImmediateQueue leaves none waiting

const std::string kRaw = "raw";
const std::string kCompressed = "compressed";

ros::NodeHandle withQueue(ros::NodeHandle node, ros::CallbackQueueInterface* queue) {
  node.setCallbackQueue(queue);
  return node;
}

std::string transportsToBeHad(const image_transport::ImageTransport& transport) {
  std::string names = kRaw + ", " + kCompressed;
  for (const std::string& plugin : transport.getLoadableTransports()) {
    const std::string name = plugin.substr(plugin.find('/') + 1);
    if (name != kRaw && name != kCompressed) names += ", " + name;
  }
  return names;
}

}  // namespace

ImageIntake::ImageIntake(const ros::NodeHandle& node, const IntakeOptions& options,
                         evaluate::Evaluation& evaluation)
    : node_(withQueue(node, &queue_)),
      transport_(node_),
      options_(options),
      evaluation_(evaluation),
      last_image_s_(ros::SteadyTime::now().toSec()),
      places_topic_(node_.resolveName(topics::kPose)),
      streams_(evaluation.options().streams.size()) {
  for (std::size_t s = 0; s < streams_.size(); ++s) subscribe(s);
  places_ = node_.subscribe<geometry_msgs::PoseStamped>(
      topics::kPose, kQueue, [this](const geometry_msgs::PoseStamped::ConstPtr& message) {
        guarded([&] {
          evaluation_.addPlace(placeOf(*message));
          evaluation_.addTruePose(nanosecondsOf(message->header.stamp), truePoseOf(*message));
          noteFrame(message->header);
        });
      });
  if (!evaluation_.options().localisation.map.empty()) subscribeToTruth();
}

void ImageIntake::noteFrame(const std_msgs::Header& header) {
  const std::lock_guard<std::mutex> lock(frame_mutex_);
  frame_of_poses_ = header.frame_id;
  const std::string warning = frames_.note(header.frame_id, places_topic_);
  if (warning.empty()) return;
  ROS_WARN("%s", warning.c_str());
  evaluation_.addPoseProblem(nanosecondsOf(header.stamp), kOtherFrame, warning);
}

std::string ImageIntake::frameOfPoses() const {
  const std::lock_guard<std::mutex> lock(frame_mutex_);
  return frame_of_poses_;
}

// As it is subscribed to, and may be remapped.
std::string ImageIntake::imagesTopicOf(const std::string& stream) const {
  if (options_.transport == kRaw) return stream + "/" + topics::kImage;
  if (options_.transport == kCompressed) return stream + "/" + topics::kCompressedImage;
  return stream + "/" + topics::kImage + "/" + options_.transport;
}

// Only what is localised needs depth, which is larger than an image.
void ImageIntake::subscribeToTruth() {
  depth_ = node_.subscribe<sensor_msgs::Image>(
      topics::kDepth, kQueue, [this](const sensor_msgs::Image::ConstPtr& message) {
        guarded([&] {
          evaluation_.addDepth(nanosecondsOf(message->header.stamp), depthOf(*message, options_.max_pixels));
        });
      });
  for (std::size_t s = 0; s < streams_.size(); ++s) {
    streams_[s].cameras = node_.subscribe<sensor_msgs::CameraInfo>(
        evaluation_.options().streams[s] + "/" + topics::kCameraInfo, kQueue,
        [this, s, images = node_.resolveName(imagesTopicOf(evaluation_.options().streams[s]))](
            const sensor_msgs::CameraInfo::ConstPtr& message) {
          guarded([&] {
            evaluation_.addCamera(s, nanosecondsOf(message->header.stamp), cameraOf(*message, images));
          });
        });
  }
}

ImageIntake::~ImageIntake() = default;

void ImageIntake::subscribe(std::size_t stream) {
  const std::string root = evaluation_.options().streams[stream] + "/";
  const auto hints = ros::TransportHints().tcpNoDelay();
  streams_[stream].captures = node_.subscribe<Capture>(
      root + topics::kCapture, kQueue,
      [this, stream](const Capture::ConstPtr& message) {
        guarded([&] { evaluation_.addCapture(stream, captureOf(*message)); });
      },
      nullptr, hints);
  const std::string images = imagesTopicOf(evaluation_.options().streams[stream]);
  if (options_.transport == kRaw) {
    streams_[stream].images = imagesOf<sensor_msgs::Image>(stream, images);
  } else if (options_.transport == kCompressed) {
    streams_[stream].images = imagesOf<sensor_msgs::CompressedImage>(stream, images);
  } else {
    subscribeByPlugin(stream, root + topics::kImage);
  }
}

template <typename Message>
ros::Subscriber ImageIntake::imagesOf(std::size_t stream, const std::string& topic) {
  using Event = ros::MessageEvent<const Message>;
  const boost::function<void(const Event&)> taken = [this, stream](const Event& event) {
    take(stream, *event.getMessage(), event.getPublisherName());
  };
  return node_.subscribe<Message, const Event&>(topic, kQueue, taken, nullptr,
                                                ros::TransportHints().tcpNoDelay());
}

void ImageIntake::subscribeByPlugin(std::size_t stream, const std::string& topic) {
  const image_transport::TransportHints hints(options_.transport, ros::TransportHints().tcpNoDelay(),
                                              ros::NodeHandle("~"));
  try {
    streams_[stream].plugged = transport_.subscribe(
        topic, kQueue,
        [this, stream](const sensor_msgs::ImageConstPtr& message) { take(stream, *message, ""); }, nullptr,
        hints);
  } catch (const image_transport::Exception&) {
    refuse("image_transport", '"' + options_.transport + '"',
           "one of those that are installed: " + transportsToBeHad(transport_));
  }
}

// In the thread of roscpp, which an exception would end.
template <typename Call>
void ImageIntake::guarded(const Call& call) {
  try {
    call();
  } catch (...) {
    const std::lock_guard<std::mutex> lock(fault_mutex_);
    if (!fault_) fault_ = std::current_exception();
  }
}

template <typename Message>
void ImageIntake::take(std::size_t stream, const Message& message, const std::string& sender) {
  guarded([&] {
    last_image_s_ = ros::SteadyTime::now().toSec();
    countGap(stream, message.header, sender);
    const DecodedImage decoded = decode(message, options_.max_pixels);
    const std::int64_t stamp_ns = nanosecondsOf(message.header.stamp);
    if (!decoded.fault.empty()) {
      ROS_WARN("%s: image of stamp %s cannot be used: %s", evaluation_.options().streams[stream].c_str(),
               textOfStamp(message.header.stamp).c_str(), decoded.fault.c_str());
      evaluation_.addBadImage(stream, stamp_ns, decoded.fault);
    } else {
      evaluation_.addImage(stream, stamp_ns, decoded.rgb, decoded.traits);
    }
  });
}

std::size_t ImageIntake::senders(std::size_t stream) const {
  const Stream& s = streams_[stream];
  return s.images ? s.images.getNumPublishers() : s.plugged.getNumPublishers();
}

std::string ImageIntake::unheardStreams() const {
  const evaluate::Counts counts = evaluation_.counts();
  std::string names;
  for (std::size_t s = 0; s < streams_.size(); ++s) {
    if (counts.streams[s].received > 0 || senders(s) > 0) continue;
    names += (names.empty() ? "" : ", ") + evaluation_.options().streams[s];
  }
  return names;
}

std::string ImageIntake::silentTopics() const {
  const evaluate::Counts counts = evaluation_.counts();
  std::string topics;
  for (std::size_t s = 0; s < streams_.size(); ++s) {
    if (counts.streams[s].received > 0) continue;
    topics += (topics.empty() ? "" : ", ") +
              node_.resolveName(imagesTopicOf(evaluation_.options().streams[s])) +
              (senders(s) > 0 ? "" : " (nobody sends it)");
  }
  return topics;
}

std::string ImageIntake::unheardTruth() const {
  std::vector<const ros::Subscriber*> needed = {&places_, &depth_};
  for (const Stream& stream : streams_) needed.push_back(&stream.cameras);
  std::string topics;
  for (const ros::Subscriber* subscriber : needed) {
    if (!*subscriber || subscriber->getNumPublishers() > 0) continue;
    topics += (topics.empty() ? "" : ", ") + subscriber->getTopic();
  }
  return topics;
}

// Two senders at once have two counts, and of a plug-in's images nobody tells which is whose.
void ImageIntake::countGap(std::size_t stream, const std_msgs::Header& header, const std::string& sender) {
  const SequenceGaps::Gap gap = streams_[stream].gaps[sender].add(header.seq, nanosecondsOf(header.stamp));
  if (gap.images > 0 && (!sender.empty() || senders(stream) == 1))
    evaluation_.addLost(stream, gap.images, gap.stamp_ns);
}

double ImageIntake::secondsWithoutImage() const {
  return ros::SteadyTime::now().toSec() - last_image_s_;
}

void ImageIntake::rethrow() const {
  const std::lock_guard<std::mutex> lock(fault_mutex_);
  if (fault_) std::rethrow_exception(fault_);
}

}  // namespace sunlit::ros_interface
