#include "light/geometry/embree_fault.h"

#include <stdexcept>

#include "sunlit/quantity/memory.h"

namespace sunlit::light {

void failWith(RTCError error, const std::string& doing) {
  if (error == RTC_ERROR_OUT_OF_MEMORY) throw OutOfMemory(doing);
  throw std::runtime_error("ray library (Embree): " + doing + ": error code " +
                           std::to_string(static_cast<int>(error)));
}

void requireFine(RTCDevice device, const std::string& doing) {
  const RTCError error = rtcGetDeviceError(device);
  if (error != RTC_ERROR_NONE) failWith(error, doing);
}

}  // namespace sunlit::light
