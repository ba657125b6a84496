#include "sunlit/ros/frame_names.h"

#include <algorithm>
#include <map>
#include <stdexcept>

namespace sunlit::ros_interface {

std::string withoutSlash(const std::string& frame) {
  return frame.substr(std::min(frame.find_first_not_of('/'), frame.size()));
}

void requireFrameNames(const ParameterReader& parameters, const std::vector<Field>& rows) {
  std::map<std::string, std::string> keys;
  for (const Field& row : rows) {
    const std::string name = row.text();
    const std::string parameter = "parameter " + parameters.fullName(row.key) + " is \"" + name + "\", but ";
    if (name.empty() || name.front() == '/')
      throw std::invalid_argument(parameter + "must be the name of a TF frame, without a slash in front");
    const auto [known, is_new] = keys.emplace(name, row.key);
    if (!is_new)
      throw std::invalid_argument(parameter + parameters.fullName(known->second) + " is called so already");
  }
}

}  // namespace sunlit::ros_interface
