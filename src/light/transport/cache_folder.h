/// The folder that bakes are kept in, shared with other processes.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>

namespace sunlit::light {

/// The turn to make a bake: held by one process at a time, as long as it lives, and given back by the system
/// when a process dies. Its file is there only while somebody holds it or waits for it.
class BakeTurn {
 public:
  /// Waits for its turn to make `bake`. Throws std::runtime_error with the path if the file can't be made.
  static BakeTurn await(const std::filesystem::path& bake);
  /// Nothing while another process has the turn, or if the file can't be made.
  static std::optional<BakeTurn> ifFree(const std::filesystem::path& bake);

  BakeTurn(BakeTurn&& other) noexcept;
  BakeTurn& operator=(BakeTurn&& other) noexcept;
  ~BakeTurn();

 private:
  BakeTurn(std::filesystem::path file, int descriptor) : file_(std::move(file)), descriptor_(descriptor) {}
  std::filesystem::path file_;
  int descriptor_;
};

/// Keeps a bake in the folder as long as it lives, and marks it as used now. Any number may hold one bake.
class BakeInUse {
 public:
  /// Of a file that can't be opened it holds nothing.
  explicit BakeInUse(const std::filesystem::path& bake);
  ~BakeInUse();
  BakeInUse(const BakeInUse&) = delete;
  BakeInUse& operator=(const BakeInUse&) = delete;

 private:
  int descriptor_;
};

/// Removes what was left by processes that died, and then, until the rest takes no more than `limit_bytes`,
/// bakes that are not in use, first those that have not been used for longest. Touches nothing but files with
/// the names of bakes. What can't be removed is named by one line to `log`.
void tidyCache(const std::filesystem::path& folder, std::uintmax_t limit_bytes,
               const std::function<void(const std::string&)>& log);

}  // namespace sunlit::light
