/// SDF as text, for tests.
#pragma once

#include <string>

namespace sunlit::scene {

inline std::string world(const std::string& content, const std::string& version = "1.9") {
  return "<?xml version='1.0'?><sdf version='" + version + "'><world name='w'>" + content + "</world></sdf>";
}

/// A box of 2 × 4 × 6 m.
inline std::string boxVisual(const std::string& pose = "") {
  return "<visual name='v'>" + (pose.empty() ? "" : "<pose>" + pose + "</pose>") +
         "<geometry><box><size>2 4 6</size></box></geometry></visual>";
}

}  // namespace sunlit::scene
