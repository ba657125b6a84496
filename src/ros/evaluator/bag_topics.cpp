#include "ros/evaluator/bag_topics.h"

#include <ros/exception.h>
#include <rosbag/view.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <system_error>

#include "sunlit/evaluate/files/stream_name.h"
#include "sunlit/quantity/comma_list.h"
#include "sunlit/ros/topic_names.h"

namespace sunlit::ros_interface {

std::string topicsInWords(const std::set<std::string>& topics) {
  return topics.empty() ? "nothing" : commaList(topics);
}

namespace {

bool isBegunAs(const std::string& path, const std::string& wanted) {
  std::string begin(wanted.size(), '\0');
  std::ifstream file(path, std::ios::binary);
  file.read(begin.data(), static_cast<std::streamsize>(begin.size()));
  return file && begin == wanted;
}

bool isBegunAsBag(const std::string& path) {
  return isBegunAs(path, "#ROSBAG V");
}

/// What is said of a file that does not begin as bags do, nor is one of nothing.
std::string notABag(const std::string& path) {
  if (isBegunAs(path, "SQLite format 3") || isBegunAs(path, "\x89MCAP"))
    return path + ": is a bag of ROS 2, but must be one of ROS 1: rosbags-convert of the Python package " +
           "rosbags makes one of it";
  return path + ": is not a bag: it does not begin with #ROSBAG V2.0";
}

/// The index of a bag is its end, which is missing where it was cut off: it is unindexed, or its reading
/// fails.
bool lacksItsEnd(const std::string& path, const rosbag::BagException& error) {
  return dynamic_cast<const rosbag::BagUnindexedException*>(&error) != nullptr ||
         (dynamic_cast<const rosbag::BagIOException*>(&error) != nullptr && isBegunAsBag(path));
}

}  // namespace

std::unique_ptr<rosbag::Bag> openBag(const std::string& path) {
  auto bag = std::make_unique<rosbag::Bag>();
  std::error_code none;
  if (std::filesystem::is_regular_file(path, none) && !isBegunAsBag(path))
    throw std::runtime_error(notABag(path));
  try {
    bag->open(path, rosbag::bagmode::Read);
  } catch (const rosbag::BagException& error) {
    std::string told = path + ": is not a bag that can be read: " + error.what();
    if (lacksItsEnd(path, error)) {
      told +=
          "; its end is missing: it is still being recorded, or was cut off while it was recorded or copied; "
          "copy it again, or mend what is there by rosbag reindex " +
          path;
    }
    throw std::runtime_error(told);
  }
  return bag;
}

void readingBag(const std::string& path, const std::function<void()>& read) {
  try {
    read();
  } catch (const ros::Exception& error) {  // of records, and of a message that is cut short
    throw std::runtime_error(path + ": is damaged inside (" + error.what() +
                             "): copy it again from where it was recorded");
  }
}

std::string withSlash(const std::string& topic) {
  return topic.empty() || topic.front() == '/' ? topic : "/" + topic;
}

rosbag::TopicQuery topicQuery(const std::vector<std::string>& topics) {
  std::vector<std::string> both;
  for (const std::string& topic : topics) {
    both.push_back(withSlash(topic));
    both.push_back(both.back().substr(1));
  }
  return rosbag::TopicQuery(both);
}

std::string rootOf(const std::string& name_space) {
  std::string root = name_space;
  if (root.empty() || root.back() != '/') root += '/';
  return withSlash(root);
}

std::map<std::string, std::string> typesOfTopics(const rosbag::Bag& bag) {
  std::map<std::string, std::string> types;
  rosbag::View view(bag);
  for (const rosbag::ConnectionInfo* connection : view.getConnections())
    types.emplace(withSlash(connection->topic), connection->datatype);
  return types;
}

std::set<std::string> topicsIn(const std::vector<std::string>& bags) {
  std::set<std::string> topics;
  for (const std::string& path : bags) {
    for (const auto& [topic, type] : typesOfTopics(*openBag(path))) topics.insert(topic);
  }
  return topics;
}

std::vector<std::string> streamsIn(const std::vector<std::string>& bags, const std::string& name_space) {
  const std::string root = rootOf(name_space);
  std::set<std::string> streams;
  for (const std::string& topic : topicsIn(bags)) {
    if (topic.compare(0, root.size(), root) != 0) continue;
    for (const char* kind : {topics::kImage, topics::kCompressedImage}) {
      const std::string ending = std::string("/") + kind;
      if (topic.size() <= root.size() + ending.size()) continue;
      const std::size_t end = topic.size() - ending.size();
      if (topic.compare(end, std::string::npos, ending) != 0) continue;
      const std::string stream = topic.substr(root.size(), end - root.size());
      evaluate::requireStreamName(stream, "the stream of topic " + topic);
      streams.insert(stream);
    }
  }
  return {streams.begin(), streams.end()};
}

std::string topicOf(const std::string& root, const std::string& stream, const char* name) {
  return root + (stream.empty() ? "" : stream + "/") + name;
}

std::string heldImages(const std::string& topic, const std::set<std::string>& held) {
  if (topic.empty() || held.count(topic) > 0) return topic;
  return held.count(topic + kCompressedEnding) > 0 ? topic + kCompressedEnding : "";
}

std::string imageTopic(const std::string& root, const std::string& stream, const std::string& transport,
                       const std::set<std::string>& held) {
  const std::string raw = topicOf(root, stream, topics::kImage);
  const std::string compressed = topicOf(root, stream, topics::kCompressedImage);
  const bool has_raw = held.count(raw) != 0;
  const bool has_compressed = held.count(compressed) != 0;
  if (!has_raw && !has_compressed) {
    throw std::runtime_error("the bags hold neither " + raw + " nor " + compressed +
                             "; they hold: " + topicsInWords(held));
  }
  const std::string& chosen = has_raw && (!has_compressed || transport != "compressed") ? raw : compressed;
  if (has_raw && has_compressed) {
    std::printf("%s: the bags hold raw and compressed images; those of %s count\n", stream.c_str(),
                chosen.c_str());
  }
  return chosen;
}

}  // namespace sunlit::ros_interface
