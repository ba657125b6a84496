#include "sunlit/quantity/memory.h"

#include <gtest/gtest.h>

#include <sys/resource.h>
#include <unistd.h>

#include <cstdint>
#include <new>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

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

std::int64_t pagesTaken() {
  struct rusage usage {};
  getrusage(RUSAGE_SELF, &usage);
  return usage.ru_minflt;
}

int takeAndFree(std::size_t bytes) {
  const std::vector<char> one(bytes, 1), other(bytes / 8, 1);
  return one[bytes / 2] + other[1];
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

#if defined(__GLIBC__) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
// By threads, too, whose heaps are others. A hundredth is left to what else takes a page meanwhile.
TEST(Memory, ThatIsKeptIsNotTakenFromTheSystemAgain) {
  constexpr std::size_t kBytes = std::size_t{40} << 20;
  keepFreedMemory();
  const auto look = [] {
    takeAndFree(kBytes);
    const std::int64_t before = pagesTaken();
    for (int again = 0; again < 5; ++again) EXPECT_EQ(takeAndFree(kBytes), 2);
    EXPECT_LT(pagesTaken() - before, static_cast<std::int64_t>(kBytes) / sysconf(_SC_PAGESIZE) / 100);
  };
  look();
  std::thread(look).join();
}
#endif
