#include "sunlit/evaluate/files/report.h"

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <thread>
#include <vector>

namespace sunlit::evaluate {
namespace {

/// Whether it ended well. What `stop` throws ends the child first.
bool awaitEnd(pid_t child, const StopToken& stop) {
  constexpr std::chrono::milliseconds kGlance(50);
  int status = 1;
  try {
    while (::waitpid(child, &status, WNOHANG) == 0) {
      stop.check();
      std::this_thread::sleep_for(kGlance);
    }
  } catch (...) {
    ::kill(child, SIGTERM);
    ::waitpid(child, &status, 0);
    throw;
  }
  return status == 0;
}

}  // namespace

bool drawReport(const std::string& folder, ReportTables tables, const StopToken& stop) {
  const std::filesystem::path beside =
      std::filesystem::read_symlink("/proc/self/exe").parent_path() / "report";
  std::vector<std::string> words = {"rosrun", "sunlit", "report", folder};
  if (std::filesystem::exists(beside)) words = {beside.string(), folder};
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  ::posix_spawn_file_actions_init(&actions);
  // rosrun asks where it finds several, which nobody would see.
  ::posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  if (tables == ReportTables::kHidden)
    ::posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  pid_t child = 0;
  const bool has_begun =
      ::posix_spawnp(&child, arguments[0], &actions, nullptr, arguments.data(), environ) == 0;
  ::posix_spawn_file_actions_destroy(&actions);
  return has_begun && awaitEnd(child, stop);
}

}  // namespace sunlit::evaluate
