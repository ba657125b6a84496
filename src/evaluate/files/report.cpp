#include "sunlit/evaluate/files/report.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <vector>

namespace sunlit::evaluate {

bool drawReport(const std::string& folder, ReportTables tables) {
  const std::filesystem::path beside =
      std::filesystem::read_symlink("/proc/self/exe").parent_path() / "report";
  std::vector<std::string> words = {"rosrun", "sunlit", "report", folder};
  if (std::filesystem::exists(beside)) words = {beside.string(), folder};
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  ::posix_spawn_file_actions_init(&actions);
  if (tables == ReportTables::kHidden)
    ::posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  pid_t child = 0;
  int status = 1;
  const bool has_begun =
      ::posix_spawnp(&child, arguments[0], &actions, nullptr, arguments.data(), environ) == 0;
  ::posix_spawn_file_actions_destroy(&actions);
  return has_begun && ::waitpid(child, &status, 0) == child && status == 0;
}

}  // namespace sunlit::evaluate
