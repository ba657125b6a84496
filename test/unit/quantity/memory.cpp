#include "sunlit/quantity/memory.h"

#include <gtest/gtest.h>

#include <new>
#include <stdexcept>
#include <string>

using namespace sunlit;

namespace {

template <typename Work>
std::string toldOf(const Work& work) {
  try {
    work();
  } catch (const std::exception& error) {
    return reasonInWords(error);
  }
  return "";
}

[[noreturn]] void findNone() {
  throw std::bad_alloc();
}

}  // namespace

TEST(Memory, ThatEndsIsToldInWords) {
  EXPECT_EQ(toldOf(findNone), "not enough memory");
  EXPECT_EQ(toldOf([] { inMemory("loading a world", findNone); }), "not enough memory: loading a world");
}

TEST(Memory, ThatEndsIsToldByWhatWasMadeThenAndNotByWhatThatIsPartOf) {
  EXPECT_EQ(toldOf([] { inMemory("a run", [] { inMemory("a picture", findNone); }); }),
            "not enough memory: a picture");
}

TEST(Memory, WorkThatFindsEnoughHandsOnWhatItGivesAndThrows) {
  EXPECT_EQ(inMemory("a sum", [] { return 2 + 3; }), 5);
  EXPECT_EQ(toldOf([] { inMemory("a file", [] { throw std::runtime_error("a.csv: broken"); }); }),
            "a.csv: broken");
}
