#include "tools/output_folder.h"

#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <stdexcept>
#include <system_error>

namespace sunlit::tools {

namespace {

[[noreturn]] void fail(const std::string& folder, const std::error_code& why) {
  throw std::runtime_error(folder + ": the folder cannot be made or written: " + why.message());
}

}  // namespace

void requireFolderCanBeMade(const std::string& folder) {
  std::error_code error;
  std::filesystem::path there = std::filesystem::absolute(folder);
  while (!std::filesystem::exists(there, error) && there.has_relative_path()) there = there.parent_path();
  if (!std::filesystem::is_directory(there, error))
    fail(folder, std::make_error_code(std::errc::not_a_directory));
  if (::access(there.c_str(), W_OK | X_OK) != 0) fail(folder, {errno, std::generic_category()});
}

std::string anythingIn(const std::string& folder) {
  constexpr const char* kUnfinished = ".part";  // as image::writeFileAtomically() has it
  std::error_code error;                        // no such folder: nothing
  std::string first;
  for (const auto& entry : std::filesystem::directory_iterator(folder, error)) {
    const std::string name = entry.path().filename().string();
    if (entry.path().extension() != kUnfinished && (first.empty() || name < first)) first = name;
  }
  return first;
}

}  // namespace sunlit::tools
