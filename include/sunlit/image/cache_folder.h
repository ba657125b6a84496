/// A folder of what would take long to make again, shared by processes.
///
/// Files are named by the hash of what they were made from. Whoever makes one takes its turn first, writes
/// beside it (NAME.NUMBER.part, or an UnfinishedFile) and renames, so that only whole files have the
/// name.
#pragma once

#include <cstdint>
#include <exception>
#include <filesystem>
#include <functional>
#include <limits>
#include <optional>
#include <string>

namespace sunlit::image {

/// SUNLIT_CACHE_DIR, or sunlit in XDG_CACHE_HOME, or .cache/sunlit in HOME, or else in the system's temporary
/// folder.
std::string usualCacheFolder();

/// What is told where `what` ("baked light is") cannot be kept in such a folder: why, without what libraries
/// say around it, and how another folder is named.
std::string notKeptText(const std::string& what, const std::exception& problem);

/// How far whoever has the turn to make a file is with it.
struct CacheProgress {
  double share = std::numeric_limits<double>::quiet_NaN();         ///< 0 … 1; NaN: not told
  double seconds_left = std::numeric_limits<double>::quiet_NaN();  ///< NaN: not told
};

/// The turn to make a file: held by one process at a time, as long as it lives, and given back by the system
/// when a process dies. Its own file is there only while somebody holds it or waits for it.
class CacheTurn {
 public:
  using Waits = std::function<void(const CacheProgress&)>;  ///< takes what the other one told last
  /// Waits for its turn to make `kept`, and calls `waits` again and again while another has it: what that
  /// throws ends the wait. Throws std::system_error with the path if its file can't be made.
  static CacheTurn await(const std::filesystem::path& kept, const Waits& waits = nullptr);
  /// Nothing while another has the turn, or if its file can't be made.
  static std::optional<CacheTurn> ifFree(const std::filesystem::path& kept);

  CacheTurn(CacheTurn&& other) noexcept;
  CacheTurn& operator=(CacheTurn&& other) noexcept;
  ~CacheTurn();

  /// Tells those who wait. That it can't is no error.
  void tell(const CacheProgress& progress) const;

 private:
  CacheTurn(std::filesystem::path file, int descriptor) : file_(std::move(file)), descriptor_(descriptor) {}
  std::filesystem::path file_;
  int descriptor_;
};

/// Keeps a file in the folder as long as it lives, and marks it as used now. Any number may hold one file.
class CacheUse {
 public:
  /// Of a file that can't be opened it holds nothing.
  explicit CacheUse(const std::filesystem::path& kept);
  ~CacheUse();
  CacheUse(const CacheUse&) = delete;
  CacheUse& operator=(const CacheUse&) = delete;

 private:
  int descriptor_;
};

/// Those files of a folder that are named by 32 hexadecimal digits (ContentHash::text()) and `ending`.
struct CacheFolder {
  using Log = std::function<void(const std::string&)>;  ///< takes one line of what went wrong; may be empty

  std::filesystem::path path;
  std::string ending;  ///< such as ".light"

  /// What they take now; 0 where there is no such folder.
  std::uintmax_t usedBytes() const;
  /// Removes what was left by processes that died, and then, until the rest takes no more than `limit_bytes`,
  /// files that are not in use, first those that have not been used for longest; none that was used at
  /// `since` or later. Touches nothing of other names. Returns what the rest takes.
  std::uintmax_t tidy(std::uintmax_t limit_bytes, const Log& log,
                      std::filesystem::file_time_type since = std::filesystem::file_time_type::max()) const;
};

}  // namespace sunlit::image
