/// Images of all streams, from topics into an Evaluation.
#pragma once

#include <image_transport/image_transport.h>
#include <ros/callback_queue_interface.h>
#include <ros/node_handle.h>
#include <ros/subscriber.h>

#include <atomic>
#include <cstdint>
#include <exception>
#include <map>
#include <mutex>
#include <string>
#include <vector>

#include "ros/evaluator/pose_frames.h"
#include "ros/evaluator/sequence_gaps.h"
#include "sunlit/evaluate/run/evaluation.h"

namespace sunlit::ros_interface {

/// Calls back at once, in the thread of roscpp that reads from sockets. So no message waits in a queue of
/// roscpp, which drops the oldest of a full one without a word: what we are too slow for stays with its
/// sender, and its numbers tell.
class ImmediateQueue : public ros::CallbackQueueInterface {
 public:
  void addCallback(const ros::CallbackInterfacePtr& callback, std::uint64_t) override { callback->call(); }
  void removeByID(std::uint64_t) override {}  // nothing is kept
};

struct IntakeOptions {
  std::string transport = "raw";      ///< of image_transport; `compressed` needs no plug-in of it
  std::size_t max_pixels = 64000000;  ///< of an image
};

inline std::vector<Field> fieldsOf(IntakeOptions& options) {
  return {
      {"image_transport",
       &options.transport,
       "",
       {},
       "raw, compressed (PNG, JPEG) or one that has a plug-in"},
      {"max_pixels", &options.max_pixels, "", {1, 1e9}, "larger images are refused before they are decoded"}};
}

/// Subscribes, decodes and hands over images, captures and places.
class ImageIntake {
 public:
  /// Throws std::invalid_argument, naming those that can be had, for a transport that has no plug-in.
  ImageIntake(const ros::NodeHandle& node, const IntakeOptions& options, evaluate::Evaluation& evaluation);
  ~ImageIntake();
  ImageIntake(const ImageIntake&) = delete;
  ImageIntake& operator=(const ImageIntake&) = delete;

  /// Since the last image came, or since the start.
  double secondsWithoutImage() const;
  /// Those of which nobody sends images and none has come, in words; empty: none of them.
  std::string unheardStreams() const;
  /// Topics of streams of which no image has come, in words, and which of them nobody sends; empty: of all.
  std::string silentTopics() const;
  /// Topics of true poses, depths and cameras that nobody sends, in words; empty: none of those that are
  /// needed.
  std::string unheardTruth() const;
  /// Of the latest true pose; empty: none has come.
  std::string frameOfPoses() const;
  /// Throws what the evaluation threw at an image, such as that its disk is full.
  void rethrow() const;

 private:
  struct Stream {
    ros::Subscriber images;               // raw or compressed
    image_transport::Subscriber plugged;  // of another transport
    ros::Subscriber captures;
    ros::Subscriber cameras;
    std::map<std::string, SequenceGaps> gaps;  // by sender; of a plug-in, which tells none, all of them
  };

  void subscribe(std::size_t stream);
  template <typename Message>
  ros::Subscriber imagesOf(std::size_t stream, const std::string& topic);
  void subscribeToTruth();
  void subscribeByPlugin(std::size_t stream, const std::string& topic);
  std::string imagesTopicOf(const std::string& stream) const;
  template <typename Message>
  void take(std::size_t stream, const Message& message, const std::string& sender);
  template <typename Call>
  void guarded(const Call& call);
  void noteFrame(const std_msgs::Header& header);
  void countGap(std::size_t stream, const std_msgs::Header& header, const std::string& sender);
  std::size_t senders(std::size_t stream) const;

  ImmediateQueue queue_;
  ros::NodeHandle node_;
  image_transport::ImageTransport transport_;
  IntakeOptions options_;
  evaluate::Evaluation& evaluation_;
  std::atomic<double> last_image_s_;  // of the steady clock
  mutable std::mutex fault_mutex_;
  std::exception_ptr fault_;
  mutable std::mutex frame_mutex_;
  std::string places_topic_;
  std::string frame_of_poses_;
  PoseFrames frames_;
  // Last, so that they end before what their callbacks use.
  std::vector<Stream> streams_;
  ros::Subscriber places_;
  ros::Subscriber depth_;
};

}  // namespace sunlit::ros_interface
