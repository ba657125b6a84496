// What becomes of tasks, and where threads lack.
#include "evaluate/run/work_queue.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <stdexcept>
#include <string>

namespace sunlit::evaluate {
namespace {

/// Of this process: `processes` of an ordinary user, who cannot have more.
void allow(rlim_t processes) {
  const rlimit limit{processes, processes};
  constexpr uid_t kNobody = 65534;
  if (getuid() == 0 && setuid(kNobody) != 0) std::_Exit(1);
  if (setrlimit(RLIMIT_NPROC, &limit) != 0) std::_Exit(1);
}

TEST(WorkQueueDeathTest, SaysWhatLacksWhereNoThreadCanBeStarted) {
  const auto start = [] {
    allow(0);
    try {
      const WorkQueue queue(3);
    } catch (const std::runtime_error& error) {
      std::fprintf(stderr, "%s\n", error.what());
      std::_Exit(3);
    }
    std::_Exit(0);
  };
  EXPECT_EXIT(start(), testing::ExitedWithCode(3), "no thread can be started .*: raise ulimit -u");
}

TEST(WorkQueue, TakesAllTasksAndThrowsWhatOneThrew) {
  std::atomic<int> done{0};
  {
    WorkQueue queue(3);
    for (int i = 0; i < 100; ++i) queue.add([&done] { ++done; });
    queue.waitForAtMost(0);
    EXPECT_EQ(done, 100);
    EXPECT_EQ(queue.size(), 0u);
    EXPECT_NO_THROW(queue.rethrow());
    queue.add([] { throw std::runtime_error("no"); });
    queue.waitForAtMost(0);
    EXPECT_THROW(queue.rethrow(), std::runtime_error);
  }
  EXPECT_EQ(done, 100);
}

}  // namespace
}  // namespace sunlit::evaluate
