// Slightly wrong inputs, the same each time, end no process, hang none and need no absurd memory.
#include <gtest/gtest.h>
#include <signal.h>
#include <stdlib.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <string>

#include "fuzz/mutate.h"
#include "fuzz/reader.h"
#include "fuzz/trial.h"
#include "support/temporary_folder.h"

namespace sunlit::fuzz {
namespace {

constexpr std::size_t kLongest_bytes = std::size_t{1} << 20;
constexpr rlim_t kMostMemory_bytes = rlim_t{4} << 30;  // of addresses; threads reserve some
constexpr int kMostTime_s = 30;                        // of the wall clock, on a busy machine
constexpr std::size_t kMostFaults = 10;

/// Has temporary folders made in memory, where there is such a place: files are written over some thousand
/// times, for which a disk would be waited for each time.
void keepOffDisks() {
  const char* const memory = "/dev/shm";
  if (::access(memory, W_OK | X_OK) == 0) ::setenv("TMPDIR", memory, 1);
}

/// What parent and child share: what is being read.
struct Shared {
  std::size_t number, size;
  std::size_t read;  ///< so many were taken without complaint
  char input[kLongest_bytes];
  char fault[4096];
};

std::string inputOf(std::size_t number, const std::vector<std::string>& all) {
  if (number < all.size()) return all[number];
  Dice dice(number);
  std::string input = mutated(all[dice.below(all.size())], all, dice);
  input.resize(std::min(input.size(), kLongest_bytes));
  return input;
}

/// A seed is read without complaint.
std::string faultOfSeed(const std::string& seed) {
  try {
    read(seed);
  } catch (const std::exception& error) {
    return std::string("is a seed, but is refused: ") + error.what();
  }
  return "";
}

/// All from `first` on. Ends the process at the first that is no good, with what is known of it in `shared`.
[[noreturn]] void readAll(std::size_t first, Shared* shared) {
  const rlimit memory{kMostMemory_bytes, kMostMemory_bytes}, no_core{0, 0};
  ::setrlimit(RLIMIT_AS, &memory);
  ::setrlimit(RLIMIT_CORE, &no_core);
  if (std::freopen("/dev/null", "w", stdout) == nullptr || std::freopen("/dev/null", "w", stderr) == nullptr)
    ::_exit(2);
  const std::vector<std::string> all = seeds();
  for (std::size_t i = first; i < kTrial.cases; ++i) {
    const std::string input = inputOf(i, all);
    shared->number = i;
    shared->size = input.size();
    std::memcpy(shared->input, input.data(), input.size());
    const itimerval time{{0, 0}, {kMostTime_s, 0}};
    ::setitimer(ITIMER_REAL, &time, nullptr);
    const std::string fault = i < all.size() ? faultOfSeed(input) : faultOf(input);
    if (!fault.empty()) {
      std::strncpy(shared->fault, fault.c_str(), sizeof(shared->fault) - 1);
      ::_exit(1);
    }
    ++shared->read;
  }
  ::_exit(0);
}

std::string told(int status, const Shared& shared) {
  if (WIFEXITED(status)) return WEXITSTATUS(status) == 1 ? shared.fault : "ended the process";
  if (WTERMSIG(status) == SIGALRM) return "was not read within " + std::to_string(kMostTime_s) + " s";
  return std::string("ended the process: ") + ::strsignal(WTERMSIG(status));
}

/// The file that keeps what `shared` holds.
std::string keep(const Shared& shared) {
  const std::string file =
      std::string(SUNLIT_FUZZ_KEPT) + "/" + kTrial.reader + "_" + std::to_string(shared.number);
  setContent(file, std::string(shared.input, shared.size));
  return file;
}

TEST(SlightlyWrongInputs, AreReadOrRefused) {
  keepOffDisks();
  const TemporaryFolder folder;
  std::filesystem::current_path(folder.path());
  void* const memory =
      ::mmap(nullptr, sizeof(Shared), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  ASSERT_NE(memory, MAP_FAILED);
  auto* const shared = static_cast<Shared*>(memory);
  std::size_t first = 0;
  for (std::size_t faults = 0; first < kTrial.cases && faults < kMostFaults; ++faults) {
    const pid_t child = ::fork();
    ASSERT_GE(child, 0);
    if (child == 0) readAll(first, shared);
    int status = 0;
    ASSERT_EQ(::waitpid(child, &status, 0), child);
    if (WIFEXITED(status) && WEXITSTATUS(status) == 0) break;
    ADD_FAILURE() << kTrial.reader << ", input " << shared->number << " " << told(status, *shared)
                  << "\nIt is kept in " << keep(*shared);
    first = shared->number + 1;
  }
  std::filesystem::current_path("/");
  ::munmap(memory, sizeof(Shared));
}

}  // namespace
}  // namespace sunlit::fuzz
