/// Which streams of which bags make a map, and which are looked for in it.
#pragma once

#include <string>
#include <vector>

#include "ros/evaluator/view_topics.h"

namespace sunlit::ros_interface {

struct BagStream {
  std::string bag;     ///< path
  std::string stream;  ///< a condition's name; empty: that of topics without one, camera/image_raw
  std::string name;    ///< what it is called in tables
  /// What it is called in names of files: stereo_left of stereo/left, since a file lies in no folder of its
  /// stream.
  std::string fileName() const;
};

struct LocalisationStreams {
  std::vector<BagStream> map, queries;
};

/// Each of `maps` and `queries` is "BAG" or "BAG:STREAM,STREAM"; what is a file as a whole is a BAG. A map's
/// BAG without streams must have one only; of a query's, all count but those of the same bag that the map is
/// made of. Streams are called by their names, those without a name by that of the bag; of several bags,
/// those of one name by that of the bag, too, and of bags of one name by the folders that tell these apart.
/// Throws std::runtime_error for a bag that cannot be read or has no such streams, and std::invalid_argument
/// where the map, the queries or names of their own, in tables or in files, are missing.
LocalisationStreams localisationStreams(const std::vector<std::string>& maps,
                                        const std::vector<std::string>& queries, const ViewTopics& topics);

}  // namespace sunlit::ros_interface
