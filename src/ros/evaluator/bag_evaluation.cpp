#include "ros/evaluator/bag_evaluation.h"

#include <rosbag/bag.h>
#include <rosbag/view.h>

#include <cstdio>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <stdexcept>

#include "ros/evaluator/folder_lock.h"
#include "ros/evaluator/image_conversion.h"
#include "ros/evaluator/progress_log.h"

namespace sunlit::ros_interface {
namespace {

// Enough to keep all processors busy, few enough to keep the memory flat.
constexpr std::size_t kPosesInWork = 8;

const std::string kImageTopic = "/camera/image_raw";

std::unique_ptr<rosbag::Bag> opened(const std::string& path) {
  auto bag = std::make_unique<rosbag::Bag>();
  try {
    bag->open(path, rosbag::bagmode::Read);
  } catch (const rosbag::BagException& error) {
    throw std::runtime_error(path + ": is not a bag that can be read: " + error.what());
  }
  return bag;
}

// "/" or "/name/…/".
std::string rootOf(const std::string& name_space) {
  std::string root = name_space;
  if (root.empty() || root.back() != '/') root += '/';
  return root.front() == '/' ? root : "/" + root;
}

class BagSource {
 public:
  explicit BagSource(const BagEvaluationOptions& options) {
    const std::string root = rootOf(options.name_space);
    place_topic_ = root + "camera/pose";
    for (std::size_t s = 0; s < options.evaluation.streams.size(); ++s) {
      images_[root + options.evaluation.streams[s] + kImageTopic] = s;
      captures_[root + options.evaluation.streams[s] + "/camera/capture"] = s;
    }
    std::vector<std::string> topics = {place_topic_};
    for (const auto& item : images_) topics.push_back(item.first);
    for (const auto& item : captures_) topics.push_back(item.first);
    for (const std::string& path : options.bags) {
      bags_.push_back(opened(path));
      view_.addQuery(*bags_.back(), rosbag::TopicQuery(topics));
    }
    requireImages();
  }

  void feed(evaluate::Evaluation& evaluation) {
    for (const rosbag::MessageInstance& instance : view_) {
      if (const auto found = images_.find(instance.getTopic()); found != images_.end()) {
        feedImage(evaluation, found->second, instance);
      } else if (const auto capture = captures_.find(instance.getTopic()); capture != captures_.end()) {
        if (const auto message = instance.instantiate<Capture>()) {
          evaluation.addCapture(capture->second, captureOf(*message));
        }
      } else if (const auto message = instance.instantiate<geometry_msgs::PoseStamped>()) {
        evaluation.addPlace(placeOf(*message));
      }
      evaluation.waitForRoom(kPosesInWork);
      log_.update(evaluation.options(), evaluation.counts());
    }
  }

 private:
  void requireImages() {
    std::set<std::string> topics;
    std::string held;
    for (const rosbag::ConnectionInfo* connection : view_.getConnections()) topics.insert(connection->topic);
    for (const std::string& topic : topics) held += (held.empty() ? "" : ", ") + topic;
    for (const auto& item : images_) {
      if (topics.count(item.first) == 0) {
        throw std::runtime_error("the bags hold no " + item.first +
                                 "; of what is asked for they hold: " + (held.empty() ? "nothing" : held));
      }
    }
  }

  static void feedImage(evaluate::Evaluation& evaluation, std::size_t stream,
                        const rosbag::MessageInstance& instance) {
    const auto message = instance.instantiate<sensor_msgs::Image>();
    if (!message)
      throw std::runtime_error(instance.getTopic() + " is " + instance.getDataType() +
                               ", not sensor_msgs/Image");
    const DecodedImage decoded = decode(*message);
    const std::int64_t stamp_ns = nanosecondsOf(message->header.stamp);
    if (decoded.fault.empty()) {
      evaluation.addImage(stream, stamp_ns, decoded.rgb);
    } else {
      evaluation.addBadImage(stream, stamp_ns, decoded.fault);
    }
  }

  std::vector<std::unique_ptr<rosbag::Bag>> bags_;
  rosbag::View view_;
  std::map<std::string, std::size_t> images_;
  std::map<std::string, std::size_t> captures_;
  std::string place_topic_;
  ProgressLog log_;
};

}  // namespace

std::vector<std::string> streamsIn(const std::vector<std::string>& bags, const std::string& name_space) {
  const std::string root = rootOf(name_space);
  std::set<std::string> streams;
  for (const std::string& path : bags) {
    const auto bag = opened(path);
    rosbag::View view(*bag);
    for (const rosbag::ConnectionInfo* connection : view.getConnections()) {
      const std::string& topic = connection->topic;
      const bool is_long_enough = topic.size() > root.size() + kImageTopic.size();
      if (!is_long_enough || topic.compare(0, root.size(), root) != 0) continue;
      const std::size_t end = topic.size() - kImageTopic.size();
      if (topic.compare(end, std::string::npos, kImageTopic) != 0) continue;
      streams.insert(topic.substr(root.size(), end - root.size()));
    }
  }
  return {streams.begin(), streams.end()};
}

int evaluateBags(const BagEvaluationOptions& options) {
  std::optional<BagSource> source;
  if (!options.bags.empty()) source.emplace(options);
  evaluate::EvaluationCallbacks callbacks;
  callbacks.note = [](const std::string& line) { std::printf("%s\n", line.c_str()); };
  const FolderLock lock(options.evaluation.output_dir);
  evaluate::Evaluation evaluation(options.evaluation, callbacks);
  if (source) source->feed(evaluation);
  const evaluate::Outcome outcome = evaluation.finish();
  std::printf("%zu poses in %s\n%s\n", outcome.counts.completed_poses, options.evaluation.output_dir.c_str(),
              summaryTable(outcome.summary).c_str());
  const std::string faults = faultsOf(evaluation.options(), outcome);
  if (faults.empty()) return 0;
  std::fprintf(stderr, "%s\n", faults.c_str());
  return kNotWholeStatus;
}

}  // namespace sunlit::ros_interface
