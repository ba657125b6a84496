/// Bags, and the streams of images that they hold.
#pragma once

#include <rosbag/bag.h>
#include <rosbag/query.h>

#include <functional>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

namespace sunlit::ros_interface {

/// Throws std::runtime_error with path and reason for a bag that cannot be read, and what mends one that was
/// cut off.
std::unique_ptr<rosbag::Bag> openBag(const std::string& path);

/// Calls `read`, which reads messages of the bag; throws std::runtime_error that names it where it is damaged
/// inside, be its index whole.
void readingBag(const std::string& path, const std::function<void()>& read);

/// "/" or "/name/…/".
std::string rootOf(const std::string& name_space);

/// As topics are called here: some tools write bags whose topics lack the leading slash.
std::string withSlash(const std::string& topic);

/// Of these topics, with their slash or without.
rosbag::TopicQuery topicQuery(const std::vector<std::string>& topics);

/// "a, b", or "nothing".
std::string topicsInWords(const std::set<std::string>& topics);

/// Of each topic, with its slash: what its messages are, "sensor_msgs/Image".
std::map<std::string, std::string> typesOfTopics(const rosbag::Bag& bag);

/// Each with its slash.
std::set<std::string> topicsIn(const std::vector<std::string>& bags);

/// Names, in alphabetical order, of which the bags hold <name_space>/<name>/camera/image_raw, or that with
/// /compressed. Throws std::runtime_error for a bag that cannot be read, and std::invalid_argument for a
/// topic whose name is none of a stream.
std::vector<std::string> streamsIn(const std::vector<std::string>& bags, const std::string& name_space);

/// "root/stream/name", and of a stream without a name "root/name".
std::string topicOf(const std::string& root, const std::string& stream, const char* name);

/// Behind the name of a topic, of the same images as PNG or JPEG.
inline constexpr const char* kCompressedEnding = "/compressed";

/// The topic that is said to have images, or that with /compressed where the bags hold this alone; empty
/// where they hold neither.
std::string heldImages(const std::string& topic, const std::set<std::string>& held);

/// The topic of a stream's images, of which `held` has some; where they are there twice, one kind counts:
/// compressed for that `transport`, else raw, and it is said which. Throws std::runtime_error where there are
/// none.
std::string imageTopic(const std::string& root, const std::string& stream, const std::string& transport,
                       const std::set<std::string>& held);

}  // namespace sunlit::ros_interface
