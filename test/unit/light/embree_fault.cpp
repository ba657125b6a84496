#include "light/geometry/embree_fault.h"

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>

#include "light/geometry/triangle_mesh.h"

using namespace sunlit::light;

namespace {

std::string faultOfRays(RTCError error) {
  try {
    failWith(error, treeOf(12));
  } catch (const std::runtime_error& thrown) {
    return thrown.what();
  }
}

}  // namespace

TEST(EmbreeFault, OfMemoryIsToldAsAllMemoryThatEnds) {
  EXPECT_EQ(faultOfRays(RTC_ERROR_OUT_OF_MEMORY), "not enough memory: a tree of 12 triangles for rays");
}

TEST(EmbreeFault, OfAnotherKindHasItsNumber) {
  EXPECT_EQ(faultOfRays(RTC_ERROR_UNSUPPORTED_CPU),
            "ray library (Embree): a tree of 12 triangles for rays: error code 5");
}

TEST(EmbreeFault, IsNoneWhereAllIsWell) {
  const DevicePointer device = newDevice();
  EXPECT_NO_THROW(requireFine(device.get(), "nothing"));
}
