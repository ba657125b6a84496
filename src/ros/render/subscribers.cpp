#include "ros/render/subscribers.h"

#include <algorithm>

namespace sunlit::ros_interface {

bool Subscribers::are(const Audience& wanted) const {
  int listen = 0;
  for (const auto& [node, links] : *links_) {
    if (wanted.of.empty() || std::find(wanted.of.begin(), wanted.of.end(), node) != wanted.of.end()) ++listen;
  }
  return listen >= wanted.size;
}

}  // namespace sunlit::ros_interface
