#include "sunlit/quantity/late_library.h"

#include <gtest/gtest.h>

#include <stdexcept>
#include <utility>

#include "sunlit/quantity/memory.h"

namespace sunlit {
namespace {

std::string faultOf(const std::string& library, const std::string& name) {
  try {
    addressIn(library, name);
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "";
}

TEST(LateLibrary, LiesBesideTheOneThatAsks) {
  // By the name that compilers of this ABI give it.
  EXPECT_EQ(addressIn("libsunlit_quantity.so", "_ZN6sunlit15keepFreedMemoryEv"),
            reinterpret_cast<void*>(&keepFreedMemory));
}

TEST(LateLibrary, ThatIsMissingOrAnotherIsNamedWithWhatToDo) {
  for (const auto& [library, name] :
       {std::pair("libsunlit_nowhere.so", "any"), {"libsunlit_quantity.so", "nowhere"}}) {
    const std::string fault = faultOf(library, name);
    EXPECT_EQ(fault.front(), '/') << fault;
    EXPECT_NE(fault.find(std::string("/") + library + ": a part of sunlit cannot be loaded ("),
              std::string::npos)
        << fault;
    EXPECT_NE(fault.find("nowhere"), std::string::npos) << fault;
    EXPECT_NE(fault.find("): build or install sunlit again"), std::string::npos) << fault;
  }
}

}  // namespace
}  // namespace sunlit
