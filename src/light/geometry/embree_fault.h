/// What goes wrong in the ray library.
#pragma once

#include <string>

#include "light/geometry/embree.h"

namespace sunlit::light {

/// Throws OutOfMemory where `error` says so, else std::runtime_error with its number. `doing`: as for
/// OutOfMemory.
[[noreturn]] void failWith(RTCError error, const std::string& doing);

/// Throws so for the first fault of `device` that nobody has asked for yet; without a device, for that of its
/// making. Nothing where there is none.
void requireFine(RTCDevice device, const std::string& doing);

}  // namespace sunlit::light
