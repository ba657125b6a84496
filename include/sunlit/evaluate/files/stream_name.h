/// Names of streams: part of topics, and of the folders of their pictures.
#pragma once

#include <string>

namespace sunlit::evaluate {

/// A relative ROS graph name: parts of letters, digits and underscores, joined by single slashes, of which
/// the first begins with a letter. So no name leads out of the folder that it is put under.
bool isStreamName(const std::string& name);
/// Refuses what is none; in messages it is `called` so, such as "a name in streams".
void requireStreamName(const std::string& name, const std::string& called);

/// A stream beside itself, or beside its second rendering, which experiments call self_test/NAME.
bool isSelfTest(const std::string& a, const std::string& b);

}  // namespace sunlit::evaluate
