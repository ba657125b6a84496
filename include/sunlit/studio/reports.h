/// What work that takes its time tells a person.
#pragma once

#include <functional>
#include <string>

#include "sunlit/light/transport.h"

namespace sunlit::light {
struct World;
}

namespace sunlit::studio {

/// Each may be left unset, and is called on a thread of the work, never on two at once.
struct Reports {
  std::function<void(const std::string& line)> note;     ///< what was done, or is about to be
  std::function<void(const std::string& line)> warning;  ///< what was amiss, and was made good
  light::BakeProgress baking;                            ///< how far a bake is, many times a second
  /// Called many times a second while another process bakes; what it throws, or `baking`, ends the work.
  std::function<void()> check = {};
  /// What Studio has loaded and is about to bake, with its light::fingerprint(); what it throws ends the
  /// work.
  std::function<void(const light::World& world, const std::string& fingerprint)> loaded = {};
  /// A warning of what the files of world and stars have amiss, which all who read them find alike; unset:
  /// `warning` gets it.
  std::function<void(const std::string& line)> flaw = {};
};

}  // namespace sunlit::studio
