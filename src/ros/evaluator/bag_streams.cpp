#include "ros/evaluator/bag_streams.h"

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>
#include <stdexcept>
#include <utility>

#include "ros/evaluator/bag_topics.h"
#include "sunlit/quantity/columns.h"
#include "sunlit/quantity/comma_list.h"
#include "sunlit/ros/topic_names.h"

namespace sunlit::ros_interface {
namespace {

namespace fs = std::filesystem;

/// As typed.
struct NamedBag {
  std::string bag;
  std::vector<std::string> streams;  ///< empty: not said
};

NamedBag namedBag(const std::string& text) {
  NamedBag named;
  const std::size_t colon = text.rfind(':');
  if (colon == std::string::npos || fs::exists(text)) {
    named.bag = text;
    return named;
  }
  named.bag = text.substr(0, colon);
  named.streams = splitAtCommas(text.substr(colon + 1));
  return named;
}

std::vector<std::string> imageStreamsIn(const std::string& bag, const ViewTopics& topics) {
  const std::set<std::string> held = topicsIn({bag});
  if (!heldImages(topics.images, held).empty()) return {""};
  std::vector<std::string> streams = streamsIn({bag}, topics.name_space);
  const std::string root = rootOf(topics.name_space);
  for (const char* kind : {topics::kImage, topics::kCompressedImage}) {
    if (held.count(topicOf(root, "", kind)) > 0 && (streams.empty() || !streams[0].empty()))
      streams.insert(streams.begin(), "");
  }
  if (streams.empty()) {
    throw std::runtime_error(
        bag + ": holds no image below " + root +
        ": neither <stream>/camera/image_raw nor that with /compressed" +
        (topics.images.empty() ? ", and --images TOPIC was not given" : ", nor " + topics.images) +
        "; it holds: " + topicsInWords(held));
  }
  return streams;
}

std::string listed(std::vector<std::string> streams) {
  std::replace(streams.begin(), streams.end(), std::string(), std::string("one without a name"));
  return commaList(streams);
}

bool isSameBag(const std::string& a, const std::string& b) {
  std::error_code none;
  return a == b || fs::equivalent(a, b, none);
}

bool isSameStream(const BagStream& a, const BagStream& b) {
  return a.stream == b.stream && isSameBag(a.bag, b.bag);
}

std::vector<BagStream> streamsOf(const NamedBag& named, const std::vector<std::string>& held) {
  std::vector<BagStream> streams;
  for (const std::string& name : named.streams) {
    if (std::count(held.begin(), held.end(), name) == 0)
      throw std::runtime_error(named.bag + ": holds no stream " + name + "; it holds: " + listed(held));
    streams.push_back({named.bag, name, name.empty() ? fs::path(named.bag).stem().string() : name});
  }
  return streams;
}

std::vector<BagStream> mapStreams(const std::string& text, const ViewTopics& topics) {
  NamedBag named = namedBag(text);
  const std::vector<std::string> held = imageStreamsIn(named.bag, topics);
  if (named.streams.empty() && held.size() > 1) {
    throw std::invalid_argument(named.bag + ": holds the streams " + listed(held) +
                                ": say which the map is made of, as in --map " + text + ":" + held.back());
  }
  if (named.streams.empty()) named.streams = held;
  return streamsOf(named, held);
}

std::vector<BagStream> queryStreams(const std::string& text, const ViewTopics& topics,
                                    const std::vector<BagStream>& map) {
  NamedBag named = namedBag(text);
  const std::vector<std::string> held = imageStreamsIn(named.bag, topics);
  if (!named.streams.empty()) return streamsOf(named, held);
  for (const std::string& stream : held) {
    const bool is_of_map = std::any_of(map.begin(), map.end(), [&](const BagStream& other) {
      return isSameStream(other, {named.bag, stream, ""});
    });
    if (!is_of_map) named.streams.push_back(stream);
  }
  if (named.streams.empty())
    throw std::invalid_argument(named.bag + ": holds no stream but the map's: " + listed(held));
  return streamsOf(named, held);
}

/// What a stream is called by its own name and so many of the last parts of its bag's path, of which the
/// file's name is one; one that has no name of its own is called by that part anyway. Empty where there are
/// fewer.
std::string nameByBag(const BagStream& stream, std::size_t parts) {
  const fs::path path = fs::absolute(stream.bag).lexically_normal().relative_path();
  std::string name = stream.name;
  fs::path folder = path.parent_path();
  if (!stream.stream.empty() && parts > 0) {
    name = path.stem().string() + "_" + name;
    --parts;
  }
  for (; parts > 0; --parts, folder = folder.parent_path()) {
    if (folder.empty()) return "";
    name = folder.filename().string() + "_" + name;
  }
  return name;
}

/// Streams of one name, but of several bags, are called by their bags too, whether of the map or not; and by
/// as many of the folders around them as tell them apart.
std::vector<BagStream> toldApart(const std::vector<BagStream>& streams, const std::vector<BagStream>& all) {
  std::vector<BagStream> apart = streams;
  std::set<std::string> names;
  for (BagStream& stream : apart) {
    const auto isShared = [&](std::size_t parts) {
      return std::any_of(all.begin(), all.end(), [&](const BagStream& other) {
        return nameByBag(other, parts) == nameByBag(stream, parts) && !isSameStream(other, stream);
      });
    };
    std::size_t parts = 0;
    while (isShared(parts) && !nameByBag(stream, parts + 1).empty()) ++parts;
    stream.name = nameByBag(stream, parts);
    if (!names.insert(stream.name).second)
      throw std::invalid_argument(stream.bag + ": a second stream would be called " + stream.name +
                                  ": each counts once, and bags need names of their own");
  }
  return apart;
}

/// A file of one would else be written over by that of another, and only once all is done.
void requireOwnFiles(const std::vector<BagStream>& streams) {
  std::map<std::string, std::string> names;
  for (const BagStream& stream : streams) {
    const auto [other, is_first] = names.emplace(stream.fileName(), stream.name);
    if (!is_first) {
      throw std::invalid_argument(other->second + " and " + stream.name + " are both " + stream.fileName() +
                                  " in names of files: each needs a run and an --out of its own");
    }
  }
}

/// A misspelt topic would else count for nothing.
void requireHeld(const ViewTopics& topics, const std::vector<BagStream>& streams) {
  if (topics.images.empty() && topics.camera_info.empty() && topics.depth.empty() && topics.poses.empty())
    return;  // large bags take long to open
  std::vector<std::string> bags;
  for (const BagStream& stream : streams) bags.push_back(stream.bag);
  const std::set<std::string> held = topicsIn(bags);
  for (const auto& [option, topic] : {std::pair{"--images", &topics.images},
                                      {"--camera-info", &topics.camera_info},
                                      {"--depth", &topics.depth},
                                      {"--poses", &topics.poses}}) {
    const bool is_there =
        topic == &topics.images ? !heldImages(*topic, held).empty() : held.count(*topic) > 0;
    if (!topic->empty() && !is_there) {
      throw std::runtime_error(std::string(option) + " is " + *topic +
                               ", but must be a topic that a bag holds; they hold: " + topicsInWords(held));
    }
  }
}

}  // namespace

std::string BagStream::fileName() const {
  std::string file = name;
  std::replace(file.begin(), file.end(), '/', '_');
  return file;
}

LocalisationStreams localisationStreams(const std::vector<std::string>& maps,
                                        const std::vector<std::string>& queries, const ViewTopics& topics) {
  LocalisationStreams streams;
  for (const std::string& text : maps) {
    for (const BagStream& stream : mapStreams(text, topics)) streams.map.push_back(stream);
  }
  for (const std::string& text : queries) {
    for (const BagStream& stream : queryStreams(text, topics, streams.map)) streams.queries.push_back(stream);
  }
  std::vector<BagStream> all = streams.map;
  all.insert(all.end(), streams.queries.begin(), streams.queries.end());
  requireHeld(topics, all);
  streams = {toldApart(streams.map, all), toldApart(streams.queries, all)};
  requireOwnFiles(streams.queries);
  return streams;
}

}  // namespace sunlit::ros_interface
