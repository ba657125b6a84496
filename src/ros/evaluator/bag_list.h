/// Which bags the results in a folder are of.
#pragma once

#include <rosbag/bag.h>

#include <memory>
#include <string>
#include <vector>

namespace sunlit::ros_interface {

/// Throws std::invalid_argument where `folder` holds results of a bag that is not among these: values go by
/// stamps, and every simulation begins at 0. A bag is known again by its size, stamps and count of messages,
/// wherever it lies; a folder that no bag was noted for is taken as it is.
void requireSameBags(const std::string& folder, const std::vector<std::unique_ptr<rosbag::Bag>>& bags);

/// Notes these, before the first result.
void noteBags(const std::string& folder, const std::vector<std::unique_ptr<rosbag::Bag>>& bags);

}  // namespace sunlit::ros_interface
